// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/peers/peer_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>
#include <vector>

#include "cli/evaluate/peers/peer_rows.hpp"
#include "io/importer/child_process.hpp"
#include "io/source/input_file.hpp"

namespace strake::cli {

namespace {

namespace fs = std::filesystem;

/// A run has up to two scenes, and Strake's own work beside the peer's.
constexpr double kLimitsOfRun = 3;

/// One run of a peer program.
class PeerRun {
 public:
  PeerRun(const PeerCase& one, const PeerPrograms& programs, double scale)
      : one_(one),
        program_(programs.folder / peer_program(one.job)),
        rows_file_(programs.output / (std::string(one.name) + ".json")),
        limit_s_(kLimitsOfRun * programs.limit_s),
        objects_(peer_objects(one, scale)) {
    child_.words = {program_.string()};
    for (std::string& word : peer_question(one, scale)) child_.words.push_back(std::move(word));
    for (std::string word :
         {std::string("--limit"), fmt::format("{:g}", programs.limit_s), std::string("--scenes"),
          programs.output.string(), std::string("--json"), rows_file_.string()})
      child_.words.push_back(std::move(word));
    child_.limit_s = limit_s_;
    child_.log = programs.output / (std::string(one.name) + ".log");
  }

  Result<PeerRecord> run(const std::stop_token& stop) {
    std::error_code none;
    fs::remove(rows_file_, none);  // those of an earlier run
    const io::ChildEnd end = io::run_child(child_, stop);
    if (end.how == io::ChildEnd::How::stopped)
      return Error{ErrorCode::cancelled, "cancelled", {}, {}};
    PeerRecord record{std::string(one_.name), {}};
    std::string fault = read_rows(record);
    if (fault.empty()) fault = fault_of(end, record);
    if (!fault.empty()) record.rows.push_back(without_result(outcome_of(end), std::move(fault)));
    return record;
  }

 private:
  /// Takes the rows that the program wrote; says why they cannot be taken.
  std::string read_rows(PeerRecord& record) const {
    std::error_code none;
    if (!fs::exists(rows_file_, none)) return {};
    const Result<io::FileContent> content = io::FileContent::read(rows_file_.string());
    if (!content) return content.error().text();
    Result<std::vector<PeerRow>> rows =
        parse_peer_rows(io::as_text(content->bytes()), rows_file_.string());
    if (!rows) return rows.error().text();
    record.rows = std::move(*rows);
    return {};
  }

  /// Says what the end of the program leaves to say beside its rows.
  [[nodiscard]] std::string fault_of(const io::ChildEnd& end, const PeerRecord& record) const {
    constexpr std::size_t kTail = 300;
    switch (end.how) {
      case io::ChildEnd::How::not_started:
        return fmt::format("{} cannot be run: './run bench --build' builds it", program_.string());
      case io::ChildEnd::How::over_limit:
        return fmt::format("no answer within {:g} s, several times --peer-limit", limit_s_);
      case io::ChildEnd::How::killed:
        return fmt::format("ended by signal {}: {}", end.code, io::tail_of(end.output, kTail));
      case io::ChildEnd::How::refused:
      case io::ChildEnd::How::stopped:
      case io::ChildEnd::How::lost:
      case io::ChildEnd::How::exited:
        break;
    }
    // It ends with another status where a result disagrees, too.
    const bool disagrees =
        std::ranges::find(record.rows, kDisagrees, &PeerRow::outcome) != record.rows.end();
    if (end.code != 0 && !disagrees)
      return fmt::format("exit status {}: {}", end.code, io::tail_of(end.output, kTail));
    return record.rows.empty() ? "it ended without an answer" : std::string();
  }

  static std::string_view outcome_of(const io::ChildEnd& end) {
    if (end.how == io::ChildEnd::How::not_started) return kNotThere;
    return end.how == io::ChildEnd::How::over_limit ? kOverLimit : kFailed;
  }

  [[nodiscard]] PeerRow without_result(std::string_view outcome, std::string why) const {
    PeerRow row;
    row.scene = fmt::format("ship of {} objects", objects_);
    row.objects = objects_;
    row.who = one_.title;
    row.outcome = outcome;
    row.result = std::move(why);
    return row;
  }

  const PeerCase& one_;
  fs::path program_, rows_file_;
  double limit_s_;
  std::uint64_t objects_;
  io::ChildProgram child_;
};

}  // namespace

Result<PeerRecord> run_peer(const PeerCase& one, const PeerPrograms& programs, double scale,
                            const std::stop_token& stop) {
  std::error_code failure;
  fs::create_directories(programs.output, failure);
  if (failure)
    return Error{ErrorCode::output, "the folder cannot be made: " + failure.message(),
                 programs.output.string(), "give -o another folder"};
  return PeerRun(one, programs, scale).run(stop);
}

bool may_be_retried(const PeerRecord& record) {
  return std::ranges::any_of(record.rows, [](const PeerRow& row) {
    return row.outcome == kNotThere || row.outcome == kFailed;
  });
}

std::string outcome_line(const PeerRecord& record) {
  std::vector<std::string> parts;
  for (const PeerRow& row : record.rows)
    parts.push_back(
        row.outcome == kMeasured
            ? fmt::format("{}: {:.1f} times our CPU time", row.who, row.cpu_s / row.ours_cpu_s)
            : fmt::format("{}: {}, {}", row.who, row.outcome, row.result));
  return fmt::format("{}: {}", record.name, fmt::join(parts, "; "));
}

}  // namespace strake::cli
