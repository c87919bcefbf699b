// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/json/json.hpp"

#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <string>

#include "io/gltf/document.hpp"
#include "strake/parallel/team.hpp"

namespace strake::io::gltf {
namespace {

JsonDocument parse(const std::string& text) {
  Result<JsonDocument> document = JsonDocument::parse(text);
  EXPECT_TRUE(document) << text << ": " << (document ? "" : document.error().text());
  return document ? std::move(*document) : JsonDocument{};
}

TEST(JsonValue, FindsValuesByKeyAndPlace) {
  const std::string text =
      R"( {"a": [1, -2.5e1, true, null, "x"], "b": {"c": {"d": 7}}, "e": "", "a": 9} )";
  const JsonDocument document = parse(text);
  const JsonValue root = document.root();
  const std::vector<JsonValue> items = root["a"].items();
  ASSERT_EQ(items.size(), 5U);
  EXPECT_EQ(items[0].index(), 1U);
  EXPECT_EQ(items[1].number(), -25.0);
  EXPECT_EQ(items[1].index(), std::nullopt);
  EXPECT_EQ(items[2].boolean(), true);
  EXPECT_EQ(items[3].type(), JsonType::null);
  EXPECT_EQ(items[4].text_value(), "x");
  EXPECT_EQ(root["b"]["c"]["d"].index(), 7U);
  EXPECT_FALSE(root["b"]["x"]["d"].exists());
  EXPECT_TRUE(root["e"].is_string());
  EXPECT_EQ(root["b"].items().size(), 1U);
  EXPECT_EQ(root["b"].raw(), R"({"c": {"d": 7}})");
}

TEST(JsonValue, DecodesStrings) {
  const std::string text = R"(["\"\\\/\b\f\n\r\t", "\u00e4\u20AC", "\ud83d\ude00", "\ud83d", "ä",)"
                           "\"\xC4\"]";
  const JsonDocument document = parse(text);
  std::vector<std::string> decoded;
  document.root().elements([&](const JsonValue& item) { decoded.push_back(item.text_value()); });
  EXPECT_EQ(decoded, (std::vector<std::string>{"\"\\/\b\f\n\r\t", "ä€", "😀", "\xEF\xBF\xBD", "ä",
                                               "\xEF\xBF\xBD"}));
}

TEST(JsonValue, FindsKeysThatAreEscaped) {
  const std::string text = R"({"\u0061\n": 5})";
  const JsonDocument document = parse(text);
  EXPECT_EQ(document.root()["a\n"].index(), 5U);
}

TEST(JsonValue, RefusesWhatIsNotJson) {
  for (const char* text :
       {"",       "  ",        "{",       "[",        "]",          "[1",          "[1,",
        "[1,]",   "{,}",       "{\"a\"}", "{\"a\":}", "{\"a\":1,}", "{a:1}",       "[1 2]",
        "[1}",    "{\"a\":1]", "01",      "-",        "1.",         ".5",          "1e",
        "+1",     "tru",       "nul",     "\"",       "\"\\x\"",    "\"\\u12g4\"", "\"\\u12",
        "\"\n\"", "1 2",       "[1]]",    "NaN",      "Infinity",   "'a'"})
    EXPECT_FALSE(JsonDocument::parse(text)) << text;
  const Result<JsonDocument> bad = JsonDocument::parse("{\"a\": [1, x]}");
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().where, "byte 10");
}

TEST(JsonValue, BoundsTheNesting) {
  EXPECT_TRUE(JsonDocument::parse(std::string(512, '[') + std::string(512, ']')));
  EXPECT_FALSE(JsonDocument::parse(std::string(513, '[') + std::string(513, ']')));
  EXPECT_FALSE(JsonDocument::parse(std::string(1'000'000, '[')));
}

/// Everything that a document says, types and places included.
void dump(const JsonValue& json, std::string& out) {
  out += std::to_string(static_cast<int>(json.type()));
  if (json.is_array()) {
    out += '[';
    json.elements([&](const JsonValue& item) { dump(item, out); });
    out += ']';
  } else if (json.is_object()) {
    out += '{';
    json.members([&](const JsonValue& key, const JsonValue& value) {
      out += key.text_value() + ':';
      dump(value, out);
    });
    out += '}';
  }
  out.append(json.raw()).append(",");
}

std::string answer(const std::string& text, std::size_t piece_bytes,
                   const parallel::Context& context = {}) {
  const Result<JsonDocument> document = JsonDocument::parse(text, context, piece_bytes);
  if (!document) return document.error().text();
  std::string out;
  dump(document->root(), out);
  return out;
}

/// A document of all kinds of values, strings full of what could be taken for structure.
void append_random(std::mt19937& random, int depth, std::string& out) {
  static constexpr std::array<const char*, 12> kLeaves{
      "0",          "-12.5e3",          "true", "null", "\"a,b\"", R"("\\")",
      R"("\",\"")", R"("{[,\u0041]}")", "[]",   "{}",   "\"\"",    "false"};
  const auto kind = random() % 4;
  if (depth == 0 || kind == 0) {
    out += kLeaves[random() % kLeaves.size()];
    return;
  }
  const bool object = kind == 1;
  out += object ? '{' : '[';
  for (auto count = random() % 5, i = 0 * count; i < count; ++i) {
    if (i != 0) out += random() % 2 == 0 ? "," : " ,\n";
    if (object) out += R"("k\")" + std::to_string(random() % 100) + "\": ";
    append_random(random, depth - 1, out);
  }
  out += object ? '}' : ']';
}

TEST(JsonValue, StatesTheSameInPiecesOfAnySize) {
  parallel::Team team(3);
  parallel::Context context;
  context.team = &team;
  for (unsigned number = 1; number <= 60; ++number) {
    SCOPED_TRACE(number);
    std::mt19937 random(number);
    std::string text = "[";
    while (text.size() < 600) {
      append_random(random, 6, text);
      text += ",";
    }
    text.back() = ']';
    const std::string whole = answer(text, text.size() + 1);
    ASSERT_TRUE(nlohmann::json::accept(text)) << text;
    ASSERT_TRUE(whole.starts_with("5[") || whole.starts_with("6[")) << whole;
    for (std::size_t piece = 1; piece < 70; ++piece)
      ASSERT_EQ(answer(text, piece, context), whole) << piece << " in " << text;
  }
}

TEST(JsonValue, RefusesTheSameInPiecesOfAnySize) {
  for (unsigned number = 1; number <= 3000; ++number) {
    SCOPED_TRACE(number);
    std::mt19937 random(number);
    std::string text;
    append_random(random, 5, text);
    const std::string pool = "{}[]\",:0 \\";
    for (auto k = random() % 3; k > 0; --k)
      text.insert(random() % (text.size() + 1), 1, pool[random() % pool.size()]);
    const std::string whole = answer(text, text.size() + 1);
    for (const std::size_t piece : {1U, 2U, 3U, 5U, 8U, 13U, 21U})
      ASSERT_EQ(answer(text, piece), whole) << piece << " in " << text;
  }
}

TEST(JsonValue, BoundsTheNestingAcrossPieces) {
  const auto nested = [](std::size_t depth) {
    std::string text;
    for (std::size_t i = 0; i < depth; ++i) text += "[1, ";
    text += "1";
    for (std::size_t i = 0; i < depth; ++i) text += ", 2]";
    return text;
  };
  for (const std::size_t piece : {7U, 100U, 10000U}) {
    EXPECT_TRUE(JsonDocument::parse(nested(512), {}, piece));
    EXPECT_FALSE(JsonDocument::parse(nested(513), {}, piece));
  }
}

TEST(JsonValue, AgreesWithAnotherParserOnMutatedText) {
  // Whether a text is JSON at all: both must say the same of thousands of damaged documents.
  const std::string good =
      R"({"nodes":[{"name":"a\u00e4\n","matrix":[1,0.5,-2e-3,0]},{"x":true,"y":null}],"z":{}})";
  const unsigned seed = 7;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  const std::string pool = "{}[]\",:0123456789.eE+-truefalsn \\u/\t";
  for (int i = 0; i < 20000; ++i) {
    std::string text = good;
    for (unsigned k = 0; k <= random() % 3; ++k) {
      const std::size_t at = random() % text.size();
      const char c = pool[random() % pool.size()];
      if (random() % 3 == 0)
        text.erase(at, 1);
      else if (random() % 2 == 0)
        text.insert(at, 1, c);
      else
        text[at] = c;
    }
    ASSERT_EQ(static_cast<bool>(JsonDocument::parse(text)), nlohmann::json::accept(text)) << text;
  }
}

/// What a document says, its nodes put together from their pieces; "no JSON" where it is none.
std::string answer_of_document(const std::string& text, std::size_t piece_bytes,
                               const parallel::Context& context = {}) {
  const Result<Document> document = Document::open(text, context, piece_bytes);
  if (!document) return "no JSON";
  std::string out;
  std::size_t count = 0;
  for (const ArrayPiece& piece : document->node_pieces()) {
    const std::optional<JsonDocument> items = JsonDocument::parse_items(piece.text, kNodeDepth);
    if (!items) return "no JSON";
    EXPECT_EQ(piece.first, count);
    items->each_item([&](const JsonValue& item) {
      dump(item, out);
      ++count;
    });
    EXPECT_EQ(piece.first + piece.count, count);
  }
  EXPECT_EQ(document->node_count(), count);
  document->root().members([&](const JsonValue& key, const JsonValue& value) {
    out += "|" + key.text_value() + ":";
    if (!key.is_text("nodes")) dump(value, out);
  });
  return out;
}

/// An outermost object with nodes, and much that could be taken for nodes.
std::string random_document(std::mt19937& random) {
  static constexpr std::array<const char*, 5> kKeys{"\"nodes\"", R"("n\u006fdes")", R"("a\"nodes")",
                                                    "\"meshes\"", "\"node\""};
  std::string text = "{";
  const auto members = 1 + random() % 4;
  for (std::size_t m = 0; m < members; ++m) {
    if (m != 0) text += ",\n";
    text += kKeys[m == members / 2 ? 0 : random() % kKeys.size()];
    text += random() % 2 == 0 ? ":" : " : ";
    if (random() % 8 == 0) {
      append_random(random, 3, text);
      continue;
    }
    text += random() % 2 == 0 ? "[" : "[ ";
    for (auto count = random() % 30, i = 0 * count; i < count; ++i) {
      if (i != 0) text += ",";
      append_random(random, 4, text);
    }
    text += "]";
  }
  return text + "}";
}

TEST(Document, StatesTheSameInPiecesOfAnySize) {
  parallel::Team team(3);
  const parallel::Context context{.team = &team};
  std::size_t split = 0;
  for (unsigned number = 1; number <= 300; ++number) {
    SCOPED_TRACE(number);
    std::mt19937 random(number);
    const std::string text = random_document(random);
    ASSERT_TRUE(nlohmann::json::accept(text)) << text;
    const std::string whole = answer_of_document(text, text.size() + 1);
    for (const std::size_t piece : {1U, 2U, 7U, 30U, 63U, 64U, 65U, 128U, 200U})
      ASSERT_EQ(answer_of_document(text, piece, context), whole) << piece << " in " << text;
    const Result<Document> pieces = Document::open(text, {}, 64);
    if (pieces && pieces->node_pieces().size() > 1) ++split;
  }
  EXPECT_GT(split, 100U);
}

TEST(Document, RefusesTheSameInPiecesOfAnySize) {
  for (unsigned number = 1; number <= 2000; ++number) {
    SCOPED_TRACE(number);
    std::mt19937 random(number);
    std::string text = random_document(random);
    const std::string pool = "{}[]\",:0 \\";
    for (auto k = random() % 3; k > 0; --k)
      text.insert(random() % (text.size() + 1), 1, pool[random() % pool.size()]);
    const std::string whole = answer_of_document(text, text.size() + 1);
    ASSERT_EQ(whole == "no JSON", !nlohmann::json::accept(text)) << text;
    for (const std::size_t piece : {1U, 5U, 64U, 100U})
      ASSERT_EQ(answer_of_document(text, piece), whole) << piece << " in " << text;
  }
}

TEST(Document, BoundsTheNestingOfNodesAsOfAllValues) {
  const auto nested = [](std::size_t depth) {
    const std::string text = "{\"nodes\":[0," + std::string(depth - 2, '[');
    return text + std::string(depth - 2, ']') + ",0]}";
  };
  for (const std::size_t piece : {64U, 10000U}) {
    EXPECT_NE(answer_of_document(nested(512), piece), "no JSON");
    EXPECT_EQ(answer_of_document(nested(513), piece), "no JSON");
  }
}

}  // namespace
}  // namespace strake::io::gltf
