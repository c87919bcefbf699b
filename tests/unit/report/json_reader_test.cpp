// SPDX-License-Identifier: Apache-2.0
#include "report/json/json_reader.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace strake::report {
namespace {

using nlohmann::json;

std::optional<std::string> copied(const std::string& text) {
  std::istringstream in(text);
  try {
    JsonReader reader(in, 12);
    std::string out;
    reader.copy(out);
    reader.end();
    return out;
  } catch (const JsonReader::Fault&) {
    return std::nullopt;
  }
}

TEST(JsonReader, TakesWhatIsRequestedAndSkipsTheRest) {
  std::istringstream in(
      "\xEF\xBB\xBF {\"skip\": [1, {\"x\": [null, true]}, \"]\"], \"d\" : -2.5e1 "
      ",\"t\":\"\\u00e4\\ud83d"
      "\\ude00\\n\", \"list\": [1,2 , 3], \"none\": [], \"empty\": {}}\n");
  JsonReader reader(in, 12);
  std::string text;
  double d = 0, sum = 0;
  reader.members([&](std::string_view key) {
    if (key == "d")
      d = reader.number();
    else if (key == "t")
      text = reader.text();
    else if (key == "list")
      reader.items([&] { sum += reader.number(); });
    else
      reader.skip();
  });
  reader.end();
  EXPECT_EQ(d, -25);
  EXPECT_EQ(text, "ä😀\n");
  EXPECT_EQ(sum, 6);
}

/// What one library takes for JSON the other does, and reads the same.
TEST(JsonReader, AgreesWithAnother) {
  for (const char* const text : {"0",
                                 "-0",
                                 "01",
                                 "1.",
                                 ".5",
                                 "1e5",
                                 "1E+5",
                                 "1e",
                                 "-",
                                 "+1",
                                 "0x1",
                                 "1.5e-3",
                                 "tru",
                                 "true",
                                 "truex",
                                 "nul",
                                 "null",
                                 "\"\"",
                                 "\"\\x\"",
                                 "\"\\u12g4\"",
                                 "\"\\udc00\"",
                                 "\"\\ud800\\u0041\"",
                                 "\"\t\"",
                                 "\"\x7F\"",
                                 "\"\xC3\xA4\"",
                                 "\"\xC3\"",
                                 "\"\xED\xA0\x80\"",
                                 "[1,]",
                                 "[,1]",
                                 "[1 2]",
                                 "{\"a\" 1}",
                                 "{a: 1}",
                                 "{\"a\": 1,}",
                                 "{\"a\": 1}}",
                                 "[1}",
                                 "{\"a\": 1]",
                                 "",
                                 " ",
                                 "[]",
                                 "{}",
                                 " [ ] ",
                                 "{\"a\": [{}, [], \"\\\"\"]}",
                                 "/**/1",
                                 "NaN",
                                 "[1]x"}) {
    const auto ours = copied(text);
    const json other = json::parse(text, nullptr, false);
    ASSERT_EQ(ours.has_value(), !other.is_discarded()) << text;
    if (ours) {
      EXPECT_EQ(json::parse(*ours), other) << text;
    }
  }
}

/// Values that lie over the end of the reader's buffer, at every place of theirs.
TEST(JsonReader, ValuesMayLieOverTheEndOfTheBuffer) {
  constexpr std::size_t kBuffer = std::size_t{1} << 18U;
  const std::string value =
      R"({"key \u00e4\ud83d\ude00 ä": [true, null, -12.25e+2, "text\\ \"", {"n": 1}]})";
  const json meant = json::parse(value);
  for (std::size_t before = kBuffer - value.size() - 2; before <= kBuffer; ++before) {
    const auto ours = copied(std::string(before, ' ') + value + "  ");
    ASSERT_TRUE(ours) << before;
    ASSERT_EQ(json::parse(*ours), meant) << before;
  }
  const std::string names(3 * kBuffer, 'n');
  EXPECT_EQ(copied("[\"" + names + "\"]"), "[\"" + names + "\"]");
}

TEST(JsonReader, CountsLines) {
  std::istringstream in(std::string(300'000, '\n') + "[1,\n2\n;");
  JsonReader reader(in, 12);
  try {
    reader.skip();
    FAIL();
  } catch (const JsonReader::Fault& fault) {
    EXPECT_EQ(fault.what, JsonReader::Fault::What::broken);
    EXPECT_EQ(fault.line, 300'003U);
  }
}

}  // namespace
}  // namespace strake::report
