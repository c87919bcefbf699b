// SPDX-License-Identifier: Apache-2.0
// Binary neutral drawings: they say what the text says, and what is wrong with them is reported.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "support/view_documents.hpp"

namespace strake::report {
namespace {

using test::ViewForm;

constexpr std::size_t kChecksum = 16;

/// As versions wrote drawings that knew of none.
std::string without_checksum(const std::string& sound) {
  const std::string named = ",\"checksum\":\"XXH3-128\"}}";
  std::string older = sound.substr(0, sound.size() - kChecksum);
  const std::size_t at = older.find(named);
  EXPECT_NE(at, std::string::npos);
  return older.replace(at, named.size(), "}}" + std::string(named.size() - 2, ' '));
}

model::Model crowd(double apart) {
  test::ClashModel m;
  m.box("a", {0, 0, 0}, {100, 100, 100});
  m.box("b", {90, 20, 20}, {180, 60, 60});
  m.box("c", {apart, 0, 0}, {apart + 50, 50, 50});
  return std::move(m.model);
}

void expect_same(const ViewDocument& text, const ViewDocument& rows) {
  EXPECT_EQ(text.hash, rows.hash);
  EXPECT_EQ(text.settings, rows.settings);
  EXPECT_EQ(text.width_mm, rows.width_mm);
  EXPECT_EQ(text.scale, rows.scale);
  ASSERT_EQ(text.objects.size(), rows.objects.size());
  ASSERT_EQ(text.pieces.size(), rows.pieces.size());
  for (std::size_t i = 0; i < text.pieces.size(); ++i) {
    const ViewPiece &t = text.pieces[i], &r = rows.pieces[i];
    EXPECT_EQ(t.a, r.a);
    EXPECT_EQ(t.b, r.b);
    EXPECT_EQ(t.a_paper, r.a_paper);
    EXPECT_EQ(t.b_paper, r.b_paper);
    EXPECT_EQ(t.object, r.object);
    EXPECT_EQ(t.other, r.other);
    EXPECT_EQ(t.kind, r.kind);
    EXPECT_EQ(t.state, r.state);
  }
}

TEST(ViewRows, StateWhatTheTextStates) {
  // 3 km apart, numbers of 32 bits suffice; 30,000 km apart they do not.
  for (const auto& [apart, bytes] :
       {std::pair(500.0, 64), std::pair(3e6, 64), std::pair(3e10, 104)}) {
    const model::Model model = crowd(apart);
    test::Drawn how;
    how.view.direction = {1, -2, 3};
    const std::string rows = test::view_file(model, how, ViewForm::rows);
    EXPECT_NE(rows.find("\"rows\":{\"bytes\":" + std::to_string(bytes)), std::string::npos)
        << apart;
    const ViewDocument read = test::view_document(rows);
    expect_same(test::view_document(test::view_file(model, how)), read);
    EXPECT_GT(read.pieces.size(), 30U);
  }
}

TEST(ViewRows, PointsThatNothingCanHaveAreReported) {
  const std::string sound = test::view_file(crowd(3e10), {}, ViewForm::rows);
  for (const auto& [offset, key] : {std::pair(24, "a_um"), std::pair(88, "b_paper_um")})
    for (const std::int64_t um : {INT64_MAX, INT64_MIN, std::int64_t{4} << 60U}) {
      std::string bytes = sound;
      std::memcpy(bytes.data() + bytes.size() - kChecksum - 104 + offset, &um, sizeof um);
      std::istringstream in(bytes);
      const auto document = parse_view_document(in, "x.view");
      ASSERT_FALSE(document) << key << " " << um;
      EXPECT_NE(document.error().text().find(key), std::string::npos) << document.error().text();
    }
}

TEST(ViewRows, WhatIsWrongIsReported) {
  const std::string sound = test::view_file(crowd(500), {}, ViewForm::rows);
  const auto error_of = [](const std::string& bytes) {
    std::istringstream in(bytes);
    const auto document = parse_view_document(in, "x.view");
    return document ? std::string() : document.error().text();
  };
  const auto with = [&](const std::string& what, const std::string& by) {
    std::string bytes = sound;
    const std::size_t at = bytes.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    EXPECT_EQ(what.size(), by.size());
    return bytes.replace(at, what.size(), by);
  };
  // In the last row: what stands so many bytes behind its beginning.
  const auto in_row = [&](std::size_t offset, std::uint32_t value) {
    std::string bytes = sound;
    std::memcpy(bytes.data() + bytes.size() - kChecksum - 64 + offset, &value, sizeof value);
    return bytes;
  };
  const auto with_length = [&](std::uint64_t length) {
    std::string bytes = sound;
    std::memcpy(bytes.data() + 8, &length, sizeof length);
    return bytes;
  };
  std::uint64_t length = 0;
  std::memcpy(&length, sound.data() + 8, sizeof length);
  EXPECT_EQ(length % 16, 0U);
  EXPECT_EQ(error_of(sound), "");
  for (const auto& [bytes, words] : std::vector<std::pair<std::string, std::string>>{
           {sound.substr(0, 5), "is no drawing"},
           {"STRIPES!" + sound.substr(8), "is no drawing"},
           {sound.substr(0, 12), "before its rows"},
           {sound.substr(0, 500), "ends too soon"},
           {sound.substr(0, length + 15), "before its rows"},
           {with_length(~std::uint64_t{0}), "no JSON"},
           {with_length(length + 3), "no JSON"},
           {with_length(length - 40), "ends too soon"},
           {sound.substr(0, sound.size() - kChecksum - 65), "ends in row"},
           {sound.substr(0, sound.size() - kChecksum - 1), "ends in row"},
           {sound.substr(0, sound.size() - kChecksum), "ends in the checksum"},
           {sound.substr(0, sound.size() - 1), "ends in the checksum"},
           {in_row(12, 7), "has not the checksum"},
           {with("\"XXH3-128\"", "\"XXH3-129\""), "have a checksum 'XXH3-129'"},
           {sound + "x", "goes on"},
           {without_checksum(in_row(0, 7000)), "is of object 7000"},
           {without_checksum(in_row(0, 7000)), "row "},
           {in_row(16, 0x000000ff), "kind of line"},
           {in_row(16, 0x0000ff00), "state"},
           {with("\"bytes\":64", "\"bytes\":96"), "form of rows"},
           {with("\"offset\":24", "\"offset\":25"), "form of rows"},
           {with("\"a_um\"", "\"z_um\""), "form of rows"},
           {with("\"contour\"", "\"contort\""), "'contort', which this version does not know"},
           {with("\"origin_um\"", "\"origin_mm\""), "has no \"origin_um\""},
           {with("\"kinds\"", "\"bytes\""), "twice"},
           {with("\"bytes\":64", "\"bytes\":6."), "no JSON"},
           {with("\"bytes\":64", "\"bytes\":.5"), "no JSON"},
           {with("\"origin_um\":[", "\"origin_um\":{"), "no point"},
           {with("\"curves\":[]", "\"pieces\":[]"), "beside or instead of its rows"},
           {with("\"projecting\":", "\"duplicate\": "), "twice"},
           {with("\"rows\"", "\"nows\""), "has no \"rows\""},
           {with("\"pieces\":", "\"pierce\":"), "has no \"pieces\""}}) {
    EXPECT_NE(error_of(bytes).find(words), std::string::npos) << words << ": " << error_of(bytes);
    EXPECT_NE(error_of(bytes).find("x.view"), std::string::npos) << error_of(bytes);
  }
}

/// One bit is enough, wherever it is.
TEST(ViewRows, NoBitCanChange) {
  test::ClashModel m;
  m.box("a", {0, 0, 0}, {100, 100, 100});
  const std::string sound = test::view_file(m.model, {}, ViewForm::rows);
  for (std::size_t bit = 0; bit < 8 * sound.size(); ++bit) {
    std::string bytes = sound;
    bytes[bit / 8] = static_cast<char>(static_cast<unsigned char>(bytes[bit / 8]) ^ 1U << bit % 8);
    std::istringstream in(bytes);
    EXPECT_FALSE(parse_view_document(in, "x.view")) << "bit " << bit;
  }
}

TEST(ViewRows, NoEndCanBeMissing) {
  const std::string sound = test::view_file(crowd(500), {}, ViewForm::rows);
  for (std::size_t length = 0; length < sound.size(); ++length) {
    std::istringstream in(sound.substr(0, length));
    EXPECT_FALSE(parse_view_document(in, "x.view")) << length;
  }
}

TEST(ViewRows, OlderDrawingsAreRead) {
  const std::string sound = test::view_file(crowd(500), {}, ViewForm::rows);
  expect_same(test::view_document(sound), test::view_document(without_checksum(sound)));
}

}  // namespace
}  // namespace strake::report
