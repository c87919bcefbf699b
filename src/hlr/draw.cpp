// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "hlr/prepare/view_job.hpp"
#include "hlr/results/edge_curves.hpp"
#include "hlr/results/object_fates.hpp"
#include "hlr/seams/flush_seams.hpp"
#include "hlr/visibility/specks.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/hlr/steps.hpp"
#include "strake/parallel/report.hpp"

namespace strake::hlr {
namespace {

Result<SpeckedObjects> solve(const ViewJob& job, const parallel::Context& context,
                             Drawing& drawing) {
  switch (job.options.solver) {
    case Solver::brute_force:
      return solve_brute_force(job, context, drawing);
    case Solver::push:
      return solve_push(job, context, drawing);
    case Solver::gather:
      break;
  }
  return solve_gather(job, context, drawing);
}

}  // namespace

Result<Drawing> draw(const model::Scene& scene, const std::vector<bool>& drawn, const View& view,
                     const Options& options, const parallel::Context& context) {
  Options adjusted = options;
  // The baseline knows no culling.
  if (options.solver == Solver::push) adjusted.culling = false;
  Result<ViewJob> job = [&] {
    const parallel::StageTimer timer(context.report, kPreparationStep);
    return prepare_view({scene, drawn, view, adjusted}, context);
  }();
  if (!job) return job.error();
  Drawing drawing;
  drawing.view = view;
  drawing.options = options;
  drawing.contact_distance_mm = job->contact_distance_mm;
  drawing.weld_mm = scene.weld_mm;
  drawing.sag_mm = job->scene->sag_mm;
  drawing.counters = job->counters;
  drawing.diagnostics = job->diagnostics;
  drawing.origin = view.perspective ? view.perspective->target : job->origin;
  drawing.hatches = job->hatches;
  make_room_for_counts(options, scene.model->objects.size(), drawing);
  const Result<SpeckedObjects> specked = solve(*job, context, drawing);
  if (!specked) return specked.error();
  if (const Status status = leave_out_hidden_objects(context, drawing); !status)
    return status.error();
  if (const Status status = dot_lone_specks(*job, *specked, context, drawing); !status)
    return status.error();
  Result<Curves> curves = find_curves(*job, context);
  if (!curves) return curves.error();
  drawing.curves = std::move(*curves);
  Result<Account> account = account_of(*job->scene, job->drawn, drawing, context);
  if (!account) return account.error();
  drawing.account = std::move(*account);
  if (!options.flush_seams)
    if (const Status status = leave_out_flush_seams(*job, context, drawing); !status)
      return status.error();
  sum_up_lines(drawing);
  report_defects(*job->scene->model, drawing.account, drawing.diagnostics);
  take_down(*job, context);
  return drawing;
}

Result<BruteForceWork> brute_force_work(const model::Scene& scene, const std::vector<bool>& drawn,
                                        const View& view, const Options& options,
                                        const parallel::Context& context) {
  const Result<ViewJob> job = prepare_view({scene, drawn, view, options}, context);
  if (!job) return job.error();
  return count_brute_force_work(*job, context);
}

}  // namespace strake::hlr
