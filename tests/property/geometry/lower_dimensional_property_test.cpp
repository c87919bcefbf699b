// SPDX-License-Identifier: Apache-2.0
// Points, lines, polylines, polygons and arcs against each other, primitives and meshes: brackets
// hold what constructed truth, big rationals, samples and the solver for sheets say.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "strake/geometry/grid.hpp"
#include "strake/geometry/lower_dimensional_separation.hpp"
#include "support/exact_membership.hpp"
#include "support/lattice_solids.hpp"
#include "support/random_primitives.hpp"
#include "support/rounds.hpp"

namespace strake::geometry {
namespace {

using test::PrimitiveDraw;
using testing::Lattice;

constexpr int kRounds = test::rounds(300, 20'000);

/// What a bracket may be off by beside the oracle's own arithmetic, grid units.
constexpr double kRounding = 1e-3;

DepthOptions narrow_goal() {
  DepthOptions goal;
  goal.tolerance = 1;
  goal.relative = 0;
  goal.threshold = -1;
  goal.cells_decided = 20'000;
  return goal;
}

Vec3d on_grid(const Vec3d& p) { return to_mm(snap(p).value_or(Vec3l{})); }

void expect_within(const LowerDimensionalSeparation& s, double low, double high,
                   double margin = kRounding) {
  ASSERT_LE(s.lower, s.upper);
  ASSERT_LE(s.lower, s.d);
  ASSERT_LE(s.d, s.upper);
  ASSERT_LE(s.lower, high + margin);
  ASSERT_GE(s.upper, low - margin);
}

/// Distance of a point to an arc in its own plane's frame, by the C library's angles.
double to_arc(const Vec3d& p, double radius, double angle) {
  double at = std::atan2(p.y, p.x);
  if (at < 0) at += 2 * M_PI;
  const double out = std::hypot(p.x, p.y);
  if (at <= angle) return std::hypot(out - radius, p.z);
  const auto end = [&](double t) {
    return std::hypot(p.x - radius * std::cos(t), p.y - radius * std::sin(t), p.z);
  };
  return std::min(end(0), end(angle));
}

Vec3d point_of(const CircularArc& arc, double t) {
  return arc.placement * Vec3d{arc.radius_mm * std::cos(t), arc.radius_mm * std::sin(t), 0};
}

/// A body by drawing, and points of it no farther than `spacing` (mm) from any other.
struct Drawn {
  LowerDimensionalBody body;
  std::vector<Vec3d> samples;
  double spacing = 0;
  std::string what;

  void sample(const Vec3d& p, const Vec3d& q, int count) {
    for (int i = 0; i <= count; ++i)
      samples.push_back(p + (q - p) * (static_cast<double>(i) / count));
    const Vec3d d = q - p;
    spacing = std::max(spacing, std::sqrt(dot(d, d)) / count / 2);
  }
};

Drawn draw_thin(PrimitiveDraw& draw, double size, std::uint64_t kind, int count) {
  Drawn r;
  const auto corner = [&] { return on_grid(draw.point(size)); };
  if (kind == 0) {
    const Vec3d p = corner();
    r.body = *make_point_body(p);
    r.samples = {p};
    r.what = "point";
  } else if (kind == 1 || kind == 2) {
    std::vector<Vec3d> points;
    const std::size_t n = kind == 1 ? 2 : 3 + draw.below(4);
    while (points.size() < n) points.push_back(corner());
    const bool closed = kind == 2 && draw.one_in(2);
    r.body = *make_polyline_body(points, closed);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) r.sample(points[i], points[i + 1], count);
    if (closed) r.sample(points.back(), points.front(), count);
    r.what = kind == 1 ? "line" : "polyline";
  } else if (kind == 3) {
    const Vec3d o = corner(), u = draw.point(size), v = draw.point(size);
    const std::array<Vec3d, 3> corners{o, on_grid(o + u), on_grid(o + v)};
    const PolygonBody polygon = make_polygon_body(corners, std::array<std::uint32_t, 2>{0, 3});
    EXPECT_EQ(polygon.fault, FaceFault::none);
    r.body = polygon.body;
    for (int i = 0; i <= count; ++i)
      for (int j = 0; i + j <= count; ++j)
        r.samples.push_back(corners[0] + (corners[1] - corners[0]) * (1.0 * i / count) +
                            (corners[2] - corners[0]) * (1.0 * j / count));
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d e = corners[(i + 1) % 3] - corners[i];
      r.spacing = std::max(r.spacing, std::sqrt(dot(e, e)) / count);
    }
    r.what = "polygon";
  } else {
    CircularArc arc{
        draw.between(0.2, 1) * size, draw.one_in(4) ? 2 * M_PI : draw.between(0.2, 6.2), {}};
    arc.placement.linear = draw.turn();
    arc.placement.translation = corner();
    r.body = *make_arc_body(arc);
    const int n = 4 * count;
    for (int i = 0; i <= n; ++i) r.samples.push_back(point_of(arc, arc.angle * i / n));
    r.spacing = arc.radius_mm * arc.angle / n / 2;
    r.what = "arc";
  }
  return r;
}

class LowerDimensionalPair : public ::testing::TestWithParam<int> {
 protected:
  PrimitiveDraw draw{static_cast<std::uint64_t>(GetParam())};
  Lattice lattice{static_cast<std::uint64_t>(GetParam())};
};

TEST_P(LowerDimensionalPair, AgainstSpheresByTheClosedForm) {
  for (int round = 0; round < kRounds; ++round) {
    SCOPED_TRACE(round);
    const double size = std::pow(10, draw.between(0.5, 4));
    const SpherePrimitive sphere{draw.between(0.1, 2) * size};
    const Placement at{draw.turn(), on_grid(draw.point(size))};
    const Primitive primitive = sphere;
    const Vec3d c = at.translation;
    // An arc: its plane's frame sees the centre.
    CircularArc arc{draw.between(0.2, 1) * size, draw.between(0.2, 2 * M_PI), {}};
    arc.placement = {draw.turn(), on_grid(draw.point(size))};
    const Mat3d& m = arc.placement.linear;
    const Vec3d off = c - arc.placement.translation;
    Vec3d local;
    for (int k = 0; k < 3; ++k)
      local[k] = off.x * m.row[0][k] + off.y * m.row[1][k] + off.z * m.row[2][k];
    const double arc_d =
        (to_arc(local, arc.radius_mm, arc.angle) - sphere.diameter / 2) * kGridPerMm;
    const auto of_arc = lower_dimensional_separation(*make_arc_body(arc), {&primitive, &at});
    ASSERT_TRUE(of_arc);
    expect_within(*of_arc, arc_d, arc_d, 1e-9 * size * kGridPerMm + kRounding);
    ASSERT_LE(of_arc->upper - of_arc->lower, 1);
    // A segment: the nearest point to the centre.
    const Vec3d p = on_grid(draw.point(size)), q = on_grid(draw.point(size));
    const Vec3d e = q - p;
    const double t = std::clamp(dot(c - p, e) / dot(e, e), 0.0, 1.0);
    const Vec3d gap = p + e * t - c;
    const double d = (std::sqrt(dot(gap, gap)) - sphere.diameter / 2) * kGridPerMm;
    const auto of_line =
        lower_dimensional_separation(*make_polyline_body(std::array{p, q}), {&primitive, &at});
    ASSERT_TRUE(of_line);
    expect_within(*of_line, d, d, 1e-9 * size * kGridPerMm + kRounding);
    ASSERT_LE(of_line->upper - of_line->lower, 0.25);
    if (HasFatalFailure()) return;
  }
}

TEST_P(LowerDimensionalPair, AgainstPrimitivesBySamples) {
  int inside = 0, wide = 0;
  for (int round = 0; round < kRounds; ++round) {
    const double size = std::pow(10, draw.between(0.5, 4));
    const bool torus = draw.one_in(3);
    const Primitive primitive = torus ? draw.torus(size) : draw.convex(size);
    const Placement at{draw.linear(torus), on_grid(draw.point(0.5 * size))};
    const Drawn thin = draw_thin(draw, 1.5 * size, draw.below(5), 12);
    SCOPED_TRACE(std::to_string(round) + ' ' + thin.what + ' ' + std::string(kind_name(primitive)));
    const auto s = lower_dimensional_separation(thin.body, {&primitive, &at});
    if (!s) continue;
    inside += s->inside ? 1 : 0;
    wide += s->upper - s->lower > 1 ? 1 : 0;
    double min_low = INFINITY, min_high = INFINITY;
    for (const Vec3d& p : thin.samples) {
      const auto point = lower_dimensional_separation(*make_point_body(p), {&primitive, &at});
      ASSERT_TRUE(point);
      min_low = std::min(min_low, point->lower);
      min_high = std::min(min_high, point->upper);
    }
    // Signed distance changes by no more than the way; samples are snapped.
    expect_within(*s, min_low - thin.spacing * kGridPerMm - 2, min_high + 2);
    if (HasFatalFailure()) return;
    // The witness stands where it says.
    const Vec3d way = s->on_other - s->on_body;
    const double apart = std::sqrt(dot(way, way));
    ASSERT_NEAR(apart, std::fabs(s->d), (s->upper - s->lower) + 1 + 1e-6 * size * kGridPerMm);
  }
  EXPECT_GT(inside, kRounds / 20);
  EXPECT_LT(wide, kRounds / 20);
}

TEST_P(LowerDimensionalPair, LinesAndRectanglesAsSheetsThatTheSolverKnows) {
  for (int round = 0; round < kRounds; ++round) {
    SCOPED_TRACE(round);
    const double size = std::pow(10, draw.between(0.5, 4));
    const Primitive primitive = draw.convex(size);
    const Placement at{draw.linear(false), on_grid(draw.point(0.5 * size))};
    // On the coordinate axes corners fall on the grid.
    const auto whole = [&] { return 2 * std::floor(draw.between(1, size) * 250) / 500; };
    const double x = draw.one_in(2) ? 0 : whole(), y = whole();
    const Placement place{{}, on_grid(draw.point(size))};
    const Primitive sheet = BoxPrimitive{x, y, 0};
    const Vec3d u{x / 2, 0, 0}, v{0, y / 2, 0}, c = place.translation;
    LowerDimensionalBody thin;
    if (x == 0) {
      thin = *make_polyline_body(std::array{c - v, c + v});
    } else {
      const std::array corners{c - u - v, c + u - v, c + u + v, c - u + v};
      thin = make_polygon_body(corners, std::array<std::uint32_t, 2>{0, 4}).body;
    }
    const auto s = lower_dimensional_separation(thin, {&primitive, &at});
    const auto truth = iterative_separation({&sheet, &place}, {&primitive, &at});
    ASSERT_EQ(s.has_value(), truth.has_value());
    if (!s) continue;
    // Halves of lengths may fall between grid points.
    expect_within(*s, truth->lower, truth->upper, 2);
    if (HasFatalFailure()) return;
  }
}

TEST_P(LowerDimensionalPair, AHoopRoundARodIsAsDeepAsItsPointsShow) {
  for (const double press : {0.0, 0.3, 5.0}) {
    SCOPED_TRACE(press);
    const double radius = 1500;
    const Placement at{draw.turn(), on_grid(draw.point(500))};
    const Primitive rod = CylinderPrimitive{radius + press, 4 * radius};
    const auto s =
        lower_dimensional_separation(*make_arc_body({radius, 2 * M_PI, at}), {&rod, &at});
    ASSERT_TRUE(s);
    // A work limit ends the search, and points that hardly lie inside may be all that it found.
    EXPECT_LE(s->lower, -press * kGridPerMm + 5);
    EXPECT_GE(s->upper, -press * kGridPerMm - 5);
    EXPECT_NEAR(s->d, -press * kGridPerMm, 30) << s->lower << ' ' << s->upper;
    const Vec3d way = s->on_body - s->on_other;
    EXPECT_NEAR(std::sqrt(dot(way, way)), std::fabs(s->d), 30);
  }
}

TEST_P(LowerDimensionalPair, ThinBodiesAgainstEachOtherBySamples) {
  for (int round = 0; round < kRounds; ++round) {
    const double size = std::pow(10, draw.between(0.5, 4));
    const Drawn a = draw_thin(draw, size, draw.below(5), 8);
    const Drawn b = draw_thin(draw, size, draw.below(5), 8);
    SCOPED_TRACE(std::to_string(round) + ' ' + a.what + ' ' + b.what);
    const LowerDimensionalSeparation s = lower_dimensional_separation(a.body, b.body),
                                     t = lower_dimensional_separation(b.body, a.body);
    double least = INFINITY;
    for (const Vec3d& p : a.samples)
      for (const Vec3d& q : b.samples)
        least = std::min(least, std::sqrt(dot(p - q, p - q)) * kGridPerMm);
    expect_within(s, least - (a.spacing + b.spacing) * kGridPerMm - 2, least + 2);
    expect_within(s, t.lower, t.upper);
    ASSERT_GE(s.lower, 0);
    ASSERT_LE(s.upper - s.lower, 0.2 + 1e-3 * s.upper);
    if (HasFatalFailure()) return;
  }
}

TEST_P(LowerDimensionalPair, CirclesOnOneAxis) {
  for (int round = 0; round < kRounds; ++round) {
    const double r = draw.between(10, 1000), s = draw.between(10, 1000);
    const Mat3d turn = draw.turn();
    const Vec3d axis{turn.row[0].z, turn.row[1].z, turn.row[2].z};
    const Vec3d base = on_grid(draw.point(1000)), top = on_grid(base + axis * draw.between(0, 500));
    const LowerDimensionalSeparation d = lower_dimensional_separation(
        *make_arc_body({r, 2 * M_PI, {turn, base}}), *make_arc_body({s, 2 * M_PI, {turn, top}}));
    const Vec3d up = top - base;
    const double truth = std::hypot(r - s, std::sqrt(dot(up, up))) * kGridPerMm;
    expect_within(d, truth, truth, 2);
    if (HasFatalFailure()) return;
  }
}

/// A lattice body and thin bodies with corners on it, in rationals.
TEST_P(LowerDimensionalPair, LatticeBodiesByRationals) {
  int case_counts[3] = {};
  for (int round = 0; round < kRounds / 3; ++round) {
    SCOPED_TRACE(round);
    constexpr int kScale = 16;
    testing::LatticeMap grow;
    grow.row = {Vec3i{kScale, 0, 0}, {0, kScale, 0}, {0, 0, kScale}};
    const testing::LatticeSolid body = mapped(testing::random_pair(lattice.rng()).a, grow);
    const testing::Subject subject(body.mesh, lattice.point(1000));
    const Box3i& box = subject.part.box;
    const auto corner = [&] {
      Vec3l p;
      for (int k = 0; k < 3; ++k)
        p[k] = box.lo[k] + kScale * (lattice.below((box.hi[k] - box.lo[k]) / kScale + 5) - 2);
      return p;
    };
    const std::array<Vec3l, 3> c{corner(), corner(), corner()};
    const auto count = static_cast<std::size_t>(1 + lattice.below(3));
    if (count == 3 && !testing::spans(c)) continue;
    LowerDimensionalBody thin;
    thin.origin = subject.origin;
    for (std::size_t i = 0; i < count; ++i) thin.vertices.push_back(c[i].as<std::int32_t>());
    if (count == 1) thin.points = {0};
    if (count == 2) thin.segments = {{0, 1}};
    if (count == 3) thin.triangles = {{0, 1, 2}};
    const std::vector<Vec3l> corners(c.begin(), c.begin() + static_cast<std::ptrdiff_t>(count));
    const mpq_class apart = testing::squared_distance(testing::as_mesh(corners), body.mesh);
    QueryContext work;
    const LowerDimensionalSeparation s =
        lower_dimensional_separation(thin, subject.treed(), narrow_goal(), work);
    // The deepest of the points at sixteenths.
    double deepest = -1;
    const auto visit = [&](const Vec3l& p) {
      if (std::ranges::none_of(body.pieces, [&](const testing::Tetrahedron& t) {
            return testing::holds(t, testing::exact(p));
          }))
        return;
      const mpq_class d = testing::squared_distance(testing::as_mesh(std::vector{p}), body.mesh);
      deepest = std::max(deepest, std::sqrt(d.get_d()));
    };
    double spacing = 0;
    const int steps = count == 3 ? 4 : 16;
    const auto share = [&](const Vec3l& e, int i) {
      return Vec3l{e.x * i / steps, e.y * i / steps, e.z * i / steps};
    };
    for (int i = 0; i <= (count > 1 ? steps : 0); ++i)
      for (int j = 0; i + j <= (count > 2 ? steps : i); ++j) {
        Vec3l p = c[0];
        if (count > 1) p = p + share(c[1] - c[0], i);
        if (count > 2) p = p + share(c[2] - c[0], j);
        visit(p);
      }
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3d e = (c[(i + 1) % count] - c[i]).as<double>();
      spacing = std::max(spacing, std::sqrt(dot(e, e)) / steps);
    }
    if (deepest > 0) {
      ++case_counts[0];
      expect_within(s, -deepest - spacing, -deepest);
      ASSERT_LE(s.upper - s.lower, 1.1);
    } else if (apart == 0) {
      // On the skin, or inside between the sampled points.
      ++case_counts[1];
      expect_within(s, -spacing, 0);
    } else if (deepest < 0) {
      ++case_counts[2];
      ASSERT_LE(mpq_class(s.lower) * mpq_class(s.lower), apart);
      ASSERT_GE(mpq_class(s.upper) * mpq_class(s.upper), apart);
      ASSERT_LE(s.upper - s.lower, 1e-12 * s.upper);
      const Vec3d way = s.on_body - s.on_other;
      ASSERT_NEAR(std::sqrt(dot(way, way)), s.d, 1e-9);
    }
    if (HasFatalFailure()) return;
  }
  for (const int n : case_counts) EXPECT_GT(n, kRounds / 60);
}

/// Arcs beside and in meshes, by the samples' own answers.
TEST_P(LowerDimensionalPair, ArcsAndMeshes) {
  for (int round = 0; round < kRounds / 5; ++round) {
    SCOPED_TRACE(round);
    testing::LatticeMap grow;
    grow.row = {Vec3i{50'000, 0, 0}, {0, 50'000, 0}, {0, 0, 50'000}};
    const testing::LatticeSolid body = mapped(testing::random_pair(lattice.rng()).a, grow);
    const testing::Subject subject(body.mesh);
    CircularArc arc{draw.between(20, 300), draw.one_in(4) ? 2 * M_PI : draw.between(0.2, 6.2), {}};
    arc.placement = {draw.turn(), on_grid(draw.point(300))};
    QueryContext work;
    const LowerDimensionalSeparation s =
        lower_dimensional_separation(*make_arc_body(arc), subject.treed(), narrow_goal(), work);
    double low = INFINITY, high = INFINITY;
    const int count = 60;
    for (int i = 0; i <= count; ++i) {
      const LowerDimensionalSeparation p =
          lower_dimensional_separation(*make_point_body(point_of(arc, arc.angle * i / count)),
                                       subject.treed(), narrow_goal(), work);
      low = std::min(low, p.lower);
      high = std::min(high, p.upper);
    }
    expect_within(s, low - arc.radius_mm * arc.angle / count / 2 * kGridPerMm - 2, high + 2);
    ASSERT_LE(s.upper - s.lower, 4);
    if (HasFatalFailure()) return;
  }
}

TEST_P(LowerDimensionalPair, PolylinesOnTheLatticeAreExact) {
  for (int round = 0; round < 2 * kRounds; ++round) {
    const auto body = [&](std::vector<Vec3l>& points) {
      for (int i = 0; i < 3; ++i) points.push_back(lattice.point());
      LowerDimensionalBody b;
      for (const Vec3l& p : points) b.vertices.push_back(p.as<std::int32_t>());
      b.segments = {{0, 1}, {1, 2}};
      return b;
    };
    std::vector<Vec3l> p, q;
    const LowerDimensionalBody a = body(p), b = body(q);
    mpq_class least(1'000'000);
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        const auto at = [](const std::vector<Vec3l>& v, int k) {
          return std::vector{v[static_cast<std::size_t>(k)], v[static_cast<std::size_t>(k) + 1]};
        };
        least = std::min(least, testing::squared_distance(testing::as_mesh(at(p, i)),
                                                          testing::as_mesh(at(q, j))));
      }
    const LowerDimensionalSeparation s = lower_dimensional_separation(a, b);
    ASSERT_LE(mpq_class(s.lower) * mpq_class(s.lower), least);
    ASSERT_GE(mpq_class(s.upper) * mpq_class(s.upper), least);
    ASSERT_LE(s.upper - s.lower, 1e-14);
    if (least == 0) {
      ASSERT_EQ(s.upper, 0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, LowerDimensionalPair, strake::test::seeds(2));

TEST(LowerDimensionalBodies, WhatHasNoPlaceOrNoSizeIsRefused) {
  EXPECT_FALSE(make_point_body({NAN, 0, 0}));
  EXPECT_FALSE(make_polyline_body({}));
  EXPECT_FALSE(make_polyline_body(std::array{Vec3d{0, 0, 0}, Vec3d{0, 0, 3e6}}));
  EXPECT_FALSE(make_arc_body({0, 1, {}}));
  EXPECT_FALSE(make_arc_body({1, INFINITY, {}}));
  CircularArc ellipse{10, 1, {}};
  ellipse.placement.linear.row[0].x = 2;
  EXPECT_FALSE(make_arc_body(ellipse));
  EXPECT_EQ(make_polyline_body(std::array{Vec3d{1, 1, 1}, Vec3d{1, 1, 1}})->points.size(), 1U);
  const std::array bow{Vec3d{0, 0, 0}, Vec3d{2, 2, 0}, Vec3d{2, 0, 0}, Vec3d{0, 3, 0}};
  EXPECT_EQ(make_polygon_body(bow, std::array<std::uint32_t, 2>{0, 4}).fault, FaceFault::crossing);
}

/// The centre line of a pipe is as deep in it as the pipe's radius, all along.
TEST(LowerDimensionalBodies, ACentreLineIsAsDeepAsTheRadius) {
  const Primitive pipe = CylinderPrimitive{100, 10'000};
  const Placement at;
  const auto line = make_polyline_body(std::array{Vec3d{0, 0, -5000}, Vec3d{0, 0, 5000}});
  const auto s = lower_dimensional_separation(*line, {&pipe, &at});
  ASSERT_TRUE(s);
  EXPECT_TRUE(s->inside);
  EXPECT_NEAR(s->d, -100'000, 0.1);
  const Primitive elbow = CircularTorusPrimitive{300, 100, 1.5};
  const auto arc = lower_dimensional_separation(*make_arc_body({300, 1.5, {}}), {&elbow, &at});
  ASSERT_TRUE(arc);
  EXPECT_NEAR(arc->d, -100'000, 1);
  EXPECT_LE(arc->upper - arc->lower, 1);
}

}  // namespace
}  // namespace strake::geometry
