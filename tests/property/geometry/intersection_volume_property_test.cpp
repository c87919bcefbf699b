// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include "geometry/intersection_volume/intersection_volume.hpp"
#include "support/lattice_solids.hpp"
#include "support/rational_oracle.hpp"
#include "support/rounds.hpp"

namespace strake::geometry {
namespace {

using strake::testing::axis_symmetry;
using strake::testing::box_mesh;
using strake::testing::common_volume6;
using strake::testing::IndexedMesh;
using strake::testing::LatticeMap;
using strake::testing::LatticePair;
using strake::testing::LatticeSolid;
using strake::testing::mapped;
using strake::testing::random_pair;
using strake::testing::Subject;

constexpr int kRounds = test::rounds(60, 4000);

constexpr std::uint64_t kPlenty = 1'000'000;

IntersectionVolume volume_of(const Subject& a, const Subject& b) {
  return intersection_volume(a.treed(), b.treed(), kPlenty).value();
}

LatticeMap scaling(std::int32_t factor) {
  LatticeMap m;
  for (Vec3i& row : m.row) row = row * factor;
  return m;
}

/// The truth lies in the bracket, and the bracket is narrow.
void expect_volume(const mpq_class& truth, const IntersectionVolume& got, double size) {
  EXPECT_LE(mpq_class(got.lower), truth);
  EXPECT_GE(mpq_class(got.upper), truth);
  EXPECT_LE(got.lower, got.volume);
  EXPECT_GE(got.upper, got.volume);
  EXPECT_LT(got.upper - got.lower, 1e-9 * size * size * size);
}

class IntersectionVolumeProperty : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  std::mt19937_64 rng{GetParam()};
};

TEST_P(IntersectionVolumeProperty, AsExactRationalsHaveIt) {
  for (int round = 0; round < kRounds; ++round) {
    const LatticePair pair = random_pair(rng);
    const mpq_class truth = common_volume6(pair.a.pieces, pair.b.pieces) / 6;
    for (const std::int32_t factor : {1, 12345}) {
      SCOPED_TRACE(pair.recipe + " times " + std::to_string(factor));
      const Subject a(mapped(pair.a.mesh, scaling(factor))),
          b(mapped(pair.b.mesh, scaling(factor)));
      const mpq_class f = factor;
      expect_volume(truth * f * f * f, volume_of(a, b), 64.0 * factor);
    }
  }
}

TEST_P(IntersectionVolumeProperty, TurnedAndSwappedBracketsOverlap) {
  for (int round = 0; round < kRounds / 4; ++round) {
    const LatticePair pair = random_pair(rng);
    SCOPED_TRACE(pair.recipe);
    const mpq_class truth = common_volume6(pair.a.pieces, pair.b.pieces) / 6;
    for (const int symmetry : {0, 7, 13, 22, 31, 40, 47}) {
      const LatticeMap map = axis_symmetry(symmetry);
      const Subject a(mapped(pair.a.mesh, map)), b(mapped(pair.b.mesh, map));
      expect_volume(truth, volume_of(a, b), 64);
      expect_volume(truth, volume_of(b, a), 64);
    }
  }
}

TEST_P(IntersectionVolumeProperty, PlaceShowsInNoBit) {
  for (int round = 0; round < kRounds / 4; ++round) {
    const LatticePair pair = random_pair(rng);
    const Vec3l far{40'000'000'000, -77'777'777'777, 123'456'789};
    const Subject a(pair.a.mesh), b(pair.b.mesh), a_far(pair.a.mesh, far), b_far(pair.b.mesh, far);
    EXPECT_EQ(volume_of(a, b).volume, volume_of(a_far, b_far).volume);
    EXPECT_EQ(volume_of(a, b).upper, volume_of(a_far, b_far).upper);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, IntersectionVolumeProperty, strake::test::seeds<std::uint64_t>(4));

TEST(IntersectionVolume, WallsNestsAndCopies) {
  const Subject wall(box_mesh({0, 0, 0}, {200'000, 5'000'000, 3'000'000}));
  const Subject other(box_mesh({150'000, 0, 0}, {350'000, 5'000'000, 3'000'000}));
  const Subject inner(box_mesh({50'000, 1000, 1000}, {60'000, 2000, 2000}));
  const Subject beside(box_mesh({200'000, 0, 0}, {300'000, 5'000'000, 3'000'000}));
  EXPECT_DOUBLE_EQ(volume_of(wall, other).volume, 50e3 * 5e6 * 3e6);
  EXPECT_DOUBLE_EQ(volume_of(wall, wall).volume, 200e3 * 5e6 * 3e6);
  EXPECT_NEAR(volume_of(wall, inner).volume, 10e9, 1e-3);
  EXPECT_NEAR(volume_of(inner, wall).volume, 10e9, 1e-3);
  EXPECT_EQ(volume_of(wall, beside).volume, 0);
  EXPECT_EQ(volume_of(wall, beside).upper, 0);
}

TEST(IntersectionVolume, ThinAndFarReachingBodies) {
  // A rod of 2 mm that crosses a block at a slant, 100 m long: the common part is a millionth of
  // it.
  IndexedMesh rod;
  const Vec3i u{2000, 0, 0}, v{0, 2000, 0}, along{70'000'000, 10'000'000, 70'000'000};
  const std::array<Vec3i, 4> ring{Vec3i{}, u, u + v, v};
  for (const Vec3i& p : ring) rod.vertices.push_back(p - along);
  for (const Vec3i& p : ring) rod.vertices.push_back(p + along);
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t j = (i + 1) % 4;
    rod.triangles.push_back({i, j, j + 4});
    rod.triangles.push_back({i, j + 4, i + 4});
  }
  for (const Triangle& t :
       {Triangle{0, 2, 1}, Triangle{0, 3, 2}, Triangle{4, 5, 6}, Triangle{4, 6, 7}})
    rod.triangles.push_back(t);
  const Subject a(rod),
      block(box_mesh({-1'000'000, -1'000'000, -50'000}, {1'000'000, 1'000'000, 50'000}));
  const IntersectionVolume common = volume_of(a, block);
  EXPECT_NEAR(common.volume, 2000.0 * 2000.0 * 100'000.0, 400.0);
  EXPECT_LT(common.upper - common.lower, 2e-3 * common.volume);
}

TEST(IntersectionVolume, GivesUpRatherThanGuesses) {
  const Subject a(box_mesh({0, 0, 0}, {10, 10, 10})), b(box_mesh({5, 5, 5}, {20, 20, 20}));
  EXPECT_FALSE(intersection_volume(a.treed(), b.treed(), 10).has_value());
  EXPECT_TRUE(intersection_volume(a.treed(), b.treed(), 200).has_value());
}

TEST(IntersectionVolume, SheetsHaveNone) {
  const Subject sheet(strake::testing::quad_mesh({0, 0, 5}, {10, 0, 0}, {0, 10, 0}));
  const Subject box(box_mesh({0, 0, 0}, {10, 10, 10}));
  EXPECT_FALSE(intersection_volume(sheet.treed(), box.treed(), kPlenty).has_value());
}

TEST(IntersectionVolume, WorkFollowsTheSkins) {
  const auto fine = [](std::int32_t half) {
    IndexedMesh mesh = box_mesh({-half, -half, -half}, {half, half, half});
    for (int i = 0; i < 4; ++i) mesh = strake::testing::subdivided(mesh);
    return mesh;
  };
  const Subject outer(fine(160'000)), inner(fine(96'000));
  ASSERT_EQ(outer.part.triangles.size(), 3072U);
  const IntersectionVolume common = volume_of(outer, inner);
  EXPECT_DOUBLE_EQ(common.volume, std::pow(192'000.0, 3));
  EXPECT_LT(common.triangle_pairs, 10 * 3072U);
}

}  // namespace
}  // namespace strake::geometry
