// SPDX-License-Identifier: Apache-2.0
#include <cstddef>

#include "hlr/job.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::hlr {
namespace {

// An object is drawn when a line of it is visible, hidden when all are hidden, clipped when no
// line of it lies within the limits. An object without lines counts as drawn.
void count_objects(const Job& job, Drawing& drawing) {
  Counters& counters = drawing.counters;
  std::size_t next = 0;
  for (std::uint32_t object = 0; object < job.drawn.size(); ++object) {
    if (!job.drawn[object]) continue;
    ++counters.objects;
    bool visible = false, hidden = false, clipped = false;
    for (; next < drawing.pieces.size() && model::index(drawing.pieces[next].object) == object;
         ++next) {
      const State state = drawing.pieces[next].state;
      visible = visible || state == State::visible || state == State::projecting;
      hidden = hidden || state == State::hidden_by_self || state == State::hidden_by_other;
      clipped = clipped || state == State::clipped;
    }
    if (visible || !(hidden || clipped))
      ++counters.objects_drawn;
    else if (hidden)
      ++counters.objects_hidden;
    else
      ++counters.objects_clipped;
  }
}

}  // namespace

Result<Drawing> draw(const model::Scene& scene, const std::vector<bool>& drawn, const View& view,
                     const Options& options, const parallel::Context& context) {
  const Result<Job> job = prepare(scene, drawn, view, options, context);
  if (!job) return job.error();
  Drawing drawing;
  drawing.view = view;
  drawing.options = options;
  drawing.contact_distance_mm = job->contact_distance_mm;
  drawing.diagnostics = job->diagnostics;
  const Status status = options.solver == Solver::brute_force
                            ? solve_brute_force(*job, context, drawing)
                            : solve_gather(*job, context, drawing);
  if (!status) return status.error();
  count_objects(*job, drawing);
  return drawing;
}

}  // namespace strake::hlr
