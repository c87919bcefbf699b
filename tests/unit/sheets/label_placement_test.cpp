// SPDX-License-Identifier: Apache-2.0
// Labels on paper whose lines are known: what is free is found, and nothing is covered.
#include "sheets/labels/label_placement.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <ctime>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "support/draw.hpp"

namespace strake::sheets {
namespace {

using Places = std::vector<std::optional<LabelPlace>>;

/// Paper of A3 with lines.
struct Paper {
  SheetArea room{{10, 10, 410, 287}, {}};
  std::vector<PaperSegment> lines;
  std::vector<PaperBox> views;

  void frame(const PaperBox& box) {
    const PaperPoint a{box.left, box.top}, b{box.right, box.top}, c{box.right, box.bottom},
        d{box.left, box.bottom};
    lines.insert(lines.end(), {{a, b}, {b, c}, {c, d}, {d, a}});
  }
  /// Draws lines everywhere but in some boxes.
  void ink_all_but(const std::vector<PaperBox>& holes) {
    for (double y = 0.5; y < 297; ++y) {
      double from = 0;
      // Holes do not overlap and come from left to right.
      for (const PaperBox& hole : holes)
        if (hole.top < y && y < hole.bottom) {
          lines.push_back({{from, y}, {hole.left, y}});
          from = hole.right;
        }
      lines.push_back({{from, y}, {420, y}});
    }
  }
  [[nodiscard]] Places place(const std::vector<LabelRequest>& requests) const {
    OccupancyGrid occupied(420, 297);
    for (const PaperSegment& line : lines) occupied.add_line(line.a, line.b);
    occupied.finish();
    return place_labels(requests, {420, 297, occupied, room, views}, {});
  }
};

LabelRequest request(PaperPoint anchor, double width, std::size_t view = 0) {
  return {.width_mm = width, .height_mm = 2.5, .anchors = {anchor}, .object = {}, .view = view};
}

/// What is wrong with places: texts on texts, on lines and under leaders, and crossed leaders.
struct Faults {
  std::size_t without = 0, on_texts = 0, on_lines = 0, under_leaders = 0, crossings = 0;
};

Faults faults_of(const Places& places, const Paper& paper) {
  Faults f;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i]) {
      ++f.without;
      continue;
    }
    const LabelPlace& one = *places[i];
    for (const PaperSegment& line : paper.lines)
      if (clipped(line, one.box)) ++f.on_lines;
    for (std::size_t k = 0; k < places.size(); ++k) {
      if (k == i || !places[k]) continue;
      const LabelPlace& other = *places[k];
      if (other.has_leader && clipped(other.leader, one.box)) ++f.under_leaders;
      if (k > i) continue;
      if (one.box.overlaps(other.box)) ++f.on_texts;
      if (one.has_leader && other.has_leader && segments_cross(one.leader, other.leader))
        ++f.crossings;
    }
  }
  return f;
}

void expect_clean(const Faults& f) {
  EXPECT_EQ(f.on_texts, 0U);
  EXPECT_EQ(f.on_lines, 0U);
  EXPECT_EQ(f.under_leaders, 0U);
}

TEST(Segments, CrossWhereTheyDo) {
  EXPECT_TRUE(segments_cross({{0, 0}, {2, 2}}, {{0, 2}, {2, 0}}));
  EXPECT_FALSE(segments_cross({{0, 0}, {2, 2}}, {{0, 0}, {2, 0}})) << "one end";
  EXPECT_FALSE(segments_cross({{0, 0}, {2, 0}}, {{1, 0}, {3, 0}})) << "one line";
  EXPECT_FALSE(segments_cross({{0, 0}, {2, 2}}, {{3, 0}, {9, 9}}));
}

TEST(Segments, AreClippedByBoxes) {
  const auto through = clipped({{-1, 1}, {5, 1}}, {0, 0, 4, 2});
  ASSERT_TRUE(through);
  EXPECT_EQ(through->a, (PaperPoint{0, 1}));
  EXPECT_EQ(through->b, (PaperPoint{4, 1}));
  EXPECT_FALSE(clipped({{-1, 3}, {5, 3}}, {0, 0, 4, 2}));
  EXPECT_FALSE(clipped({{3, -3}, {9, 3}}, {0, 0, 4, 2})) << "past a corner";
  EXPECT_TRUE(clipped({{1, 1}, {1, 1}}, {0, 0, 4, 2})) << "a point";
}

TEST(Occupancy, NeverCallsABoxFreeThatALineTouches) {
  test::Draw draw(7);
  for (int round = 0; round < 3000; ++round) {
    OccupancyGrid occupied(100, 80);
    const PaperSegment line{{draw.between(-20, 120), draw.between(-20, 100)},
                            {draw.between(-20, 120), draw.between(-20, 100)}};
    occupied.add_line(line.a, line.b);
    occupied.finish();
    const double x = draw.between(1, 88), y = draw.between(1, 73);
    const PaperBox box{x, y, x + draw.between(0.1, 10), y + draw.between(0.1, 5)};
    if (clipped(line, widened(box, kClearanceMm))) {
      EXPECT_FALSE(occupied.is_free(box)) << round;
    }
    // Nor is what lies far from the line taken.
    if (!clipped(line, widened(box, kClearanceMm + 2.5))) {
      EXPECT_TRUE(occupied.is_free(box)) << round;
    }
  }
}

TEST(Labels, OfARowOfBoxesStandClearOfThemAndOfEachOther) {
  Paper paper;
  std::vector<LabelRequest> requests;
  for (int i = 0; i < 16; ++i) {
    const double x = 60 + i * 9;
    paper.frame({x, 100, x + 7, 130});
    requests.push_back(request({x + 3.5, 100}, 34));
  }
  const Faults f = faults_of(paper.place(requests), paper);
  expect_clean(f);
  EXPECT_EQ(f.without, 0U);
  EXPECT_EQ(f.crossings, 0U);
}

TEST(Labels, TakeTheNearestFreePaper) {
  Paper paper;
  paper.ink_all_but({{200, 128, 230, 138}});
  const Places places = paper.place({request({150, 150}, 20)});
  ASSERT_TRUE(places[0]);
  EXPECT_TRUE((PaperBox{200, 128, 230, 138}).holds(places[0]->box));
  EXPECT_EQ(places[0]->leader.a, (PaperPoint{150, 150}));
  // Beyond the reach there is none.
  EXPECT_FALSE(paper.place({request({50, 150}, 20)})[0]);
  // Nor where it is too small.
  EXPECT_FALSE(paper.place({request({150, 150}, 30)})[0]);
}

// Of two labels the first has two places, and the nearer is the only one of the second.
TEST(Labels, MakeRoomForEachOther) {
  Paper paper;
  const PaperBox near{148, 126, 168, 134}, far{200, 158, 222, 166};
  paper.ink_all_but({near, far});
  const LabelRequest first = request({140, 150}, 12), second = request({70, 150}, 12);
  EXPECT_TRUE(near.holds(paper.place({first})[0].value().box));
  for (const bool turned : {false, true}) {
    const Places places = turned ? paper.place({second, first}) : paper.place({first, second});
    ASSERT_TRUE(places[0] && places[1]);
    EXPECT_TRUE(far.holds(places[turned ? 1 : 0]->box));
    EXPECT_TRUE(near.holds(places[turned ? 0 : 1]->box));
  }
  // A third has no room, and the two keep theirs.
  const Places three = paper.place({first, second, request({142, 150}, 12)});
  EXPECT_EQ(faults_of(three, paper).without, 1U);
}

// The first label's nearest place is beyond the second one's, whose leader would cross the first's.
TEST(Labels, AreUntangled) {
  Paper paper;
  const PaperBox left{84, 126, 104, 134}, right{121, 126, 141, 134};
  paper.ink_all_but({left, right});
  const LabelRequest first = request({110, 150}, 12), second = request({104, 150}, 12);
  EXPECT_TRUE(left.holds(paper.place({first})[0].value().box));
  const Places places = paper.place({first, second});
  EXPECT_EQ(faults_of(places, paper).without, 0U);
  EXPECT_EQ(faults_of(places, paper).crossings, 0U);
  EXPECT_TRUE(right.holds(places[0]->box));
  EXPECT_TRUE(left.holds(places[1]->box));
}

TEST(Labels, OnObjectsCoverNothingOfThem) {
  LabelRequest plate = request({100, 100}, 20);
  plate.on_object = true;
  plate.object = {100, 100, 160, 140};
  Paper paper;
  paper.frame(plate.object);
  const Places middle = paper.place({plate});
  ASSERT_TRUE(middle[0]);
  EXPECT_FALSE(middle[0]->has_leader);
  EXPECT_EQ(middle[0]->at, (PaperPoint{130, 121.25}));
  // A stiffener through its middle: beside it.
  paper.lines.push_back({{100, 120}, {160, 120}});
  const Places beside = paper.place({plate});
  ASSERT_TRUE(beside[0]);
  EXPECT_FALSE(beside[0]->has_leader);
  expect_clean(faults_of(beside, paper));
  // Many: no text has room on it, and it gets a leader.
  for (double x = 103; x < 160; x += 3) paper.lines.push_back({{x, 100}, {x, 140}});
  const Places outside = paper.place({plate});
  ASSERT_TRUE(outside[0]);
  EXPECT_TRUE(outside[0]->has_leader);
  expect_clean(faults_of(outside, paper));
}

TEST(Labels, KeepOutOfOtherViewsWhereTheyCan) {
  Paper paper;
  paper.views = {{100, 100, 200, 200}, {201, 100, 300, 200}};
  const Places places = paper.place({request({199, 150}, 30)});
  ASSERT_TRUE(places[0]);
  EXPECT_FALSE(places[0]->box.overlaps(paper.views[1]));
}

TEST(Labels, OfAnyCrowdCoverNothingAndAreTheSameAgain) {
  test::Draw draw(29);
  for (int round = 0; round < 4; ++round) {
    Paper paper;
    std::vector<LabelRequest> requests;
    const int count = draw.whole(5, 60);
    for (int i = 0; i < count; ++i) {
      const double x = draw.between(60, 340), y = draw.between(60, 230);
      const PaperBox box{x, y, x + draw.between(0.5, 30), y + draw.between(0.5, 20)};
      paper.frame(box);
      requests.push_back(request({x, (box.top + box.bottom) / 2}, draw.between(5, 45)));
      requests.back().object = box;
      requests.back().on_object = draw.one_in(3);
    }
    const Places places = paper.place(requests), again = paper.place(requests);
    const Faults f = faults_of(places, paper);
    expect_clean(f);
    EXPECT_LT(f.without, places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      ASSERT_EQ(places[i].has_value(), again[i].has_value());
      if (!places[i]) continue;
      EXPECT_EQ(places[i]->at, again[i]->at);
      EXPECT_TRUE(paper.room.takes(places[i]->box));
    }
  }
}

/// Bad paper for many labels: narrow gaps between lines, and anchors close together.
std::pair<Paper, std::vector<LabelRequest>> crowd(int count) {
  test::Draw draw(41);
  Paper paper;
  for (double x = 20; x < 400; x += 50) paper.frame({x, 12, x + 10, 285});
  std::vector<LabelRequest> requests;
  for (int i = 0; i < count; ++i)
    requests.push_back(request({draw.between(60, 340), draw.between(60, 230)}, 25));
  return {paper, requests};
}

// The work is counted for all labels together, so the time does not grow with their number: these
// took many minutes once. A limit in seconds of any machine says how busy it is: this one is
// far from any, with sanitizers, too.
TEST(Labels, OfAnyNumberEndSoonAndCoverNothing) {
  const auto [paper, requests] = crowd(3000);
  const std::clock_t start = std::clock();
  const Places places = paper.place(requests);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  EXPECT_LT(seconds, 30);
  const Faults f = faults_of(places, paper);
  expect_clean(f);
  EXPECT_GT(places.size() - f.without, 100U);
}

TEST(Labels, ThatAreStoppedHaveNoPlaces) {
  const auto [paper, requests] = crowd(10);
  OccupancyGrid occupied(420, 297);
  occupied.finish();
  const std::stop_source stop;
  stop.request_stop();
  const Places places =
      place_labels(requests, {420, 297, occupied, paper.room, {}}, stop.get_token());
  for (const auto& place : places) EXPECT_FALSE(place);
}

// Queries look into the bins along a leader alone: they must miss nobody.
TEST(Labels, FindWhatTheyMeetInAnyDirection) {
  test::Draw draw(43);
  for (int round = 0; round < 400; ++round) {
    const auto drawn = [&] {
      LabelPlace place;
      const double x = draw.between(0, 390), y = draw.between(0, 290);
      place.box = {x, y, x + draw.between(1, 30), y + draw.between(1, 7)};
      place.has_leader = true;
      place.leader = {{draw.between(0, 420), draw.between(0, 297)}, {x, place.box.bottom}};
      return place;
    };
    PlacedLabels placed(420, 297, 2);
    LabelPlace one = drawn();
    const LabelPlace other = drawn();
    placed.add(0, one);
    PlacedLabels::Conflicts found;
    placed.find_conflicts(other, {2, 2}, found);
    const auto near = [](const LabelPlace& leader, const LabelPlace& text) {
      return clipped(leader.leader, widened(text.box, kClearanceMm)).has_value();
    };
    const bool blocks =
        widened(one.box, kClearanceMm).overlaps(other.box) || near(one, other) || near(other, one);
    EXPECT_EQ(found.blockers.size(), blocks ? 1U : 0U) << round;
    EXPECT_EQ(found.crossed.size(), !blocks && segments_cross(one.leader, other.leader) ? 1U : 0U)
        << round;
    // Its place is known by number until it leaves.
    const PlacedLabels::Blocker blocker = placed.blocker(0);
    EXPECT_TRUE(placed.has(blocker));
    placed.remove(0);
    EXPECT_FALSE(placed.has(blocker));
    placed.find_conflicts(other, {2, 2}, found);
    EXPECT_TRUE(found.blockers.empty() && found.crossed.empty());
  }
}

// A leader is looked at up to the first square that is blocked.
TEST(Occupancy, LeadersEndAtWhatBlocksThem) {
  OccupancyGrid occupied(100, 80);
  occupied.block({20, 0, 22, 80});
  occupied.finish();
  const auto open = occupied.leader_path({30, 10}, {90, 70});
  EXPECT_TRUE(open.open);
  EXPECT_GT(open.steps, 150U);
  const auto blocked = occupied.leader_path({10, 10}, {90, 70});
  EXPECT_FALSE(blocked.open);
  EXPECT_LT(blocked.steps, 30U);
}

}  // namespace
}  // namespace strake::sheets
