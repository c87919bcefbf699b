// SPDX-License-Identifier: Apache-2.0
// The solver of analytic pairs against points of the true bodies, over all pairs of kinds: no two
// points of the skins are nearer than the bracket allows, no point of both bodies is deeper, and
// the witnesses show that the bracket's other end is reached. Knows nothing of how the solver
// works: distances come from the definitions of the primitives.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <ranges>
#include <string>
#include <vector>

#include "strake/geometry/grid.hpp"
#include "strake/geometry/primitive_separation.hpp"
#include "support/body_depth.hpp"
#include "support/random_primitives.hpp"
#include "support/rounds.hpp"
#include "support/slender_primitives.hpp"
#include "support/true_surface.hpp"

namespace strake::geometry {
namespace {

using test::PrimitiveDraw;

constexpr auto kSlenderPairs = test::rounds<std::uint64_t>(1'620, 100'000);
/// In the fast set twenty of each pair of kinds.
constexpr auto kPairs = test::rounds<std::uint64_t>(1'620, 100'000);
constexpr std::uint64_t kKinds = PrimitiveDraw::kConvexKinds + 2;
constexpr std::size_t kSkinPoints = 200, kInnerPoints = 300;
constexpr double kSize = 100;
/// Rounding of the definitions and of the frames here, mm.
constexpr double kSlack = 1e-5;
/// How closely a body's extremes in a curved one are looked for, mm: what counts is whether there
/// is one outside, so that the search may stop farther off where all are deep inside.
double inside_slack(double depth) { return 0.01 + 0.005 * depth; }

struct Body {
  Primitive primitive;
  Placement at;

  [[nodiscard]] PlacedPrimitive placed() const { return {&primitive, &at}; }
  [[nodiscard]] Vec3d world(const Vec3d& local) const { return at.linear * local + at.translation; }
  /// The linear part is a rotation, maybe mirrored: its transpose takes back.
  [[nodiscard]] double depth(const Vec3d& p) const {
    const Vec3d v = p - at.translation;
    const auto& m = at.linear.row;
    return test::depth_in(primitive, m[0] * v.x + m[1] * v.y + m[2] * v.z);
  }
};

Primitive of_kind(PrimitiveDraw& draw, std::uint64_t kind, double size) {
  if (kind < PrimitiveDraw::kConvexKinds) return draw.convex(kind, size);
  for (;;) {
    const Primitive t = draw.torus(size);
    const bool round = std::holds_alternative<CircularTorusPrimitive>(t);
    if (round == (kind == PrimitiveDraw::kConvexKinds)) return t;
  }
}

Body placed_body(PrimitiveDraw& draw, const Primitive& primitive, double reach) {
  Body b{primitive, {draw.turn(), {}}};
  if (draw.one_in(6)) b.at.linear.row[0] = -b.at.linear.row[0];
  b.at.translation = to_mm(snap(draw.point(reach)).value_or(Vec3l{}));
  return b;
}

Body draw_body(PrimitiveDraw& draw, std::uint64_t kind, double size, double reach) {
  return placed_body(draw, of_kind(draw, kind, size), reach);
}

struct Bodies {
  Body a, b;
};

/// Lengths of four orders of magnitude in one body, the two as near as one of those lengths.
Bodies draw_slender(std::uint64_t seed) {
  PrimitiveDraw draw(seed);
  test::SlenderDraw slender(draw, 0.05, 500);
  const Primitive a = slender.of_kind(seed % kKinds), b = slender.of_kind(seed / kKinds % kKinds);
  const double reach = std::pow(10, draw.between(-1, 2.5));
  Bodies of;
  of.a = placed_body(draw, a, reach / 4);
  of.b = placed_body(draw, b, reach);
  return of;
}

/// Every pair of kinds in turn.
Bodies draw_bodies(std::uint64_t seed) {
  PrimitiveDraw draw(seed);
  Bodies of;
  of.a = draw_body(draw, seed % kKinds, kSize, kSize / 4);
  of.b = draw_body(draw, seed / kKinds % kKinds, kSize * draw.between(0.3, 1.5), kSize * 0.6);
  return of;
}

struct Sampled {
  double nearest = 1e300;  ///< from skin to skin
  double deepest = 0;      ///< of points in both
  /// The least depth of one's skin in the other: negative where it sticks out.
  double a_in_b = 1e300, b_in_a = 1e300;
};

Sampled sample(const Body& a, const Body& b, std::mt19937_64& random) {
  std::array<std::vector<Vec3d>, 2> skin;
  for (const std::size_t i : {0U, 1U}) {
    const Body& body = i == 0 ? a : b;
    for (const Vec3d& p : test::surface_points(body.primitive, kSkinPoints, random))
      skin[i].push_back(body.world(p));
  }
  Sampled s;
  const auto try_inside = [&](const Vec3d& p) {
    const double in_a = a.depth(p), in_b = b.depth(p);
    if (in_a >= 0 && in_b >= 0) s.deepest = std::max({s.deepest, in_a, in_b});
  };
  for (const Vec3d& p : skin[0])
    for (const Vec3d& q : skin[1]) {
      const Vec3d way = p - q;
      s.nearest = std::min(s.nearest, std::sqrt(dot(way, way)));
    }
  // Between two points of a skin, one point in two or so lies in the body.
  for (std::size_t i = 0; i < kInnerPoints; ++i) {
    const auto& from = skin[i % 2];
    const Vec3d &p = from[random() % kSkinPoints], &q = from[random() % kSkinPoints];
    try_inside((p + q) * 0.5);
  }
  for (const auto& points : skin)
    for (const Vec3d& p : points) try_inside(p);
  for (const Vec3d& p : skin[0]) s.a_in_b = std::min(s.a_in_b, b.depth(p));
  for (const Vec3d& q : skin[1]) s.b_in_a = std::min(s.b_in_a, a.depth(q));
  return s;
}

void check_apart(const Body& a, const Body& b, const PrimitiveSeparation& s, const Sampled& found) {
  EXPECT_GE(found.nearest, s.lower * kMmPerGrid - kSlack);
  EXPECT_EQ(found.deepest, 0) << "a point lies in both";
  // The witnesses lie on the two skins, so that the bracket's upper end is reached.
  const Vec3d middle = a.at.translation + s.point * kMmPerGrid;
  const Vec3d half = s.away * (s.d * kMmPerGrid / 2);
  const double off = s.error() * kMmPerGrid + 1e-3;
  EXPECT_NEAR(a.depth(middle + half), 0, off);
  EXPECT_NEAR(b.depth(middle - half), 0, off);
}

void check_meeting(const Body& a, const Body& b, const PrimitiveSeparation& s,
                   const Sampled& found) {
  const double least = -s.upper * kMmPerGrid, most = -s.lower * kMmPerGrid;
  EXPECT_LE(found.deepest, most + kSlack);
  // The deepest point lies in both and is as deep as it is said to be.
  const Vec3d point = a.at.translation + s.point * kMmPerGrid;
  const double in_a = a.depth(point), in_b = b.depth(point);
  EXPECT_GE(in_a, -1e-3);
  EXPECT_GE(in_b, -1e-3);
  EXPECT_GE(s.deep_in_a ? in_a : in_b, least - kSlack);
  // And comes out where it is said to: on the skin that it is nearest to.
  const Vec3d out = s.away * (s.d * kMmPerGrid * (s.deep_in_a ? 1 : -1));
  EXPECT_NEAR((s.deep_in_a ? a : b).depth(point + out), 0, s.error() * kMmPerGrid + 1e-3);
}

/// Whoever is said to lie in the other does so with all of its skin.
void check_inside(const PrimitiveSeparation& s, const Sampled& found) {
  if (s.a_inside_b > 0) {
    const double depth = s.a_inside_b * kMmPerGrid;
    EXPECT_GE(found.a_in_b, depth - inside_slack(depth));
  }
  if (s.b_inside_a > 0) {
    const double depth = s.b_inside_a * kMmPerGrid;
    EXPECT_GE(found.b_in_a, depth - inside_slack(depth));
  }
}

auto first(std::uint64_t count) { return std::views::iota(std::uint64_t{1}, count + 1); }

/// How many pairs were seen of each sort.
struct Observation {
  std::uint64_t answered = 0, apart = 0, meeting = 0, held = 0;
};

/// Draws a pair for each seed and holds its answer against samples; `more(seed, answer, samples)`
/// for each that was answered.
template <class Seeds, class Draw, class More>
Observation check_pairs(const Seeds& seeds, const Draw& draw, const More& more) {
  Observation observed;
  for (const std::uint64_t seed : seeds) {
    const auto [a, b] = draw(seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + ' ' + std::string(kind_name(a.primitive)) +
                 " and " + std::string(kind_name(b.primitive)));
    const auto s = primitive_separation(a.placed(), b.placed());
    if (!s) continue;
    ++observed.answered;
    std::mt19937_64 random(seed);
    const Sampled found = sample(a, b, random);
    check_inside(*s, found);
    if (s->a_inside_b > 0 || s->b_inside_a > 0) ++observed.held;
    if (s->lower > 0) {
      ++observed.apart;
      check_apart(a, b, *s, found);
    } else if (s->upper < 0) {
      ++observed.meeting;
      check_meeting(a, b, *s, found);
    }
    more(seed, *s, found);
  }
  return observed;
}

TEST(PrimitiveSampling, NoPointOfTheBodiesContradictsABracket) {
  std::uint64_t sampled_deep = 0;
  std::array<std::uint64_t, kKinds * kKinds> of_kinds{};
  const Observation observed =
      check_pairs(first(kPairs), draw_bodies,
                  [&](std::uint64_t seed, const PrimitiveSeparation& s, const Sampled& found) {
                    ++of_kinds[seed % (kKinds * kKinds)];
                    if (s.lower > 0) {
                      EXPECT_LE(found.nearest - s.upper * kMmPerGrid, 0.5 * kSize)
                          << "the samples cover the skins";
                    }
                    if (s.upper < 0 && found.deepest > 0.5 * -s.d * kMmPerGrid) ++sampled_deep;
                  });
  EXPECT_GT(observed.answered, kPairs * 9 / 10);
  EXPECT_GT(observed.apart, kPairs / 4);
  EXPECT_GT(observed.meeting, kPairs / 4);
  EXPECT_GT(observed.held, kPairs / 200);
  EXPECT_GT(sampled_deep, observed.meeting / 2) << "the samples reach where it is deep";
  for (const std::uint64_t count : of_kinds) EXPECT_GT(count, kPairs / (kKinds * kKinds) / 3);
}

TEST(PrimitiveSampling, NoPointOfSlenderBodiesContradictsABracket) {
  const Observation observed =
      check_pairs(first(kSlenderPairs), draw_slender,
                  [](std::uint64_t, const PrimitiveSeparation&, const Sampled&) {});
  EXPECT_GT(observed.answered, kSlenderPairs * 8 / 10);
  EXPECT_GT(observed.apart, kSlenderPairs / 8);
  EXPECT_GT(observed.meeting, kSlenderPairs / 8);
  EXPECT_GT(observed.held, kSlenderPairs / 200);
}

/// Bodies in a ring whose place nearest to the skin is no corner, no end and no middle: where the
/// ring's hole bends in, or on the inner side of an arc.
TEST(PrimitiveSampling, BodiesLieNoDeeperInRingsThanTheirNearestPlace) {
  constexpr std::array<std::uint64_t, 9> kSeeds{11338, 12058, 22097, 39274, 79208,
                                                87649, 93701, 97514, 99620};
  const Observation observed = check_pairs(
      kSeeds, draw_slender, [](std::uint64_t, const PrimitiveSeparation&, const Sampled&) {});
  EXPECT_EQ(observed.held, kSeeds.size());
}

/// Next to either end of a sweep of any angle the way out is through that end, and deep inside one
/// of more than half a turn, without a hole, it is over the edge where both ends meet.
TEST(PrimitiveSampling, TheWayOutOfASweepIsItsNearestEnds) {
  constexpr auto kSweeps = test::rounds<std::uint64_t>(600, 20'000);
  std::uint64_t by_end = 0;
  for (std::uint64_t seed = 1; seed <= kSweeps; ++seed) {
    PrimitiveDraw draw(seed);
    const double angle = draw.between(0.3, 6.2), tube = draw.between(5, 60);
    Bodies of;
    if (draw.one_in(2))
      of.a.primitive = CircularTorusPrimitive{tube * draw.between(1, 6), tube, angle};
    else
      of.a.primitive = RectangularTorusPrimitive{draw.one_in(3) ? 0 : tube,
                                                 tube * draw.between(2, 4), 2 * tube, angle};
    of.a = placed_body(draw, of.a.primitive, kSize);
    // A ball as small as a point for which the way out is asked, next to one of the ends.
    const double beside = draw.between(0.02, 0.7), at = draw.one_in(2) ? beside : angle - beside;
    const auto* const round = std::get_if<CircularTorusPrimitive>(&of.a.primitive);
    const double out = round != nullptr ? round->centre_radius : tube * draw.between(1, 2);
    of.b.primitive = SpherePrimitive{0.02};
    const Vec3d local{out * std::cos(at), out * std::sin(at), 0};
    of.b.at.translation = to_mm(snap(of.a.world(local)).value_or(Vec3l{}));
    SCOPED_TRACE("seed " + std::to_string(seed) + ' ' + std::string(kind_name(of.a.primitive)));
    const auto s = primitive_separation(of.a.placed(), of.b.placed());
    ASSERT_TRUE(s);
    if (!(s->upper < 0)) continue;
    ASSERT_TRUE(s->deep_in_a);
    const Vec3d point = of.a.at.translation + s->point * kMmPerGrid;
    const Vec3d skin = point + s->away * (s->d * kMmPerGrid);
    EXPECT_NEAR(of.a.depth(skin), 0, s->error() * kMmPerGrid + 1e-3);
    // The same way farther on it is outside.
    EXPECT_LT(of.a.depth(skin + s->away * (s->d * kMmPerGrid * 0.01)), 0);
    if (of.a.depth(point) < out * std::sin(beside) + 0.02) ++by_end;
  }
  EXPECT_GT(by_end, kSweeps / 2);
}

/// From all but on its axis a cylinder is left through its skin, not through an end that is
/// farther.
TEST(PrimitiveSampling, TheWayOutFromNextToAnAxisIsTheShortest) {
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    PrimitiveDraw draw(seed);
    Bodies of;
    of.a = placed_body(draw, CylinderPrimitive{7.2, 40}, kSize);
    of.b = placed_body(draw, BoxPrimitive{60, 60, 60}, 1);
    // A box with a face through the axis, but for the grid's rounding.
    of.b.at.linear = of.a.at.linear;
    of.b.at.translation = to_mm(snap(of.a.world({30, 0, draw.between(-9, 9)})).value_or(Vec3l{}));
    const auto s = primitive_separation(of.a.placed(), of.b.placed());
    ASSERT_TRUE(s);
    ASSERT_LT(s->upper, 0);
    const Vec3d point = of.a.at.translation + s->point * kMmPerGrid;
    const Vec3d skin = point + s->away * (s->d * kMmPerGrid * (s->deep_in_a ? 1 : -1));
    EXPECT_NEAR((s->deep_in_a ? of.a : of.b).depth(skin), 0, 1e-3) << "seed " << seed;
  }
}

/// Its ends in a disc of more than half a turn, across the apex of what is left out.
TEST(PrimitiveSampling, ARodAcrossANotchSticksOut) {
  constexpr std::uint64_t kSeed = 68'795;
  const auto [a, b] = draw_bodies(kSeed);
  const auto s = primitive_separation(a.placed(), b.placed());
  ASSERT_TRUE(s);
  std::mt19937_64 random(kSeed);
  EXPECT_LT(sample(a, b, random).b_in_a, -0.1);
  EXPECT_LT(s->b_inside_a * kMmPerGrid, -0.1);
}

}  // namespace
}  // namespace strake::geometry
