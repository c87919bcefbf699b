// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>

#include "cli/options/options.hpp"
#include "cli/run/exit_code.hpp"
#include "cli/run/session.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/model/scene.hpp"

namespace strake::cli {

/// Warns of two files that may be of different units: that of one at least is only assumed, and the
/// extents of the one are those of the other times what one unit of length is in another.
void note_doubtful_units(model::Scene& scene);

/// Which bodies take part, how finely curved ones are tessellated and which seams of meshes close,
/// as written.
struct SceneInput {
  std::string sag, weld;
  bool obstructions = false, insulation = false;
};

void add_scene_options(CLI::App& command, SceneInput& options, const std::string& default_sag);
/// `default_sag_mm` where --sag was not given.
[[nodiscard]] Result<model::SceneOptions> scene_options(const SceneInput& input,
                                                        double default_sag_mm);

/// The files of the command line as one model, and that model on the grid.
struct Loaded {
  std::unique_ptr<const model::Model> model;  ///< what the scene refers to
  model::Scene scene;

  /// What reading and placing noticed.
  [[nodiscard]] Diagnostics diagnostics() const;
};

/// Reads the files of the command line, puts them on the grid, and tells what was noticed.
[[nodiscard]] Result<Loaded> load(Session& session, const InputOptions& input,
                                  const model::SceneOptions& options);

/// `done`, or `partial` where --strict was given and something was skipped.
[[nodiscard]] ExitCode strict_exit_code(const InputOptions& input, const Loaded& loaded);

/// One line per kind of diagnostic: how often, and the first in its own words. Of the kinds in
/// `each`, every one.
void print_diagnostics(Console& console, const Diagnostics& diagnostics,
                       std::initializer_list<std::string_view> each = {});

}  // namespace strake::cli
