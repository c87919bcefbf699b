// SPDX-License-Identifier: Apache-2.0
#include "bcf/topics/words.hpp"

#include <gtest/gtest.h>

namespace strake::bcf {
namespace {

using report::DecisionStatus;

TEST(TopicWords, StatusesComeBackAsTheyWere) {
  for (const DecisionStatus status : report::kDecisionStatuses) {
    const std::optional<ParsedStatus> stated = parse_topic_status(topic_status(status));
    ASSERT_TRUE(stated) << name(status);
    EXPECT_EQ(*stated == ParsedStatus::open, status == DecisionStatus::undecided) << name(status);
    if (*stated != ParsedStatus::open) {
      EXPECT_EQ(decided_status(*stated), status) << name(status);
    }
  }
}

TEST(TopicWords, OtherProgramsHaveOtherWords) {
  EXPECT_EQ(parse_topic_status(" CLOSED "), ParsedStatus::resolved);
  EXPECT_EQ(parse_topic_status("In Progress"), ParsedStatus::active);
  EXPECT_FALSE(parse_topic_status(""));
  EXPECT_FALSE(parse_topic_status("perhaps"));
}

}  // namespace
}  // namespace strake::bcf
