// SPDX-License-Identifier: Apache-2.0
// Dashes that fit the lines that have them: strokes begin and end with ink and turn with it.
#include "drawing/strokes/dash_runs.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "drawing/ink/dash_fit.hpp"
#include "drawing/svg/svg_path.hpp"
#include "geometry/numeric/trig.hpp"

namespace strake::drawing {
namespace {

constexpr std::array kDashes{3.0, 0.75};  // 0.25 mm wide: 12 widths and 3
constexpr std::array kCentre{6.0, 0.75, 0.25, 0.75};

/// Returns how many millimetres of the first dash are left at the end of an open stroke: all of it
/// where the pattern fits; negative: the stroke ends in a gap.
double end_dash(double length, double stretch, std::span<const double> dash) {
  double period = 0;
  for (const double d : dash) period += d * stretch;
  return std::fmod(length, period);
}

TEST(DashFit, StrokesEndWithTheWholeFirstDash) {
  for (const auto dash : {std::span<const double>(kDashes), std::span<const double>(kCentre)})
    for (double length = shortest_dashed(dash) + 0.01; length < 200; length *= 1.037) {
      const double stretch = fitted_stretch(length, DashEnds::open, dash);
      ASSERT_GT(stretch, 0) << length;
      EXPECT_GE(stretch, kMinStretch * 0.9) << length;
      EXPECT_LE(stretch, 1.5) << length;
      const double first = dash.front() * stretch;
      EXPECT_NEAR(end_dash(length, stretch, dash), first, 0.101 * first + 1e-9) << length;
    }
}

TEST(DashFit, WhatIsTooShortForAGapIsContinuous) {
  EXPECT_EQ(fitted_stretch(2.6, DashEnds::open, kDashes), 0);
  EXPECT_GT(fitted_stretch(2.71, DashEnds::open, kDashes), 0);
  EXPECT_EQ(fitted_stretch(2.9, DashEnds::closed, kDashes), 0);
  EXPECT_EQ(fitted_stretch(100, DashEnds::open, {}), 0);
}

TEST(DashFit, ClosedStrokesHaveWholePeriodsAndSmallCirclesFourDashes) {
  for (double length = 6.1; length < 200; length *= 1.037) {
    const double stretch = fitted_stretch(length, DashEnds::closed, kDashes);
    const double periods = length / (3.75 * stretch);
    EXPECT_NEAR(periods, std::round(periods), 0.101 * 0.8) << length;
    EXPECT_GE(std::round(periods), 4) << length;
  }
}

// The arms of a cross meet in a dash, and not in a gap or a dot.
TEST(DashFit, CentredStrokesHaveADashInTheirMiddle) {
  for (double length = 1; length < 200; length *= 1.037) {
    const double stretch = fitted_stretch(length, DashEnds::centred, kCentre);
    if (stretch == 0) {
      EXPECT_LT(length, 0.4 * (2 * 7.75 + 6) + 1e-9);
      continue;
    }
    const double middle = std::fmod(length / 2, 7.75 * stretch);
    EXPECT_NEAR(middle, 3 * stretch, 0.11 * 6 * stretch) << length;
  }
}

TEST(DashFit, FewPatternsServeMostShortStrokes) {
  std::vector<double> known;
  for (double length = 3; length < 8; length += 0.01) {
    const double stretch = fitted_stretch(length, DashEnds::open, kDashes);
    if (std::ranges::find(known, stretch) == known.end()) known.push_back(stretch);
  }
  EXPECT_LT(known.size(), 20U);
}

/// The lines from point to point, and the runs that they make.
struct DashedPolyline {
  std::vector<Line> lines;
  PaperCurves curves;

  explicit DashedPolyline(const std::vector<PaperPoint>& points) {
    for (std::size_t i = 1; i < points.size(); ++i) {
      Line line;
      line.edge = static_cast<std::uint32_t>(i - 1);
      line.state = LineState::hidden_by_self;
      line.a_paper = points[i - 1];
      line.b_paper = points[i];
      lines.push_back(line);
    }
  }

  [[nodiscard]] std::vector<DashRun> runs() const {
    std::vector<const Line*> some;
    for (const Line& line : lines) some.push_back(&line);
    std::vector<DashRun> all;
    for (const JoinedLines& chain : join_lines(some))
      for (DashRun& run : dash_runs(chain, curves, kDashes)) all.push_back(std::move(run));
    return all;
  }
};

std::vector<PaperPoint> polygon(int corners, double radius) {
  std::vector<PaperPoint> points;
  for (const auto& [sin, cos] : geometry::unit_circle(corners))
    points.push_back(
        {std::round(radius * cos * 1000) / 1000, std::round(radius * sin * 1000) / 1000});
  points.push_back(points.front());
  return points;
}

TEST(DashRuns, CornersAreTurnedWithADash) {
  const std::vector<DashRun> runs =
      DashedPolyline({{0, 0}, {40, 0}, {40, 25}, {0, 25}, {0, 0}}).runs();
  ASSERT_EQ(runs.size(), 4U);
  for (const DashRun& run : runs) {
    ASSERT_EQ(run.chain.points.size(), 2U);
    const double length = std::abs(run.chain.points[1].x - run.chain.points[0].x) +
                          std::abs(run.chain.points[1].y - run.chain.points[0].y);
    EXPECT_NEAR(end_dash(length, run.stretch, kDashes), 3 * run.stretch, 0.31) << length;
  }
}

// A closed chain may begin anywhere: in the middle of a side it would have a dash that is cut.
TEST(DashRuns, ClosedChainsBeginAtACorner) {
  const std::vector<DashRun> runs =
      DashedPolyline({{20, 0}, {40, 0}, {40, 25}, {0, 25}, {0, 0}, {20, 0}}).runs();
  ASSERT_EQ(runs.size(), 4U);
  std::size_t of_two = 0;
  for (const DashRun& run : runs) of_two += run.chain.points.size() == 3 ? 1U : 0U;
  EXPECT_EQ(of_two, 1U);
}

TEST(DashRuns, PolygonsThatStandForCirclesAreOneRoundStroke) {
  for (const double radius : {1.5, 5.0, 20.0}) {
    const std::vector<DashRun> runs = DashedPolyline(polygon(16, radius)).runs();
    ASSERT_EQ(runs.size(), 1U);
    const double periods =
        32 * radius * geometry::sin_cos(geometry::kPi / 16).sin / (3.75 * runs.front().stretch);
    EXPECT_NEAR(periods, std::round(periods), 0.09) << radius;
    EXPECT_GE(std::round(periods), 4) << radius;
  }
}

// Each side of the head of a bolt is too short for a gap; its whole outline is not.
TEST(DashRuns, SidesTooShortForAGapShareOne) {
  const std::vector<DashRun> runs = DashedPolyline(polygon(6, 1.8)).runs();
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_GT(runs.front().stretch, 0);
  EXPECT_EQ(runs.front().chain.lines.size(), 6U);
}

// Chords of a circle are shorter than its arcs: a quarter of eight percent would be a cut dash.
TEST(DashRuns, CurvesCountWithTheLengthsOfTheirArcs) {
  constexpr double kRadius = 30;
  DashedPolyline drawn(polygon(8, kRadius));
  drawn.curves.all.push_back({{0, 0}, {kRadius, 0}, {0, kRadius}});
  for (std::uint32_t e = 0; e < 8; ++e) drawn.curves.edges.push_back({model::ObjectId{}, e, 0U});
  const std::vector<DashRun> runs = drawn.runs();
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_EQ(runs.front().stretch,
            fitted_stretch(2 * geometry::kPi * kRadius, DashEnds::closed, kDashes));
}

TEST(DashRuns, NothingIsLostAndOrderIsKept) {
  const std::vector<PaperPoint> points{{0, 0}, {1, 0}, {9, 0}, {9, 1}, {10, 1}, {10, 12}, {11, 30}};
  double length = 0;
  PaperPoint at{0, 0};
  const DashedPolyline drawn(points);  // the runs refer to its lines
  for (const DashRun& run : drawn.runs()) {
    EXPECT_EQ(run.chain.points.front(), at);
    at = run.chain.points.back();
    EXPECT_EQ(run.chain.lines.size() + 1, run.chain.points.size());
    for (const Line* line : run.chain.lines)
      length += std::hypot(line->b_paper.x - line->a_paper.x, line->b_paper.y - line->a_paper.y);
  }
  EXPECT_EQ(at, points.back());
  EXPECT_NEAR(length, 1 + 8 + 1 + 1 + 11 + std::hypot(1, 18), 1e-9);
}

}  // namespace
}  // namespace strake::drawing
