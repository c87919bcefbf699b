// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/text_encoding.hpp"
#include "drawing/layout/far_objects.hpp"
#include "python/bindings/draw_request.hpp"
#include "python/bindings/selection.hpp"
#include "strake/drawing/centre_lines.hpp"
#include "strake/drawing/hatching.hpp"
#include "strake/drawing/object_styles.hpp"
#include "strake/drawing/thinning.hpp"
#include "strake/model/single_lines.hpp"

namespace strake::python {

namespace {

/// Objects far from all others decide the scale: they are left out, or told of.
Status resolve_far_objects(const model::Scene& scene, const hlr::View& view, bool leave_out,
                           std::vector<bool>& drawn, drawing::LayoutOptions& layout,
                           Diagnostics& diagnostics, const parallel::Context& context) {
  const Result<drawing::FarObjects> far = drawing::find_far_objects(scene, drawn, view, context);
  if (!far) return far.error();
  if (far->objects.empty()) return {};
  const std::string text = drawing::far_objects_text(*far, *scene.model);
  if (!leave_out) {
    diagnostics.add(Severity::warning, "far-object", text + " (limits='auto' leaves them out)", {});
    return {};
  }
  drawing::leave_out(*far, *scene.model, drawn);
  layout.far_left_out = far->objects;
  diagnostics.add(Severity::note, "far-object-left-out", text, {});
  return {};
}

drawing::InkOptions ink_options(const DrawRequest& request, const DrawJob& job) {
  drawing::InkOptions options{.hidden = request.hidden != "off",
                              .clean_up = request.hidden != "all",
                              .split_hidden = request.split_hidden};
  options.styles = job.styles;
  if (request.pens)
    options.pens = {(*request.pens)[0], (*request.pens)[1], (*request.pens)[2], (*request.pens)[3]};
  return options;
}

/// Returns the hatch of each object; "30deg,80mm: PIPE*" is for those that the selection picks, and
/// the first that picks an object counts.
Result<std::vector<hlr::Hatch>> hatches_of(const DrawRequest& request, const model::Scene& scene,
                                           const parallel::Context& context) {
  drawing::Hatching hatching(scene.model->objects.size());
  for (const std::string& text : request.hatches) {
    const std::size_t colon = text.find(':');
    const auto hatch = drawing::parse_hatch(std::string_view(text).substr(0, colon));
    if (!hatch) return in_argument(hatch.error(), "hatch");
    std::vector<bool> picked;
    if (colon != std::string::npos) {
      auto some =
          pick_some({{std::string(trimmed(text.substr(colon + 1)))}, {}}, scene, "hatch", context);
      if (!some) return some.error();
      picked = std::move(*some);
    }
    hatching.add(*hatch, picked);
  }
  return std::move(hatching).by_object();
}

/// Returns the styles of the objects, of which the first that picks an object holds for it; null
/// without any.
Result<std::shared_ptr<const drawing::ObjectStyles>> styles_of(const DrawRequest& request,
                                                               const model::Scene& scene,
                                                               const parallel::Context& context) {
  constexpr const char* kStyle = "style";
  if (request.styles.empty()) return std::shared_ptr<const drawing::ObjectStyles>();
  if (request.styles.size() > drawing::kMaxObjectStyles)
    return Error{ErrorCode::usage, "there are more than 1000 styles", kStyle,
                 "give those that are seen"};
  drawing::ObjectStyles styles(scene.model->objects.size());
  for (const std::string& text : request.styles) {
    auto style = drawing::parse_style(text);
    if (!style) return in_argument(style.error(), kStyle);
    const auto picked = pick_some({{style->selection}, {}}, scene, kStyle, context);
    if (!picked) return picked.error();
    styles.add(std::move(style->style), *picked);
  }
  return std::make_shared<const drawing::ObjectStyles>(std::move(styles));
}

/// Reads the text of an argument, unless it is empty.
template <class Value>
Status take_argument(const std::string& text, const char* argument,
                     Result<Value> (*parse)(std::string_view), Value& into) {
  if (text.empty()) return {};
  Result<Value> value = parse(text);
  if (!value) return in_argument(value.error(), argument);
  into = std::move(*value);
  return {};
}

}  // namespace

Result<DrawJob> job_of(const DrawRequest& request) {
  Result<hlr::View> view = view_of(request);
  if (!view) return view.error();
  Result<hlr::Options> options = line_options(request);
  if (!options) return options.error();
  Result<drawing::LayoutOptions> layout = layout_options(request);
  if (!layout) return layout.error();
  DrawJob job{std::move(*view), std::move(*options), std::move(*layout)};
  job.conventions.break_lines = request.break_lines;
  for (const Status& status :
       {take_argument(request.centre_lines, "centre_lines", drawing::parse_centre_lines,
                      job.conventions.centre_lines),
        take_argument(request.thin, "thin", drawing::parse_thinning, job.conventions.thin),
        take_argument(request.single_line, "single_line", model::parse_single_line,
                      job.single_line)})
    if (!status) return status.error();
  if (job.single_line) job.layout.single_line_mm = job.single_line->largest_diameter_mm;
  return job;
}

Status fit_job(const DrawRequest& request, const model::Scene& scene, std::vector<bool> drawn,
               std::vector<bool> uncut, DrawJob& job, Diagnostics& diagnostics,
               const parallel::Context& context) {
  job.drawn = std::move(drawn);
  job.options.uncut = std::move(uncut);
  if (const Status status = resolve_far_objects(scene, job.view, request.leave_out_far_objects,
                                                job.drawn, job.layout, diagnostics, context);
      !status)
    return status;
  if (request.sag_mm) return {};
  const Result<double> sag =
      drawing::sag_for_paper(scene, job.drawn, job.view, job.layout, context);
  if (!sag) return sag.error();
  job.options.sag_mm = *sag;
  return {};
}

Status put_on_paper(const DrawRequest& request, const DrawJob& job, const hlr::Drawing& lines,
                    const model::Model& model, DrawRun& run, const parallel::Context& context) {
  run.diagnostics.append(lines.diagnostics);
  Result<drawing::NeutralDrawing> sheet = drawing::lay_out(lines, model, job.layout, context);
  if (!sheet) return sheet.error();
  run.drawing = std::move(*sheet);
  Result<drawing::Ink> ink = drawing::choose_ink(run.drawing, ink_options(request, job), context);
  if (!ink) return ink.error();
  run.ink = std::move(*ink);
  return drawing::apply_conventions(run.ink, run.drawing, model, job.conventions, context);
}

namespace {

/// Returns the scene of a model, with thin pipes as lines where a job requests them.
Result<std::shared_ptr<const model::Scene>> drawn_scene(LoadedModel& model,
                                                        const DrawRequest& request,
                                                        const DrawJob& job,
                                                        const parallel::Context& context) {
  auto scene = model.scene(scene_options(request), context);
  if (!scene || !job.single_line) return scene;
  auto lines = model::pipes_as_lines(**scene, *job.single_line, context);
  if (!lines) return lines.error();
  return std::make_shared<const model::Scene>(std::move(lines->scene));
}

}  // namespace

Result<std::shared_ptr<DrawRun>> draw(const ModelPointer& model, const DrawRequest& request,
                                      const parallel::Context& context) {
  Result<DrawJob> job = job_of(request);
  if (!job) return job.error();
  const auto scene = drawn_scene(*model, request, *job, context);
  if (!scene) return scene.error();
  const auto run = std::make_shared<DrawRun>();
  run->model = model;
  run->scene = *scene;
  Result<std::vector<bool>> drawn = pick_some(request.select, **scene, "select", context);
  if (!drawn) return drawn.error();
  Result<std::vector<bool>> uncut = pick_some({request.uncut, {}}, **scene, "uncut", context);
  if (!uncut) return uncut.error();
  if (const Status status = fit_job(request, **scene, std::move(*drawn), std::move(*uncut), *job,
                                    run->diagnostics, context);
      !status)
    return status.error();
  auto hatches = hatches_of(request, **scene, context);
  if (!hatches) return hatches.error();
  job->options.hatches = std::move(*hatches);
  auto styles = styles_of(request, **scene, context);
  if (!styles) return styles.error();
  job->styles = std::move(*styles);
  const Result<hlr::Drawing> lines =
      hlr::draw(**scene, job->drawn, job->view, job->options, context);
  if (!lines) return lines.error();
  const Status put = put_on_paper(request, *job, *lines, model->model(), *run, context);
  if (!put) return put.error();
  return run;
}

}  // namespace strake::python
