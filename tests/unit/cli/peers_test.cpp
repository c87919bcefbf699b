// SPDX-License-Identifier: Apache-2.0
// Peers, played by scripts: whatever they do is a row.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

#include "cli/evaluate/pages/pages.hpp"
#include "cli/evaluate/pages/peer_table.hpp"
#include "cli/evaluate/pages/tables.hpp"
#include "cli/evaluate/peers/peer_cases.hpp"
#include "cli/evaluate/peers/peer_rows.hpp"
#include "cli/evaluate/peers/peer_runs.hpp"
#include "cli/evaluate/record_json.hpp"
#include "io/importer/child_process.hpp"
#include "support/io_files.hpp"

namespace strake::cli {
namespace {

namespace fs = std::filesystem;

PeerRow measured_row() {
  PeerRow row;
  row.scene = "ship of 500 objects";
  row.objects = 500;
  row.triangles = 12000;
  row.threads = 1;
  row.who = "A peer | <another>";
  row.version = "A peer 1.0";
  row.answers = "pairs that overlap";
  row.cpu_s = 3;
  row.wall_s = 2.5;
  row.ours_cpu_s = 0.5;
  row.ours_wall_s = 0.25;
  row.outcome = kMeasured;
  row.result = "all 4 crossing pairs found";
  return row;
}

PeerRow wrong_row() {
  PeerRow row = measured_row();
  row.cpu_s = row.wall_s = 0;
  row.outcome = kDisagrees;
  row.result = "3 of 4 crossing pairs";
  return row;
}

/// Returns the document of one row, with a text in it replaced.
std::string damaged(const PeerRow& row, std::string_view from, std::string_view to) {
  std::string text = peer_rows_json({row});
  return text.replace(text.find(from), from.size(), to);
}

/// A folder with a program that plays the peers at pairs.
class FakePeers : public testing::Test {
 protected:
  /// Makes the program: a script, which knows the file for its rows as $json.
  void play(const std::string& script) {
    const fs::path program = programs_.folder / peer_program(PeerJob::pairs);
    std::ofstream(program) << "#!/bin/sh\n"
                              "for word; do [ \"$before\" = --json ] && json=$word; "
                              "before=$word; done\n"
                           << script << "\n";
    fs::permissions(program, fs::perms::owner_all);
  }
  void play_rows(const std::vector<PeerRow>& rows, const std::string& then = "exit 0") {
    play("cat > \"$json\" <<'END'\n" + peer_rows_json(rows) + "END\n" + then);
  }
  [[nodiscard]] Result<PeerRecord> run(const std::stop_token& stop = {}) const {
    return run_peer(peer_cases().front(), programs_, 0.001, stop);
  }
  /// Returns the only row.
  [[nodiscard]] PeerRow only_row() const {
    const Result<PeerRecord> record = run();
    if (!record || record->rows.size() != 1) {
      ADD_FAILURE() << "not one row";
      return {};
    }
    return record->rows.front();
  }

  test::TemporaryFolder folder_;
  PeerPrograms programs_{folder_.path(), folder_.path() / "peers", 20};
};

TEST_F(FakePeers, RowsComeBackAsTheyWereWritten) {
  play_rows({measured_row(), measured_row()});
  const Result<PeerRecord> record = run();
  ASSERT_TRUE(record.has_value());
  EXPECT_EQ(record->name, peer_cases().front().name);
  EXPECT_EQ(peer_rows_json(record->rows), peer_rows_json({measured_row(), measured_row()}));
  EXPECT_FALSE(may_be_retried(*record));
  EXPECT_NE(outcome_line(*record).find("6.0 times our CPU time"), std::string::npos);
}

TEST_F(FakePeers, TheProgramGetsSizeLimitAndFolders) {
  play("echo \"$@\"; exit 9");
  const std::string stated = only_row().result;
  for (const std::string& word : {std::string("meshes 500 strake"), std::string("--limit 20"),
                                  "--scenes " + programs_.output.string(), std::string("--json")})
    EXPECT_NE(stated.find(word), std::string::npos) << stated;
}

TEST_F(FakePeers, AProgramThatIsMissingIsARow) {
  const PeerRow row = only_row();
  EXPECT_EQ(row.outcome, kNotThere);
  EXPECT_NE(row.result.find("bench_clash_peers cannot be run"), std::string::npos) << row.result;
  EXPECT_TRUE(may_be_retried({"x", {row}}));
}

TEST_F(FakePeers, AProgramThatFailsIsARowWithWhatItStatedLast) {
  play("echo out of luck; exit 3");
  EXPECT_EQ(only_row().outcome, kFailed);
  EXPECT_EQ(only_row().result, "exit status 3: out of luck");
  play("echo off; kill -SEGV $$");
  EXPECT_EQ(only_row().result, "ended by signal 11: off");
  play("exit 0");
  EXPECT_EQ(only_row().result, "it ended without an answer");
}

TEST_F(FakePeers, WhatWasMeasuredBeforeAFailureIsKept) {
  play_rows({measured_row()}, "exit 3");
  const Result<PeerRecord> record = run();
  ASSERT_TRUE(record.has_value());
  ASSERT_EQ(record->rows.size(), 2U);
  EXPECT_EQ(record->rows[0].outcome, kMeasured);
  EXPECT_EQ(record->rows[1].outcome, kFailed);
}

TEST_F(FakePeers, RowsOfAnEarlierRunAreNotTaken) {
  play_rows({measured_row()});
  ASSERT_EQ(only_row().outcome, kMeasured);
  play("exit 0");
  EXPECT_EQ(only_row().outcome, kFailed);
}

TEST_F(FakePeers, WhatIsNoAnswerIsARow) {
  for (const std::string& text :
       {std::string("{"), std::string("[]"), std::string("{\"schema_version\": 1}"),
        damaged(measured_row(), "\"measured\"", "\"fine\""),
        damaged(measured_row(), "\"cpu_s\": 3.0", "\"cpu_s\": -3.0"),
        damaged(measured_row(), "\"wall_s\": 2.5", "\"wall_s\": 0"),
        damaged(measured_row(), "\"objects\": 500", "\"objects\": -500"),
        damaged(measured_row(), "\"triangles\": 12000", "\"triangles\": 1.5"),
        damaged(measured_row(), "\"threads\": 1", "\"threads\": 4294967296"),
        damaged(measured_row(), "\"measured\"", "\"disagrees\"")}) {
    EXPECT_FALSE(parse_peer_rows(text, "x").has_value()) << text;
    play("cat > \"$json\" <<'END'\n" + text + "\nEND");
    EXPECT_EQ(only_row().outcome, kFailed) << text;
    EXPECT_NE(only_row().result.find("no rows of a peer program"), std::string::npos);
  }
}

TEST_F(FakePeers, ALimitEndsAProgramAndAllThatItStarted) {
  programs_.limit_s = 0.1;
  const fs::path late = folder_.path() / "late";
  play("(sleep 0.8; echo > " + late.string() + ") & wait");
  EXPECT_EQ(only_row().outcome, kOverLimit);
  std::this_thread::sleep_for(std::chrono::milliseconds(800));
  EXPECT_FALSE(fs::exists(late)) << "what it started goes on";
}

TEST_F(FakePeers, AStopEndsTheProgram) {
  play("sleep 20");
  std::stop_source source;
  std::thread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    source.request_stop();
  });
  const Result<PeerRecord> record = run(source.get_token());
  stopper.join();
  ASSERT_FALSE(record.has_value());
  EXPECT_EQ(record.error().code, ErrorCode::cancelled);
}

TEST_F(FakePeers, ADisagreementIsADifferenceWithoutATime) {
  play_rows({wrong_row()}, "exit 1");
  EvaluationRecord record;
  record.peers = {{"pairs-strake", {only_row()}}};
  ASSERT_EQ(differences_of(record).size(), 1U);
  EXPECT_NE(differences_of(record).front().find("3 of 4 crossing pairs"), std::string::npos);
  const TableSection section = peer_section(record);
  ASSERT_EQ(section.table.rows.size(), 1U);
  EXPECT_EQ(section.table.rows[0][7], "-") << "no time";
  EXPECT_EQ(section.table.rows[0][11], "NO: 3 of 4 crossing pairs");
  EXPECT_NE(evaluation_html(record).find("<td class=\"wrong\">NO: 3 of 4"), std::string::npos);
}

TEST(PeerPages, ShowRowsEscaped) {
  EvaluationRecord record;
  record.peers = {{"pairs-fcl", {measured_row()}}};
  EXPECT_TRUE(differences_of(record).empty());
  EXPECT_NE(evaluation_html(record).find("A peer | &lt;another&gt;"), std::string::npos);
  EXPECT_NE(evaluation_markdown(record).find("A peer \\| <another>"), std::string::npos);
  EXPECT_NE(peers_csv(record).find("500,12000,"), std::string::npos);
  const std::vector<std::string> row = peer_section(record).table.rows.at(0);
  EXPECT_EQ(row[10], "6.0") << "times ours";
  EXPECT_EQ(evaluation_json(*parse_evaluation(evaluation_json(record), "x")),
            evaluation_json(record));
}

TEST(PeerCases, HaveNamesOfTheirOwnAndScenesThatFollowTheScale) {
  for (const PeerCase& one : peer_cases()) {
    EXPECT_EQ(std::ranges::count(peer_cases(), one.name, &PeerCase::name), 1) << one.name;
    EXPECT_EQ(static_cast<double>(peer_objects(one, 1)), one.full_objects) << one.name;
    EXPECT_EQ(peer_objects(one, 1e-6), 500U) << one.name;
  }
}

TEST(TailOf, IsTheEndFromTheBeginningOfALine) {
  EXPECT_EQ(io::tail_of("", 10), "");
  EXPECT_EQ(io::tail_of("\n\n", 10), "");
  EXPECT_EQ(io::tail_of("all of it\n", 10), "all of it");
  EXPECT_EQ(io::tail_of("first\nsecond\nthird\n", 12), "third");
  EXPECT_EQ(io::tail_of("one long line", 4), "line");
}

}  // namespace
}  // namespace strake::cli
