// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/bvh/scene_bvh.hpp"
#include "strake/parallel/team.hpp"
#include "support/draw.hpp"

namespace strake::geometry {
namespace {

using test::Draw;

/// Boxes in frames, with boxes along the coordinate axes round them.
struct Scene {
  BoxesInFrames framed;
  std::vector<BoxItem> items;
};

Vec3d from_frame(const Mat3d& frame, const Vec3d& p) {
  return frame.row[0] * p.x + frame.row[1] * p.y + frame.row[2] * p.z;
}

Vec3d random_point(Draw& draw, const Box3l& box) {
  const Vec3d lo = box.lo.as<double>(), hi = box.hi.as<double>();
  return {draw.between(lo.x, hi.x), draw.between(lo.y, hi.y), draw.between(lo.z, hi.z)};
}

void add(Scene& scene, std::uint32_t frame, const Vec3d& middle, const Vec3d& half) {
  const Mat3d& axes = scene.framed.frames[frame];
  const Vec3d at = axes * middle;
  Box3l box, around = empty_box<std::int64_t>();
  for (int k = 0; k < 3; ++k) {
    box.lo[k] = static_cast<std::int64_t>(std::floor(at[k] - half[k])) - 2;
    box.hi[k] = static_cast<std::int64_t>(std::ceil(at[k] + half[k])) + 2;
  }
  for (int corner = 0; corner < 8; ++corner) {
    Vec3d p;
    for (int k = 0; k < 3; ++k)
      p[k] = static_cast<double>(((corner >> k) & 1) != 0 ? box.hi[k] : box.lo[k]);
    p = from_frame(axes, p);
    around.include(Vec3l{std::llround(p.x), std::llround(p.y), std::llround(p.z)});
  }
  scene.framed.frame.push_back(frame);
  scene.framed.box.push_back(box);
  scene.items.push_back({around.inflated(2).moved(scene.framed.origin),
                         static_cast<std::uint32_t>(scene.items.size()), kSetA | kSetB});
}

/// Long thin ones and others, in up to five frames.
Scene random_scene(Draw& draw, std::size_t count) {
  Scene scene;
  scene.framed.origin = {draw.whole(-1'000'000, 1'000'000), 5'000'000'000, -77};
  scene.framed.frames.resize(1 + draw.below(5));
  for (std::size_t f = 1; f < scene.framed.frames.size(); ++f)
    scene.framed.frames[f] = draw.rotation();
  for (std::size_t i = 0; i < count; ++i) {
    const double spread = 100'000;
    const Vec3d middle{draw.between(-spread, spread), draw.between(-spread, spread),
                       draw.between(-spread, spread)};
    const bool thin = !draw.one_in(3);
    const Vec3d half{thin ? 80'000 : draw.between(0, 9000), draw.between(0, 900),
                     draw.between(0, thin ? 900 : 9000)};
    add(scene, static_cast<std::uint32_t>(draw.below(scene.framed.frames.size())), middle, half);
  }
  return scene;
}

TEST(BoxesInFrames, TheTreesGiveWhatTheLoopGives) {
  std::size_t found = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Draw draw(seed);
    Scene scene = random_scene(draw, 600);
    for (BoxItem& item : scene.items) {
      item.sets = static_cast<std::uint8_t>(draw.below(4));
      item.owner /= 2;
    }
    const auto all = overlapping_box_pairs_brute_force(scene.items, scene.framed, {});
    ASSERT_TRUE(all);
    found += all->size();
    for (const unsigned threads : {1U, 2U, 5U}) {
      parallel::Team team(threads);
      const auto pairs =
          overlapping_box_pairs(scene.items, scene.framed, {.team = &team, .stop = {}});
      ASSERT_TRUE(pairs);
      ASSERT_EQ(*pairs, *all);
    }
    if (!all->empty()) {
      EXPECT_FALSE(overlapping_box_pairs(scene.items, scene.framed, {}, all->size() - 1));
    }
    EXPECT_TRUE(overlapping_box_pairs(scene.items, scene.framed, {}, all->size()));
  }
  EXPECT_GT(found, 200U);
}

TEST(BoxesInFrames, NoneThatShareAPointAreParted) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Draw draw(seed);
    Scene scene = random_scene(draw, 150);
    std::vector<IndexPair> touching;
    for (std::uint32_t i = 0; i < 150; ++i) {
      const Vec3d p = from_frame(scene.framed.frames[scene.framed.frame[i]],
                                 random_point(draw, scene.framed.box[i]));
      const Vec3d half{draw.between(0, 50'000), draw.between(0, 500), draw.between(0, 500)};
      const auto frame = static_cast<std::uint32_t>(draw.below(scene.framed.frames.size()));
      // Somewhere in the new box, up to its very corner.
      const Vec3d off{half.x * draw.between(-1, 1), half.y * (draw.one_in(2) ? 1 : -1),
                      half.z * draw.between(-1, 1)};
      touching.push_back({i, static_cast<std::uint32_t>(scene.items.size())});
      add(scene, frame, p + from_frame(scene.framed.frames[frame], off), half);
    }
    const auto pairs = overlapping_box_pairs(scene.items, scene.framed, {});
    ASSERT_TRUE(pairs);
    for (const IndexPair& pair : touching) ASSERT_TRUE(std::ranges::binary_search(*pairs, pair));
  }
}

TEST(BoxesInFrames, PartAcrossFacesAndAcrossEdges) {
  constexpr double kLong = 50'000, kThin = 100;
  Scene scene;
  scene.framed.frames.resize(3);
  const double s = std::sqrt(0.5);
  scene.framed.frames[1].row = {Vec3d{s, s, 0}, Vec3d{-s, s, 0}, Vec3d{0, 0, 1}};
  scene.framed.frames[2].row = {Vec3d{s, 0, s}, Vec3d{0, 1, 0}, Vec3d{-s, 0, s}};
  add(scene, 1, {0, 0, 0}, {kLong, kThin, kThin});
  add(scene, 1, {-300, 300, 0}, {kLong, kThin, kThin});  // beside the first
  add(scene, 2, {0, 0, 0}, {kLong, kThin, kThin});       // across the first
  add(scene, 2, {0, 400, 400}, {kLong, kThin, kThin});   // past it, edge by edge
  const auto pairs = overlapping_box_pairs(scene.items, scene.framed, {});
  ASSERT_TRUE(pairs);
  EXPECT_EQ(*pairs, *overlapping_box_pairs_brute_force(scene.items, scene.framed, {}));
  EXPECT_TRUE(std::ranges::binary_search(*pairs, IndexPair{0, 2}));
  EXPECT_FALSE(std::ranges::binary_search(*pairs, IndexPair{0, 1}));
  EXPECT_FALSE(std::ranges::binary_search(*pairs, IndexPair{2, 3}));
}

}  // namespace
}  // namespace strake::geometry
