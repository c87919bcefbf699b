// SPDX-License-Identifier: Apache-2.0
// What an evaluation measured: plain data, which tables, charts and files are made from.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cli/evaluate/chart.hpp"
#include "cli/evaluate/peers/peer_row.hpp"
#include "strake/parallel/report.hpp"

namespace strake::cli {

/// The machine and the program that measured.
struct Machine {
  std::string processor, system, compiler, version;
  std::string program;  ///< the hash of the program's file: another build is another program
  unsigned hardware_threads = 0;  ///< those that this process may use
  std::uint64_t memory_bytes = 0;
};

/// What evaluations must share to be parts of one.
struct EvaluationSettings {
  double scale = 1;
  std::vector<unsigned> threads;  ///< ascending, from 1
  std::uint64_t repeat = 3;       ///< the least number of rounds
  double limit_s = 60;            ///< after which a run of the thesis's way is stopped
  friend bool operator==(const EvaluationSettings&, const EvaluationSettings&) = default;
};

/// All runs of one contender.
struct ContenderRecord {
  std::string name;  ///< kSequential, kAgain, kOurs, or one of the thesis's ways
  unsigned threads = 1;
  std::vector<double> seconds;   ///< wall, one entry per round
  double cpu_s = 0;              ///< of the process, in the last round
  std::uint64_t peak_bytes = 0;  ///< the most memory of the process while it ran
  std::map<std::string, std::uint64_t> counters;
  std::string hash;            ///< of the result
  std::string published_hash;  ///< of the bytes of the document made from it; empty: not published
  std::string unfinished;  ///< why it has no result, such as "stopped after 60 s"; empty: it has
  std::vector<parallel::RegionReport> regions;  ///< of the last round, those above a millisecond
  double shared_wall_s = 0;                     ///< in regions of a whole team, in the last round
  double alone_s = 0;  ///< CPU of the calling thread outside of these, in the last round
  /// Of a team: what work that is perfectly shared took without it and with it, before and after
  /// each round. Their ratio is what the machine has to give while ours runs.
  std::vector<double> kernel_alone_s, kernel_s;
};
inline constexpr const char* kSequential = "sequential";
inline constexpr const char* kAgain = "sequential, again";
inline constexpr const char* kOurs = "strake";

/// One stage of one case: the same input to all contenders.
struct StageRecord {
  std::string name;  ///< "local", "global" or "clash"
  std::vector<ContenderRecord> contenders;
  double reference_s = 0;  ///< what fixed work took on one core in the same rounds
  /// What was not equal where it has to be, a line each; empty: all was.
  std::vector<std::string> differences;
};

struct CaseRecord {
  std::string name, title;
  std::uint64_t objects = 0, bodies = 0, triangles = 0;
  std::vector<StageRecord> stages;
};

/// The answer to a question, as a table and charts.
struct StudyRecord {
  std::string name, title, question;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  std::vector<BarChart> charts;
  std::vector<std::string> differences;  ///< as of a StageRecord
};

/// What one peer did, on each scene that it was asked about.
struct PeerRecord {
  std::string name;
  std::vector<PeerRow> rows;
};

struct EvaluationRecord {
  Machine machine;
  EvaluationSettings settings;
  std::vector<CaseRecord> cases;
  std::vector<StudyRecord> studies;
  std::vector<PeerRecord> peers;
};

}  // namespace strake::cli
