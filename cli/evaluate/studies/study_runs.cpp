// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/studies/study_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "cli/evaluate/statistics.hpp"
#include "cli/evaluate/time_limit.hpp"
#include "core/stopwatch.hpp"
#include "strake/parallel/team.hpp"

namespace strake::cli {

std::string StudyRun::text() const {
  return unfinished.empty() ? fmt::format("{:.3f}", seconds) : unfinished;
}

std::string StudyRun::counter(const std::string& name) const {
  const auto found = computed.counters.find(name);
  return found == computed.counters.end() ? "-" : std::to_string(found->second);
}

Result<StudyRun> run_for_study(const StudyInput& input, const Contender& contender,
                               const StudyConditions& conditions) {
  std::optional<parallel::Team> team;
  if (contender.threads > 1) team.emplace(contender.threads);
  const TimeLimit limit(input.stop, input.settings.limit_s);
  StudyRun run;
  std::vector<double> seconds;
  for (std::uint64_t round = 0; round < input.settings.repeat; ++round) {
    parallel::RunReport report;
    const parallel::Context context{.team = team ? &*team : nullptr,
                                    .stop = limit.token(),
                                    .report = conditions.with_regions ? &report : nullptr,
                                    .distribution = conditions.distribution,
                                    .min_chunk = conditions.min_chunk};
    const Stopwatch watch;
    Result<Computed> computed = contender.compute(context);
    const double took = watch.seconds();
    if (!computed) {
      if (input.stop.stop_requested() || computed.error().code != ErrorCode::cancelled)
        return computed.error();
      // What ended in an earlier round has a time.
      if (seconds.empty()) run.unfinished = fmt::format("over {:g} s", input.settings.limit_s);
      break;
    }
    if (seconds.empty() || took < *std::ranges::min_element(seconds))
      run.regions = report.regions();
    seconds.push_back(took);
    run.computed = std::move(*computed);
  }
  run.seconds = median(std::move(seconds));
  return run;
}

std::string times(const StudyRun& slower, const StudyRun& faster) {
  if (!slower.unfinished.empty() || !faster.unfinished.empty()) return "-";
  return fmt::format("{:.1f}", slower.seconds / faster.seconds);
}

std::string equal(const StudyRun& x, const StudyRun& y, const std::string& what,
                  StudyRecord& study) {
  if (!x.unfinished.empty() || !y.unfinished.empty()) return "-";
  if (x.computed.hash() == y.computed.hash()) return "yes";
  study.differences.push_back("the results differ: " + what);
  return "NO";
}

}  // namespace strake::cli
