// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/options/options.hpp"
#include "cli/run/exit_code.hpp"
#include "cli/run/session.hpp"
#include "strake/clash/incremental.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/model/scene.hpp"
#include "strake/rules/rules.hpp"

/// Loads the models of a command line and prints what was noticed.
namespace strake::cli {

/// Warns of two files that may be of different units: their extents differ by the ratio of two
/// units of length, and the unit of one is only assumed, or nobody has said that of either. Errors:
/// cancelled, out of memory.
[[nodiscard]] Status note_doubtful_units(model::Scene& scene, const parallel::Context& context);

/// Which bodies take part, how finely curved ones are tessellated and which seams of meshes are
/// closed, as written.
struct SceneInput {
  std::string sag, weld;
  bool obstructions = false, insulation = false;
};

void add_scene_options(CLI::App& command, SceneInput& options, const std::string& default_sag);
/// Parses the options; uses `default_sag_mm` where --sag was not given.
[[nodiscard]] Result<model::SceneOptions> scene_options(const SceneInput& input,
                                                        double default_sag_mm);

/// The files of the command line as one model, and that model on the grid.
struct LoadedModel {
  /// The model that the scene refers to. It is taken down by the workers of the session, which it
  /// must not outlive.
  std::shared_ptr<const model::Model> model;
  model::Scene scene;
  /// The model files; of a project those that it was made of.
  std::vector<std::filesystem::path> files = {};

  // Of a project, what project::SignedModel has; otherwise nothing.
  std::vector<Hash128> shape_hashes = {};
  Hash128 names = {};
  std::vector<clash::HashedBodies> bodies = {};

  /// Returns all of it that hashes of objects may be made from.
  [[nodiscard]] clash::KnownModel known() const { return {shape_hashes, bodies, names}; }

  /// Returns what reading and placing noticed.
  [[nodiscard]] Diagnostics diagnostics() const;
};

/// Prints what was read of each file of a model, and what was noticed.
void print_model_notes(Session& session, const model::Model& model);

/// Reads the files of the command line and prints what was noticed, as load() does, but puts
/// nothing on the grid.
[[nodiscard]] Result<model::Model> load_model(Session& session, const InputOptions& input);

/// Puts a model on the grid, and prints what was noticed.
[[nodiscard]] Result<LoadedModel> place(Session& session, model::Model model,
                                        const model::SceneOptions& options);

/// Reads the files of the command line, puts them on the grid, and prints what was noticed;
/// `file_settings` is what rules say of them, if there are any. Of a project it takes the model, as
/// it was read. Errors: usage where rules say otherwise of a file of a project than it was read.
[[nodiscard]] Result<LoadedModel> load(Session& session, const InputOptions& input,
                                       const model::SceneOptions& options,
                                       std::span<const rules::FileSettings> file_settings = {});

/// Returns `done`, or `partial` where --strict was given and something was skipped.
[[nodiscard]] ExitCode strict_exit_code(const InputOptions& input, const Diagnostics& diagnostics);
[[nodiscard]] ExitCode strict_exit_code(const InputOptions& input, const LoadedModel& loaded);

/// Prints one line per kind of diagnostic: how often, and the first in its own words. Of the kinds
/// in `each`, it prints every one.
void print_diagnostics(Console& console, const Diagnostics& diagnostics,
                       std::initializer_list<std::string_view> each = {});

}  // namespace strake::cli
