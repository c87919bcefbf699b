// SPDX-License-Identifier: Apache-2.0
#include "hlr/incremental/solve_part.hpp"

#include <utility>

#include "hlr/results/edge_curves.hpp"
#include "hlr/results/object_fates.hpp"
#include "hlr/visibility/specks.hpp"
#include "strake/hlr/steps.hpp"
#include "strake/parallel/report.hpp"

namespace strake::hlr {

Result<Drawing> solve_part(const ViewInput& input, const parallel::Context& context) {
  const Result<ViewJob> job = [&] {
    const parallel::StageTimer timer(context.report, kPreparationStep);
    return prepare_view(input, context);
  }();
  if (!job) return job.error();
  const std::size_t objects = input.scene.model->objects.size();
  Drawing drawing;
  drawing.options = input.options;
  drawing.counters = job->counters;
  drawing.diagnostics = job->diagnostics;
  drawing.origin = input.view.perspective ? input.view.perspective->target : job->origin;
  make_room_for_counts(input.options, objects, drawing);
  const Result<SpeckedObjects> specked = solve_gather(*job, context, drawing);
  if (!specked) return specked.error();
  if (const Status status = leave_out_hidden_objects(context, drawing); !status)
    return status.error();
  if (const Status status = dot_lone_specks(*job, *specked, context, drawing); !status)
    return status.error();
  auto curves = find_curves(*job, context);
  if (!curves) return curves.error();
  drawing.curves = std::move(*curves);
  sum_up_lines(drawing);
  return drawing;
}

}  // namespace strake::hlr
