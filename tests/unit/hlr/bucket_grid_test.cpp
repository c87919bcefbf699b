// SPDX-License-Identifier: Apache-2.0
#include "hlr/occluders/bucket_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "hlr/visibility/open_part.hpp"
#include "strake/parallel/team.hpp"
#include "support/lattice_scene.hpp"

namespace strake::hlr {
namespace {

using test::Random;

/// Where a segment that runs from `a` in 64 steps is after `i` of them.
struct Steps {
  ViewPoint a, step;
  [[nodiscard]] ViewPoint at(int i) const {
    return {a.u + i * step.u, a.v + i * step.v, a.w + i * step.w};
  }
};

bool meets(const ViewBox& box, const ViewPoint& p) {
  return p.u >= box.lo.u && p.u <= box.hi.u && p.v >= box.lo.v && p.v <= box.hi.v;
}

SegmentQuery loose(const Steps& steps, int from, int to) {
  const ViewPoint a = steps.at(0), b = steps.at(64), p = steps.at(from), q = steps.at(to);
  SegmentQuery s;
  s.au = static_cast<double>(a.u);
  s.av = static_cast<double>(a.v);
  s.du = static_cast<double>(b.u - a.u);
  s.dv = static_cast<double>(b.v - a.v);
  s.u0 = static_cast<double>(std::min(p.u, q.u));
  s.u1 = static_cast<double>(std::max(p.u, q.u));
  s.v0 = static_cast<double>(std::min(p.v, q.v));
  s.v1 = static_cast<double>(std::max(p.v, q.v));
  s.w0 = static_cast<double>(std::min(p.w, q.w));
  return s;
}

std::int64_t draw(Random& random, std::int64_t size) {
  return static_cast<std::int64_t>(random.below(static_cast<std::uint32_t>(2 * size))) - size;
}

/// Boxes over [-100 unit, 100 unit], most of them small, some on the sides of buckets.
std::vector<ViewBox> some_boxes(Random& random, std::int64_t unit) {
  std::vector<ViewBox> boxes(1 + random.below(200));
  for (ViewBox& box : boxes) {
    const std::int64_t most = random.one_in(10) ? 80 : 8;
    const auto extent = [&] { return unit * random.below(static_cast<std::uint32_t>(most)); };
    const ViewPoint lo{unit * draw(random, 100), unit * draw(random, 100),
                       unit * draw(random, 100)};
    box.include(lo);
    box.include(ViewPoint{lo.u + extent(), lo.v + extent(), lo.w + extent()});
  }
  return boxes;
}

BucketGrid made(const std::vector<ViewBox>& boxes, std::uint32_t side,
                const parallel::Context& context = {}) {
  auto buckets = BucketGrid::of(boxes, BucketPlan(boxes).axes(side), context);
  EXPECT_TRUE(buckets.has_value());
  return std::move(*buckets);
}

TEST(BucketGrid, MeetAllThatMayHideOnceEach) {
  std::uint64_t met = 0, all = 0;
  BucketMarks marks;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    Random random(seed);
    const std::int64_t unit = std::int64_t{1} << (4 * random.below(11));
    const std::vector<ViewBox> boxes = some_boxes(random, unit);
    const BucketGrid buckets = made(boxes, 1U << random.below(9));
    for (int round = 0; round < 8; ++round) {
      // Upright, level, a point, or any way.
      const auto step = [&](std::uint32_t still) {
        return random.one_in(still) ? 0 : unit * draw(random, 4);
      };
      const Steps steps{
          {unit * draw(random, 120), unit * draw(random, 120), unit * draw(random, 120)},
          {step(4), step(4), step(4)}};
      const int from = static_cast<int>(random.below(32));
      const int to = from + static_cast<int>(random.below(32));
      SegmentQuery segment = loose(steps, from, to);
      if (random.one_in(8)) segment.du = segment.dv = 0;  // where it is not known but for its box
      std::vector<int> visible(boxes.size(), 0);
      buckets.traverse(segment, marks, [&](std::uint32_t i) {
        ++visible[i];
        return true;
      });
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        ASSERT_LE(visible[i], 1);
        bool may_be_hidden_by = false;
        for (int k = from; k <= to; ++k)
          may_be_hidden_by = may_be_hidden_by || meets(boxes[i], steps.at(k));
        may_be_hidden_by = may_be_hidden_by && static_cast<double>(boxes[i].hi.w) > segment.w0;
        ASSERT_TRUE(visible[i] == 1 || !may_be_hidden_by) << "seed " << seed << " box " << i;
        met += static_cast<std::uint64_t>(visible[i]);
      }
      all += boxes.size();
    }
  }
  EXPECT_LT(4 * met, all);
}

TEST(BucketGrid, MeetWhatMayHideTheOpenPartOfAnEdge) {
  // Buckets narrower than a unit, and ends within one.
  BucketMarks marks;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    Random random(seed);
    const std::vector<ViewBox> boxes = some_boxes(random, 1);
    const BucketGrid buckets = made(boxes, 1U << (5 + random.below(4)));
    for (int round = 0; round < 8; ++round) {
      const ViewPoint a{draw(random, 120), draw(random, 120), -200};
      const ViewPoint b{a.u + draw(random, 30) * 2 + 1, a.v + draw(random, 60), -200};
      const auto from = static_cast<int>(random.below(16));
      const auto to = from + 1 + static_cast<int>(random.below(7));
      const OpenRange open(RationalParam::of(from, 23), RationalParam::of(to, 23));
      std::vector<bool> visible(boxes.size());
      buckets.traverse(on_segment(a, b, open_box(a, b, open)), marks, [&](std::uint32_t i) {
        visible[i] = true;
        return true;
      });
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        const auto inside = [](double x, std::int64_t lo, std::int64_t hi) {
          return x > static_cast<double>(lo) + 1e-9 && x < static_cast<double>(hi) - 1e-9;
        };
        for (int k = 1; k < 32 && !visible[i]; ++k) {
          const double t = (from + (to - from) * k / 32.0) / 23;
          const double u = static_cast<double>(a.u) + t * static_cast<double>(b.u - a.u);
          const double v = static_cast<double>(a.v) + t * static_cast<double>(b.v - a.v);
          ASSERT_FALSE(inside(u, boxes[i].lo.u, boxes[i].hi.u) &&
                       inside(v, boxes[i].lo.v, boxes[i].hi.v))
              << "seed " << seed << " box " << i;
        }
      }
    }
  }
}

TEST(BucketGrid, AWalkEndsOnRequest) {
  Random random(5);
  const std::vector<ViewBox> boxes = some_boxes(random, 16);
  const BucketGrid buckets = made(boxes, 16);
  BucketMarks marks;
  SegmentQuery everything;
  everything.u0 = everything.v0 = everything.w0 = -1e6;
  everything.u1 = everything.v1 = 1e6;
  std::size_t met = 0;
  buckets.traverse(everything, marks, [&](std::uint32_t) { return ++met < 5; });
  EXPECT_EQ(met, 5U);
  met = 0;
  buckets.traverse(everything, marks, [&](std::uint32_t) { return ++met > 0; });
  EXPECT_EQ(met, boxes.size());
}

/// Boxes of one size in rows.
std::vector<ViewBox> rows(std::int64_t count, std::int64_t size) {
  std::vector<ViewBox> boxes;
  for (std::int64_t i = 0; i < count; ++i)
    for (std::int64_t j = 0; j < count; ++j)
      boxes.push_back({{i * 1000, j * 1000, 0}, {i * 1000 + size, j * 1000 + size, i}});
  return boxes;
}

TEST(BucketGrid, TheirNumberFollowsTheData) {
  const EdgeLengths edges{.count = 10000, .sum = 1e7};
  const std::vector<ViewBox> scattered = rows(100, 900), upon_each_other = rows(100, 99000);
  EXPECT_GE(BucketPlan(scattered).best_side(edges), 32U);
  EXPECT_LE(BucketPlan(upon_each_other).best_side(edges), 4U);
  EXPECT_GE(BucketPlan(scattered).best_side({}), 32U) << "nothing is known of others' edges";
  // A number that was requested is kept while it does not list the boxes over and over.
  EXPECT_EQ(BucketPlan(scattered).axes(256).u.count, 256U);
  EXPECT_LE(BucketPlan(upon_each_other).axes(4096).u.count, 32U);
  EXPECT_LE(BucketPlan(rows(2, 10)).axes(4096).u.count, 16U);
}

/// With as many buckets as some edges, each as long as a box, would choose.
double crowding_as_chosen(const std::vector<ViewBox>& boxes) {
  return made(boxes, BucketPlan(boxes).best_side({})).crowding();
}

TEST(BucketGrid, AreNotCrowdedWhereBoxesAreAlike) {
  EXPECT_NEAR(made(rows(64, 1), 64).crowding(), 1, 0.2);
  EXPECT_LT(crowding_as_chosen(rows(200, 900)), 16);
}

TEST(BucketGrid, AreCrowdedByAClusterInAWideSpace) {
  std::vector<ViewBox> cluster = rows(100, 900);
  cluster.push_back({{100'000'000, 100'000'000, 0}, {100'000'001, 100'000'001, 1}});
  EXPECT_GT(crowding_as_chosen(cluster), 1000);
  // Wide boxes that lie over it stand in all buckets, which is not to hide it.
  for (int i = 0; i < 300; ++i)
    cluster.push_back({{0, 0, -i - 2}, {100'000'000, 100'000'000, -i - 1}});
  EXPECT_GT(crowding_as_chosen(cluster), 500);
}

TEST(BucketGrid, AreCrowdedByLongStrips) {
  std::vector<ViewBox> strips;
  for (std::int64_t i = 0; i < 10000; ++i)
    strips.push_back({{i * 100, 0, 0}, {i * 100 + 99, 1'000'000, 1}});
  EXPECT_GT(crowding_as_chosen(strips), 500);
}

TEST(BucketGrid, LeaveEmptyBoxesOut) {
  std::vector<ViewBox> boxes = rows(64, 1);
  const std::uint32_t side = BucketPlan(boxes).best_side({});
  for (int i = 0; i < 50; ++i) boxes.insert(boxes.begin() + 80 * i, ViewBox{});
  EXPECT_EQ(BucketPlan(boxes).best_side({}), side);
  const BucketGrid buckets = made(boxes, side);
  EXPECT_LT(buckets.crowding(), 16);
  BucketMarks marks;
  SegmentQuery everything;
  everything.u0 = everything.v0 = everything.w0 = -1;
  everything.u1 = everything.v1 = 1e9;
  std::size_t met = 0;
  buckets.traverse(everything, marks, [&](std::uint32_t i) {
    EXPECT_FALSE(boxes[i].empty());
    return ++met > 0;
  });
  EXPECT_EQ(met, 64U * 64U);
  EXPECT_TRUE(made({ViewBox{}, ViewBox{}}, 8).crowding() == 0);
}

TEST(BucketGrid, BoxesInAPointMakeOneBucket) {
  const std::vector<ViewBox> boxes(20, ViewBox{{7, 7, 0}, {7, 7, 5}});
  const BucketGrid buckets = made(boxes, 64);
  BucketMarks marks;
  std::size_t met = 0;
  SegmentQuery through;
  through.u0 = through.u1 = through.v0 = through.v1 = through.au = through.av = 7;
  buckets.traverse(through, marks, [&](std::uint32_t) { return ++met > 0; });
  EXPECT_EQ(met, boxes.size());
}

}  // namespace
}  // namespace strake::hlr
