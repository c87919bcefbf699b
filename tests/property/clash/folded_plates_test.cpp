// SPDX-License-Identifier: Apache-2.0
// A cone of flat sides through a sheet or plate that is folded to and fro, so that it passes it
// several times: every place has a depth of its own, by closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "strake/clash/clash.hpp"
#include "support/clash_model.hpp"
#include "support/draw.hpp"
#include "support/rounds.hpp"

namespace strake::clash {
namespace {

using geometry::Mat3d;
using geometry::Placement;
using geometry::TriangleMesh;
using geometry::Vec3d;
using test::ClashModel;
using test::Draw;

/// What snapped corners and a turn move, mm.
constexpr double kSnap = 4e-3;

/// A frustum round z with its ends at 0 and `length`.
struct Cone {
  std::uint32_t sides = 3;
  double bottom = 1, top = 1, length = 1;
  double first_side = 0;  ///< its angle

  /// How far a point of the axis lies from the sides. At a height that is far from the ends no
  /// point is farther from the skin: the sides are alike, and each takes as much as another gives.
  [[nodiscard]] double depth_at(double z) const {
    const double inradius = std::cos(std::numbers::pi / sides);
    const double low = bottom * inradius, high = top * inradius;
    return (low + (high - low) * z / length) * length / std::hypot(length, high - low);
  }

  [[nodiscard]] TriangleMesh mesh() const {
    TriangleMesh m;
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle = first_side + 2 * std::numbers::pi * i / sides;
      const Vec3d out{std::cos(angle), std::sin(angle), 0};
      m.vertices.push_back(out * bottom);
      m.vertices.push_back(out * top + Vec3d{0, 0, length});
    }
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t p = 2 * i, q = 2 * ((i + 1) % sides);
      m.triangles.push_back({p, q, q + 1});
      m.triangles.push_back({p, q + 1, p + 1});
      if (i == 0 || i + 1 == sides) continue;
      m.triangles.push_back({0, q, p});
      m.triangles.push_back({1, p + 1, q + 1});
    }
    return m;
  }
};

/// A strip that runs to and fro across z at some heights; without thickness a sheet.
struct Folded {
  std::vector<double> heights;
  double from_x = -1, to_x = 1, from_y = -1, to_y = 1;
  double thickness = 0;
  std::uint32_t pieces_x = 1, pieces_y = 1;  ///< that each fold is cut into

  /// The strip seen from the side, with what leads from a point to the side above.
  [[nodiscard]] std::vector<std::array<Vec3d, 2>> profile() const {
    std::vector<Vec3d> points;
    for (std::size_t i = 0; i < heights.size(); ++i)
      for (std::uint32_t k = 0; k <= pieces_x; ++k) {
        const double share = static_cast<double>(k) / pieces_x;
        const double there = i % 2 == 0 ? share : 1 - share;
        points.push_back({from_x + (to_x - from_x) * there, 0, heights[i]});
      }
    const auto upward = [&](std::size_t i) {
      const Vec3d way = points[i + 1] - points[i];
      return Vec3d{-way.z, 0, way.x} * (thickness / 2 / std::hypot(way.x, way.z));
    };
    std::vector<std::array<Vec3d, 2>> profile;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::size_t before = i > 0 ? i - 1 : 0, after = std::min(i, points.size() - 2);
      // A straight run, or a right angle with its mitre.
      const Vec3d one = upward(before), other = upward(after);
      const bool straight = dot(one, other) > thickness * thickness / 8;
      profile.push_back({points[i], straight ? one : one + other});
    }
    return profile;
  }

  [[nodiscard]] TriangleMesh mesh() const {
    return thickness > 0 ? plate(profile()) : sheet(profile());
  }

 private:
  static void add_quad(TriangleMesh& m, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                       std::uint32_t d) {
    m.triangles.push_back({a, b, c});
    m.triangles.push_back({a, c, d});
  }

  [[nodiscard]] TriangleMesh sheet(std::span<const std::array<Vec3d, 2>> profile) const {
    TriangleMesh m;
    for (const auto& [p, up] : profile)
      for (std::uint32_t k = 0; k <= pieces_y; ++k)
        m.vertices.push_back({p.x, from_y + (to_y - from_y) * k / pieces_y, p.z});
    for (std::uint32_t i = 0; i + 1 < profile.size(); ++i)
      for (std::uint32_t k = 0; k < pieces_y; ++k) {
        const std::uint32_t a = i * (pieces_y + 1) + k, b = a + pieces_y + 1;
        add_quad(m, a, b, b + 1, a + 1);
      }
    return m;
  }

  /// Four corners for each point of the profile: below and above, before and behind.
  [[nodiscard]] TriangleMesh plate(std::span<const std::array<Vec3d, 2>> profile) const {
    TriangleMesh m;
    for (const auto& [p, up] : profile)
      for (const double y : {from_y, to_y})
        for (const double sign : {-1.0, 1.0}) m.vertices.push_back(p + up * sign + Vec3d{0, y, 0});
    const auto last = static_cast<std::uint32_t>(4 * (profile.size() - 1));
    for (std::uint32_t a = 0; a < last; a += 4) {
      const std::uint32_t b = a + 4;
      add_quad(m, a, a + 2, b + 2, b);
      add_quad(m, a + 1, b + 1, b + 3, a + 3);
      add_quad(m, a, b, b + 1, a + 1);
      add_quad(m, a + 2, a + 3, b + 3, b + 2);
    }
    add_quad(m, 0, 1, 3, 2);
    add_quad(m, last, last + 2, last + 3, last + 1);
    return m;
  }
};

struct Scene {
  Cone cone;
  Folded folded;
  Placement place;
  bool cone_first = false;

  explicit Scene(std::uint64_t seed, bool sheet) {
    Draw draw(seed);
    cone.sides = static_cast<std::uint32_t>(draw.whole(3, 49));
    cone.bottom = draw.between(20, 120);
    cone.top = cone.bottom * draw.between(0.7, 1.4);
    cone.first_side = draw.between(0, 6);
    const double widest = std::max(cone.bottom, cone.top);
    double z = 2 * widest;
    for (std::int32_t i = draw.whole(1, 5); i > 0; --i) {
      folded.heights.push_back(z);
      z += draw.between(60, 200);
    }
    cone.length = z + 2 * widest;
    folded.from_x = -widest - draw.between(20, 300);
    folded.to_x = widest + draw.between(20, 300);
    folded.from_y = -widest - draw.between(20, 300);
    folded.to_y = widest + draw.between(20, 300);
    folded.pieces_x = static_cast<std::uint32_t>(draw.whole(1, 9));
    folded.pieces_y = static_cast<std::uint32_t>(draw.whole(1, 9));
    if (!sheet) folded.thickness = draw.between(2, 12);
    if (!draw.one_in(4)) place.linear = draw.rotation();
    const double x = draw.between(-5000, 5000), y = draw.between(-5000, 5000);
    place.translation = {x, y, draw.between(-5000, 5000)};
    cone_first = draw.one_in(2);
  }

  [[nodiscard]] ClashModel model() const {
    ClashModel m;
    const auto add = [&](const char* id, TriangleMesh mesh) {
      for (Vec3d& v : mesh.vertices) v = place * v;
      m.object(id).body(std::move(mesh));
    };
    if (cone_first) add("cone", cone.mesh());
    add("folded", folded.mesh());
    if (!cone_first) add("cone", cone.mesh());
    return m;
  }

  /// The fold that a point lies in.
  [[nodiscard]] std::size_t fold_of(const Vec3d& p) const {
    const Vec3d from = p - place.translation;
    double z = 0;
    for (int k = 0; k < 3; ++k) z += place.linear.row[static_cast<std::size_t>(k)].z * from[k];
    const auto nearest = std::ranges::min_element(
        folded.heights, {}, [&](double height) { return std::fabs(height - z); });
    return static_cast<std::size_t>(nearest - folded.heights.begin());
  }
  [[nodiscard]] double depth_of(std::size_t fold) const {
    const double z = folded.heights[fold], half = folded.thickness / 2;
    return std::max(cone.depth_at(z - half), cone.depth_at(z + half));
  }

  [[nodiscard]] std::string recipe(std::uint64_t seed) const {
    return "seed " + std::to_string(seed) + ", " + std::to_string(cone.sides) + " sides, radius " +
           std::to_string(cone.bottom) + " to " + std::to_string(cone.top) + ", folds " +
           std::to_string(folded.heights.size()) + " of " + std::to_string(folded.pieces_x) +
           " x " + std::to_string(folded.pieces_y) + ", thickness " +
           std::to_string(folded.thickness);
  }
};

/// What a pair and one of its places say alike. A depth is right to what is aimed for and a bracket
/// as narrow, unless a work limit ended the search: then the depth of a sheet is right all the
/// same.
template <class Found>
void expect_depth(const Found& found, double depth, bool sheet) {
  const double relative = sheet ? 0.01 : 0.02;
  EXPECT_EQ(name(found.cls), name(Class::hit));
  EXPECT_LE(found.d_lower_mm, found.d_mm);
  EXPECT_LE(found.d_mm, found.d_upper_mm);
  EXPECT_LE(found.d_lower_mm, -depth + kSnap);
  EXPECT_GE(found.d_upper_mm, -depth - kSnap);
  const double within = std::max(0.05, relative * depth) + kSnap;
  if (sheet || found.depth_complete) {
    EXPECT_NEAR(found.d_mm, -depth, within);
  }
  if (found.depth_complete) {
    EXPECT_LE(found.d_upper_mm - found.d_lower_mm, within * (1 + relative));
  }
}

/// Places one by one, and the pair that is as deep as the worst of them.
void expect_places(const Scene& scene, const Report& report) {
  ASSERT_EQ(report.pairs.size(), 1U);
  const Pair& pair = report.pairs[0];
  ASSERT_EQ(pair.regions, scene.folded.heights.size());
  std::vector<double> depths;
  for (std::size_t i = 0; i < scene.folded.heights.size(); ++i) depths.push_back(scene.depth_of(i));
  const bool sheet = !(scene.folded.thickness > 0);
  expect_depth(pair, std::ranges::max(depths), sheet);
  if (pair.regions == 1) return;
  const std::span<const Region> regions(report.regions);
  ASSERT_EQ(regions.size(), depths.size());
  std::set<std::size_t> met;
  for (const Region& region : regions) {
    const std::size_t fold = scene.fold_of(region.point_mm);
    EXPECT_TRUE(met.insert(fold).second) << "two places in one fold";
    expect_depth(region, depths[fold], sheet);
    EXPECT_GE(region.d_lower_mm, pair.d_lower_mm);
    EXPECT_GE(region.d_mm, pair.d_mm);
  }
  EXPECT_EQ(regions[0].d_mm, pair.d_mm);
  EXPECT_EQ(regions[0].d_lower_mm, pair.d_lower_mm);
  EXPECT_EQ(regions[0].d_upper_mm, pair.d_upper_mm);
  EXPECT_EQ(regions[0].depth_complete, pair.depth_complete);
  EXPECT_TRUE(std::ranges::is_sorted(regions, {}, &Region::d_mm));
}

constexpr auto kScenes = test::rounds<std::uint64_t>(60, 4000);

TEST(FoldedPlates, ASheetIsMeasuredToAHundredthInEachPlace) {
  std::uint64_t places = 0, complete = 0;
  for (std::uint64_t seed = 1; seed <= kScenes; ++seed) {
    const Scene scene(seed, true);
    SCOPED_TRACE(scene.recipe(seed));
    const Report report = scene.model().detect();
    expect_places(scene, report);
    places += report.regions.size();
    for (const Region& region : report.regions) complete += region.depth_complete ? 1U : 0U;
  }
  EXPECT_GT(places, kScenes);
  EXPECT_GE(complete, places - places / 50);
}

TEST(FoldedPlates, APlateIsAsDeepInEachPlaceAsItIsThere) {
  for (std::uint64_t seed = 1; seed <= kScenes; ++seed) {
    const Scene scene(seed, false);
    SCOPED_TRACE(scene.recipe(seed));
    expect_places(scene, scene.model().detect());
  }
}

}  // namespace
}  // namespace strake::clash
