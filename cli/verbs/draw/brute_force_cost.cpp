// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/draw/brute_force_cost.hpp"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

namespace strake::cli {

namespace {

/// What one worker tests in a second: 5.9 and 6.5 million were measured on generated ships of 200
/// and 100 objects (AMD EPYC).
constexpr double kTestsPerSecond = 6e6;

/// Returns "25 seconds", "3 hours": a time that is only guessed has no more digits.
std::string about(double seconds) {
  struct Unit {
    double seconds;
    std::string_view name;
  };
  constexpr std::array<Unit, 3> kUnits{{{86400, "days"}, {3600, "hours"}, {60, "minutes"}}};
  if (seconds < 1) return "less than a second";
  for (const auto& [length, name] : kUnits)
    if (seconds >= 2 * length) return fmt::format("about {:.0f} {}", seconds / length, name);
  return fmt::format("about {:.0f} seconds", std::ceil(seconds));
}

std::string counted_tests(std::uint64_t tests) {
  constexpr std::uint64_t kMillion = 1'000'000;
  return tests < kMillion ? fmt::format("{} tests", tests)
                          : fmt::format("{} million tests", tests / kMillion);
}

}  // namespace

std::string brute_force_cost(const hlr::BruteForceWork& work, unsigned workers) {
  return fmt::format(
      "--solver brute-force: {} edges and {} triangles, {}: {} with {} worker{}; it is "
      "an oracle for small scenes (without it the lines are the same, in much less time)",
      work.edges, work.triangles, counted_tests(work.tests),
      about(static_cast<double>(work.tests) / kTestsPerSecond / workers), workers,
      workers == 1 ? "" : "s");
}

Status print_brute_force_cost(Session& session, const model::Scene& scene,
                              const std::vector<bool>& drawn, const hlr::View& view,
                              const hlr::Options& options) {
  const auto timer = session.step("count the work");
  const parallel::Context context = session.context();
  const Result<hlr::BruteForceWork> work =
      hlr::brute_force_work(scene, drawn, view, options, context);
  if (!work) return work.error();
  session.console().note(
      brute_force_cost(*work, context.team == nullptr ? 1 : context.team->size()));
  return {};
}

}  // namespace strake::cli
