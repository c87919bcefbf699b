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

#include "core/union_find.hpp"
#include "geometry/contact_regions/contact_regions.hpp"
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
/// Where cells are paired by brute force.
constexpr int kReachRounds = test::rounds(150, 5000);

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
  UnionFind sets(number.size());
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
  QueryContext work;
  const MeetingResult m = meet(x.treed(), y.treed(), work);
  if (m.meeting == Meeting::apart) return 0;
  const bool interiors = m.meeting != Meeting::touching;
  const auto places =
      contact_regions(x.treed(), y.treed(), {.reach = 0, .interiors_meet = interiors}, work);
  EXPECT_TRUE(places.has_value());
  if (!places) return 0;
  for (const ContactRegion& p : *places) EXPECT_EQ(p.nearest.distance, 0);
  return std::max<std::size_t>(places->size(), 1);
}

class ContactRegionsProperty : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  std::mt19937_64 rng{GetParam()};
};

TEST_P(ContactRegionsProperty, AsTheCellsOfALatticeHaveIt) {
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
std::optional<std::vector<ContactRegion>> requested(const Subject& x, const Subject& y,
                                                    double reach, SingleRegionDetail one) {
  QueryContext work;
  return contact_regions(x.treed(), y.treed(), {.reach = reach, .one = one}, work);
}

TEST_P(ContactRegionsProperty, TheShortWayToASinglePlaceCountsAsTheLongOneDoes) {
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
    const auto full = requested(x, y, reach, SingleRegionDetail::described);
    const auto counted = requested(x, y, reach, SingleRegionDetail::counted);
    const auto boxed = requested(x, y, reach, SingleRegionDetail::boxed);
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

/// A cell of a body, or what two of them share, in grid units.
struct Block {
  Vec3l lo, hi;
};

/// A body of cells that are not cubes: plates and bars where they are flat and long.
struct Blocks {
  Cells cells;
  Vec3i size;  ///< of a cell, grid units
  Vec3l at;

  [[nodiscard]] Block block(const Vec3i& cell) const {
    Block b;
    for (int axis = 0; axis < 3; ++axis) {
      b.lo[axis] = at[axis] + std::int64_t{cell[axis]} * size[axis];
      b.hi[axis] = b.lo[axis] + size[axis];
    }
    return b;
  }
  [[nodiscard]] Block shared(const Vec3i& x, const Vec3i& y) const {
    const Block p = block(x), q = block(y);
    Block both;
    for (int axis = 0; axis < 3; ++axis) {
      both.lo[axis] = std::max(p.lo[axis], q.lo[axis]);
      both.hi[axis] = std::min(p.hi[axis], q.hi[axis]);
    }
    return both;
  }
  [[nodiscard]] IndexedMesh skin() const {
    IndexedMesh mesh = skin_of(cells, 1);
    for (Vec3i& v : mesh.vertices)
      for (int axis = 0; axis < 3; ++axis) v[axis] = v[axis] / kCell * size[axis];
    return mesh;
  }
};

double squared_gap(const Block& x, const Block& y) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto gap = static_cast<double>(
        std::max<std::int64_t>({0, x.lo[axis] - y.hi[axis], y.lo[axis] - x.hi[axis]}));
    sum += gap * gap;
  }
  return sum;
}

/// Components of the pairs of points of two bodies that are within reach of each other. Those of
/// two cells are a convex set, and two such sets with a cell in common meet where what the two
/// others share is within reach of it.
std::size_t near_components(const Blocks& a, const Blocks& b, double reach) {
  const auto near = [&](const Block& x, const Block& y) {
    return squared_gap(x, y) <= reach * reach;
  };
  std::map<std::pair<Vec3i, Vec3i>, std::uint32_t> number;
  for (const Vec3i& x : a.cells)
    for (const Vec3i& y : b.cells)
      if (near(a.block(x), b.block(y)))
        number.emplace(std::pair(x, y), static_cast<std::uint32_t>(number.size()));
  UnionFind sets(number.size());
  for (const auto& [cells, n] : number)
    for (std::int32_t i = 0; i < 27; ++i) {
      const Vec3i step{i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
      const auto& [x, y] = cells;
      const auto of_a = number.find({x + step, y}), of_b = number.find({x, y + step});
      if (of_a != number.end() && near(a.shared(x, x + step), b.block(y)))
        sets.join(n, of_a->second);
      if (of_b != number.end() && near(a.block(x), b.shared(y, y + step)))
        sets.join(n, of_b->second);
    }
  std::set<std::uint32_t> roots;
  for (const auto& [cells, n] : number) roots.insert(sets.root(n));
  return roots.size();
}

/// A block of cells of which a smaller one is taken out: a frame, a tube or a hollow block.
Cells with_hole(std::mt19937_64& rng) {
  const auto below = [&](int n) {
    return static_cast<std::int32_t>(rng() % static_cast<std::uint64_t>(n));
  };
  Vec3i size, lo, hi;
  for (int axis = 0; axis < 3; ++axis) {
    size[axis] = 1 + below(kSize);
    lo[axis] = below(size[axis] + 1);
    hi[axis] = lo[axis] + below(size[axis] - lo[axis] + 1);
  }
  Cells cells;
  for (std::int32_t x = 0; x < size.x; ++x)
    for (std::int32_t y = 0; y < size.y; ++y)
      for (std::int32_t z = 0; z < size.z; ++z)
        if (x < lo.x || y < lo.y || z < lo.z || x >= hi.x || y >= hi.y || z >= hi.z)
          cells.insert({x, y, z});
  return cells.empty() ? Cells{{}} : cells;
}

std::size_t count_within(const Subject& x, const Subject& y, double reach) {
  QueryContext work;
  const MeetingResult m = meet(x.treed(), y.treed(), work);
  const bool interiors = m.meeting != Meeting::apart && m.meeting != Meeting::touching;
  const auto places =
      contact_regions(x.treed(), y.treed(), {.reach = reach, .interiors_meet = interiors}, work);
  EXPECT_TRUE(places.has_value());
  if (!places) return 0;
  // Of a body that lies deep in the other no skins are near each other.
  return interiors ? std::max<std::size_t>(places->size(), 1) : places->size();
}

/// Round holes and cavities, of plates and bars, within less and more than they are thick.
TEST_P(ContactRegionsProperty, WithinReachAsTheCellsOfALatticeHaveIt) {
  int one = 0, two = 0, more = 0;
  for (int round = 0; round < kReachRounds; ++round) {
    const auto cells = [&] {
      const auto kind = rng() % 4;
      return kind == 0   ? grown(rng, 1, 30)
             : kind == 1 ? worm(rng, 20 + static_cast<int>(rng() % 30))
                         : with_hole(rng);
    };
    const auto blocks = [&] {
      Blocks b{cells(), {}, {}};
      for (int axis = 0; axis < 3; ++axis) b.size[axis] = 200 << (rng() % 6);
      return b;
    };
    // Some cell of the one comes near some cell of the other.
    const auto some = [&](const Blocks& of) {
      auto it = of.cells.begin();
      std::advance(it, static_cast<long>(rng() % of.cells.size()));
      return of.block(*it);
    };
    const auto reach = static_cast<std::int64_t>(100 + rng() % (500U << (rng() % 5)));
    const Blocks a = blocks();
    Blocks b = blocks();
    const Block of_a = some(a), of_b = some(b);
    for (int axis = 0; axis < 3; ++axis) {
      const bool before = rng() % 2 == 0;
      b.at[axis] = before ? of_a.lo[axis] - of_b.hi[axis] : of_a.hi[axis] - of_b.lo[axis];
      b.at[axis] += static_cast<std::int64_t>(rng() % static_cast<unsigned>(2 * reach)) - reach;
    }
    const auto r = static_cast<double>(reach);
    const std::size_t truth = near_components(a, b, r + 1.0 / 256);
    const Subject x(a.skin(), a.at), y(b.skin(), b.at);
    ASSERT_EQ(count_within(x, y, r), truth) << "round " << round;
    ASSERT_EQ(count_within(y, x, r), truth) << "round " << round;
    ++(truth <= 1 ? one : truth == 2 ? two : more);
  }
  EXPECT_GT(one, kReachRounds / 10);
  EXPECT_GT(two, kReachRounds / 50);
  EXPECT_GT(more, 0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, ContactRegionsProperty, strake::test::seeds<std::uint64_t>(3));

}  // namespace
}  // namespace strake::geometry
