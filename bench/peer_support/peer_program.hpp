// SPDX-License-Identifier: Apache-2.0
// A peer that is a program of its own.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "cli/evaluate/peers/peer_row.hpp"

namespace strake::bench {

/// What such a program said. It prints a line, RESULT and JSON with the members version, load_s,
/// wall_s and cpu_s, or exits with 77 where what it runs is not installed.
struct ProgramReply {
  std::string_view outcome = cli::kMeasured;  ///< cli::kDisagrees is the caller's to say
  std::string why;                            ///< there is no answer; empty: there is
  std::string version;
  double cpu_s = 0, wall_s = 0;  ///< of the work alone
  double load_s = 0;             ///< of what comes before it
};

/// Runs a program and reads what it says. After `limit_s` seconds it is killed; `log` takes its
/// output and stays.
[[nodiscard]] ProgramReply run_program(std::vector<std::string> words, double limit_s,
                                       const std::filesystem::path& log);

}  // namespace strake::bench
