// SPDX-License-Identifier: Apache-2.0
// What a result about two primitives promises, held against an oracle of another kind: the true
// separation lies in the bracket, d is positive only where they are certainly apart, the points lie
// on the skins and as far apart as d says, and push_out leads out. Most pairs all but touch.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "strake/clash/clash.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/geometry/primitive_separation.hpp"
#include "support/body_depth.hpp"
#include "support/clash_model.hpp"
#include "support/convex_oracle.hpp"
#include "support/random_primitives.hpp"
#include "support/rounds.hpp"

namespace strake::clash {
namespace {

using geometry::Mat3d;
using geometry::Placement;
using geometry::Primitive;
using geometry::Vec3d;
using test::PrimitiveDraw;

constexpr auto kPairs = test::rounds(test::rounds<std::uint64_t>(3'000), std::uint64_t{100'000});
constexpr std::uint64_t kConvex = PrimitiveDraw::kConvexKinds, kKinds = kConvex + 2;
/// Rounding of the definitions here, mm.
constexpr double kSlack = 2e-6;
constexpr double kClearance = 25;

struct Body {
  Primitive primitive;
  Placement at;

  [[nodiscard]] geometry::PlacedPrimitive placed() const { return {&primitive, &at}; }
  /// Of a point; the linear part is a rotation, maybe mirrored.
  [[nodiscard]] double depth(const Vec3d& p) const {
    const Vec3d v = p - at.translation;
    const auto& m = at.linear.row;
    return test::depth_in(primitive, m[0] * v.x + m[1] * v.y + m[2] * v.z);
  }
};

struct Bodies {
  Body a, b;
};

double length(const Vec3d& v) { return std::sqrt(dot(v, v)); }

Vec3d on_grid(const Vec3d& p) { return geometry::to_mm(geometry::snap(p).value()); }

Primitive of_kind(PrimitiveDraw& draw, std::uint64_t kind, double size) {
  if (kind < kConvex) return draw.convex(kind, size);
  for (;;) {
    Primitive t = draw.torus(size);
    if (std::holds_alternative<geometry::CircularTorusPrimitive>(t) == (kind == kConvex)) return t;
  }
}

/// Whole millimetres, as designs have them: then flush faces touch exactly.
Primitive whole(Primitive p) {
  const auto round = [](double& x) { x = std::max(1.0, std::round(x)); };
  if (auto* box = std::get_if<geometry::BoxPrimitive>(&p))
    for (double* x : {&box->length_x, &box->length_y, &box->length_z}) round(*x);
  if (auto* cylinder = std::get_if<geometry::CylinderPrimitive>(&p))
    for (double* x : {&cylinder->radius, &cylinder->height}) round(*x);
  return p;
}

/// Moves b along the nearest way to a until about `gap` is left between them.
void bring_near(Bodies& of, double gap) {
  const auto s = geometry::primitive_separation(of.a.placed(), of.b.placed());
  if (!s || !(s->lower > 0)) return;
  const double far = s->d * geometry::kMmPerGrid - gap;
  of.b.at.translation = on_grid(of.b.at.translation + s->away * far);
}

/// A few micrometres to a few millimetres, either way; on the grid, so that what is requested as
/// nothing is anything up to a micrometre.
double draw_gap(PrimitiveDraw& draw) {
  if (draw.one_in(3)) return 0;
  const double gap = std::pow(10, draw.between(-4, 0.6));
  return draw.one_in(2) ? gap : -gap;
}

/// Every pair of kinds in turn: anywhere, all but touching, or of one frame.
Bodies draw_bodies(std::uint64_t seed) {
  PrimitiveDraw draw(seed);
  const double size = std::pow(10, draw.between(1, 2.6));
  Bodies of;
  of.a.primitive = of_kind(draw, seed % kKinds, size);
  of.b.primitive = of_kind(draw, seed / kKinds % kKinds, size * draw.between(0.3, 1.5));
  of.a.at.linear = draw.turn();
  of.b.at.linear = draw.turn();
  const bool one_frame = draw.one_in(4);
  if (one_frame) {
    of.a.primitive = whole(of.a.primitive);
    of.b.primitive = whole(of.b.primitive);
    of.b.at.linear = of.a.at.linear;
  }
  if (draw.one_in(8)) of.b.at.linear.row[0] = -of.b.at.linear.row[0];
  of.a.at.translation = on_grid(draw.point(size));
  if (draw.one_in(4)) {
    of.b.at.translation = on_grid(of.a.at.translation + draw.point(size * 0.6));
    return of;
  }
  // Beside each other along an axis of a, or anywhere round it.
  Vec3d way = draw.direction();
  if (one_frame) {
    Vec3d axis;
    axis[static_cast<int>(draw.below(3))] = draw.one_in(2) ? 1 : -1;
    way = of.a.at.linear * axis;
  }
  of.b.at.translation = on_grid(of.a.at.translation + way * (8 * size));
  bring_near(of, draw_gap(draw));
  return of;
}

struct Answer {
  std::optional<Pair> pair;
};

std::optional<Pair> requested(const Bodies& of, const Options& options) {
  test::ClashModel m;
  m.object("a").body(of.a.primitive, of.a.at);
  m.object("b").body(of.b.primitive, of.b.at);
  const Report report = m.detect(options);
  return report.pairs.empty() ? std::nullopt : std::optional(report.pairs.front());
}

/// How far a bracket lets points lie from where they are said to be.
double room_of(const Pair& p) { return 2e-3 + (p.d_upper_mm - p.d_lower_mm); }

void expect_points_of_gap(const Bodies& of, const Pair& p) {
  EXPECT_NEAR(of.a.depth(p.on_a_mm), 0, room_of(p));
  EXPECT_NEAR(of.b.depth(p.on_b_mm), 0, room_of(p));
  EXPECT_NEAR(length(p.on_a_mm - p.on_b_mm), p.d_mm, 1e-6);
}

void expect_exit_direction(const Bodies& of, const Pair& p) {
  const Body &in = p.deep_in_a ? of.a : of.b, &other = p.deep_in_a ? of.b : of.a;
  EXPECT_GE(in.depth(p.point_mm), -p.d_upper_mm - room_of(p));
  EXPECT_GE(other.depth(p.point_mm), -room_of(p));
  EXPECT_NEAR(in.depth(p.surface_mm()), 0, room_of(p)) << "surface_mm lies on the skin";
  ASSERT_NEAR(length(p.away), 1, 1e-9);
  // A move of a by D takes a's material at the point to b's skin, or a's skin to the point.
  const Vec3d from = p.deep_in_a ? p.surface_mm() : p.point_mm;
  const Vec3d to = p.deep_in_a ? p.point_mm : p.surface_mm();
  EXPECT_LE(length(from + p.away * -p.d_mm - to), 2e-5);
}

/// What was seen of each sort.
struct Observation {
  std::uint64_t apart = 0, open = 0, deep = 0, held = 0;
};

void check(const Bodies& of, const Options& options, Observation& observed) {
  const auto truth =
      test::oracle_separation({&of.a.primitive, of.a.at}, {&of.b.primitive, of.b.at});
  const auto p = requested(of, options);
  if (truth) {
    ASSERT_LE(truth->lower, truth->upper + kSlack);
    if (!p) {
      EXPECT_GE(truth->upper, kClearance - kSlack) << "a pair was lost";
      return;
    }
    ++observed.held;
    EXPECT_LE(p->d_lower_mm, truth->upper + kSlack);
    EXPECT_GE(p->d_upper_mm, truth->lower - kSlack);
  }
  if (!p) return;
  EXPECT_LE(p->d_lower_mm, p->d_mm);
  EXPECT_LE(p->d_mm, p->d_upper_mm);
  if (p->d_lower_mm > 0)
    ++observed.apart;
  else
    EXPECT_LE(p->d_mm, 0) << "open whether they are apart";
  if (p->d_upper_mm < 0) ++observed.deep;
  if (!(p->d_lower_mm > 0) && !(p->d_upper_mm < 0)) ++observed.open;
  if (p->d_mm < 0)
    expect_exit_direction(of, *p);
  else
    expect_points_of_gap(of, *p);
}

TEST(PrimitiveCertificates, HoldTheTruthAndShowIt) {
  Observation observed;
  for (std::uint64_t seed = 1; seed <= kPairs; ++seed) {
    const Bodies of = draw_bodies(seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + ' ' + std::string(kind_name(of.a.primitive)) +
                 " and " + std::string(kind_name(of.b.primitive)));
    constexpr std::array kDistances{-1.0, -1.0, 0.05, 0.5};
    check(of,
          {.tolerances = {.clearance_mm = kClearance}, .contact_distance_mm = kDistances[seed % 4]},
          observed);
  }
  EXPECT_GT(observed.held, kPairs / 3);
  EXPECT_GT(observed.apart, kPairs / 8);
  EXPECT_GT(observed.open, kPairs / 20);
  EXPECT_GT(observed.deep, kPairs / 8);
}

}  // namespace
}  // namespace strake::clash
