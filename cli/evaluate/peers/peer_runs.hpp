// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <stop_token>
#include <string>

#include "cli/evaluate/peers/peer_cases.hpp"
#include "cli/evaluate/record.hpp"
#include "strake/core/result.hpp"

namespace strake::cli {

/// Where peers are, and what they may take. They are programs of their own, never part of this one.
struct PeerPrograms {
  std::filesystem::path folder;  ///< holds the programs of peer_program()
  std::filesystem::path output;  ///< takes scenes, logs and rows
  double limit_s = 60;           ///< of a peer; of a whole run several times that
};

/// Runs one peer, in a process of its own. Whatever becomes of that process is a row: it is not
/// there, it fails, it takes too long, it says what is no answer. Errors: cancelled, and output
/// where the folder cannot be made.
[[nodiscard]] Result<PeerRecord> run_peer(const PeerCase& one, const PeerPrograms& programs,
                                          double scale, const std::stop_token& stop);

/// Whether a peer that was not there, or failed, may have an answer now.
[[nodiscard]] bool may_be_retried(const PeerRecord& record);

/// Returns what became of a peer, in a line.
[[nodiscard]] std::string outcome_line(const PeerRecord& record);

}  // namespace strake::cli
