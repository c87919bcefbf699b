// SPDX-License-Identifier: Apache-2.0
#include "hlr/visibility/step_shares.hpp"

#include <algorithm>
#include <string>

#include "strake/hlr/steps.hpp"

namespace strake::hlr {
namespace {

// Two looks at a clock for each edge take some hundredths of what the edge does: of many items a
// few say enough.
constexpr std::size_t kFewItems = 4096, kEvery = 16;

}  // namespace

StepShares::StepShares(parallel::RunReport* report, Stage stage, std::size_t items)
    : report_(report), stage_(stage) {
  if (report_ == nullptr) return;
  if (stage_ == Stage::global) every_ = items <= kFewItems ? 1 : kEvery;
  start_cpu_s_ = parallel::process_cpu_s();
}

void StepShares::report(double own_s, double timed_s) const {
  if (report_ == nullptr) return;
  if (stage_ != Stage::global) return add(kLocalStep, 1);
  const double local = timed_s > 0 ? std::min(1.0, own_s / timed_s) : 0;
  add(kLocalStep, local);
  add(kGlobalStep, 1 - local);
}

void StepShares::add(std::string_view step, double share) const {
  report_->add(parallel::StageReport{.name = std::string(step),
                                     .wall_s = share * watch_.seconds(),
                                     .cpu_s = share * (parallel::process_cpu_s() - start_cpu_s_)});
}

}  // namespace strake::hlr
