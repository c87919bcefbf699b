// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/studies/study_runs.hpp"

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <utility>
#include <vector>

#include "cli/evaluate/statistics.hpp"
#include "cli/evaluate/time_limit.hpp"
#include "strake/parallel/team.hpp"

namespace strake::cli {

std::string StudyRun::text() const {
  return unfinished.empty() ? fmt::format("{:.3f}", seconds) : unfinished;
}

std::string StudyRun::counter(const std::string& name) const {
  const auto found = computed.counters.find(name);
  return found == computed.counters.end() ? "-" : std::to_string(found->second);
}

Result<StudyRun> run_for_study(const StudyInput& input, const Contender& contender) {
  std::optional<parallel::Team> team;
  if (contender.threads > 1) team.emplace(contender.threads);
  const TimeLimit limit(input.stop, input.settings.limit_s);
  StudyRun run;
  std::vector<double> seconds;
  for (std::uint64_t round = 0; round < input.settings.repeat; ++round) {
    const auto start = std::chrono::steady_clock::now();
    Result<Computed> computed =
        contender.compute({.team = team ? &*team : nullptr, .stop = limit.token()});
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    if (!computed) {
      if (input.stop.stop_requested() || computed.error().code != ErrorCode::cancelled)
        return computed.error();
      // What ended in an earlier round has a time.
      if (seconds.empty()) run.unfinished = fmt::format("over {:g} s", input.settings.limit_s);
      break;
    }
    seconds.push_back(took.count());
    run.computed = std::move(*computed);
  }
  run.seconds = median(std::move(seconds));
  return run;
}

}  // namespace strake::cli
