// SPDX-License-Identifier: Apache-2.0
#include "strake/core/glob.hpp"

#include <gtest/gtest.h>

#include <string>

namespace strake {
namespace {

TEST(Glob, matches_the_whole_text) {
  struct Case {
    const char* pattern;
    const char* text;
    bool matches;
  };
  for (const Case& one : {
           Case{"", "", true},
           Case{"", "a", false},
           Case{"*", "", true},
           Case{"*", "/any/thing", true},
           Case{"pipe*", "pipe-12", true},
           Case{"pipe*", "a pipe", false},
           Case{"*pipe", "a pipe", true},
           Case{"*a*b*c*", "xxaxxbxxcxx", true},
           Case{"*a*b*c*", "xxaxxcxxbxx", false},
           Case{"p?pe", "pipe", true},
           Case{"p?pe", "ppe", false},
           Case{"?", "ü", true},
           Case{"?", "üx", false},
           Case{"??", "ü", false},
           Case{"[a-c]x", "bx", true},
           Case{"[a-c]x", "dx", false},
           Case{"[!a-c]x", "dx", true},
           Case{"[!a-c]x", "bx", false},
           Case{"[!a]", "ü", true},
           Case{"[]a]", "]", true},
           Case{"[-a]", "-", true},
           Case{"[a", "[a", true},
           Case{"\\*", "*", true},
           Case{"\\*", "x", false},
           Case{"a\\", "a\\", true},
           Case{"/SITE/*/VALVE-[0-9]", "/SITE/ZONE/EQUI/VALVE-7", true},
           Case{"A", "a", false},
           Case{"**a**", "a", true},
       })
    EXPECT_EQ(glob_match(one.pattern, one.text), one.matches) << one.pattern << " on " << one.text;
}

TEST(Glob, does_not_explode) {
  std::string pattern;
  for (int i = 0; i < 50; ++i) pattern += "*a";
  pattern += "b";
  EXPECT_FALSE(glob_match(pattern, std::string(20000, 'a')));
}

TEST(Glob, survives_broken_utf8) {
  EXPECT_TRUE(glob_match("?x", "\xf0x"));
  EXPECT_TRUE(glob_match("*", "\xff\xfe\x80"));
  EXPECT_TRUE(glob_match("???", "\xff\xfe\x80"));
}

}  // namespace
}  // namespace strake
