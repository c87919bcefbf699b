// SPDX-License-Identifier: Apache-2.0
// Runs compared whose objects have ids that are only positions in their files.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "strake/report/clash_diff.hpp"
#include "support/clash_model.hpp"

namespace strake::report {
namespace {

using geometry::Vec3d;
using test::ClashModel;
using Corners = std::vector<Vec3d>;

/// Cubes of 100 mm that nobody named, as a reader calls them.
ClashModel unnamed(const Corners& corners) {
  ClashModel m;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    m.box("node " + std::to_string(i), corners[i], corners[i] + Vec3d{100, 100, 100});
    m.model.objects.back().positional_id = true;
  }
  return m;
}

std::string text_of(ClashModel m) {
  finish(m.model);
  const clash::Findings findings{{m.detect()}, {}};
  std::string text;
  EXPECT_TRUE(
      write_clash_json({findings, m.model}, [&](std::string_view piece) { text += piece; }));
  return text;
}

Result<ClashDocument> document_of(const std::string& text) {
  std::istringstream in(text);
  return parse_clash_document(in, "x.json");
}

/// A document and what it is compared with.
struct Runs {
  ClashDocument before, after;
  ClashDiff diff;

  Runs(const ClashModel& x, const ClashModel& y) : Runs(text_of(x), text_of(y)) {}
  Runs(const std::string& x, const std::string& y)
      : before(document_of(x).value()),
        after(document_of(y).value()),
        diff(compare(before, after)) {}

  /// How many are new, changed, the same, gone, and cannot be known.
  [[nodiscard]] std::vector<std::size_t> counts() const {
    return {diff.added.size(), diff.changed.size(), diff.same.size(), diff.gone.size(),
            diff.cannot_tell.size()};
  }
};

using Counts = std::vector<std::size_t>;

TEST(ClashDiffPositions, WhatDidNotMoveIsTheSameWhateverItsNumbers) {
  const Corners corners{{0, 0, 0}, {90, 0, 0}, {1000, 0, 0}, {1030, 20, 0}, {5000, 0, 0}};
  const ClashModel before = unnamed(corners);
  std::array<std::size_t, 5> order{};
  std::iota(order.begin(), order.end(), 0U);
  do {
    Corners moved;
    for (const std::size_t i : order) moved.push_back(corners[i]);
    ASSERT_EQ(Runs(before, unnamed(moved)).counts(), (Counts{0, 0, 2, 0, 0}));
  } while (std::ranges::next_permutation(order).found);
}

TEST(ClashDiffPositions, NumbersOfMoreDigitsTurnAPairRound) {
  const Corners pair{{0, 0, 0}, {90, 30, 10}};
  Corners behind;
  for (int i = 0; i < 9; ++i) behind.push_back({-5000.0 - 500 * i, 0, 0});
  behind.insert(behind.end(), pair.begin(), pair.end());
  const Runs runs(unnamed(pair), unnamed(behind));
  EXPECT_EQ(runs.after.a(runs.after.results[0]).id, "node 10") << "it stands before node 9";
  EXPECT_EQ(runs.counts(), (Counts{0, 0, 1, 0, 0}));
}

TEST(ClashDiffPositions, AnotherClashOfTheSameNumbersIsNotTheOldOne) {
  const ClashModel before = unnamed({{0, 0, 0}, {90, 0, 0}});
  const ClashModel after = unnamed({{-5000, 0, 0}, {-4910, 0, 0}, {0, 0, 0}, {200, 0, 0}});
  const Runs runs(before, after);
  ASSERT_EQ(runs.counts(), (Counts{0, 0, 0, 0, 2}));
  EXPECT_NE(runs.diff.cannot_tell[0].before, nullptr);
  EXPECT_NE(runs.diff.cannot_tell[1].after, nullptr);
  EXPECT_EQ(runs.diff.cannot_tell[0].why,
            "the id 'node 0' is only a position in t.obj, and no such result is at that place in "
            "the other run");
  EXPECT_FALSE(runs.diff.has_new(false));
  EXPECT_EQ(runs.diff.maybe_new(true), 1U);
  EXPECT_EQ(Runs(after, before).counts(), (Counts{0, 0, 0, 0, 2}));
}

TEST(ClashDiffPositions, AnotherDepthAtThatPlaceIsNotToBeDecided) {
  const Runs runs(unnamed({{0, 0, 0}, {90, 0, 0}}), unnamed({{0, 0, 0}, {89, 0, 0}}));
  EXPECT_EQ(runs.counts(), (Counts{0, 0, 0, 0, 2}));
}

TEST(ClashDiffPositions, ALastingIdOnTheOtherSideMustBeTheSame) {
  const auto with = [](const std::string& name) {
    ClashModel m = unnamed({{5000, 0, 0}, {0, 0, 0}});
    m.box(name, {90, 0, 0}, {190, 100, 100});
    return m;
  };
  const ClashModel pipe = with("pipe");
  EXPECT_EQ(Runs(pipe, with("pipe")).counts(), (Counts{0, 0, 1, 0, 0}));
  EXPECT_EQ(Runs(pipe, with("duct")).counts(), (Counts{0, 0, 0, 0, 2}));
}

TEST(ClashDiffPositions, LastingIdsBesideThemAreComparedAsEver) {
  ClashModel before = unnamed({{0, 0, 0}, {90, 0, 0}});
  before.box("p", {3000, 0, 0}, {3100, 100, 100}).box("q", {3050, 0, 0}, {3150, 100, 100});
  ClashModel after = unnamed({{9000, 0, 0}, {0, 0, 0}, {90, 0, 0}});
  after.box("p", {3000, 0, 0}, {3100, 100, 100}).box("q", {3200, 0, 0}, {3300, 100, 100});
  EXPECT_EQ(Runs(before, after).counts(), (Counts{0, 0, 1, 1, 0}));
  EXPECT_EQ(Runs(after, before).counts(), (Counts{1, 0, 1, 0, 0}));
}

TEST(ClashDiffPositions, ThoseAtOnePlaceGoTogetherWhereTheyAreAsMany) {
  const Corners three(3, {0, 0, 0}), two(2, {0, 0, 0});
  Corners shifted{{-3000, 0, 0}};
  shifted.insert(shifted.end(), three.begin(), three.end());
  EXPECT_EQ(Runs(unnamed(three), unnamed(shifted)).counts(), (Counts{0, 0, 3, 0, 0}));
  const Runs fewer(unnamed(three), unnamed(two));
  ASSERT_EQ(fewer.counts(), (Counts{0, 0, 0, 0, 4}));
  EXPECT_TRUE(fewer.diff.cannot_tell[0].why.ends_with("several results are at that place"));
}

TEST(ClashDiffPositions, ANameThatIsRepeatedSinceIsNoLastingId) {
  ClashModel before, after;
  before.box("pipe", {0, 0, 0}, {100, 100, 100}).box("wall", {90, 0, 0}, {190, 100, 100});
  // The old one is the second of that name, and deeper in the wall.
  after.box("pipe", {5000, 0, 0}, {5100, 100, 100}).box("pipe", {2, 0, 0}, {102, 100, 100});
  after.box("wall", {90, 0, 0}, {190, 100, 100});
  EXPECT_EQ(Runs(before, after).counts(), (Counts{0, 0, 0, 0, 2})) << "no clash is gone";
  EXPECT_EQ(Runs(after, before).counts(), (Counts{0, 0, 0, 0, 2}));
}

TEST(ClashDiffPositions, ResultsThatDoNotStateItAreComparedByKey) {
  const auto silent = [](std::string text) {
    const std::size_t at = text.find("\"positional_ids\"");
    return text.erase(at, text.find('\n', at) + 1 - at);
  };
  const std::string before = text_of(unnamed({{0, 0, 0}, {90, 0, 0}}));
  const std::string after = text_of(unnamed({{-5000, 0, 0}, {-4910, 0, 0}, {0, 0, 0}}));
  EXPECT_EQ(Runs(silent(before), silent(after)).counts(), (Counts{0, 0, 1, 0, 0}));
  EXPECT_EQ(Runs(silent(before), after).counts(), (Counts{0, 0, 0, 0, 2}));
  EXPECT_EQ(Runs(silent(before), before).counts(), (Counts{0, 0, 1, 0, 0}));
}

TEST(ClashDiffPositions, BitsThatDoNotGoWithTheElementsAreRefused) {
  std::string text = text_of(unnamed({{0, 0, 0}, {90, 0, 0}}));
  const std::string bits = "\"positional_ids\": \"";
  const std::size_t at = text.find(bits);
  ASSERT_NE(at, std::string::npos);
  text.insert(at + bits.size(), "AAAA");
  const Result<ClashDocument> read = document_of(text);
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("\"positional_ids\" does not go with \"elements\""),
            std::string::npos);
}

TEST(ClashDiffPositions, TheKeyOfTheOldRunIsReported) {
  const Runs runs(unnamed({{0, 0, 0}, {90, 0, 0}}),
                  unnamed({{-5000, 0, 0}, {0, 0, 0}, {90, 0, 0}, {-5050, 0, 0}}));
  ASSERT_EQ(runs.counts(), (Counts{0, 0, 1, 0, 1}));
  std::string text;
  write_clash_diff_json(runs.diff, [&](std::string_view piece) { text += piece; });
  const std::string key = text_of(unnamed({{0, 0, 0}, {90, 0, 0}}));
  const std::size_t at = key.find("{\"key\": \"") + 9;
  EXPECT_NE(text.find("\"was\": {\"key\": \"" + key.substr(at, 26)), std::string::npos);
  EXPECT_NE(text.find("\"run\": \"new\", \"why\": \"the id 'node 0'"), std::string::npos);
}

/// The run of a model whose file is called otherwise.
std::string text_of_file(ClashModel m, const std::string& label) {
  m.model.files[0].label = label;
  return text_of(std::move(m));
}

TEST(ClashDiffPositions, ARenamedFileWithoutLastingIdsIsFoundByItsPlaces) {
  const ClashDocument before =
      document_of(text_of(unnamed({{0, 0, 0}, {90, 0, 0}, {1000, 0, 0}, {1040, 0, 0}}))).value();
  const ClashModel moved =
      unnamed({{1000, 0, 0}, {1040, 0, 0}, {-9000, 0, 0}, {0, 0, 0}, {90, 0, 0}});
  const ClashDocument after = document_of(text_of_file(moved, "tues.obj")).value();
  EXPECT_EQ(compare(before, after).same.size(), 0U) << "labels decide where no files are given";
  const auto files = match_files(before, after);
  ASSERT_TRUE(files);
  ASSERT_EQ(files->matches.size(), 1U);
  EXPECT_EQ(files->matches[0], (FileMatch{"t.obj", "tues.obj", FileRelation::renamed, 4, 4, true}));
  const ClashDiff diff = compare(before, after, *files);
  EXPECT_EQ(diff.same.size(), 2U);
  EXPECT_TRUE(diff.added.empty() && diff.changed.empty() && diff.gone.empty());
  EXPECT_TRUE(diff.cannot_tell.empty());
}

TEST(ClashDiffPositions, WhatIsMendedInARenamedFileIsGone) {
  const auto boxes = [](double c_from) {
    ClashModel m;
    m.box("a", {0, 0, 0}, {100, 100, 100}).box("b", {90, 0, 0}, {200, 100, 100});
    m.box("c", {c_from, 10, 10}, {300, 90, 90}).box("d", {290, 0, 0}, {400, 100, 100});
    return m;
  };
  const ClashDocument before = document_of(text_of(boxes(180))).value();
  const ClashDocument after = document_of(text_of_file(boxes(210), "revB.obj")).value();
  const auto files = match_files(before, after);
  ASSERT_TRUE(files);
  EXPECT_EQ(files->matches.at(0), (FileMatch{"t.obj", "revB.obj", FileRelation::renamed, 4, 4}));
  const ClashDiff diff = compare(before, after, *files);
  ASSERT_EQ(diff.gone.size(), 1U);
  EXPECT_EQ(before.b(*diff.gone[0].before).id, "c");
  EXPECT_EQ(diff.same.size(), 2U);
  EXPECT_TRUE(diff.added.empty() && diff.cannot_tell.empty());
  EXPECT_EQ(compare(before, after).gone.size(), 0U) << "another file is no mended clash";
}

}  // namespace
}  // namespace strake::report
