// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/output/console.hpp"
#include "cli/run/session.hpp"
#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/model/selection.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own name
class App;
class Option;
}  // namespace CLI

/// The options of `draw` for hatches and for perspective.
namespace strake::cli {

/// How the sections of some objects are hatched.
struct HatchRule {
  hlr::Hatch hatch;
  std::optional<model::Selection> selection;  ///< absent: all objects
};

/// Parses "30deg,80mm: type = pipe": angle, spacing in the model, or both, or "off", and whose
/// sections. Errors name --hatch.
[[nodiscard]] Result<std::vector<HatchRule>> parse_hatches(const std::vector<std::string>& texts);

/// Returns the hatch of each object of the scene; the first rule that picks an object counts. It is
/// empty without rules. Errors: a selection that picks nothing.
[[nodiscard]] Result<std::vector<hlr::Hatch>> hatches_of(Session& session,
                                                         const model::Scene& scene,
                                                         const std::vector<HatchRule>& rules);

/// --eye, --target, --near and --field-of-view as they were written.
struct PerspectiveOptions {
  std::string eye, target, near, field_of_view;
};

/// Adds the options; they take the place of `view` and `direction`.
void add_perspective_options(CLI::App& command, PerspectiveOptions& options, CLI::Option* view,
                             CLI::Option* direction);

/// Puts a view, with its direction, into perspective, and says where the direction was rounded.
/// Does nothing where no eye was given.
[[nodiscard]] Status set_perspective(const PerspectiveOptions& given, hlr::View& view,
                                     Console& console);

}  // namespace strake::cli
