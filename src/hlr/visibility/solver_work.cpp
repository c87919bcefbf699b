// SPDX-License-Identifier: Apache-2.0
#include "hlr/visibility/solver_work.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "strake/hlr/steps.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/reduce.hpp"

namespace strake::hlr {

void add(Counters& counters, const SolverWork& work) {
  counters.covered_edges += work.covered;
  counters.face_tests += work.tests;
  counters.exact_fallbacks += work.wide_tests;
}

void add(LineCount& lines, const SolverWork& work) {
  lines.edges += static_cast<std::uint32_t>(work.edges);
  lines.specks += static_cast<std::uint32_t>(work.specks);
}

Result<SolverWork> sum_up_work(const VisibilityScene& visibility, std::span<const SolverWork> work,
                               const parallel::Context& context, Drawing& drawing,
                               SpeckedObjects& specked) {
  constexpr std::size_t kGrain = 4096;
  const Status counted = parallel::for_each(
      context,
      {.name = "hidden lines: edges outside", .n = visibility.outside.size(), .grain = kGrain},
      [&](std::size_t object) {
        drawing.counted[object].edges += visibility.outside[object];
        drawing.clipped_left_out[object] += visibility.outside[object];
      });
  if (!counted) return counted.error();
  const auto object_of = [&](std::size_t i) {
    return visibility.placed[visibility.items[i].body].object;
  };
  return parallel::reduce(
      context, {.name = "hidden lines: work", .n = work.size(), .grain = kGrain}, SolverWork{},
      [&](SolverWork& sum, std::size_t i) {
        const SolverWork& done = work[i];
        sum.covered += done.covered;
        sum.tests += done.tests;
        sum.wide_tests += done.wide_tests;
        sum.own_s += done.own_s;
        sum.timed_s += done.timed_s;
        // Items are by object: the first one counts for all.
        const std::uint32_t object = object_of(i);
        if (i > 0 && object_of(i - 1) == object) return;
        for (std::size_t k = i; k < work.size() && object_of(k) == object; ++k) {
          add(drawing.counted[object], work[k]);
          if (work[k].specked) specked[object] = 1;
          if (work[k].left_out > 0)
            drawing.left_out[object] += static_cast<std::uint32_t>(work[k].left_out);
          if (work[k].clipped > 0)
            drawing.clipped_left_out[object] += static_cast<std::uint32_t>(work[k].clipped);
        }
      },
      [](SolverWork& into, const SolverWork& sum) {
        into.covered += sum.covered;
        into.tests += sum.tests;
        into.wide_tests += sum.wide_tests;
        into.own_s += sum.own_s;
        into.timed_s += sum.timed_s;
      });
}

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
