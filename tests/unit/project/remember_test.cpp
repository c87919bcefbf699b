// SPDX-License-Identifier: Apache-2.0
// Runs over boxes in a row, remembered one after another in a project in memory.
#include "project/results/remember.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "project/database/exchange_tables.hpp"
#include "project/database/history_tables.hpp"
#include "project/database/result_tables.hpp"
#include "project/database/snapshot_tables.hpp"
#include "project/database/view_tables.hpp"
#include "project/results/clash_queries.hpp"
#include "project/update/rename_files.hpp"
#include "strake/clash/incremental.hpp"
#include "strake/parallel/team.hpp"
#include "support/clash_model.hpp"

namespace strake::project {
namespace {

using report::DecisionStatus;
using test::ClashModel;

/// Boxes of 100 mm, each `depth_mm` in the next, from number `first` on.
ClashModel row(int count, double depth_mm = 20, int first = 0) {
  ClashModel m;
  double x = 0;
  for (int i = first; i < count; ++i, x += 100 - depth_mm)
    m.box("c" + std::to_string(i), {x, 0, 0}, {x + 100, 100, 100});
  return m;
}

class Remembered : public ::testing::Test {
 protected:
  void SetUp() override {
    database_ = std::move(Database::in_memory()).value();
    ASSERT_TRUE(database_->execute(kResultTables));
    ASSERT_TRUE(database_->execute(kViewTables));
    ASSERT_TRUE(database_->execute(kHistoryTables));
    ASSERT_TRUE(database_->execute(kExchangeTables));
    ASSERT_TRUE(database_->execute(kSnapshotTables));
  }

  /// Tests the model in full and remembers the run.
  RememberedRun run(const ClashModel& m, const clash::Policy& policy = {}, double deeper_mm = 1,
                    const clash::Options& options = {}) {
    const auto scene = make_scene(m.model, clash::scene_options(options), {}).value();
    const clash::Sets sets = clash::one_set(scene);
    const clash::Signatures signed_by =
        clash::signatures(scene, sets, options, policy, context_).value();
    const Snapshot snapshot{signed_by.rules, identities(m.model, context_).value(),
                            signed_by.objects};
    std::optional<StoredTest> before = read_test(*database_, "", context_).value();
    clash::FollowedRun found;
    if (follows_ && before) {
      const std::vector<std::uint32_t> now_of =
          unchanged(before->snapshot, snapshot, context_).value();
      const bool same_ids = before->snapshot.identities == snapshot.identities;
      found = clash::follow_changes(scene, sets, options, policy,
                                    {before->results.report, now_of, same_ids,
                                     reports_changes_ ? &*before->results.partners : nullptr},
                                    context_)
                  .value();
      if (!reports_changes_) found.changes.reset();
      if (found.changes) before->results.report = std::move(found.earlier);
    } else {
      found.report = clash::detect(scene, sets, options, policy, context_).value();
    }
    if (found.changes) ++reported_;
    found.report.counters = {};
    const clash::Report report = found.report;
    const TestedTest tested{&found.report,
                            &snapshot,
                            &sets,
                            &policy,
                            before ? &*before : nullptr,
                            {},
                            found.changes ? &*found.changes : nullptr};
    Result<RememberedRun> run = remember(
        *database_, m.model, {"2026-01-01T00:00:00Z", "ann", 1, deeper_mm}, {&tested, 1}, context_);
    EXPECT_TRUE(run) << run.error().text();
    if (!is_forged_) expect_statuses(report, run->decided);
    return std::move(run).value();
  }

  /// What is said of each result is the status of its row, and so it is counted.
  void expect_statuses(const clash::Report& report, const report::DecidedResults& decided) {
    std::map<std::string, DecisionStatus> by_key;
    for (const ListedClash& clash : clashes()) by_key[clash.row.key] = clash.status;
    std::array<std::uint64_t, report::kDecisionStatuses.size()> counts{};
    const std::optional<StoredTest> stored = read_test(*database_, "", context_).value();
    for (std::size_t i = 0; i < report.pairs.size(); ++i) {
      const clash::Pair& pair = report.pairs[i];
      const report::DecidedResult* const stated = decided.of(0, pair);
      const DecisionStatus status =
          stated == nullptr ? DecisionStatus::undecided : stated->decision->status;
      if (pair.allowed >= 0) continue;
      const std::string key = row_key(stored->results.rows[i]);
      EXPECT_EQ(name(status), name(by_key[key])) << key;
      ++counts[static_cast<std::size_t>(status)];
    }
    EXPECT_EQ(decided.counts, counts);
  }
  std::string row_key(std::int64_t row) {
    Statement select = database_->prepare("SELECT key FROM clash WHERE id = ?1").value();
    EXPECT_TRUE(select.bind(1, row).step().value());
    return std::string(select.text(0));
  }

  RememberedRun run(const ClashModel& m, const clash::Options& options) {
    return run(m, {}, 1, options);
  }

  std::vector<ListedClash> clashes() { return list_clashes(*database_, {}).value(); }
  std::vector<std::string> statuses() {
    std::vector<std::string> all;
    for (const ListedClash& clash : clashes()) all.emplace_back(name(clash.status));
    return all;
  }
  void decide(std::size_t clash, DecisionStatus status) {
    const std::vector<std::string> keys{clashes()[clash].row.key};
    ClashDecision decision;
    decision.status = status;
    decision.comment = "as agreed";
    decision.by = "bob";
    decision.at = "2026-01-02T00:00:00Z";
    EXPECT_EQ(project::decide(*database_, keys, decision).value(), 1U);
  }
  std::unique_ptr<Database> database_;
  parallel::Context context_;
  bool follows_ = false;          ///< whether runs follow changes
  bool reports_changes_ = false;  ///< whether such runs tell what they did to the results
  int reported_ = 0;              ///< runs that told
  bool is_forged_ = false;        ///< rows belong to another test than the one that found them
};

using Statuses = std::vector<std::string>;

TEST_F(Remembered, clashes_are_new_once_and_active_then_without_a_row_written) {
  const RememberedRun first = run(row(4));
  EXPECT_EQ(first.trends[0].appeared, 3U);
  EXPECT_EQ(first.decided.counts[0], 3U);
  EXPECT_EQ(statuses(), (Statuses{"new", "new", "new"}));
  const RememberedRun second = run(row(4));
  EXPECT_EQ(second.trends[0].appeared, 0U);
  EXPECT_EQ(second.trends[0].written, 0U);
  EXPECT_EQ(second.decided.counts[1], 3U);
  EXPECT_EQ(statuses(), (Statuses{"active", "active", "active"}));
}

TEST_F(Remembered, bytes_do_not_depend_on_the_number_of_workers) {
  // Two parts of 1,024 objects, and a change after it.
  const ClashModel before = row(1500), now = row(1501, 20, 1);
  std::set<std::string> known;
  for (const unsigned workers : {1U, 2U, 3U, 8U, 64U}) {
    SetUp();
    parallel::Team team(workers);
    context_.team = &team;
    EXPECT_EQ(run(before).trends[0].appeared, 1499U);
    run(now);
    known.insert(database_->serialized().value());
    context_ = {};
  }
  EXPECT_EQ(known.size(), 1U);
}

TEST_F(Remembered, what_a_run_reports_its_changes_is_remembered_as_what_is_compared) {
  clash::Options options;
  options.engine.keep_for_changes = true;
  options.engine.max_regions = 8;
  // Deeper, apart, longer, shorter, beside, and as it was: of some clashes people decided.
  const auto week = [&] {
    SetUp();
    ClashModel m = row(1500, 10);
    run(m, options);
    for (const std::size_t clash : {3U, 700U, 1400U}) decide(clash, DecisionStatus::approved);
    decide(5, DecisionStatus::resolved);
    const auto move = [&](const std::string& id, const geometry::Vec3d& by) {
      const auto object = std::ranges::find(m.model.objects, id, &model::Object::id);
      m.model.bodies[object->first_body].placement.translation =
          m.model.bodies[object->first_body].placement.translation + by;
      run(m, options);
    };
    for (const char* const id : {"c3", "c701", "c1499", "c0"}) {
      move(id, {4, 0, 0});
      move(id, {0, 300, 0});
      run(row(1501, 10), options);
      move(id, {0, -295, 0});
    }
    run(row(1498, 10), options);
    return database_->serialized().value();
  };
  follows_ = true;
  const std::string compared = week();
  EXPECT_EQ(reported_, 0);
  reports_changes_ = true;
  EXPECT_TRUE(week() == compared);  // two databases are no text to be shown
  EXPECT_EQ(reported_, 8);
}

TEST_F(Remembered, results_that_are_not_all_there_are_damage_and_not_less_clashes) {
  run(row(4));
  for (const char* const damage :
       {"DELETE FROM report_part", "UPDATE report_part SET part = part + 1",
        "INSERT INTO report_part SELECT test, part + 1, data FROM report_part",
        "UPDATE report SET seal = x''", "UPDATE report SET seal = zeroblob(16)"}) {
    SCOPED_TRACE(damage);
    ASSERT_TRUE(database_->execute("SAVEPOINT before"));
    ASSERT_TRUE(database_->execute(damage));
    const Result<std::optional<StoredTest>> read = read_test(*database_, "", {});
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::input);
    EXPECT_NE(read.error().text().find("is damaged"), std::string::npos) << read.error().text();
    ASSERT_TRUE(database_->execute("ROLLBACK TO before; RELEASE before"));
  }
  EXPECT_TRUE(read_test(*database_, "", {}));
}

TEST_F(Remembered, decisions_hold_and_settle) {
  run(row(4));
  decide(0, DecisionStatus::approved);
  decide(1, DecisionStatus::reviewed);
  const RememberedRun second = run(row(4));
  EXPECT_EQ(second.trends[0].written, 0U);
  EXPECT_EQ(statuses(), (Statuses{"approved", "reviewed", "active"}));
  ASSERT_EQ(second.decided.tests[0].size(), 2U) << "of the third nobody wrote anything";
  EXPECT_TRUE(second.decided.tests[0][0].is_settled());
  EXPECT_FALSE(second.decided.tests[0][1].is_settled());
  EXPECT_EQ(second.decided.tests[0][0].decision->by, "bob");
  EXPECT_EQ(second.decided.tests[0][0].decision->date, "2026-01-02");
}

TEST_F(Remembered, approved_ones_come_back_deeper_as_active_with_an_event) {
  run(row(2));
  decide(0, DecisionStatus::approved);
  EXPECT_EQ(run(row(2, 20.9)).trends[0].written, 1U) << "its depth is another";
  EXPECT_EQ(statuses(), Statuses{"approved"});
  const RememberedRun deeper = run(row(2, 22));
  EXPECT_EQ(statuses(), Statuses{"active"});
  EXPECT_EQ(deeper.decided.tests[0][0].reopened, report::Reopened::deeper);
  EXPECT_EQ(deeper.decided.tests[0][0].decision->status, DecisionStatus::active);
  const std::vector<ClashEvent> events = read_events(*database_, clashes()[0].row.key).value();
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].who, "bob");
  EXPECT_FALSE(events[0].run);
  EXPECT_EQ(events[1].who, kProgram);
  EXPECT_EQ(events[1].run, deeper.number);
  EXPECT_EQ(events[1].comment, "approved at d = -20.000 mm, and -22.000 mm now");
}

TEST_F(Remembered, what_is_gone_is_resolved_and_found_again_new) {
  run(row(2));
  const RememberedRun gone = run(row(2, -500));
  EXPECT_EQ(gone.trends[0].gone, 1U);
  EXPECT_EQ(gone.trends[0].resolved, 1U);
  EXPECT_EQ(statuses(), Statuses{"resolved"});
  EXPECT_EQ(clashes()[0].row.gone_run, gone.number);
  EXPECT_EQ(run(row(2, -500)).trends[0].written, 0U);
  const RememberedRun again = run(row(2));
  EXPECT_EQ(again.trends[0].appeared, 1U);
  EXPECT_EQ(statuses(), Statuses{"new"});
  EXPECT_EQ(clashes()[0].row.first_run, 1);
  EXPECT_FALSE(clashes()[0].row.gone_run);
}

TEST_F(Remembered, what_a_person_resolved_and_is_still_there_is_new_again) {
  run(row(2));
  decide(0, DecisionStatus::resolved);
  EXPECT_EQ(statuses(), Statuses{"resolved"});
  const RememberedRun second = run(row(2));
  EXPECT_EQ(statuses(), Statuses{"new"});
  EXPECT_EQ(second.decided.tests[0][0].reopened, report::Reopened::found_again);
  decide(0, DecisionStatus::resolved);
  run(row(2, -500));
  EXPECT_EQ(statuses(), Statuses{"resolved"});
}

TEST_F(Remembered, an_element_that_is_missing_resolves_nothing) {
  run(row(3));
  decide(0, DecisionStatus::approved);
  const RememberedRun second = run(row(3, 20, 1));
  EXPECT_EQ(second.trends[0].cannot_tell, 1U);
  EXPECT_EQ(second.trends[0].gone, 0U);
  ASSERT_EQ(second.decided.not_found.size(), 1U);
  EXPECT_EQ(clashes()[0].row.unknown, "'c0' is not in the model");
  EXPECT_EQ(statuses(), (Statuses{"approved", "active"}));
  EXPECT_EQ(run(row(3, 20, 1)).trends[0].written, 0U);
  run(row(3));
  EXPECT_EQ(clashes()[0].row.unknown, "");
  EXPECT_EQ(statuses(), (Statuses{"approved", "active"}));
}

TEST_F(Remembered, files_that_end_early_and_objects_not_read_whole_resolve_nothing) {
  run(row(2));
  ClashModel early = row(2, -500);
  early.model.files[0].ends_early = true;
  run(early);
  EXPECT_EQ(clashes()[0].row.unknown, "t.obj ends early");
  ClashModel incomplete = row(2, -500);
  incomplete.model.objects[1].incomplete = true;
  run(incomplete);
  EXPECT_EQ(statuses(), Statuses{"active"});
  EXPECT_NE(clashes()[0].row.unknown, "");
  run(row(2, -500));
  EXPECT_EQ(statuses(), Statuses{"resolved"});
}

TEST_F(Remembered, a_rule_that_allows_resolves_and_one_that_exempts_cannot_decide) {
  run(row(2));
  clash::Policy allowing;
  allowing.allowed.push_back({"meant", {true, true}, {true, true}, {}, {}, 1000, {}, {}});
  run(row(2), allowing);
  EXPECT_EQ(statuses(), Statuses{"resolved"});
  const std::vector<ClashEvent> events = read_events(*database_, clashes()[0].row.key).value();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].comment, "allowed by rule 'meant'");
  run(row(2));
  EXPECT_EQ(statuses(), Statuses{"new"});
  clash::Policy exempting;
  exempting.exemptions.push_back({"same frame", clash::Between{{true, true}, {true, true}}});
  run(row(2), exempting);
  EXPECT_EQ(clashes()[0].row.unknown, "exempted by 'same frame'");
  EXPECT_EQ(statuses(), Statuses{"active"});
}

TEST_F(Remembered, a_test_that_reaches_less_far_cannot_decide_on_any_later_night) {
  clash::Options far;
  far.tolerances.clearance_mm = 25;
  run(row(2, -20), far);
  ASSERT_EQ(clashes()[0].row.now.cls, clash::Class::clearance_violation);
  for (int night = 0; night < 3; ++night) {
    EXPECT_EQ(run(row(2, -20)).trends[0].cannot_tell, 1U) << night;
    EXPECT_EQ(clashes()[0].row.unknown, "the test does not reach as far as it did") << night;
    EXPECT_EQ(statuses(), Statuses{"active"}) << night;
  }
  run(row(2, -50), far);
  EXPECT_EQ(statuses(), Statuses{"resolved"}) << "it reaches as far again, and they are apart";
}

TEST_F(Remembered, another_reason_in_between_does_not_hide_that_a_test_reaches_less_far) {
  clash::Options far;
  far.tolerances.clearance_mm = 25;
  run(row(2, -20), far);
  ClashModel early = row(2, -20);
  early.model.files[0].ends_early = true;
  run(early);
  EXPECT_EQ(clashes()[0].row.unknown, "t.obj ends early");
  run(row(2, -20));
  EXPECT_EQ(clashes()[0].row.unknown, "the test does not reach as far as it did");
}

TEST_F(Remembered, lines_that_are_not_checked_any_more_stay_unknown) {
  geometry::Polylines line;
  line.points = {{-50, 50, 40}, {150, 50, 40}};
  line.first = {0, 2};
  ClashModel m = row(1);
  m.object("line").body(line);
  clash::Options curves;
  curves.engine.curves = clash::Curves::on;
  run(m, curves);
  ASSERT_EQ(clashes().size(), 1U);
  for (int night = 0; night < 3; ++night) {
    run(m);
    EXPECT_EQ(clashes()[0].row.unknown, "lines are not checked any more") << night;
  }
  EXPECT_EQ(statuses(), Statuses{"active"});
}

TEST_F(Remembered, a_mesh_that_became_open_stays_unknown_until_it_is_closed) {
  const auto within = [](bool open) {
    ClashModel m;
    m.box("hull", {0, 0, 0}, {1000, 1000, 1000});
    m.box("inner", {400, 400, 400}, {600, 600, 600});
    auto& mesh = std::get<geometry::TriangleMesh>(m.model.shapes[0]);
    if (open) mesh.triangles.resize(2);
    return m;
  };
  run(within(false));
  ASSERT_EQ(clashes().size(), 1U);
  for (int night = 0; night < 3; ++night) {
    run(within(true));
    EXPECT_NE(clashes()[0].row.unknown.find("'hull' has surfaces that enclose nothing"),
              std::string::npos)
        << night;
  }
  EXPECT_EQ(statuses(), Statuses{"active"});
  run(within(false));
  EXPECT_EQ(clashes()[0].row.unknown, "");
}

/// The night on which it was away says nothing of what it was when the clash was seen.
TEST_F(Remembered, a_mesh_that_was_away_and_comes_back_open_is_unknown) {
  const auto night = [](bool there, bool open) {
    ClashModel m;
    if (there) m.box("hull", {0, 0, 0}, {1000, 1000, 1000});
    m.box("inner", {400, 400, 400}, {600, 600, 600});
    if (open) std::get<geometry::TriangleMesh>(m.model.shapes[0]).triangles.resize(2);
    return m;
  };
  run(night(true, false));
  run(night(false, false));
  EXPECT_EQ(clashes()[0].row.unknown, "'hull' is not in the model");
  for (int n = 0; n < 2; ++n) {
    run(night(true, true));
    EXPECT_NE(clashes()[0].row.unknown.find("'hull' has surfaces that enclose nothing"),
              std::string::npos)
        << n;
    EXPECT_EQ(statuses(), Statuses{"active"});
  }
  run(night(false, false));
  ClashModel apart = night(true, false);
  apart.model.bodies[1].placement.translation = {5000, 0, 0};
  run(apart);
  EXPECT_EQ(statuses(), Statuses{"resolved"}) << "it is a solid again, and was compared";
}

/// What is known of an open mesh does not get lost either: as open as it was, it resolves.
TEST_F(Remembered, a_mesh_that_was_open_all_along_is_compared_when_it_comes_back) {
  const auto night = [](bool there, double at) {
    ClashModel m;
    if (there) m.box("hull", {0, 0, 0}, {1000, 1000, 1000});
    if (there) std::get<geometry::TriangleMesh>(m.model.shapes[0]).triangles.resize(2);
    m.box("post", {400, 400, at - 100}, {600, 600, at + 100});
    return m;
  };
  run(night(true, 0));
  ASSERT_EQ(clashes().size(), 1U) << "it passes through the open face";
  run(night(false, 0));
  run(night(true, 5000));
  EXPECT_EQ(statuses(), Statuses{"resolved"}) << clashes()[0].row.unknown;
}

clash::Options counting_contacts() {
  clash::Options options;
  options.tolerances.clearance_mm = 25;
  options.engine.contacts = clash::Contacts::count;
  options.engine.keep_for_changes = true;
  return options;
}

/// Three boxes, of which the first two touch and the third is far away.
ClashModel closed_row() {
  ClashModel m;
  m.box("c0", {0, 0, 0}, {100, 100, 100}).box("c1", {100, 0, 0}, {200, 100, 100});
  m.box("c2", {900, 0, 0}, {1000, 100, 100});
  return m;
}

TEST_F(Remembered, a_violation_that_closes_to_a_counted_contact_is_that_contact) {
  const clash::Options options = counting_contacts();
  run(row(3, -20), options);
  ASSERT_EQ(statuses(), (Statuses{"new", "new"}));
  decide(0, DecisionStatus::approved);
  for (int night = 0; night < 3; ++night) {
    run(closed_row(), options);
    EXPECT_EQ(clashes()[0].row.unknown, "") << "it was compared";
    EXPECT_EQ(clashes()[0].row.now.cls, clash::Class::contact);
    EXPECT_EQ(statuses(), (Statuses{"active", "resolved"})) << "a contact is severer";
  }
  const std::vector<ClashEvent> events = read_events(*database_, clashes()[0].row.key).value();
  ASSERT_EQ(events.size(), 2U) << "the approval, and one that it came back";
  EXPECT_EQ(events[1].comment, "approved as CLEARANCE_VIOLATION, and CONTACT now");
  decide(0, DecisionStatus::approved);
  run(closed_row(), options);
  EXPECT_EQ(statuses(), (Statuses{"approved", "resolved"})) << "approved as a contact";
}

/// No result of the run before tells that a counted contact is gone.
TEST_F(Remembered, a_counted_contact_that_parts_is_resolved_whether_decided_or_not) {
  const clash::Options options = counting_contacts();
  ClashModel apart = closed_row();
  apart.model.bodies[1].placement.translation = {0, 500, 0};
  for (const bool is_decided : {false, true}) {
    SetUp();
    run(row(3, -20), options);
    if (is_decided) decide(0, DecisionStatus::reviewed);
    run(closed_row(), options);
    run(closed_row(), options);
    EXPECT_EQ(statuses()[0], is_decided ? "reviewed" : "active");
    run(apart, options);
    EXPECT_EQ(statuses()[0], "resolved");
    EXPECT_EQ(clashes()[0].row.gone_run, 4);
  }
}

TEST_F(Remembered, one_change_among_many_writes_a_handful_of_rows) {
  run(row(300));
  ClashModel moved = row(300);
  moved.model.bodies[150].placement.translation = {0, 0, 5};
  const RememberedRun second = run(moved);
  EXPECT_LE(second.trends[0].written, 2U);
  EXPECT_EQ(second.trends[0].appeared, 0U);
}

TEST_F(Remembered, keys_and_decisions_follow_files_that_exchange_their_names) {
  ClashModel m = row(2);
  m.model.files.push_back({"u.obj", "OBJ", "mm", "z", 1, 0});
  m.model.objects[1].file = 1;
  run(m);
  decide(0, DecisionStatus::approved);
  const std::vector<RenamedFile> renamed{{"t.obj", "z.obj"}};
  ASSERT_TRUE(rename_files(*database_, m.model, renamed));
  ClashModel after = row(2);
  after.model.files = {{"u.obj", "OBJ", "mm", "z", 1, 0}, {"z.obj", "OBJ", "mm", "z", 1, 0}};
  std::swap(after.model.objects[0], after.model.objects[1]);
  after.model.objects[1].file = 1;
  const RememberedRun second = run(after);
  EXPECT_EQ(second.trends[0].appeared, 0U);
  EXPECT_EQ(second.trends[0].gone, 0U);
  EXPECT_EQ(statuses(), Statuses{"approved"});
  EXPECT_EQ(clashes()[0].row.b.file, "z.obj");
}

TEST_F(Remembered, who_sees_to_a_clash_leaves_an_event_and_empty_texts_clear) {
  run(row(2));
  const std::vector<std::string> keys{clashes()[0].row.key};
  ClashDecision decision;
  decision.by = "bob";
  decision.at = "2026-01-02T00:00:00Z";
  decision.assignee = "ann";
  EXPECT_EQ(project::decide(*database_, keys, decision).value(), 1U);
  EXPECT_EQ(project::decide(*database_, keys, decision).value(), 0U) << "it is so already";
  decision.assignee.reset();
  decision.comment = "soon";
  EXPECT_EQ(project::decide(*database_, keys, decision).value(), 1U);
  decision.assignee = decision.comment = "";
  EXPECT_EQ(project::decide(*database_, keys, decision).value(), 1U);
  EXPECT_EQ(clashes()[0].row.assignee, "");
  EXPECT_EQ(clashes()[0].row.comment, "");
  std::vector<std::string> comments;
  const std::vector<ClashEvent> events = read_events(*database_, keys[0]).value();
  for (const ClashEvent& event : events) comments.push_back(event.comment);
  EXPECT_EQ(comments, (std::vector<std::string>{"assigned to ann", "soon",
                                                "the comment is taken back; assigned to nobody"}));
}

TEST_F(Remembered, clashes_of_a_test_that_never_ran_are_an_error) {
  ClashFilter filter;
  filter.test = "nope";
  EXPECT_EQ(list_clashes(*database_, filter).error().code, ErrorCode::usage);
  run(row(2));
  ASSERT_TRUE(database_->execute("UPDATE test SET name = 'all'"));
  EXPECT_EQ(list_clashes(*database_, filter).error().mend, "there are 'all'");
  filter.test = "all";
  EXPECT_EQ(list_clashes(*database_, filter).value().size(), 1U);
}

TEST_F(Remembered, an_unknown_key_is_an_error) {
  run(row(2));
  const std::vector<std::string> keys{"none"};
  EXPECT_FALSE(project::decide(*database_, keys, {}));
  EXPECT_FALSE(read_events(*database_, "none"));
}

TEST_F(Remembered, a_damaged_result_names_its_test) {
  run(row(2));
  ASSERT_TRUE(database_->execute("UPDATE report SET snapshot = x'00'"));
  EXPECT_NE(read_test(*database_, "", {}).error().where.find("the test of the command line"),
            std::string::npos);
  ASSERT_TRUE(database_->execute("UPDATE test SET name = 'all'"));
  EXPECT_NE(read_test(*database_, "all", {}).error().where.find("the result of test 'all'"),
            std::string::npos);
}

TEST_F(Remembered, the_tests_of_the_last_run_are_those_that_it_ran) {
  run(row(2));
  EXPECT_EQ(last_tests(*database_).value(), std::vector<std::string>{""});
  ASSERT_TRUE(database_->execute("UPDATE test SET name = 'before'"));
  is_forged_ = true;
  run(row(2));
  EXPECT_EQ(test_names(*database_).value(), (std::vector<std::string>{"before", ""}));
  EXPECT_EQ(last_tests(*database_).value(), std::vector<std::string>{""});
}

TEST_F(Remembered, the_trend_has_each_run) {
  run(row(3));
  run(row(2));
  const std::vector<TrendRow> trend = read_trend(*database_).value();
  ASSERT_EQ(trend.size(), 2U);
  EXPECT_EQ(trend[0].hit, 2U);
  EXPECT_EQ(trend[0].fresh, 2U);
  EXPECT_EQ(trend[0].who, "ann");
  EXPECT_EQ(trend[1].hit, 1U);
  EXPECT_EQ(trend[1].active, 1U);
  EXPECT_EQ(trend[1].cannot_tell, 1U);
}

}  // namespace
}  // namespace strake::project
