// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strake::cli {

/// The programs of the bench build that have peers, each for one job.
enum class PeerJob : std::uint8_t { pairs, drawing };

/// One peer at one job, on a generated ship of a size that it can finish.
struct PeerCase {
  std::string_view name;
  std::string_view title;
  PeerJob job = PeerJob::pairs;
  std::string_view peer;    ///< what the program calls it
  double full_objects = 0;  ///< of the ship at scale 1
};

[[nodiscard]] std::span<const PeerCase> peer_cases();

/// Returns the file name of the program that has the peers of a job.
[[nodiscard]] std::string_view peer_program(PeerJob job);
/// Returns how many objects the ship of a case has.
[[nodiscard]] std::uint64_t peer_objects(const PeerCase& one, double scale);
/// Returns what the program is reported ship and peer.
[[nodiscard]] std::vector<std::string> peer_question(const PeerCase& one, double scale);

}  // namespace strake::cli
