// SPDX-License-Identifier: Apache-2.0
// Pieces that the precision of the sources cannot tell from nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "strake/hlr/hlr.hpp"
#include "support/draw.hpp"
#include "support/lattice_scene.hpp"
#include "support/scene_builder.hpp"

namespace strake {
namespace {

using geometry::Vec3d;
using geometry::Vec3i;
using geometry::Vec3l;
using hlr::Fate;
using hlr::State;

constexpr double kLongest = 6;  // twice the contact distance of what says nothing of its precision

hlr::Drawing drawn_along(const test::SceneBuilder& scene, const Vec3l& direction,
                         const hlr::Options& options = {}) {
  auto drawing = hlr::draw(scene.scene(), {}, {.direction = direction, .limits = {}}, options, {});
  EXPECT_TRUE(drawing.has_value());
  return drawing ? *drawing : hlr::Drawing{};
}

double on_paper(const hlr::EdgePiece& piece, const Vec3l& direction) {
  const Vec3d d = direction.as<double>();
  const Vec3d off = cross((piece.b - piece.a).as<double>(), d);
  return std::sqrt(dot(off, off) / dot(d, d));
}

int specks(const hlr::Drawing& drawing, const Vec3l& direction) {
  int count = 0;
  for (const hlr::EdgePiece& p : drawing.pieces)
    if (p.state != State::projecting && p.state != State::clipped &&
        on_paper(p, direction) <= kLongest)
      ++count;
  return count;
}

test::HandPart turned_box(const Vec3d& at, double size, const geometry::Mat3d& turn) {
  test::HandPart part = test::hand_box({0, 0, 0}, {1, 1, 1});
  for (Vec3i& v : part.vertices) {
    const Vec3d p = turn * (at + v.as<double>() * size);
    for (int k = 0; k < 3; ++k) v[k] = static_cast<std::int32_t>(std::lround(p[k]));
  }
  return part;
}

/// A stair of flush cubes, each an object.
test::SceneBuilder stair(double size, const geometry::Mat3d& turn) {
  test::SceneBuilder scene;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 3 - x; ++z)
        scene.object({{.parts = {turned_box(Vec3d{x * size, y * size, z * size}, size, turn)},
                       .origin = {}}});
  return scene;
}

TEST(Specks, FlushCubesHaveWholeEdgesHoweverTheyStand) {
  constexpr std::uint64_t kSeed = 2;
  test::Draw random(kSeed);
  int exact = 0;
  for (const double size : {400.0, 100000.0, 2500000.0})
    for (int turn = 0; turn < 6; ++turn) {
      const geometry::Mat3d how = turn == 0 ? geometry::Mat3d{} : random.rotation();
      const test::SceneBuilder scene = stair(size, how);
      for (const Vec3l& direction : {Vec3l{1, -1, 1}, {3, -2, 5}}) {
        const hlr::Drawing drawing = drawn_along(scene, direction);
        EXPECT_EQ(specks(drawing, direction), 0) << size << ", turn " << turn;
        EXPECT_GT(drawing.counters.specks, 0U) << size << ", turn " << turn;
        exact += specks(drawn_along(scene, direction, {.keep_specks = true}), direction);
      }
    }
  EXPECT_GT(exact, 100);
}

TEST(Specks, EdgesFollowEachOtherWithoutAGap) {
  const test::SceneBuilder scene = stair(100000, {});
  const auto pieces = drawn_along(scene, {1, -1, 1}).pieces;
  for (std::size_t i = 1; i < pieces.size(); ++i)
    if (pieces[i].object == pieces[i - 1].object && pieces[i].edge == pieces[i - 1].edge) {
      EXPECT_EQ(pieces[i].a, pieces[i - 1].b);
      EXPECT_NE(pieces[i].state, pieces[i - 1].state);
    }
}

TEST(Specks, AnObjectOfNothingElseIsNotDrawn) {
  for (const std::int32_t size : {2, 3, 30}) {
    test::SceneBuilder scene;
    scene.object({{.parts = {test::hand_box({0, 0, 0}, {50000, 50000, 50000})}, .origin = {}}});
    scene.object(
        {{.parts = {test::hand_box({90000, 0, 0}, {90000 + size, size, size})}, .origin = {}}});
    const hlr::Drawing drawing = drawn_along(scene, {1, -1, 1});
    EXPECT_EQ(drawing.account.fates[0], Fate::drawn);
    EXPECT_EQ(drawing.account.fates[1] == Fate::drawn, size == 30) << size;
    const hlr::Drawing exact = drawn_along(scene, {1, -1, 1}, {.keep_specks = true});
    EXPECT_EQ(exact.account.fates[1], Fate::drawn);
  }
}

TEST(Specks, ChordsOfAFineRimStay) {
  // Chords of 2 to 4 units: each a speck, all of them a circle.
  for (const double radius : {20.0, 30.0}) {
    test::HandPart disc;
    constexpr std::uint32_t kSides = 48;
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const double turn = 2 * std::acos(-1.0) * i / kSides;
      disc.vertices.push_back({static_cast<std::int32_t>(std::lround(radius * std::cos(turn))),
                               static_cast<std::int32_t>(std::lround(radius * std::sin(turn))), 0});
    }
    for (std::uint32_t i = 1; i + 1 < kSides; ++i) {
      disc.triangles.push_back({0, i, i + 1});
      disc.faces.push_back(0);
    }
    test::SceneBuilder scene;
    scene.object({{.parts = {disc}, .origin = {}}});
    const hlr::Drawing drawing = drawn_along(scene, {0, 0, 1});
    EXPECT_EQ(drawing.counters.specks, 0U);
    EXPECT_EQ(drawing.pieces.size(), kSides);
    for (const hlr::EdgePiece& p : drawing.pieces) EXPECT_EQ(p.state, State::visible);
  }
}

TEST(Specks, SolversAgreeAndHiddenPiecesDecideNothing) {
  const hlr::View view{.direction = {1, -1, 1}, .limits = {}};
  std::uint64_t specks = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const test::SceneBuilder scene = test::lattice_scene(seed, {.unit = 6});
    hlr::Options options{.contact_distance_mm = 0.003};
    const hlr::Drawing all = drawn_along(scene, view.direction, options);
    specks += all.counters.specks;
    for (const hlr::Solver solver : {hlr::Solver::brute_force, hlr::Solver::push}) {
      options.solver = solver;
      const hlr::Drawing other = drawn_along(scene, view.direction, options);
      ASSERT_EQ(other.pieces.size(), all.pieces.size()) << seed;
      ASSERT_EQ(other.counters.specks, all.counters.specks) << seed;
      for (std::size_t i = 0; i < all.pieces.size(); ++i) {
        ASSERT_EQ(other.pieces[i].state, all.pieces[i].state) << seed;
        ASSERT_EQ(other.pieces[i].a, all.pieces[i].a) << seed;
        ASSERT_EQ(other.pieces[i].b, all.pieces[i].b) << seed;
      }
    }
    options = {.contact_distance_mm = 0.003, .hidden = false};
    const hlr::Drawing visible_only = drawn_along(scene, view.direction, options);
    std::size_t next = 0;
    for (const hlr::EdgePiece& p : all.pieces) {
      if (p.state != State::visible) continue;
      while (next < visible_only.pieces.size() && visible_only.pieces[next].state != State::visible)
        ++next;
      ASSERT_LT(next, visible_only.pieces.size()) << seed;
      ASSERT_EQ(visible_only.pieces[next].a, p.a) << seed;
      ASSERT_EQ(visible_only.pieces[next].b, p.b) << seed;
      ++next;
    }
    ASSERT_EQ(visible_only.account.fates, all.account.fates) << seed;
  }
  EXPECT_GT(specks, 100U);
}

}  // namespace
}  // namespace strake
