// SPDX-License-Identifier: Apache-2.0
#include "core/text/dates.hpp"

#include <gtest/gtest.h>

namespace strake {
namespace {

TEST(Dates, AreInUtc) {
  EXPECT_EQ(utc_of("2026-01-31T23:59:59Z"), "2026-01-31T23:59:59Z");
  EXPECT_EQ(utc_of("2026-01-31T23:59:59"), "2026-01-31T23:59:59Z");
  EXPECT_EQ(utc_of("2026-01-31T23:59:59.123456"), "2026-01-31T23:59:59Z");
  EXPECT_EQ(utc_of("2026-03-01T00:30:00+01:00"), "2026-02-28T23:30:00Z");
  EXPECT_EQ(utc_of("2025-12-31T20:30:00.5-05:45"), "2026-01-01T02:15:00Z");
  EXPECT_EQ(utc_of("2026-01-31T24:00:00Z"), "2026-02-01T00:00:00Z");
}

TEST(Dates, AreNoneWhereThereIsNoSuchDay) {
  for (const char* const text :
       {"", "2026-01-31", "2026-02-29T00:00:00Z", "2026-13-01T00:00:00Z", "2026-01-31T25:00:00Z",
        "2026-01-31T10:60:00Z", "2026-01-31 10:00:00Z", "2026-01-31T10:00:00+1",
        "2026-01-31T10:00:00Europe", "0000-12-31T00:00:00Z", "0001-01-01T00:00:00+14:00",
        "-200-01-01T00:00:00Z", "2026-01-31T24:00:01Z", "2026-01-31T10:00:00+14:01",
        "2026-01-31T10:00:00+01:60"})
    EXPECT_FALSE(utc_of(text)) << text;
}

TEST(Dates, OfCStateNoZone) {
  EXPECT_EQ(utc_of_c_time("Thu Jul 11 09:38:20 2013"), "2013-07-11T09:38:20Z");
  EXPECT_EQ(utc_of_c_time("Mon Oct  4 17:12:39 2021\n"), "2021-10-04T17:12:39Z");
  for (const char* const text :
       {"", "Thu Jul 11 09:38:20 13", "Thu Jux 11 09:38:20 2013", "Thu anF 11 09:38:20 2013",
        "Thu Feb 30 09:38:20 2013", "Thu Jul 1x 09:38:20 2013", "Thu Jul 11 09:38:61 2013",
        "11 Jul 2013 09:38:20 more"})
    EXPECT_FALSE(utc_of_c_time(text)) << text;
}

TEST(Dates, DaysHaveAForm) {
  EXPECT_TRUE(is_day("2026-01-31"));
  for (const char* const text : {"", "2026-1-31", "2026-01-311", "2026/01/31", "yyyy-mm-dd"})
    EXPECT_FALSE(is_day(text)) << text;
}

}  // namespace
}  // namespace strake
