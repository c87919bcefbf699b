// SPDX-License-Identifier: Apache-2.0
#include "project/review/decide_if_unchanged.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "support/clash_rows.hpp"

namespace strake::project {
namespace {

using report::DecisionStatus;
using test::add_run;
using test::clash_key;
using test::project_with_clashes;

ClashDecision decision_by(const std::string& who, DecisionStatus status) {
  ClashDecision decision;
  decision.status = status;
  decision.by = who;
  decision.at = "2026-01-02T00:00:00Z";
  return decision;
}

class DecideIfUnchanged : public ::testing::Test {
 protected:
  DecideOutcome decide(const std::vector<std::string>& keys, const ClashDecision& decision,
                       const KnownState& known) {
    return decide_if_unchanged(*database_, keys, decision, known).value();
  }
  KnownState now() { return current_state(*database_).value(); }
  std::string status(int number) {
    const std::vector<std::int64_t> id{number + 1};
    return std::string(report::name(read_clashes(*database_, id).value().at(0).status));
  }
  std::unique_ptr<Database> database_ = project_with_clashes(4);
};

TEST_F(DecideIfUnchanged, what_is_as_it_was_seen_is_decided) {
  const DecideOutcome done =
      decide({clash_key(0), clash_key(2)}, decision_by("ann", DecisionStatus::approved), now());
  EXPECT_EQ(done.changed, 2U);
  EXPECT_TRUE(done.refused.empty());
  EXPECT_EQ(done.decided, (std::vector<std::int64_t>{1, 3}));
  EXPECT_EQ(status(0), "approved");
  EXPECT_EQ(status(1), "new");
  EXPECT_EQ(now(), (KnownState{1, 2}));
}

TEST_F(DecideIfUnchanged, what_somebody_decided_meanwhile_is_refused_and_the_rest_stands) {
  const KnownState known = now();
  decide({clash_key(1)}, decision_by("bob", DecisionStatus::reviewed), known);
  const DecideOutcome done = decide({clash_key(0), clash_key(1), clash_key(2)},
                                    decision_by("ann", DecisionStatus::approved), known);
  EXPECT_EQ(done.changed, 2U);
  ASSERT_EQ(done.refused.size(), 1U);
  EXPECT_EQ(done.refused[0].key, clash_key(1));
  EXPECT_EQ(done.refused[0].why, "bob made it reviewed meanwhile");
  EXPECT_EQ(status(1), "reviewed");
  EXPECT_EQ(status(2), "approved");
  // Who has seen that may decide otherwise.
  EXPECT_EQ(decide({clash_key(1)}, decision_by("ann", DecisionStatus::approved), now()).changed,
            1U);
  EXPECT_EQ(status(1), "approved");
}

TEST_F(DecideIfUnchanged, a_comment_meanwhile_is_a_change_too) {
  const KnownState known = now();
  ClashDecision comment;
  comment.comment = "wait for rev C";
  comment.by = "bob";
  comment.at = "2026-01-02T00:00:00Z";
  decide({clash_key(3)}, comment, known);
  const DecideOutcome done =
      decide({clash_key(3)}, decision_by("ann", DecisionStatus::approved), known);
  EXPECT_EQ(done.changed, 0U);
  ASSERT_EQ(done.refused.size(), 1U);
  EXPECT_EQ(done.refused[0].why, "bob wrote about it meanwhile: wait for rev C");
}

TEST_F(DecideIfUnchanged, a_run_meanwhile_that_leaves_a_clash_as_it_is_is_no_change) {
  const KnownState known = now();
  add_run(*database_, 2);
  ASSERT_TRUE(database_->execute(
      "INSERT INTO event (clash, run, at, who, before, after, comment) VALUES "
      "(1, 2, '2026-01-03T00:00:00Z', 'strake', 'new', 'resolved', 'no longer found')"));
  // One that a person had resolved is gone without another word.
  ASSERT_TRUE(database_->execute("UPDATE clash SET gone_run = 2 WHERE id = 3"));
  const DecideOutcome done = decide({clash_key(0), clash_key(1), clash_key(2)},
                                    decision_by("ann", DecisionStatus::approved), known);
  EXPECT_EQ(done.changed, 1U);
  ASSERT_EQ(done.refused.size(), 2U);
  EXPECT_EQ(done.refused[0].why, "a later run made it resolved: no longer found");
  EXPECT_EQ(done.refused[1].why, "run 2 does not find it any more");
  EXPECT_EQ(status(1), "approved");
}

TEST_F(DecideIfUnchanged,
       what_a_later_run_found_is_not_decided_about_by_who_knows_its_events_alone) {
  const std::int64_t known_run = now().run;
  add_run(*database_, 2);
  ASSERT_TRUE(database_->execute(
      "INSERT INTO event (clash, run, at, who, before, after, comment) VALUES "
      "(1, 2, '2026-01-03T00:00:00Z', 'strake', 'approved', 'active', 'deeper')"));
  // Of one that nobody had approved a run changes the depth without an event.
  ASSERT_TRUE(
      database_->execute("INSERT INTO former VALUES (2, 2, 'found', 'HIT', -1, 1, NULL), "
                         "(3, 2, 'found', 'HIT', -1, 1, NULL);"
                         "UPDATE clash SET d_mm = -50 WHERE id = 2;"
                         "UPDATE clash SET unknown = 'it is left out' WHERE id = 3"));
  const std::vector<std::string> keys{clash_key(0), clash_key(1), clash_key(2), clash_key(3)};
  const ClashDecision approval = decision_by("ann", DecisionStatus::approved);
  const DecideOutcome done = decide(keys, approval, {known_run, now().event});
  EXPECT_EQ(done.decided, (std::vector<std::int64_t>{4}));
  ASSERT_EQ(done.refused.size(), 3U);
  EXPECT_EQ(done.refused[0].why, "a later run made it active: deeper");
  EXPECT_EQ(done.refused[1].why, "run 2 finds it otherwise: HIT, d = -50.000 mm");
  EXPECT_EQ(done.refused[2].why, "run 2 cannot tell whether it is there: it is left out");
  EXPECT_TRUE(decide(keys, approval, now()).refused.empty()) << "who has seen the run may";
}

TEST_F(DecideIfUnchanged, texts_that_are_no_utf8_are_stored_as_such_nowhere) {
  ClashDecision decision = decision_by("bob\xff", DecisionStatus::reviewed);
  decision.comment = "a\xff";
  decision.assignee = "\xff";
  const KnownState known = now();
  decide({clash_key(0)}, decision, known);
  const std::vector<ClashEvent> events = read_events(*database_, clash_key(0)).value();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].who, "bob\ufffd");
  EXPECT_EQ(events[0].comment, "a\ufffd; assigned to \ufffd");
  ASSERT_TRUE(events[0].original.has_value());
  EXPECT_EQ(events[0].original->text, "a\ufffd");
}

TEST_F(DecideIfUnchanged, keys_of_no_clash_are_refused_each) {
  const std::string strange(10000, '\'');
  const DecideOutcome done =
      decide({strange, "", clash_key(0)}, decision_by("ann", DecisionStatus::active), now());
  EXPECT_EQ(done.changed, 1U);
  ASSERT_EQ(done.refused.size(), 2U);
  EXPECT_EQ(done.refused[0].key, strange);
  EXPECT_NE(done.refused[1].why.find("no clash has the key"), std::string::npos);
}

TEST_F(DecideIfUnchanged, changes_are_reported_once_each_from_an_event_on) {
  decide({clash_key(2)}, decision_by("ann", DecisionStatus::approved), now());
  const KnownState known = now();
  decide({clash_key(0), clash_key(1)}, decision_by("ann", DecisionStatus::approved), now());
  decide({clash_key(0)}, decision_by("ann", DecisionStatus::reviewed), now());
  EXPECT_EQ(changed_since(*database_, known.event, 100).value(), (std::vector<std::int64_t>{1, 2}));
  EXPECT_EQ(changed_since(*database_, known.event, 1).value(), (std::vector<std::int64_t>{1}));
  EXPECT_TRUE(changed_since(*database_, now().event, 100).value().empty());
}

}  // namespace
}  // namespace strake::project
