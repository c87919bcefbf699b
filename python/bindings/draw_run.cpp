// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "drawing/layout/far_objects.hpp"
#include "python/bindings/draw_request.hpp"

namespace strake::python {

namespace {

/// Objects far from all others decide the scale: they are left out, or told of.
Status mind_far_objects(const model::Scene& scene, const hlr::View& view, bool leave_out,
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

drawing::InkOptions ink_options(const DrawRequest& request) {
  drawing::InkOptions options{.hidden = request.hidden != "off",
                              .clean_up = request.hidden != "all"};
  if (request.pens)
    options.pens = {(*request.pens)[0], (*request.pens)[1], (*request.pens)[2], (*request.pens)[3]};
  return options;
}

/// The request in terms of the library, and what it is done to.
struct Job {
  const DrawRequest& request;
  const model::Scene& scene;
  hlr::View view;
  hlr::Options options;
  drawing::LayoutOptions layout;
};

Status put_on_paper(const std::vector<bool>& drawn, Job& job, DrawRun& run,
                    const parallel::Context& context) {
  const Result<hlr::Drawing> lines = hlr::draw(job.scene, drawn, job.view, job.options, context);
  if (!lines) return lines.error();
  run.diagnostics.append(lines->diagnostics);
  Result<drawing::NeutralDrawing> sheet =
      drawing::lay_out(*lines, *job.scene.model, job.layout, context);
  if (!sheet) return sheet.error();
  run.drawing = std::move(*sheet);
  Result<drawing::Ink> ink = drawing::choose_ink(run.drawing, ink_options(job.request), context);
  if (!ink) return ink.error();
  run.ink = std::move(*ink);
  return {};
}

Status draw_job(Job job, DrawRun& run, const parallel::Context& context) {
  Result<std::vector<bool>> drawn = pick_some(job.request.select, job.scene, "select", context);
  if (!drawn) return drawn.error();
  if (const Status status = mind_far_objects(job.scene, job.view, job.request.leave_out_far_objects,
                                             *drawn, job.layout, run.diagnostics, context);
      !status)
    return status;
  Result<std::vector<bool>> uncut = pick_some({job.request.uncut, {}}, job.scene, "uncut", context);
  if (!uncut) return uncut.error();
  job.options.uncut = std::move(*uncut);
  if (!job.request.sag_mm) {
    const Result<double> sag =
        drawing::sag_for_paper(job.scene, *drawn, job.view, job.layout, context);
    if (!sag) return sag.error();
    job.options.sag_mm = *sag;
  }
  return put_on_paper(*drawn, job, run, context);
}

}  // namespace

Result<std::shared_ptr<DrawRun>> draw(const ModelPointer& model, const DrawRequest& request,
                                      const parallel::Context& context) {
  const Result<hlr::View> view = view_of(request);
  if (!view) return view.error();
  const Result<hlr::Options> options = line_options(request);
  if (!options) return options.error();
  const Result<drawing::LayoutOptions> layout = layout_options(request);
  if (!layout) return layout.error();
  const auto scene = model->scene(scene_options(request), context);
  if (!scene) return scene.error();
  const auto run = std::make_shared<DrawRun>();
  run->model = model;
  const Status drawn = draw_job({request, **scene, *view, *options, *layout}, *run, context);
  if (!drawn) return drawn.error();
  return run;
}

}  // namespace strake::python
