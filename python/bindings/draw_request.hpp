// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "drawing/conventions.hpp"
#include "python/bindings/drawing.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/drawing/object_styles.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/model/single_lines.hpp"
#include "strake/parallel/context.hpp"

/// The parts of the library's own requests that a request of Python stands for.
namespace strake::python {

/// Returns the error of a parser, with the argument that was parsed.
[[nodiscard]] Error in_argument(Error error, const char* argument);

[[nodiscard]] Result<hlr::View> view_of(const DrawRequest& request);
[[nodiscard]] Result<hlr::Options> line_options(const DrawRequest& request);
[[nodiscard]] Result<drawing::LayoutOptions> layout_options(const DrawRequest& request);
[[nodiscard]] model::SceneOptions scene_options(const DrawRequest& request);

/// A request in terms of the library.
struct DrawJob {
  hlr::View view;
  hlr::Options options;
  drawing::LayoutOptions layout;
  drawing::Conventions conventions = {};
  std::optional<model::SingleLineOptions> single_line = {};
  std::shared_ptr<const drawing::ObjectStyles> styles = nullptr;  ///< null: all look alike
  std::vector<bool> drawn = {};                                   ///< by object; empty: all
};

/// Returns what a request says of any model. Errors: usage.
[[nodiscard]] Result<DrawJob> job_of(const DrawRequest& request);

/// Takes into a job what a request makes of a scene, of which `drawn` and `uncut` have been picked:
/// far objects, and how fine curves are. Of the scene's shapes boxes and corners are looked at.
/// Errors: usage, cancelled.
[[nodiscard]] Status fit_job(const DrawRequest& request, const model::Scene& scene,
                             std::vector<bool> drawn, std::vector<bool> uncut, DrawJob& job,
                             Diagnostics& diagnostics, const parallel::Context& context);

/// Puts the lines of a job on paper. Errors: usage, cancelled, memory.
[[nodiscard]] Status put_on_paper(const DrawRequest& request, const DrawJob& job,
                                  const hlr::Drawing& lines, const model::Model& model,
                                  DrawRun& run, const parallel::Context& context);

}  // namespace strake::python
