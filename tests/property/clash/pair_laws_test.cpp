// SPDX-License-Identifier: Apache-2.0
// What must not show in an answer, and how answers must follow each other: laws of the definition
// over seeded pairs of every kind, through the whole engine.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <variant>

#include "strake/clash/clash.hpp"
#include "strake/geometry/grid.hpp"
#include "support/clash_model.hpp"
#include "support/lattice_solids.hpp"
#include "support/random_primitives.hpp"
#include "support/revolved_meshes.hpp"
#include "support/rounds.hpp"
#include "support/solid_pairs.hpp"

namespace strake::clash {
namespace {

using geometry::Placement;
using geometry::Primitive;
using geometry::Vec3d;
using geometry::Vec3i;
using test::ClashModel;
using test::PrimitiveDraw;
using test::SolidPair;
using testing::IndexedMesh;

constexpr auto kPairs = test::rounds<std::uint64_t>(150, 10'000);

Pair evaluated(const ClashModel& m) {
  const Report report = m.detect(test::exact_options());
  EXPECT_EQ(report.pairs.size(), 1U);
  return report.pairs.empty() ? Pair{} : report.pairs.front();
}

Pair evaluated(const IndexedMesh& a, const IndexedMesh& b) {
  ClashModel m;
  m.object("a").body(test::in_mm(a));
  m.object("b").body(test::in_mm(b));
  return evaluated(m);
}

Relation mirrored(Relation r) {
  if (r == Relation::a_in_b) return Relation::b_in_a;
  return r == Relation::b_in_a ? Relation::a_in_b : r;
}

/// All that an answer says of the two, apart from where.
void expect_same_bits(const Pair& x, const Pair& y) {
  EXPECT_EQ(name(x.cls), name(y.cls));
  EXPECT_EQ(name(x.relation), name(y.relation));
  EXPECT_EQ(x.d_mm, y.d_mm);
  EXPECT_EQ(x.d_lower_mm, y.d_lower_mm);
  EXPECT_EQ(x.d_upper_mm, y.d_upper_mm);
  EXPECT_EQ(x.flags, y.flags);
  EXPECT_EQ(x.depth_complete, y.depth_complete);
}

/// The same pair written down in another way: how triangles are cut and numbered may show in how
/// far a bracket of a depth was narrowed, in nothing else.
void expect_same_answer(const Pair& x, const Pair& y) {
  EXPECT_EQ(name(x.cls), name(y.cls));
  EXPECT_EQ(name(x.relation), name(y.relation));
  if (x.d_mm >= 0) {
    EXPECT_EQ(x.d_mm, y.d_mm);
  }
  EXPECT_LE(x.d_lower_mm, y.d_upper_mm);
  EXPECT_LE(y.d_lower_mm, x.d_upper_mm);
}

template <class Law>
void over_pairs(const Law& law) {
  std::uint64_t hits = 0, contacts = 0, apart = 0;
  for (std::uint64_t seed = 1; seed <= kPairs; ++seed) {
    const SolidPair pair = test::draw_solid_pair(seed);
    SCOPED_TRACE(pair.recipe);
    const Pair base = evaluated(pair.a, pair.b);
    if (base.cls == Class::hit) ++hits;
    if (base.cls == Class::contact) ++contacts;
    if (base.cls == Class::clearance_violation) ++apart;
    law(pair, base, seed);
  }
  EXPECT_GT(hits, kPairs / 5);
  EXPECT_GT(contacts, kPairs / 15);
  EXPECT_GT(apart, kPairs / 5);
}

TEST(PairLaws, SwappedNamesMirrorTheAnswer) {
  over_pairs([](const SolidPair& pair, const Pair& base, std::uint64_t) {
    Pair swapped = evaluated(pair.b, pair.a);
    swapped.relation = mirrored(swapped.relation);
    expect_same_bits(base, swapped);
  });
}

/// A depth is told to within 8 um or 2 %, or said not to be: no wide bracket of a hit without the
/// mark, and no mark beside a bracket for which the grid alone accounts.
TEST(PairLaws, ABracketOfADepthIsNarrowOrMarkedAsIncomplete) {
  // What the snap moves widens brackets beyond what a search aims for.
  constexpr double kSnap = 4e-3;
  over_pairs([](const SolidPair&, const Pair& base, std::uint64_t) {
    const double width = base.d_upper_mm - base.d_lower_mm;
    const double aimed = std::max(8e-3, 0.02 * -base.d_lower_mm);
    if (base.cls != Class::hit || base.depth_complete) {
      EXPECT_LE(width, aimed + kSnap);
    } else {
      EXPECT_GT(width, 8e-3);
    }
  });
}

TEST(PairLaws, OrderOfTrianglesAndVertices) {
  over_pairs([](const SolidPair& pair, const Pair& base, std::uint64_t seed) {
    std::mt19937_64 rng(seed);
    expect_same_answer(base,
                       evaluated(testing::shuffled(pair.a, rng), testing::shuffled(pair.b, rng)));
  });
}

TEST(PairLaws, SubdividedFaces) {
  testing::LatticeMap twice;
  for (Vec3i& row : twice.row) row = row * 2;
  over_pairs([&](const SolidPair& pair, const Pair&, std::uint64_t) {
    const IndexedMesh a = mapped(pair.a, twice), b = mapped(pair.b, twice);
    expect_same_answer(evaluated(a, b), evaluated(testing::subdivided(a), b));
    expect_same_answer(evaluated(a, b), evaluated(a, testing::subdivided(b)));
  });
}

TEST(PairLaws, MovedByGridSteps) {
  over_pairs([](const SolidPair& pair, const Pair& base, std::uint64_t seed) {
    PrimitiveDraw draw(seed);
    const Vec3d there = to_mm(geometry::snap(draw.point(4e8)).value());
    ClashModel m;
    m.object("a").body(test::in_mm(pair.a), {{}, there});
    m.object("b").body(test::in_mm(pair.b), {{}, there});
    expect_same_bits(base, evaluated(m));
  });
}

IndexedMesh moved(IndexedMesh mesh, const Vec3i& by) {
  for (Vec3i& v : mesh.vertices) v = v + by;
  return mesh;
}

/// A file may write its coordinates from anywhere.
TEST(PairLaws, MovedInTheFileByGridSteps) {
  over_pairs([](const SolidPair& pair, const Pair& base, std::uint64_t seed) {
    std::mt19937_64 rng(seed);
    const auto step = [&] {
      return static_cast<std::int32_t>(rng() % 1'000'000'000) - 500'000'000;
    };
    Vec3i there;
    for (int axis = 0; axis < 3; ++axis) there[axis] = step();
    expect_same_bits(base, evaluated(moved(pair.a, there), moved(pair.b, there)));
  });
}

/// Also where a search ends at its limit and the bracket is what it has come to.
TEST(PairLaws, MovedInTheFileByGridStepsWithWorkLeft) {
  std::mt19937_64 rng(1);
  const auto soup = [&](std::uint32_t triangles) {
    IndexedMesh made;
    for (std::uint32_t v = 0; v < 3 * triangles; ++v) {
      Vec3i at;
      for (int axis = 0; axis < 3; ++axis) at[axis] = static_cast<std::int32_t>(rng() % 200'000);
      made.vertices.push_back(at);
    }
    for (std::uint32_t t = 0; t < triangles; ++t)
      made.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    return made;
  };
  const IndexedMesh a = soup(100), b = soup(100);
  const Pair base = evaluated(a, b);
  EXPECT_EQ(base.cls, Class::hit);
  EXPECT_FALSE(base.depth_complete);
  for (const Vec3i by : {Vec3i{1, 0, 0}, Vec3i{1000, -7, 3}, Vec3i{0, 30'000'000, 0},
                         Vec3i{-400'000'000, 123'456'789, 987'654'321}})
    expect_same_bits(base, evaluated(moved(a, by), moved(b, by)));
}

/// Bit by bit where the number is exact; a depth within its bracket.
TEST(PairLaws, TheSymmetriesOfTheAxes) {
  over_pairs([](const SolidPair& pair, const Pair& base, std::uint64_t seed) {
    for (int i = 0; i < 3; ++i) {
      const auto symmetry =
          testing::axis_symmetry(static_cast<int>((seed * 7 + static_cast<unsigned>(i) * 17) % 48));
      expect_same_answer(base, evaluated(mapped(pair.a, symmetry), mapped(pair.b, symmetry)));
    }
  });
}

TEST(PairLaws, SeparationChangesByNoMoreThanTheMove) {
  over_pairs([](const SolidPair& pair, const Pair& base, std::uint64_t seed) {
    PrimitiveDraw draw(seed);
    const Vec3d by = to_mm(
        geometry::snap(draw.point(pair.size_mm() * std::pow(10, draw.between(-4, 0)))).value());
    ClashModel m;
    m.object("a").body(test::in_mm(pair.a));
    m.object("b").body(test::in_mm(pair.b), {{}, by});
    const Pair moved = evaluated(m);
    const double way = std::sqrt(dot(by, by)) * (1 + 1e-12) + 1e-9;
    EXPECT_LE(moved.d_lower_mm, base.d_upper_mm + way);
    EXPECT_LE(base.d_lower_mm, moved.d_upper_mm + way);
  });
}

/// Of several parts that are about as deep, another one than the deciding may be the deepest.
TEST(PairLaws, TheBracketIsThatOfAllParts) {
  // Two lattice solids askew that touch with two parts, up to what the snap has made of it.
  const SolidPair pair = test::draw_solid_pair(73);
  ASSERT_EQ(pair.recipe, "seed 73 lattice solid and box, touching, askew");
  const auto image = [&](int i) {
    const auto symmetry = testing::axis_symmetry(i);
    return evaluated(mapped(pair.a, symmetry), mapped(pair.b, symmetry));
  };
  const Pair base = image(0);
  for (int i = 1; i < 48; ++i) expect_same_answer(base, image(i));
}

/// One part in the other body, one across its skin, both as deep but for rounding: which of the two
/// came out deeper is not what the two objects are to each other.
TEST(PairLaws, RoundingDoesNotChooseTheRelation) {
  const SolidPair pair = test::draw_solid_pair(6316);
  ASSERT_EQ(pair.recipe, "seed 6316 lattice solid and lattice solid, contained, aligned");
  for (int i = 0; i < 48; ++i) {
    const auto symmetry = testing::axis_symmetry(i);
    const Pair image = evaluated(mapped(pair.a, symmetry), mapped(pair.b, symmetry));
    EXPECT_EQ(name(image.relation), name(Relation::interfere)) << i;
    EXPECT_NEAR(image.d_mm, -20.064154916, 1e-5) << i;
  }
}

/// What is added can only come nearer or reach deeper.
void expect_no_rise(const Pair& before, const Pair& after) {
  EXPECT_LE(after.d_lower_mm, before.d_upper_mm);
  // Where the number is exact, so is the law.
  if (after.d_mm >= 0) {
    EXPECT_LE(after.d_mm, before.d_mm * (1 + 1e-15));
  }
  EXPECT_GE(after.cls, before.cls) << "with touch tolerances of zero the class rises as well";
}

TEST(PairLaws, APartMoreNeverRaisesTheSeparation) {
  over_pairs([](const SolidPair& pair, const Pair& base, std::uint64_t seed) {
    const IndexedMesh more = test::draw_solid_pair(seed + 1'000'000).b;
    ClashModel m;
    m.object("a").body(test::in_mm(pair.a));
    m.object("b").body(test::in_mm(pair.b)).body(test::in_mm(more));
    expect_no_rise(base, evaluated(m));
  });
}

/// A body of lattice tetrahedra within one of more of them, beside a third body.
TEST(PairLaws, ALargerBodyNeverRaisesTheSeparation) {
  std::uint64_t compared = 0, rose_in_depth = 0;
  for (std::uint64_t seed = 1; seed <= 8 * kPairs; ++seed) {
    std::mt19937_64 rng(seed);
    testing::LatticePair nested = testing::random_pair(rng);
    if (nested.recipe != "nested") continue;
    if (nested.a.pieces.size() > nested.b.pieces.size()) std::swap(nested.a, nested.b);
    testing::LatticeMap scale;
    for (Vec3i& row : scale.row) row = row * 6000;
    const IndexedMesh small = mapped(nested.a.mesh, scale), large = mapped(nested.b.mesh, scale);
    const IndexedMesh other = mapped(testing::random_pair(rng).a.mesh, scale);
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Pair before = evaluated(small, other), after = evaluated(large, other);
    expect_no_rise(before, after);
    ++compared;
    if (after.d_upper_mm < before.d_lower_mm) ++rose_in_depth;
  }
  EXPECT_GT(compared, kPairs / 2);
  EXPECT_GT(rose_in_depth, compared / 10);
}

/// A primitive that contains another one of the same kind in the same place, as insulation does.
Primitive enlarged(const Primitive& p, double factor) {
  Primitive large = p;
  std::visit(
      [&]<class Kind>(Kind& k) {
        using namespace geometry;
        if constexpr (std::is_same_v<Kind, CircularTorusPrimitive>) {
          k.tube_radius = std::min(k.tube_radius * factor, k.centre_radius);
        } else if constexpr (std::is_same_v<Kind, RectangularTorusPrimitive>) {
          k.inner_radius /= factor;
          k.outer_radius *= factor;
          k.height *= factor;
        } else if constexpr (std::is_same_v<Kind, BoxPrimitive>) {
          k = {k.length_x * factor, k.length_y * factor, k.length_z};
        } else if constexpr (std::is_same_v<Kind, CylinderPrimitive>) {
          k.radius *= factor;
        } else if constexpr (std::is_same_v<Kind, SpherePrimitive>) {
          k.diameter *= factor;
        } else if constexpr (std::is_same_v<Kind, PyramidPrimitive>) {
          // All lengths: from the middle of the axis, which lies in it.
          k = {k.bottom_x * factor, k.bottom_y * factor, k.top_x * factor, k.top_y * factor,
               k.offset_x * factor, k.offset_y * factor, k.height * factor};
        } else if constexpr (std::is_same_v<Kind, SnoutPrimitive>) {
          k.bottom_radius *= factor;
          k.top_radius *= factor;
          k.height *= factor;
          k.offset_x *= factor;
          k.offset_y *= factor;
        } else if constexpr (!std::is_same_v<Kind, LinePrimitive>) {
          k.radius *= factor;  // dishes, from the middle of the base
          k.height *= factor;
        }
      },
      large);
  return large;
}

TEST(PairLaws, ALargerPrimitiveNeverRaisesTheSeparation) {
  std::uint64_t compared = 0, grew = 0;
  for (std::uint64_t seed = 1; seed <= 4 * kPairs; ++seed) {
    PrimitiveDraw draw(seed);
    const Primitive a = draw.one_in(4) ? draw.torus(300) : draw.convex(300);
    const Primitive b = draw.one_in(4) ? draw.torus(300) : draw.convex(300);
    const Placement at{draw.linear(true), {}}, beside{draw.linear(true), draw.point(350)};
    const Primitive large = enlarged(a, draw.between(1.01, 1.6));
    SCOPED_TRACE("seed " + std::to_string(seed) + ' ' + std::string(kind_name(a)) + " and " +
                 std::string(kind_name(b)));
    const auto of = [&](const Primitive& first) {
      ClashModel m;
      m.object("a").body(first, at);
      m.object("b").body(b, beside);
      return m.detect({.tolerances = {.clearance_mm = 1e6}, .engine = {.max_regions = 0}});
    };
    const Report before = of(a), after = of(large);
    if (before.pairs.size() != 1 || after.pairs.size() != 1) continue;
    ++compared;
    EXPECT_LE(after.pairs[0].d_lower_mm, before.pairs[0].d_upper_mm);
    if (after.pairs[0].d_upper_mm < before.pairs[0].d_lower_mm) ++grew;
  }
  EXPECT_GT(compared, 3 * kPairs);
  EXPECT_GT(grew, compared / 2);
}

/// A pipe and ever thicker insulation beside a wall: clear of it, into it, through it.
TEST(PairLaws, InsulationNeverHidesAClash) {
  for (const double radius : {20.0, 40.0, 60.0, 80.0, 110.0, 150.0, 200.0, 400.0}) {
    ClashModel m;
    m.object("pipe").body(geometry::CylinderPrimitive{radius, 2000}, {{}, {150, 0, 0}});
    m.box("wall", {0, -1000, -900}, {100, 1000, 900});
    const Pair p = evaluated(m);
    EXPECT_NEAR(p.d_mm, 50 - radius, 0.02) << radius;
    EXPECT_LE(p.d_lower_mm, 50 - radius) << radius;
    EXPECT_GE(p.d_upper_mm, 50 - radius) << radius;
  }
}

}  // namespace
}  // namespace strake::clash
