// SPDX-License-Identifier: Apache-2.0
// What becomes of a clash from run to run: every row of the table in docs/statuses.md.
#include "project/results/life_cycle.hpp"

#include <gtest/gtest.h>

#include <array>

namespace strake::project {
namespace {

using report::DecisionStatus;
using report::Reopened;

constexpr Measure kThen{clash::Class::contact, -1, 2};

LifeChange after(DecisionStatus status, ObservationKind sight, Measure now = kThen,
                 double deeper_mm = 1) {
  return next({status, kThen, true}, {sight, now, "X"}, deeper_mm);
}

TEST(LifeCycle, keeps_what_was_decided_while_a_clash_is_there) {
  for (const DecisionStatus status : {DecisionStatus::undecided, DecisionStatus::active,
                                      DecisionStatus::reviewed, DecisionStatus::approved}) {
    const LifeChange change = after(status, ObservationKind::found);
    EXPECT_EQ(change.status, status);
    EXPECT_TRUE(change.is_there);
    EXPECT_FALSE(change.is_new);
    EXPECT_EQ(change.cause, "");
  }
}

TEST(LifeCycle, makes_what_is_found_again_new) {
  const LifeChange change = after(DecisionStatus::resolved, ObservationKind::found);
  EXPECT_EQ(change.status, DecisionStatus::undecided);
  EXPECT_TRUE(change.is_new);
  EXPECT_EQ(change.reopened, Reopened::found_again);
  EXPECT_EQ(change.cause, "found again");
}

TEST(LifeCycle, resolves_what_is_gone) {
  for (const DecisionStatus status : report::kDecisionStatuses) {
    const LifeChange change = after(status, ObservationKind::gone);
    EXPECT_EQ(change.status, DecisionStatus::resolved);
    EXPECT_FALSE(change.is_there);
    EXPECT_EQ(change.cause, status == DecisionStatus::resolved ? "" : "no longer found");
  }
}

TEST(LifeCycle, resolves_what_a_rule_allows_but_not_what_is_approved) {
  const LifeChange active = after(DecisionStatus::active, ObservationKind::allowed);
  EXPECT_EQ(active.status, DecisionStatus::resolved);
  EXPECT_EQ(active.cause, "allowed by rule 'X'");
  const LifeChange approved = after(DecisionStatus::approved, ObservationKind::allowed);
  EXPECT_EQ(approved.status, DecisionStatus::approved);
  EXPECT_TRUE(approved.is_there);
}

TEST(LifeCycle, never_changes_what_it_cannot_decide) {
  for (const DecisionStatus status : report::kDecisionStatuses) {
    const LifeChange change = after(status, ObservationKind::cannot_tell);
    EXPECT_EQ(change.status, status);
    EXPECT_TRUE(change.is_there);
    EXPECT_EQ(change.cause, "");
  }
}

TEST(LifeCycle, brings_approved_ones_back_where_they_got_worse) {
  const auto reopened = [](Measure now, double deeper_mm = 1) {
    const LifeChange change =
        after(DecisionStatus::approved, ObservationKind::found, now, deeper_mm);
    EXPECT_EQ(change.status, change.reopened == Reopened::no ? DecisionStatus::approved
                                                             : DecisionStatus::undecided);
    EXPECT_EQ(change.cause.empty(), change.reopened == Reopened::no);
    EXPECT_FALSE(change.is_new) << "it is Active";
    return change.reopened;
  };
  EXPECT_EQ(reopened({clash::Class::contact, -2, 2}), Reopened::no);
  EXPECT_EQ(reopened({clash::Class::contact, -2.001, 2}), Reopened::deeper);
  EXPECT_EQ(reopened({clash::Class::contact, -2.001, 2}, 2), Reopened::no);
  EXPECT_EQ(reopened({clash::Class::hit, -1, 2}), Reopened::severer);
  EXPECT_EQ(reopened({clash::Class::clearance_violation, 3, 2}), Reopened::no);
  EXPECT_EQ(reopened({clash::Class::contact, -1, 3}), Reopened::more_regions);
  EXPECT_EQ(reopened({clash::Class::contact, -1, 0}), Reopened::no) << "they were not counted";
  EXPECT_EQ(
      next({DecisionStatus::approved, {}, false}, {ObservationKind::found, kThen, ""}, 1).reopened,
      Reopened::no)
      << "what it was is not known";
}

}  // namespace
}  // namespace strake::project
