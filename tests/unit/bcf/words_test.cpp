// SPDX-License-Identifier: Apache-2.0
#include "bcf/topics/words.hpp"

#include <gtest/gtest.h>

namespace strake::bcf {
namespace {

using report::DecisionStatus;

TEST(TopicWords, StatusesComeBackAsTheyWere) {
  for (const DecisionStatus status : report::kDecisionStatuses) {
    const std::optional<SaidStatus> said = said_status(topic_status(status));
    ASSERT_TRUE(said) << name(status);
    EXPECT_EQ(*said == SaidStatus::open, status == DecisionStatus::undecided) << name(status);
    if (*said != SaidStatus::open) {
      EXPECT_EQ(decided_status(*said), status) << name(status);
    }
  }
}

TEST(TopicWords, OtherProgramsHaveOtherWords) {
  EXPECT_EQ(said_status(" CLOSED "), SaidStatus::resolved);
  EXPECT_EQ(said_status("In Progress"), SaidStatus::active);
  EXPECT_FALSE(said_status(""));
  EXPECT_FALSE(said_status("perhaps"));
}

}  // namespace
}  // namespace strake::bcf
