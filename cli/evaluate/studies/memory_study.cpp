// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "cli/evaluate/machine.hpp"
#include "cli/evaluate/studies/study_runs.hpp"
#include "cli/evaluate/studies/study_scenes.hpp"
#include "strake/parallel/team.hpp"

namespace strake::cli {

namespace {

constexpr std::uint64_t kBytesPerMebibyte = std::uint64_t{1} << 20U;

/// Returns the memory that a run on so many threads may take: the sequential run's, 5 % and 16 MiB
/// a thread.
std::uint64_t allowed_bytes(std::uint64_t sequential_bytes, unsigned threads) {
  constexpr std::uint64_t kPart = 20, kThreadBytes = 16 * kBytesPerMebibyte;
  return sequential_bytes + sequential_bytes / kPart + threads * kThreadBytes;
}

/// Returns the most memory of the process while a contender ran once, the least of the rounds: what
/// else the process freed late belongs to none. 0: unknown. `hash` receives the result's.
Result<std::uint64_t> peak_of(const StudyInput& input, const Contender& contender,
                              std::string& hash) {
  std::optional<std::uint64_t> least;
  for (std::uint64_t round = 0; round < input.settings.repeat; ++round) {
    const bool has_peak = reset_peak_memory();
    std::optional<parallel::Team> team;
    if (contender.threads > 1) team.emplace(contender.threads);
    const Result<Computed> computed =
        contender.compute({.team = team ? &*team : nullptr, .stop = input.stop});
    if (!computed) return computed.error();
    const std::uint64_t peak = has_peak ? peak_memory_since_reset() : 0;
    hash = computed->hash();
    least = std::min(least.value_or(peak), peak);
  }
  return least.value_or(0);
}

std::string mebibytes(std::uint64_t bytes) {
  return fmt::format("{:.1f}", static_cast<double>(bytes) / static_cast<double>(kBytesPerMebibyte));
}

/// What the rows of a stage are compared with.
struct Sequential {
  std::uint64_t peak_bytes = 0;
  std::string hash;
};

void add_memory_row(const Contender& contender, std::uint64_t peak, const std::string& hash,
                    const Sequential& sequential, StudyRecord& study) {
  const bool known = peak > 0 && sequential.peak_bytes > 0;
  const std::uint64_t allowed = allowed_bytes(sequential.peak_bytes, contender.threads);
  const bool same = hash == sequential.hash;
  if (!same)
    study.differences.push_back(
        fmt::format("the results differ: {} on {} threads", contender.name, contender.threads));
  const std::string within = peak <= allowed ? "yes" : "NO";
  study.rows.push_back({contender.name, std::to_string(contender.threads),
                        known ? mebibytes(peak) : "unknown", known ? mebibytes(allowed) : "-",
                        known ? within : "-", same ? "yes" : "NO"});
}

}  // namespace

Status study_memory(const StudyInput& input, StudyRecord& study) {
  constexpr std::array<unsigned, 5> kThreads{1, 2, 4, 8, 16};
  study.columns = {"Stage", "Threads", "Peak MiB", "Allowed MiB", "Within", "Equal"};
  const Result<SkewedScene> scene = place_skewed_scene(input);
  if (!scene) return scene.error();
  const std::size_t stages = skewed_stages(*scene, 1).size();
  for (std::size_t stage = 0; stage < stages; ++stage) {
    Sequential sequential;
    for (const unsigned threads : kThreads) {
      const Contender contender = skewed_stages(*scene, threads)[stage];
      input.narrate(fmt::format("memory, {}: {} threads", contender.name, threads));
      std::string hash;
      const Result<std::uint64_t> peak = peak_of(input, contender, hash);
      if (!peak) return peak.error();
      if (threads == 1) sequential = {*peak, hash};
      add_memory_row(contender, *peak, hash, sequential, study);
    }
  }
  return {};
}

}  // namespace strake::cli
