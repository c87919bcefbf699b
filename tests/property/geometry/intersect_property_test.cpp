// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "strake/geometry/intersect.hpp"
#include "support/exact_membership.hpp"
#include "support/rounds.hpp"

namespace strake::geometry {
namespace {

using testing::as_mesh;
using testing::exact;
using testing::Lattice;
using testing::RationalPoint;

constexpr int kRounds = test::rounds(1000, 150'000);

/// Farther than any end of a stretch on the lattice, and nearer than any two different ones.
const mpq_class kFar(1'000'000);
const mpq_class kNear(1, 1'000'000'000'000);

bool in_reach(const GridLine& line, const mpq_class& t) {
  if (line.from == line.to) return t == 0;
  if (line.reach != LineKind::line && t < 0) return false;
  return line.reach != LineKind::segment || t <= 1;
}

RationalPoint at(const GridLine& line, const mpq_class& t) {
  return testing::plus(exact(line.from), testing::minus(exact(line.to), exact(line.from)), t);
}

using Member = std::function<bool(const RationalPoint&)>;

/// That the stretch lies in a convex set, and that nothing of the line before or after it does.
void check_stretch(const GridLine& line, const LineStretch& s, const Member& inside) {
  ASSERT_NE(s.touch, Touch::none);
  ASSERT_NE(s.touch, Touch::area);
  ASSERT_EQ(s.touch == Touch::point, s.first == s.last);
  ASSERT_TRUE(s.first <= s.last);
  const mpq_class first = s.first.den == 0 ? mpq_class(-kFar) : exact(s.first);
  const mpq_class last = s.last.den == 0 ? kFar : exact(s.last);
  for (const mpq_class& t : {first, last}) {
    ASSERT_TRUE(in_reach(line, t));
    ASSERT_TRUE(inside(at(line, t)));
  }
  if (s.first.den != 0 && in_reach(line, first - kNear)) {
    ASSERT_FALSE(inside(at(line, first - kNear)));
  }
  if (s.last.den != 0 && in_reach(line, last + kNear)) {
    ASSERT_FALSE(inside(at(line, last + kNear)));
  }
  for (const Rational& t : {s.first, s.last})
    if (t.den != 0) {
      ASSERT_EQ(exact(point_at(line, t)), at(line, exact(t)));
    }
}

/// The line as a segment so long that what it misses on the lattice, the line misses.
std::array<Vec3l, 2> long_segment(const GridLine& line) {
  const Vec3l way = (line.to - line.from) * 10'000;
  return {line.reach == LineKind::line ? line.from - way : line.from,
          line.reach == LineKind::segment ? line.to : line.from + way};
}

GridLine random_line(Lattice& lattice) {
  const Vec3l from = lattice.point();
  return {from, lattice.below(12) == 0 ? from : lattice.point(),
          static_cast<LineKind>(lattice.below(3))};
}

GridLine moved(const GridLine& line, const testing::GridMotion& m) {
  return {m(line.from), m(line.to), line.reach};
}

mpq_class off_plane(const TriangleCorners& t, const RationalPoint& p) {
  const Vec3l n = cross(t[1] - t[0], t[2] - t[0]);
  return testing::inner(exact(n), testing::minus(p, exact(t[0])));
}

class IntersectProperty : public ::testing::TestWithParam<int> {
 protected:
  Lattice lattice{static_cast<std::uint64_t>(GetParam())};

  TriangleCorners triangle() {
    TriangleCorners t = lattice.triangle();
    while (!testing::spans(t)) t = lattice.triangle();
    return t;
  }
};

TEST_P(IntersectProperty, LinesAndPlanes) {
  for (int round = 0; round < kRounds; ++round) {
    SCOPED_TRACE(round);
    const GridLine line = random_line(lattice);
    const TriangleCorners t = triangle();
    const LineInPlane r = intersect_plane(line, t);
    ASSERT_EQ(r.side_from, sgn(off_plane(t, exact(line.from))));
    ASSERT_EQ(r.side_to, sgn(off_plane(t, exact(line.to))));
    if (r.at.touch != Touch::none)
      check_stretch(line, r.at, [&](const RationalPoint& p) { return off_plane(t, p) == 0; });
    else  // All of it strictly on one side: linear, so its ends tell.
      for (const Vec3l& p : long_segment(line)) ASSERT_EQ(sgn(off_plane(t, exact(p))), r.side_from);
    if (HasFatalFailure()) return;
  }
}

TEST_P(IntersectProperty, LinesAndTriangles) {
  int counts[3] = {}, places[8] = {};
  for (int round = 0; round < kRounds; ++round) {
    SCOPED_TRACE(round);
    GridLine line = random_line(lattice);
    const TriangleCorners t = triangle();
    if (lattice.below(3) == 0)  // in the triangle's plane, or aimed at a point of it
      line.to = t[0] + (t[1] - t[0]) * (lattice.below(5) - 2) + (t[2] - t[0]) * lattice.below(3);
    if (lattice.below(4) == 0) line.from = t[0] + (t[1] - t[0]) * (lattice.below(5) - 2);
    const LineInTriangle r = intersect(line, t);
    ++counts[static_cast<int>(r.at.touch)];
    ASSERT_EQ(r.coplanar, off_plane(t, exact(line.from)) == 0 && off_plane(t, exact(line.to)) == 0);
    if (r.at.touch == Touch::none) {
      ASSERT_GT(testing::squared_distance(as_mesh(long_segment(line)), as_mesh(t)), 0);
      continue;
    }
    check_stretch(line, r.at,
                  [&](const RationalPoint& p) { return testing::true_place(t, p) != 0; });
    if (HasFatalFailure()) return;
    ASSERT_EQ(r.feature_first, testing::true_place(t, at(line, exact(r.at.first))));
    ASSERT_EQ(r.feature_last, testing::true_place(t, at(line, exact(r.at.last))));
    ++places[r.feature_first];
  }
  // The cases that go wrong elsewhere were there.
  for (const int n : counts) EXPECT_GT(n, kRounds / 50);
  for (const int place : {1, 2, 3, 4, 5, 6, 7}) EXPECT_GT(places[place], kRounds / 300) << place;
}

TEST_P(IntersectProperty, LinesAndBoxes) {
  int touched = 0, through = 0;
  for (int round = 0; round < kRounds; ++round) {
    SCOPED_TRACE(round);
    const GridLine line = random_line(lattice);
    Box3l box{lattice.point(2), {}};
    box.hi = box.lo;
    box.include(lattice.point(2));
    const LineInBox r = intersect(line, box);
    const auto place = [&](const RationalPoint& p) {
      unsigned mask = 0;
      for (unsigned k = 0; k < 3; ++k) {
        if (p[k] == box.lo[static_cast<int>(k)]) mask |= 1U << (2 * k);
        if (p[k] == box.hi[static_cast<int>(k)]) mask |= 2U << (2 * k);
      }
      return mask;
    };
    const auto inside = [&](const RationalPoint& p) {
      for (unsigned k = 0; k < 3; ++k)
        if (p[k] < box.lo[static_cast<int>(k)] || p[k] > box.hi[static_cast<int>(k)]) return false;
      return true;
    };
    if (r.at.touch == Touch::none) {
      const testing::IndexedMesh skin =
          testing::box_mesh(box.lo.as<std::int32_t>(), box.hi.as<std::int32_t>());
      ASSERT_FALSE(inside(exact(line.from)));
      ASSERT_GT(testing::squared_distance(as_mesh(long_segment(line)), skin), 0);
      continue;
    }
    check_stretch(line, r.at, inside);
    if (HasFatalFailure()) return;
    const RationalPoint first = at(line, exact(r.at.first)), last = at(line, exact(r.at.last));
    ASSERT_EQ(r.feature_first, place(first));
    ASSERT_EQ(r.feature_last, place(last));
    const RationalPoint middle = testing::plus(first, testing::minus(last, first), mpq_class(1, 2));
    ASSERT_EQ(r.through_inside, place(middle) == 0);
    ++(r.through_inside ? through : touched);
  }
  EXPECT_GT(touched, kRounds / 50);
  EXPECT_GT(through, kRounds / 50);
}

TEST_P(IntersectProperty, LinesAndLines) {
  int counts[3] = {};
  for (int round = 0; round < kRounds; ++round) {
    SCOPED_TRACE(round);
    const GridLine a = random_line(lattice);
    GridLine b = random_line(lattice);
    if (lattice.below(3) == 0)  // on one line
      b = {a.from + (a.to - a.from) * (lattice.below(5) - 2),
           a.from + (a.to - a.from) * (lattice.below(5) - 2), b.reach};
    const LineMeeting r = intersect(a, b);
    ++counts[static_cast<int>(r.touch)];
    const Vec3l e = a.to - a.from, f = b.to - b.from, d = b.from - a.from;
    ASSERT_EQ(r.parallel, cross(e, f) == Vec3l{});
    ASSERT_EQ(r.coplanar, dot(cross(e, f), d) == 0);
    if (r.touch == Touch::none) {
      ASSERT_GT(testing::squared_distance(as_mesh(long_segment(a)), as_mesh(long_segment(b))), 0);
      continue;
    }
    const auto on = [](const GridLine& line) {
      return [&line](const RationalPoint& p) {
        if (line.from == line.to) return p == exact(line.from);
        const auto w = testing::weights({exact(line.from), exact(line.to)}, p);
        return w && in_reach(line, (*w)[1]);
      };
    };
    check_stretch(a, {r.touch, r.first_a, r.last_a}, on(b));
    LineStretch of_b{r.touch, r.first_b, r.last_b};
    if (of_b.last < of_b.first) std::swap(of_b.first, of_b.last);
    check_stretch(b, of_b, on(a));
    if (HasFatalFailure()) return;
    if (r.first_a.den != 0) {
      ASSERT_EQ(point_at(a, r.first_a), point_at(b, r.first_b));
    }
    if (r.last_a.den != 0) {
      ASSERT_EQ(point_at(a, r.last_a), point_at(b, r.last_b));
    }
  }
  for (const int n : counts) EXPECT_GT(n, kRounds / 50);
}

bool same(const LineStretch& x, const LineStretch& y) {
  return x.touch == y.touch && x.first == y.first && x.last == y.last;
}

TEST_P(IntersectProperty, MotionsOfTheGridKeepTheAnswerAtTheEdgeOfTheRange) {
  for (int round = 0; round < kRounds; ++round) {
    SCOPED_TRACE(round);
    const testing::GridMotion m = testing::random_motion(lattice, 3);
    const GridLine a = random_line(lattice), b = random_line(lattice);
    const TriangleCorners t = triangle();
    const LineInTriangle r = intersect(a, t), s = intersect(moved(a, m), m(t));
    ASSERT_TRUE(same(r.at, s.at));
    ASSERT_EQ(r.feature_first, s.feature_first);
    ASSERT_EQ(r.feature_last, s.feature_last);
    const LineMeeting x = intersect(a, b), y = intersect(moved(a, m), moved(b, m));
    ASSERT_TRUE(same({x.touch, x.first_a, x.last_a}, {y.touch, y.first_a, y.last_a}));
    ASSERT_TRUE(same({x.touch, x.first_b, x.last_b}, {y.touch, y.first_b, y.last_b}));
    Box3l box{lattice.point(), {}}, image;
    box.hi = box.lo;
    box.include(lattice.point());
    image = {m(box.lo), m(box.lo)};
    image.include(m(box.hi));
    const LineInBox u = intersect(a, box), v = intersect(moved(a, m), image);
    ASSERT_TRUE(same(u.at, v.at));
    ASSERT_EQ(u.through_inside, v.through_inside);
    if (s.at.touch == Touch::point) {
      ASSERT_NE(testing::true_place(m(t), exact(point_at(moved(a, m), s.at.first))), 0U);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, IntersectProperty, strake::test::seeds(3));

}  // namespace
}  // namespace strake::geometry
