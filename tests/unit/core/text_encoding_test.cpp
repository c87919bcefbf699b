// SPDX-License-Identifier: Apache-2.0
#include "core/text_encoding.hpp"

#include <gtest/gtest.h>

#include "core/text/counted.hpp"

namespace strake {
namespace {

TEST(Text, characters_of_utf8) {
  EXPECT_EQ(first_character("a").code, U'a');
  EXPECT_EQ(first_character("äb").code, U'ä');
  EXPECT_EQ(first_character("äb").length, 2U);
  EXPECT_EQ(first_character("€").length, 3U);
  EXPECT_EQ(first_character("😀").code, U'😀');
  for (const char* const bad : {"\xC4", "\xC4x", "\xFF", "\xC0\x80", "\xED\xA0\x80",
                                "\xF5\x80\x80\x80", "\xF0\x80\x80\x80", "\xE2\x82", "\x80"})
    EXPECT_EQ(first_character(bad).length, 0U) << bad;
}

TEST(Text, nothing_printable_commands_a_terminal) {
  EXPECT_EQ(printable("pump 1 ä 😀"), "pump 1 ä 😀");
  EXPECT_EQ(printable("\x1b[31mred\x07\n"), "?[31mred??");
  EXPECT_EQ(printable("\xC2\x9B"
                      "31m"),
            "?31m");                                  // the one-character form of ESC [
  EXPECT_EQ(printable("\u202Egpj.exe"), "?gpj.exe");  // shown from right to left
  EXPECT_EQ(printable("bad\xFF\xC3("),
            "bad?"
            "?(");
}

TEST(Text, valid_utf8_keeps_all_else) {
  EXPECT_EQ(valid_utf8("tab\tä\n"), "tab\tä\n");
  EXPECT_EQ(valid_utf8("bad\xFF\xC3("), "bad\xEF\xBF\xBD\xEF\xBF\xBD(");
}

TEST(Text, valid_utf8_copies_only_what_is_not) {
  std::string room = "before";
  const std::string valid = "tab\tä\n";
  EXPECT_EQ(valid_utf8(valid, room).data(), valid.data());
  EXPECT_EQ(room, "before");
  EXPECT_EQ(valid_utf8("bad\xFF\xC3(", room), "bad\xEF\xBF\xBD\xEF\xBF\xBD(");
}

TEST(Text, json_strings) {
  const auto quoted = [](std::string_view text) {
    std::string out;
    append_json_string(out, text);
    return out;
  };
  EXPECT_EQ(quoted("a\"b\\c\n\r\t\x01\x7Fä"), "\"a\\\"b\\\\c\\n\\r\\t\\u0001\\u007fä\"");
  EXPECT_EQ(quoted("\xC4"), "\"\xEF\xBF\xBD\"");
  // Wherever a character stands among others: names are looked at eight bytes at a time.
  for (int code = 0; code < 0x80; ++code) {
    const std::string one(1, static_cast<char>(code));
    std::string inner = quoted(one);
    inner = inner.substr(1, inner.size() - 2);
    for (std::size_t at = 0; at <= 20; ++at) {
      const std::string before(at, '~'), after(20 - at, ' ');
      EXPECT_EQ(quoted(before + one + after), '"' + before + inner + after + '"') << code;
    }
  }
}

TEST(Text, things_are_counted) {
  EXPECT_EQ(counted(0, "topic"), "0 topics");
  EXPECT_EQ(counted(1, "topic"), "1 topic");
  EXPECT_EQ(counted(2, "clash", "clashes"), "2 clashes");
  EXPECT_EQ(counted(1, "clash is", "clashes are"), "1 clash is");
}

}  // namespace
}  // namespace strake
