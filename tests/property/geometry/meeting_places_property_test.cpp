// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <vector>

#include "strake/core/disjoint_sets.hpp"
#include "strake/geometry/meeting_places.hpp"
#include "support/lattice_solids.hpp"
#include "support/part_builder.hpp"
#include "support/rounds.hpp"

namespace strake::geometry {
namespace {

using testing::IndexedMesh;
using testing::mapped;
using testing::Subject;

constexpr int kRounds = test::rounds(200, 20000);
/// Where all near triangles are listed.
constexpr int kListedRounds = test::rounds(60, 4000);

/// Cells of side 1 in a cube of kSize cells.
constexpr int kSize = 8;
using Cells = std::set<Vec3i>;

/// Grid units per cell.
constexpr std::int32_t kCell = 6000;

/// The skin of a set of cubes of the given side, each face two triangles.
IndexedMesh skin_of(const Cells& cells, int side) {
  IndexedMesh mesh;
  for (const Vec3i& c : cells)
    for (int axis = 0; axis < 3; ++axis)
      for (const int way : {-1, 1}) {
        Vec3i beside = c;
        beside[axis] += way * side;
        if (cells.contains(beside)) continue;
        Vec3i p = c, u, v;
        if (way > 0) p[axis] += side;
        u[(axis + 1) % 3] = side * kCell;
        v[(axis + 2) % 3] = side * kCell;
        if (way < 0) std::swap(u, v);
        mesh.append(testing::quad_mesh(p * kCell, u, v));
      }
  return mesh;
}

/// A winding row of cubes of side 1: meets others here and there.
Cells worm(std::mt19937_64& rng, int length) {
  Vec3i c{static_cast<std::int32_t>(rng() % kSize), static_cast<std::int32_t>(rng() % kSize),
          static_cast<std::int32_t>(rng() % kSize)};
  Cells cells{c};
  while (length > 0) {
    const int axis = static_cast<int>(rng() % 3);
    const std::int32_t way = rng() % 2 == 0 ? 1 : -1;
    for (auto steps = 1 + rng() % 6; steps > 0 && length > 0; --steps, --length) {
      if (c[axis] + way < 0 || c[axis] + way >= kSize) break;
      c[axis] += way;
      cells.insert(c);
    }
    --length;
  }
  return cells;
}

/// Some cubes of the given side that hang together by faces.
Cells grown(std::mt19937_64& rng, int side, int most) {
  const int steps = kSize / side;
  const auto random_step = [&] {
    return side * static_cast<std::int32_t>(rng() % static_cast<std::uint64_t>(steps));
  };
  Cells cells{{random_step(), random_step(), random_step()}};
  for (int i = 1; i < most; ++i) {
    auto it = cells.begin();
    std::advance(it, static_cast<long>(rng() % cells.size()));
    Vec3i c = *it;
    c[static_cast<int>(rng() % 3)] += rng() % 2 == 0 ? side : -side;
    if (std::ranges::all_of(std::array{c.x, c.y, c.z},
                            [](std::int32_t x) { return x >= 0 && x < kSize; }))
      cells.insert(c);
  }
  return cells;
}

/// A square tube along an axis, somewhere about a block of the given side.
Cells tube(std::mt19937_64& rng, int block) {
  Cells cells;
  const auto below = [&](int n) {
    return static_cast<std::int32_t>(rng() % static_cast<std::uint64_t>(n));
  };
  const int axis = below(3);
  const std::int32_t from = below(block) - 2, to = from + 1 + below(block + 3);
  const std::int32_t x = below(block) - 1, y = below(block) - 1;
  for (std::int32_t i = 0; i < 3; ++i)
    for (std::int32_t j = 0; j < 3; ++j)
      for (std::int32_t k = from; k < to; ++k) {
        if (i == 1 && j == 1) continue;
        Vec3i c;
        c[axis] = k;
        c[(axis + 1) % 3] = x + i;
        c[(axis + 2) % 3] = y + j;
        cells.insert(c);
      }
  return cells;
}

Cells refined(const Cells& cells, int side) {
  Cells fine;
  for (const Vec3i& c : cells)
    for (std::int32_t i = 0; i < side; ++i)
      for (std::int32_t j = 0; j < side; ++j)
        for (std::int32_t k = 0; k < side; ++k) fine.insert(c + Vec3i{i, j, k});
  return fine;
}

/// Corners, edges, faces and cells of the closed body, in half cells.
std::set<Vec3i> closure(const Cells& cells) {
  std::set<Vec3i> all;
  for (const Vec3i& c : cells)
    for (std::int32_t i = 0; i <= 2; ++i)
      for (std::int32_t j = 0; j <= 2; ++j)
        for (std::int32_t k = 0; k <= 2; ++k) all.insert(c * 2 + Vec3i{i, j, k});
  return all;
}

/// Components of what two closed bodies of cells have in common: pieces of the lattice that lie in
/// both, joined with the pieces in their rims.
std::size_t common_components(const Cells& a, const Cells& b) {
  const std::set<Vec3i> in_a = closure(a), in_b = closure(b);
  std::map<Vec3i, std::uint32_t> number;
  for (const Vec3i& p : in_a)
    if (in_b.contains(p)) number.emplace(p, static_cast<std::uint32_t>(number.size()));
  DisjointSets sets(number.size());
  for (const auto& [p, n] : number)
    for (int axis = 0; axis < 3; ++axis) {
      if (p[axis] % 2 == 0) continue;  // a piece is wide along its odd axes
      for (const std::int32_t way : {-1, 1}) {
        Vec3i rim = p;
        rim[axis] += way;
        sets.join(n, number.at(rim));
      }
    }
  std::set<std::uint32_t> roots;
  for (const auto& [p, n] : number) roots.insert(sets.root(n));
  return roots.size();
}

std::size_t count(const IndexedMesh& a, const IndexedMesh& b, const Vec3l& at) {
  const Subject x(a, at), y(b, at);
  PairWork work;
  const MeetingResult m = meet(x.treed(), y.treed(), work);
  if (m.meeting == Meeting::apart) return 0;
  const bool interiors = m.meeting != Meeting::touching;
  const auto places =
      meeting_places(x.treed(), y.treed(), {.reach = 0, .interiors_meet = interiors}, work);
  EXPECT_TRUE(places.has_value());
  if (!places) return 0;
  for (const MeetingPlace& p : *places) EXPECT_EQ(p.nearest.distance, 0);
  return std::max<std::size_t>(places->size(), 1);
}

class MeetingPlacesProperty : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  std::mt19937_64 rng{GetParam()};
};

TEST_P(MeetingPlacesProperty, AsTheCellsOfALatticeHaveIt) {
  int one = 0, two = 0, more = 0;
  for (int round = 0; round < kRounds; ++round) {
    const auto kind = rng() % 5;
    // Of the largest cube a tube may pass through the middle of a triangle.
    const int side = kind == 0 ? 12 : kind < 3 ? 4 : 1;
    const Cells coarse = kind == 0                     ? Cells{{0, 0, 0}}
                         : side == 1 && rng() % 2 == 0 ? worm(rng, 60)
                                                       : grown(rng, side, side == 1 ? 40 : 5);
    const Cells b = kind == 0   ? tube(rng, 12)
                    : kind == 1 ? grown(rng, 1, 1 + static_cast<int>(rng() % 60))
                                : worm(rng, 40);
    const IndexedMesh mesh_a = skin_of(coarse, side), mesh_b = skin_of(b, 1);
    // Two skins of one body are not joined by material alone.
    if (testing::build_part(mesh_a).shell_count != 1 ||
        testing::build_part(mesh_b).shell_count != 1)
      continue;
    const std::size_t truth = common_components(refined(coarse, side), b);
    ++(truth <= 1 ? one : truth == 2 ? two : more);
    const Vec3l at{std::int64_t{1} << 44, -12345, static_cast<std::int64_t>(rng() % 1000)};
    const auto turn = testing::axis_symmetry(static_cast<int>(rng() % 48));
    const IndexedMesh turned_a = mapped(mesh_a, turn), turned_b = mapped(mesh_b, turn);
    ASSERT_EQ(count(turned_a, turned_b, at), truth) << "round " << round;
    ASSERT_EQ(count(testing::shuffled(turned_b, rng), testing::shuffled(turned_a, rng), {}), truth)
        << "round " << round;
    ASSERT_EQ(count(testing::subdivided(turned_a), turned_b, {}), truth) << "round " << round;
  }
  EXPECT_GT(one, kRounds / 10);
  EXPECT_GT(two, kRounds / 50);
  EXPECT_GT(more, 0);
}

/// Places by joining every two near triangles, which asking for all about a single place does.
std::optional<std::vector<MeetingPlace>> asked(const Subject& x, const Subject& y, double reach,
                                               OnePlace one) {
  PairWork work;
  return meeting_places(x.treed(), y.treed(), {.reach = reach, .one = one}, work);
}

TEST_P(MeetingPlacesProperty, TheShortWayToASinglePlaceCountsAsTheLongOneDoes) {
  int one = 0, more = 0;
  for (int round = 0; round < kListedRounds; ++round) {
    const auto form = [&] {
      const auto kind = rng() % 4;
      const Cells cells = kind == 0   ? tube(rng, 6)
                          : kind == 1 ? grown(rng, 1, 40)
                                      : worm(rng, 30 + static_cast<int>(rng() % 40));
      const IndexedMesh mesh = skin_of(cells, 1);
      return rng() % 2 == 0 ? mesh : testing::subdivided(mesh);
    };
    const auto step = [&] { return static_cast<std::int64_t>(rng() % (9 * kCell)); };
    // One draw after the other: arguments have no order, and compilers differ.
    const IndexedMesh form_x = form(), form_y = form();
    const Vec3l at{step(), step(), step()};
    const Subject x(form_x), y(form_y, at);
    // From a touch to more than all that is there.
    const int widest = rng() % 4 == 0 ? 12 : 2;
    const auto reach = static_cast<double>(rng() % static_cast<unsigned>(kCell * widest));
    const auto full = asked(x, y, reach, OnePlace::described);
    const auto counted = asked(x, y, reach, OnePlace::counted);
    const auto boxed = asked(x, y, reach, OnePlace::boxed);
    ASSERT_TRUE(full && counted && boxed);
    ASSERT_EQ(counted->size(), full->size()) << "round " << round;
    ASSERT_EQ(boxed->size(), full->size()) << "round " << round;
    for (std::size_t n = 0; n < full->size(); ++n) {
      ASSERT_EQ((*boxed)[n].extent.lo, (*full)[n].extent.lo) << "round " << round;
      ASSERT_EQ((*boxed)[n].extent.hi, (*full)[n].extent.hi) << "round " << round;
      ASSERT_LE((*full)[n].least, (*full)[n].nearest.distance);
    }
    one += full->size() == 1 ? 1 : 0;
    more += full->size() > 1 ? 1 : 0;
  }
  EXPECT_GT(one, kListedRounds / 10);
  EXPECT_GT(more, 0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, MeetingPlacesProperty, ::testing::Values(1, 2, 3));

}  // namespace
}  // namespace strake::geometry
