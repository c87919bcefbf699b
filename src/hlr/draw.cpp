// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "hlr/account.hpp"
#include "hlr/job.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::hlr {
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
  Result<Account> account = account_of(*job->scene, job->drawn, drawing.pieces, context);
  if (!account) return account.error();
  drawing.account = std::move(*account);
  report_defects(*job->scene->model, drawing.account, drawing.diagnostics);
  return drawing;
}

}  // namespace strake::hlr
