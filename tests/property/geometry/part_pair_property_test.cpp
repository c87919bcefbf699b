// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <tuple>
#include <utility>

#include "strake/geometry/part_pair.hpp"
#include "support/lattice_solids.hpp"
#include "support/nearest_double.hpp"
#include "support/rational_oracle.hpp"
#include "support/rounds.hpp"

namespace strake::geometry {
namespace {

using strake::test::nearest_double;
using strake::testing::common_volume6;
using strake::testing::IndexedMesh;
using strake::testing::LatticeMap;
using strake::testing::LatticePair;
using strake::testing::LatticeSolid;
using strake::testing::mapped;
using strake::testing::SheetCover;
using strake::testing::Subject;
using strake::testing::Tetrahedron;

constexpr int kRounds = test::rounds(80, 6000);

/// What must come out, from the oracle.
struct Truth {
  Meeting meeting = Meeting::apart;
  bool boundaries_meet = false, a_within_b = false, b_within_a = false;
  mpq_class squared;

  void settle(bool interiors) {
    if (!interiors)
      meeting = boundaries_meet ? Meeting::touching : Meeting::apart;
    else if (boundaries_meet || (!a_within_b && !b_within_a))
      meeting = Meeting::crossing;
    else
      meeting = a_within_b ? Meeting::a_inside_b : Meeting::b_inside_a;
  }
};

Truth truth_of(const LatticeSolid& a, const LatticeSolid& b) {
  Truth t;
  t.squared = testing::squared_distance(a.mesh, b.mesh);
  t.boundaries_meet = t.squared == 0;
  const mpq_class common = common_volume6(a.pieces, b.pieces);
  t.a_within_b = common == testing::volume6(a.pieces);
  t.b_within_a = common == testing::volume6(b.pieces);
  t.settle(common > 0);
  return t;
}

Truth truth_of(const IndexedMesh& sheet, const LatticeSolid& body) {
  Truth t;
  t.squared = testing::squared_distance(sheet, body.mesh);
  t.boundaries_meet = t.squared == 0;
  const SheetCover cover = testing::sheet_cover(sheet, body);
  t.a_within_b = cover.inside + cover.on_surface == cover.all;
  t.settle(cover.inside > 0);
  return t;
}

/// Everything an answer says that must not depend on how the bodies are written down.
struct Answer {
  Meeting meeting;
  bool boundaries_meet, a_within_b, b_within_a;
  double squared, distance;

  friend bool operator==(const Answer&, const Answer&) = default;
};

Answer answer(const Subject& a, const Subject& b) {
  QueryContext work;
  const MeetingResult m = meet(a.treed(), b.treed(), work);
  const auto near = find_closest_pair(a.treed(), b.treed(), INFINITY, work);
  return {m.meeting, m.boundaries_meet, m.a_within_b, m.b_within_a, near->squared, near->distance};
}

std::ostream& operator<<(std::ostream& out, const Answer& x) {
  return out << "meeting " << static_cast<int>(x.meeting) << " boundaries " << x.boundaries_meet
             << " a_in_b " << x.a_within_b << " b_in_a " << x.b_within_a << " squared "
             << x.squared;
}

Answer expected(const Truth& t, std::int32_t factor) {
  const mpq_class scaled = t.squared * factor * factor;
  return {t.meeting, t.boundaries_meet, t.a_within_b, t.b_within_a, nearest_double(scaled), 0};
}

Answer without_root(Answer x) {
  x.distance = 0;
  return x;
}

Answer swapped(Answer x) {
  std::swap(x.a_within_b, x.b_within_a);
  if (x.meeting == Meeting::a_inside_b)
    x.meeting = Meeting::b_inside_a;
  else if (x.meeting == Meeting::b_inside_a)
    x.meeting = Meeting::a_inside_b;
  return x;
}

LatticeMap scaling(std::int32_t factor) {
  LatticeMap m;
  for (Vec3i& row : m.row) row = row * factor;
  return m;
}

class PartPairProperty : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  std::mt19937_64 rng{GetParam()};

  /// Small numbers, and the full size that the exact arithmetic is made for.
  std::int32_t factor(int round) { return round % 3 == 0 ? 1 : round % 3 == 1 ? 999983 : 50000017; }
  Vec3l far_origin() {
    const auto coordinate = [this] {
      return static_cast<std::int64_t>(rng() % (1ULL << 49)) - (1LL << 48);
    };
    return {coordinate(), coordinate(), coordinate()};
  }
  [[nodiscard]] std::string label(const std::string& recipe, int round) const {
    return "seed " + std::to_string(GetParam()) + " round " + std::to_string(round) + " " + recipe;
  }
};

TEST_P(PartPairProperty, SolidsMeetAsTheirVolumesState) {
  for (int round = 0; round < kRounds; ++round) {
    const LatticePair pair = testing::random_pair(rng);
    SCOPED_TRACE(label(pair.recipe, round));
    const LatticeMap scale = scaling(factor(round));
    const Subject a(mapped(pair.a.mesh, scale)), b(mapped(pair.b.mesh, scale));
    ASSERT_EQ(a.part.kind, PartKind::solid);
    ASSERT_EQ(without_root(answer(a, b)), expected(truth_of(pair.a, pair.b), factor(round)));
  }
}

TEST_P(PartPairProperty, SheetsMeetSolidsAsTheirAreasState) {
  for (int round = 0; round < kRounds; ++round) {
    const LatticeSolid body = testing::random_pair(rng).a;
    const IndexedMesh sheet = testing::random_sheet(rng);
    SCOPED_TRACE(label("sheet", round));
    const LatticeMap scale = scaling(factor(round));
    const Subject a(mapped(sheet, scale)), b(mapped(body.mesh, scale));
    if (a.part.kind != PartKind::sheet) continue;
    const Answer truth = expected(truth_of(sheet, body), factor(round));
    ASSERT_EQ(without_root(answer(a, b)), truth);
    ASSERT_EQ(without_root(answer(b, a)), swapped(truth));
  }
}

TEST_P(PartPairProperty, SheetsCoverSheetsAsTheirAreasState) {
  for (int round = 0; round < kRounds; ++round) {
    const IndexedMesh first = testing::random_sheet(rng);
    IndexedMesh second = testing::random_sheet(rng);
    if (round % 4 == 0) {
      second = first;
      if (second.triangles.size() > 1) second.triangles.pop_back();
    }
    SCOPED_TRACE(label("two sheets", round));
    const Subject a(first), b(second);
    if (a.part.kind != PartKind::sheet || b.part.kind != PartKind::sheet) continue;
    const Answer x = answer(a, b);
    const mpq_class squared = testing::squared_distance(first, second);
    ASSERT_EQ(x.squared, nearest_double(squared));
    ASSERT_EQ(x.boundaries_meet, squared == 0);
    const SheetCover ab = testing::sheet_cover(first, second);
    const SheetCover ba = testing::sheet_cover(second, first);
    ASSERT_EQ(x.a_within_b, ab.on_surface == ab.all);
    ASSERT_EQ(x.b_within_a, ba.on_surface == ba.all);
    ASSERT_EQ(answer(b, a), swapped(x));
  }
}

TEST_P(PartPairProperty, TheSameHoweverWrittenDown) {
  for (int round = 0; round < kRounds; ++round) {
    const LatticePair pair = testing::random_pair(rng);
    SCOPED_TRACE(label(pair.recipe, round));
    const LatticeMap twice = scaling(2 * (1 + round % 2 * 20000000));
    const IndexedMesh ma = mapped(pair.a.mesh, twice), mb = mapped(pair.b.mesh, twice);
    const Subject a(ma), b(mb);
    const Answer base = answer(a, b);
    ASSERT_EQ(answer(b, a), swapped(base));
    ASSERT_EQ(answer(Subject(testing::shuffled(ma, rng)), Subject(testing::shuffled(mb, rng))),
              base);
    ASSERT_EQ(answer(Subject(testing::subdivided(ma)), b), base);
    ASSERT_EQ(answer(a, Subject(testing::subdivided(mb))), base);
    const Vec3l origin = far_origin();
    ASSERT_EQ(answer(Subject(ma, origin), Subject(mb, origin)), base);
    const LatticeMap turn = testing::axis_symmetry(static_cast<int>(rng() % 48));
    ASSERT_EQ(answer(Subject(mapped(ma, turn)), Subject(mapped(mb, turn))), base);
    // The coordinates inside a part do not matter, only where its points come to lie.
    LatticeMap shift;
    shift.offset = {1001, -77, 5};
    ASSERT_EQ(answer(Subject(mapped(ma, shift), {-1001, 77, -5}), b), base);
  }
}

/// Six times the signed volumes of a tetrahedron's parts seen from a point, all with the sign of
/// the whole: inside; one zero: on a face.
PointSide side_of_tetrahedron(const Tetrahedron& t, const std::array<mpq_class, 3>& p) {
  const auto volume = [&](const std::array<std::array<mpq_class, 3>, 4>& q) {
    std::array<std::array<mpq_class, 3>, 3> e;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) e[i][k] = q[i + 1][k] - q[0][k];
    const mpq_class v = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                        e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                        e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
    return sgn(v);
  };
  std::array<std::array<mpq_class, 3>, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = {t[i].x, t[i].y, t[i].z};
  const int whole = volume(corners);
  bool on_face = false;
  for (std::size_t i = 0; i < 4; ++i) {
    auto moved = corners;
    moved[i] = p;
    const int s = volume(moved) * whole;
    if (s < 0) return PointSide::outside;
    on_face |= s == 0;
  }
  return on_face ? PointSide::on_boundary : PointSide::inside;
}

TEST_P(PartPairProperty, PointsLieWhereThePiecesState) {
  for (int round = 0; round < kRounds; ++round) {
    const LatticeSolid body = testing::random_pair(rng).a;
    const Subject subject(body.mesh);
    SCOPED_TRACE(label("points", round));
    for (int i = 0; i < 16; ++i) {
      const std::int64_t d = i % 4 == 0 ? 1 : i % 4 == 1 ? 2 : 1 + static_cast<int>(rng() % 4096);
      Vec3l n;
      for (int k = 0; k < 3; ++k)
        n[k] = static_cast<std::int64_t>(rng() % static_cast<std::uint64_t>(8 * d + 1)) - 3 * d;
      QueryContext work;
      const PointSide side = side_of(subject.treed(), n, d, work);
      std::array<mpq_class, 3> p;
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = mpq_class(static_cast<long>(n[static_cast<int>(k)]), static_cast<long>(d));
      bool inside = false, touched = false;
      for (const Tetrahedron& t : body.pieces) {
        const PointSide s = side_of_tetrahedron(t, p);
        inside |= s == PointSide::inside;
        touched |= s == PointSide::on_boundary;
      }
      // On a face between pieces a point may be inside or on the surface; a distance tells.
      IndexedMesh tiny;
      if (inside)
        ASSERT_EQ(side, PointSide::inside);
      else if (!touched)
        ASSERT_EQ(side, PointSide::outside);
      else
        ASSERT_NE(side, PointSide::outside);
      if (d == 1 && touched) {
        tiny.vertices.assign(3, n.as<std::int32_t>());
        tiny.triangles.push_back({0, 1, 2});
        ASSERT_EQ(side == PointSide::on_boundary, testing::squared_distance(tiny, body.mesh) == 0);
      }
    }
  }
}

TEST_P(PartPairProperty, TheNearestTrianglesAreTheFirstAmongEquals) {
  for (int round = 0; round < kRounds / 4; ++round) {
    const LatticePair pair = testing::random_pair(rng);
    const Subject a(pair.a.mesh), b(pair.b.mesh);
    if (a.part.triangles.size() * b.part.triangles.size() > 150) continue;
    SCOPED_TRACE(label(pair.recipe, round));
    QueryContext work;
    const auto near = find_closest_pair(a.treed(), b.treed(), INFINITY, work);
    ASSERT_TRUE(near.has_value());
    const auto alone = [](const Part& part, std::uint32_t t) {
      return IndexedMesh{part.vertices, {part.triangles[t]}};
    };
    std::tuple<mpq_class, std::uint32_t, std::uint32_t> least{mpq_class(1000000), 0, 0};
    for (std::uint32_t i = 0; i < a.part.triangles.size(); ++i)
      for (std::uint32_t j = 0; j < b.part.triangles.size(); ++j)
        least =
            std::min(least, {testing::squared_distance(alone(a.part, i), alone(b.part, j)), i, j});
    ASSERT_EQ(near->triangle_a, std::get<1>(least));
    ASSERT_EQ(near->triangle_b, std::get<2>(least));
    const Vec3d gap = near->on_b - near->on_a;
    ASSERT_NEAR(dot(gap, gap), near->squared, 1e-9);
  }
}

#ifdef STRAKE_LONG_RUN
INSTANTIATE_TEST_SUITE_P(Seeds, PartPairProperty, ::testing::Values(11, 12, 13, 14));
#else
INSTANTIATE_TEST_SUITE_P(Seeds, PartPairProperty, strake::test::seeds<std::uint64_t>(2));
#endif

}  // namespace
}  // namespace strake::geometry
