// SPDX-License-Identifier: Apache-2.0
#include "bcf/topics/words.hpp"

#include <gtest/gtest.h>

#include "bcf/input/read_bcf.hpp"

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

TEST(TopicDates, AreInUtc) {
  EXPECT_EQ(utc_of("2026-01-31T23:59:59Z"), "2026-01-31T23:59:59Z");
  EXPECT_EQ(utc_of("2026-01-31T23:59:59"), "2026-01-31T23:59:59Z");
  EXPECT_EQ(utc_of("2026-01-31T23:59:59.123456"), "2026-01-31T23:59:59Z");
  EXPECT_EQ(utc_of("2026-03-01T00:30:00+01:00"), "2026-02-28T23:30:00Z");
  EXPECT_EQ(utc_of("2025-12-31T20:30:00.5-05:45"), "2026-01-01T02:15:00Z");
  EXPECT_EQ(utc_of("2026-01-31T24:00:00Z"), "2026-02-01T00:00:00Z");
}

TEST(TopicDates, AreNoneWhereThereIsNoSuchDay) {
  for (const char* const text :
       {"", "2026-01-31", "2026-02-29T00:00:00Z", "2026-13-01T00:00:00Z", "2026-01-31T25:00:00Z",
        "2026-01-31T10:60:00Z", "2026-01-31 10:00:00Z", "2026-01-31T10:00:00+1",
        "2026-01-31T10:00:00Europe", "0000-12-31T00:00:00Z", "0001-01-01T00:00:00+14:00",
        "-200-01-01T00:00:00Z", "2026-01-31T24:00:01Z", "2026-01-31T10:00:00+14:01",
        "2026-01-31T10:00:00+01:60"})
    EXPECT_FALSE(utc_of(text)) << text;
}

}  // namespace
}  // namespace strake::bcf
