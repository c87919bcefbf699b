// SPDX-License-Identifier: Apache-2.0
#include "core/glob.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <string_view>

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

/// The definition, by trying every way.
bool matches(std::string_view pattern, std::string_view text) {
  if (pattern.empty()) return text.empty();
  if (pattern[0] == '*')
    return matches(pattern.substr(1), text) || (!text.empty() && matches(pattern, text.substr(1)));
  return !text.empty() && (pattern[0] == '?' || pattern[0] == text[0]) &&
         matches(pattern.substr(1), text.substr(1));
}

TEST(Glob, is_what_trying_every_way_gives) {
  std::mt19937 random(7);
  const auto word = [&](std::string_view letters, std::size_t most) {
    std::string text(random() % most, ' ');
    for (char& c : text) c = letters[random() % letters.size()];
    return text;
  };
  int matched = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::string pattern = word("ab*?", 8), text = word("ab/", 10);
    ASSERT_EQ(glob_match(pattern, text), matches(pattern, text)) << pattern << " on " << text;
    matched += glob_match(pattern, text) ? 1 : 0;
  }
  EXPECT_GT(matched, 1000);
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
