// SPDX-License-Identifier: Apache-2.0
// Walks on a square lattice, drawn out to sheets: whether these cross is a question of the plane.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "geometry/sheet_separation/robust_crossings.hpp"
#include "support/lattice_solids.hpp"
#include "support/rounds.hpp"

namespace strake::geometry {
namespace {

using testing::IndexedMesh;
using testing::Subject;

constexpr int kRounds = test::rounds(2000, 100000);
constexpr int kSide = 4;

struct Cell {
  int y = 0, z = 0;
  friend bool operator==(const Cell&, const Cell&) = default;
};
using Walk = std::vector<Cell>;

constexpr std::array<Cell, 4> kSteps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};  // counter-clockwise

int direction(const Cell& from, const Cell& to) {
  for (int d = 0; d < 4; ++d) {
    const Cell& s = kSteps[static_cast<std::size_t>(d)];
    if (from.y + s.y == to.y && from.z + s.z == to.z) return d;
  }
  return -1;
}

/// Never comes back to a place.
Walk random_walk(std::mt19937_64& rng) {
  const auto any = [&](int n) { return static_cast<int>(rng() % static_cast<unsigned>(n)); };
  Walk walk{{any(kSide), any(kSide)}};
  const int length = 6 + any(12);
  for (int i = 0; i < length; ++i) {
    const Cell& s = kSteps[static_cast<std::size_t>(any(4))];
    const Cell to{walk.back().y + s.y, walk.back().z + s.z};
    const bool room = to.y >= 0 && to.z >= 0 && to.y < kSide && to.z < kSide;
    if (room && std::find(walk.begin(), walk.end(), to) == walk.end()) walk.push_back(to);
  }
  return walk;
}

std::size_t place_in(const Walk& walk, const Cell& c) {
  return static_cast<std::size_t>(std::find(walk.begin(), walk.end(), c) - walk.begin());
}

/// What leaves a place of a walk other than towards `without`; -1 where the walk ends.
int way_on(const Walk& walk, std::size_t at, int without) {
  if (at > 0 && direction(walk[at], walk[at - 1]) != without)
    return direction(walk[at], walk[at - 1]);
  if (at + 1 < walk.size() && direction(walk[at], walk[at + 1]) != without)
    return direction(walk[at], walk[at + 1]);
  return -1;
}

/// Whether p comes before q, counter-clockwise from `back`, at a place where they part:
/// 1, or 0; -1 where one of them ends.
int before(const Walk& p, const Walk& q, const Cell& at, int back) {
  const int dp = way_on(p, place_in(p, at), back), dq = way_on(q, place_in(q, at), back);
  if (dp < 0 || dq < 0) return -1;
  return (dp - back + 4) % 4 < (dq - back + 4) % 4 ? 1 : 0;
}

bool has_step(const Walk& walk, const Cell& from, const Cell& to) {
  const std::size_t i = place_in(walk, from);
  return i < walk.size() &&
         ((i > 0 && walk[i - 1] == to) || (i + 1 < walk.size() && walk[i + 1] == to));
}

bool cross(const Walk& p, const Walk& q) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (place_in(q, p[i]) == q.size()) continue;
    const bool comes = i > 0 && has_step(q, p[i - 1], p[i]);
    std::size_t end = i;
    while (end + 1 < p.size() && has_step(q, p[end], p[end + 1])) ++end;
    if (comes) continue;
    if (end == i) {  // they meet in this place alone
      if (i == 0 || i + 1 == p.size()) continue;
      const int dp = direction(p[i], p[i - 1]);
      if (direction(p[i], p[i + 1]) != (dp + 2) % 4) continue;
      const std::size_t k = place_in(q, p[i]);
      if (k > 0 && k + 1 < q.size()) return true;
      continue;
    }
    const int first = before(p, q, p[i], direction(p[i], p[i + 1]));
    const int last = before(p, q, p[end], direction(p[end], p[end - 1]));
    if (first >= 0 && first == last) return true;
    i = end;
  }
  return false;
}

/// Drawn out from x = lo to x = hi, each strip with any side up.
IndexedMesh drawn_out(const Walk& walk, int lo, int hi, std::mt19937_64& rng) {
  IndexedMesh mesh;
  for (std::size_t i = 0; i + 1 < walk.size(); ++i) {
    const Vec3i from{lo, walk[i].y * 6, walk[i].z * 6};
    const Vec3i along{0, (walk[i + 1].y - walk[i].y) * 6, (walk[i + 1].z - walk[i].z) * 6};
    const IndexedMesh strip = testing::quad_mesh(from, {hi - lo, 0, 0}, along);
    mesh.append(rng() % 2 == 0 ? strip : strip.flipped());
  }
  return mesh;
}

std::string text(const Walk& walk) {
  std::string s;
  for (const Cell& c : walk) s += " (" + std::to_string(c.y) + "," + std::to_string(c.z) + ")";
  return s;
}

class SheetCrossing : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(SheetCrossing, IsThatOfTheWalks) {
  std::mt19937_64 rng{GetParam()};
  int crossing = 0, flush = 0;
  for (int round = 0; round < kRounds; ++round) {
    const Walk p = random_walk(rng), q = random_walk(rng);
    if (p.size() < 2 || q.size() < 2) continue;
    SCOPED_TRACE("seed " + std::to_string(GetParam()) + text(p) + " |" + text(q));
    const bool truth = cross(p, q);
    ASSERT_EQ(cross(q, p), truth);
    const IndexedMesh ma = drawn_out(p, 0, 12, rng), mb = drawn_out(q, -4, 18, rng);
    const testing::LatticeMap turn = testing::axis_symmetry(static_cast<int>(rng() % 48));
    for (const bool fine : {false, true}) {
      const IndexedMesh fa = fine ? testing::subdivided(ma) : ma;
      const Subject a(testing::shuffled(mapped(fa, turn), rng)), b(mapped(mb, turn));
      QueryContext work;
      ASSERT_EQ(meet(a.treed(), b.treed(), work).meeting == Meeting::crossing, truth);
      ASSERT_EQ(meet(b.treed(), a.treed(), work).meeting == Meeting::crossing, truth);
      ASSERT_EQ(find_sheet_intersection(a.treed(), b.treed(), 0, 1000, work).segments.empty(),
                !truth);
    }
    bool along = false;
    for (std::size_t i = 0; i + 1 < p.size(); ++i) along |= has_step(q, p[i], p[i + 1]);
    crossing += truth ? 1 : 0;
    flush += truth && along ? 1 : 0;
  }
  EXPECT_GT(crossing, kRounds / 50);
  EXPECT_GT(flush, kRounds / 100);
}

INSTANTIATE_TEST_SUITE_P(Seeds, SheetCrossing, strake::test::seeds<std::uint64_t>(2));

}  // namespace
}  // namespace strake::geometry
