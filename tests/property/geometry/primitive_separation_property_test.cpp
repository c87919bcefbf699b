// SPDX-License-Identifier: Apache-2.0
// Laws of the certified separation of analytic primitives, over all kinds and placements: brackets
// are narrow, overlap with those of closed forms and of meshes ever finer, and change under swap,
// motion and turn as the definition does.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "geometry/mesh_repair/mesh_repair.hpp"
#include "geometry/mesh_repair/snap_to_grid.hpp"
#include "geometry/primitives/tessellate.hpp"
#include "strake/geometry/depth.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/geometry/primitive_separation.hpp"
#include "support/random_primitives.hpp"
#include "support/slender_primitives.hpp"

namespace strake::geometry {
namespace {

using test::PrimitiveDraw;

#ifdef STRAKE_LONG_RUN
constexpr std::uint64_t kPairs = 200'000, kTorusPairs = 50'000, kMeshPairs = 6'000;
constexpr std::array kSags{5.0, 0.5, 0.05};
#else
constexpr std::uint64_t kPairs = 2'000, kTorusPairs = 400, kMeshPairs = 40;
constexpr std::array kSags{5.0, 0.5};
#endif

struct Body {
  Primitive primitive;
  Placement at;

  [[nodiscard]] PlacedPrimitive placed() const { return {&primitive, &at}; }
};

struct Pair {
  Body a, b;
  std::string what;
};

Vec3d on_grid(const Vec3d& p) { return to_mm(snap(p).value_or(Vec3l{})); }

std::optional<PrimitiveSeparation> solved(const Body& a, const Body& b) {
  return iterative_separation(a.placed(), b.placed());
}

enum class Kinds : std::uint8_t { convex, with_torus, slender };

/// In general position, nested, beside each other or touching; small, large and far away.
Pair draw_pair(std::uint64_t seed, Kinds kinds = Kinds::convex) {
  PrimitiveDraw draw(seed);
  const double size = std::pow(10, draw.between(0.5, 4));
  Pair p;
  p.a.primitive = draw.convex(size);
  p.b.primitive = draw.convex(size * std::pow(10, draw.between(-0.8, 0.8)));
  const bool torus = kinds == Kinds::with_torus;
  if (torus) p.a.primitive = draw.torus(size);
  const bool tori = torus && draw.one_in(3);
  if (tori) p.b.primitive = draw.torus(size * std::pow(10, draw.between(-0.8, 0.8)));
  p.a.at.linear = draw.linear(torus);
  p.b.at.linear = draw.linear(tori);
  if (torus && draw.one_in(2)) std::swap(p.a, p.b);
  if (kinds == Kinds::slender) {
    // Tori go by similarities.
    test::SlenderDraw slender(draw, 0.05, size);
    p.a = {slender.of_kind(draw.below(test::SlenderDraw::kKinds)), {draw.linear(true), {}}};
    p.b = {slender.of_kind(draw.below(test::SlenderDraw::kKinds)), {draw.linear(true), {}}};
  }
  const double spread = draw.one_in(3) ? 0.2 : 1;
  const Vec3d far = draw.one_in(10) ? draw.point(5e8) : Vec3d{};
  p.a.at.translation = on_grid(far + draw.point(size * spread));
  p.b.at.translation = on_grid(far + draw.point(size * spread));
  p.what = "seed " + std::to_string(seed) + ' ' + std::string(kind_name(p.a.primitive)) + ' ' +
           std::string(kind_name(p.b.primitive));
  const auto s = solved(p.a, p.b);
  // Move b along the way between the two to where they are near a touch.
  if (s && draw.one_in(3)) {
    const double step = (std::fabs(s->d) < 1e9 ? s->d : 0) * kMmPerGrid;
    p.b.at.translation = on_grid(p.b.at.translation - draw.direction() * step);
  }
  return p;
}

bool overlap(const PrimitiveSeparation& x, const PrimitiveSeparation& y, double slack = 0) {
  return std::fabs(x.d - y.d) <= x.error() + y.error() + slack;
}

TEST(PrimitiveSeparationLaws, BracketsAreNarrowAndAgreeWithClosedForms) {
  std::uint64_t answered = 0, wide = 0;
  for (std::uint64_t seed = 1; seed <= kPairs; ++seed) {
    const Pair p = draw_pair(seed);
    const auto s = solved(p.a, p.b);
    if (!s) continue;
    ++answered;
    ASSERT_GE(s->error(), 0) << p.what;
    EXPECT_LE(s->error(), 1 + 1e-5 * std::fabs(s->d)) << p.what << " d " << s->d;
    if (s->error() > 0.25) ++wide;
    const auto closed = primitive_separation(p.a.placed(), p.b.placed());
    ASSERT_TRUE(closed);
    EXPECT_TRUE(overlap(*s, *closed)) << p.what << ' ' << s->d << " and " << closed->d;
  }
  // What is left out: snouts whose end planes meet.
  EXPECT_GT(answered, kPairs * 9 / 10);
  EXPECT_LE(wide, kPairs / 500);
}

/// The farthest that a body reaches from its middle, grid units.
double reach_of(const Body& body) {
  double square = 0;
  for (const Vec3d& v : tessellate(body.primitive, body.at.linear, 10).mesh.vertices)
    square = std::max(square, dot(v, v));
  return std::sqrt(square) * kGridPerMm;
}

/// The bracket of a torus is as narrow as the work limit lets it: a few micrometres for rings that
/// run along the other body for long; of one pair in ten thousand a few ten thousandths of its
/// size.
TEST(PrimitiveSeparationLaws, BracketsOfToriAreNarrow) {
  std::uint64_t answered = 0, wide = 0, ended = 0;
  for (std::uint64_t seed = 1; seed <= kTorusPairs; ++seed) {
    const Pair p = draw_pair(seed, Kinds::with_torus);
    const auto s = solved(p.a, p.b);
    if (!s) continue;
    ++answered;
    ASSERT_GE(s->error(), 0) << p.what;
    if (s->error() > 1) ++wide;
    if (s->error() <= 1e-3 * std::fabs(s->d) + 20) continue;
    ++ended;
    EXPECT_LE(s->error(), 5e-4 * 2 * std::max(reach_of(p.a), reach_of(p.b)))
        << p.what << " d " << s->d;
  }
  EXPECT_GT(answered, kTorusPairs * 8 / 10);
  EXPECT_LT(wide, kTorusPairs / 50);
  EXPECT_LE(ended, kTorusPairs / 10'000);
}

/// Arcs that lie wholly beside the room of the deepest point: where the linear program has no
/// solution at all, its last bound must not stand.
TEST(PrimitiveSeparationLaws, ArcsWithNothingInThemBoundNothing) {
  for (const std::uint64_t seed : {22015U, 25306U, 31100U, 31564U, 36252U, 48474U}) {
    const Pair p = draw_pair(seed, Kinds::with_torus);
    const auto s = solved(p.a, p.b);
    ASSERT_TRUE(s) << p.what;
    EXPECT_LT(s->d, 0) << p.what;
    EXPECT_LE(s->error(), 1) << p.what << " d " << s->d;
  }
}

void swap_move_and_turn(Kinds kinds, std::uint64_t pairs) {
  for (std::uint64_t seed = 1; seed <= pairs; ++seed) {
    const Pair p = draw_pair(seed, kinds);
    const auto s = solved(p.a, p.b);
    if (!s) continue;
    const auto swapped = solved(p.b, p.a);
    ASSERT_TRUE(swapped) << p.what;
    EXPECT_TRUE(overlap(*s, *swapped)) << p.what << ' ' << s->d << " and " << swapped->d;
    PrimitiveDraw draw(seed * 7919);
    Body moved = p.b;
    const Vec3d before = moved.at.translation;
    moved.at.translation = on_grid(before + draw.point(std::pow(10, draw.between(-2, 3))));
    const Vec3d way = (moved.at.translation - before) * kGridPerMm;
    const auto after = solved(p.a, moved);
    ASSERT_TRUE(after) << p.what;
    EXPECT_TRUE(overlap(*s, *after, std::sqrt(dot(way, way)) + 2))
        << p.what << ' ' << s->d << " and " << after->d;
    // Both turned about the middle of a, then snapped: by less than two units each.
    const Mat3d turn = draw.turn();
    Pair q = p;
    q.a.at = {turn * p.a.at.linear, p.a.at.translation};
    q.b.at = {turn * p.b.at.linear,
              p.a.at.translation + turn * (p.b.at.translation - p.a.at.translation)};
    const auto turned = solved(q.a, q.b);
    ASSERT_TRUE(turned) << p.what;
    EXPECT_TRUE(overlap(*s, *turned, 2)) << p.what << ' ' << s->d << " and " << turned->d;
  }
}

TEST(PrimitiveSeparationLaws, SwapMotionAndTurn) { swap_move_and_turn(Kinds::convex, kPairs); }
TEST(PrimitiveSeparationLaws, SwapMotionAndTurnOfTori) {
  swap_move_and_turn(Kinds::with_torus, kTorusPairs);
}

TEST(PrimitiveSeparationLaws, SwapMotionAndTurnOfSlenderBodies) {
  swap_move_and_turn(Kinds::slender, kTorusPairs);
}

TEST(PrimitiveSeparationLaws, TheSamePairAtAnotherPlaceGivesTheSameBits) {
  for (std::uint64_t seed = 1; seed <= kPairs / 10; ++seed) {
    const Pair p = draw_pair(seed);
    const auto s = solved(p.a, p.b);
    if (!s || std::fabs(p.a.at.translation.x) > 1e6) continue;
    Pair q = p;
    for (Body* body : {&q.a, &q.b})
      body->at.translation = body->at.translation + Vec3d{1048576, -2097152, 524288};
    const auto t = solved(q.a, q.b);
    ASSERT_TRUE(t);
    EXPECT_EQ(s->d, t->d) << p.what;
    EXPECT_EQ(s->error(), t->error()) << p.what;
    EXPECT_EQ(s->point, t->point) << p.what;
  }
}

TEST(PrimitiveSeparationLaws, AnEarlyEndIsACertainLowerBound) {
  for (std::uint64_t seed = 1; seed <= kPairs; ++seed) {
    const Pair p = draw_pair(seed);
    const auto s = solved(p.a, p.b);
    if (!s || s->d < 0) continue;
    const double cutoff = s->d * 0.7;
    const auto early = primitive_separation(p.a.placed(), p.b.placed(), cutoff);
    ASSERT_TRUE(early);
    EXPECT_LE(early->lower, s->upper) << p.what;
    // Two that touch may meet by less than a bracket's width.
    EXPECT_GE(early->upper, std::min(cutoff, s->lower)) << p.what;
  }
}

/// A primitive as the engine tessellates it.
struct Meshed {
  Part part;
  TriangleBvh tree;
  FaceKdop planes;
  Vec3l origin;
  double off = 0;  ///< the true surface lies within this of the triangles

  [[nodiscard]] DepthOperand deep() const { return {treed(), &planes}; }
  [[nodiscard]] PartWithBvh treed() const { return {{&part, origin}, &tree}; }
};

std::optional<Meshed> meshed(const Body& body, double sag_mm) {
  const Tessellation t = tessellate(body.primitive, body.at.linear, sag_mm);
  if (!t.fault.empty()) return std::nullopt;
  auto placed = snap_to_grid(t.mesh, {});
  if (!placed) return std::nullopt;
  const Vec3l base = placed->base;
  RepairedMesh analysis = repair_mesh(std::move(placed->mesh));
  if (analysis.parts.size() != 1 || analysis.parts[0].kind != PartKind::solid) return std::nullopt;
  Meshed m;
  m.part = std::move(analysis.parts[0]);
  m.origin = snap(body.at.translation).value_or(Vec3l{}) + base;
  m.planes = make_face_kdop(m.part);
  m.tree = TriangleBvh(m.part);
  m.off = t.mesh.sag_mm * kGridPerMm + 0.87;
  return m;
}

/// The bracket that triangles give, widened by how far they may lie from the surfaces.
struct Range {
  double lower = 0, upper = 0;
};
Range mesh_range(const Meshed& a, const Meshed& b) {
  QueryContext work;
  const double off = a.off + b.off;
  const MeetingResult meeting = meet(a.treed(), b.treed(), work);
  if (meeting.meeting == Meeting::apart) {
    const auto near = find_closest_pair(a.treed(), b.treed(), 1e12, work);
    return {near->distance - off, near->distance + off};
  }
  if (meeting.meeting == Meeting::touching) return {-off, off};
  DepthOptions goal;
  goal.triangle_a = meeting.triangle_a;
  goal.triangle_b = meeting.triangle_b;
  goal.meeting_point = meeting.point;
  const Depth depth = solid_depth(a.deep(), b.deep(), goal, work);
  return {-depth.upper - off, -depth.lower + off};
}

void compare_with_meshes(Kinds kinds) {
  std::uint64_t compared = 0;
  for (std::uint64_t seed = 1; seed <= kMeshPairs; ++seed) {
    const Pair p = draw_pair(seed, kinds);
    const auto s = solved(p.a, p.b);
    if (!s || std::fabs(p.a.at.translation.x) > 1e6) continue;
    for (const double sag : kSags) {
      const auto a = meshed(p.a, sag), b = meshed(p.b, sag);
      if (!a || !b || a->part.triangles.size() + b->part.triangles.size() > 40'000) break;
      const Range range = mesh_range(*a, *b);
      EXPECT_GE(s->upper, range.lower) << p.what << " sag " << sag;
      EXPECT_LE(s->lower, range.upper) << p.what << " sag " << sag;
      ++compared;
    }
  }
  EXPECT_GT(compared, kMeshPairs * 3 / 4);
}

TEST(PrimitiveSeparationLaws, MeshesEverFinerAgree) { compare_with_meshes(Kinds::convex); }
TEST(PrimitiveSeparationLaws, MeshesOfToriEverFinerAgree) {
  compare_with_meshes(Kinds::with_torus);
}
TEST(PrimitiveSeparationLaws, MeshesOfSlenderBodiesEverFinerAgree) {
  compare_with_meshes(Kinds::slender);
}

/// A mesh of planes only is its own true surface, but for the snap.
TEST(PrimitiveSeparationLaws, BesideAMeshAsBesideTheBodyThatItIs) {
  std::uint64_t compared = 0;
  for (std::uint64_t seed = 1; seed <= kTorusPairs; ++seed) {
    Pair p = draw_pair(seed, seed % 3 == 0 ? Kinds::with_torus : Kinds::convex);
    PrimitiveDraw draw(seed + 1'000'000);
    p.b.primitive = draw.convex(draw.below(2), std::pow(10, draw.between(0.5, 3.5)));
    const auto mesh = meshed(p.b, 1);
    const auto s = solved(p.a, p.b);
    if (!mesh || !s || !(s->d > 4) || std::fabs(p.a.at.translation.x) > 1e6) continue;
    ++compared;
    const auto gap = primitive_mesh_distance(p.a.placed(), mesh->treed());
    ASSERT_TRUE(gap) << p.what;
    EXPECT_LE(gap->lower, gap->upper) << p.what;
    EXPECT_LE(gap->lower, s->upper + mesh->off) << p.what;
    EXPECT_GE(gap->upper, s->lower - mesh->off) << p.what;
    // What single precision leaves of a torus's right angles is in its bracket.
    const double slack = 1 + 3e-7 * gap->upper;
    EXPECT_LE(gap->upper - gap->lower, slack) << p.what << ' ' << s->d;
    const Vec3d way = gap->on_primitive - gap->on_mesh;
    EXPECT_NEAR(std::sqrt(dot(way, way)), gap->upper, slack) << p.what;
    const auto early = primitive_mesh_distance(p.a.placed(), mesh->treed(), gap->lower / 2);
    EXPECT_GE(early->lower, gap->lower / 2) << p.what;
  }
  EXPECT_GT(compared, kTorusPairs / 4);
}

}  // namespace
}  // namespace strake::geometry
