// SPDX-License-Identifier: Apache-2.0
// Smooth edges where a curved skin begins or ends.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "strake/hlr/hlr.hpp"
#include "support/draw.hpp"
#include "support/scene_builder.hpp"

namespace strake {
namespace {

using geometry::Vec3d;
using geometry::Vec3i;

struct Sheet {
  std::uint32_t facets = 24;
  double inner_radius = 6000, thickness = 2000, plate = 60000, width = 40000, bend = 90;
  bool one_face = false;  ///< the bend, on either side
};

/// A bent sheet: plate, bend, plate. Its sides are one face each.
test::HandPart bent(const Sheet& sheet, const geometry::Mat3d& turn) {
  std::vector<std::pair<Vec3d, Vec3d>> profile;  // inner and outer
  const double all = sheet.bend * std::numbers::pi / 180;
  const auto add = [&](double angle, double along) {
    const Vec3d out{std::sin(angle), 0, -std::cos(angle)}, on{std::cos(angle), 0, std::sin(angle)};
    const Vec3d inner = out * sheet.inner_radius + on * along;
    profile.emplace_back(inner, inner + out * sheet.thickness);
  };
  add(0, -sheet.plate);
  for (std::uint32_t i = 0; i <= sheet.facets; ++i) add(all * i / sheet.facets, 0);
  add(all, sheet.plate);
  test::HandPart part;
  for (const auto& [inner, outer] : profile)
    for (const Vec3d& p : {inner, outer})
      for (const double y : {0.0, sheet.width}) {
        const Vec3d q = turn * Vec3d{p.x, y, p.z};
        part.vertices.push_back({static_cast<std::int32_t>(std::lround(q.x)),
                                 static_cast<std::int32_t>(std::lround(q.y)),
                                 static_cast<std::int32_t>(std::lround(q.z))});
      }
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d,
                        std::uint32_t face) {
    part.triangles.push_back({a, b, c});
    part.triangles.push_back({a, c, d});
    part.faces.insert(part.faces.end(), {face, face});
  };
  const auto last = static_cast<std::uint32_t>(profile.size() - 1);
  std::uint32_t face = 2;
  for (std::uint32_t i = 0; i < last; ++i) {
    const std::uint32_t at = 4 * i, to = at + 4;  // inner, inner far, outer, outer far
    quad(at, to, to + 1, at + 1, face);
    quad(at + 2, at + 3, to + 3, to + 2, face + 1);
    const bool goes_on = sheet.one_face && i > 0 && i + 2 < last;
    if (!goes_on) face += 2;
    quad(at, at + 2, to + 2, to, 0);
    quad(at + 1, to + 1, to + 3, at + 3, 1);
  }
  quad(0, 1, 3, 2, face++);
  quad(4 * last, 4 * last + 2, 4 * last + 3, 4 * last + 1, face);
  return part;
}

std::size_t smooth(const test::HandPart& part, hlr::Smooth which) {
  test::SceneBuilder scene;
  scene.object({{.parts = {part}, .origin = {}}});
  const auto drawing = hlr::draw(scene.scene(), {}, {.direction = {3, -7, 5}, .limits = {}},
                                 {.stage = hlr::Stage::none, .smooth = which}, {});
  EXPECT_TRUE(drawing);
  std::size_t count = 0;
  if (drawing)
    for (const hlr::EdgePiece& p : drawing->pieces)
      count += p.kind == hlr::EdgeKind::smooth ? 1U : 0U;
  return count;
}

TEST(TangentEdges, OfABentSheetAreFourHoweverManyFacetsItHas) {
  test::Draw random(3);
  for (const std::uint32_t facets : {6U, 8U, 24U})
    for (const double radius : {3000.0, 6000.0, 20000.0})
      for (int i = 0; i < 3; ++i) {
        const geometry::Mat3d turn = i == 0 ? geometry::Mat3d{} : random.rotation();
        const Sheet sheet{.facets = facets, .inner_radius = radius};
        // Contours are edges of another kind: the outline may run along a facet.
        const std::size_t tangent = smooth(bent(sheet, turn), hlr::Smooth::tangent);
        EXPECT_LE(tangent, 4U) << facets << " " << radius;
        EXPECT_GE(tangent, 2U) << facets << " " << radius;
        EXPECT_GE(smooth(bent(sheet, turn), hlr::Smooth::all) + 4, 2 * (facets + 1));
        EXPECT_EQ(smooth(bent(sheet, turn), hlr::Smooth::off), 0U);
      }
}

/// Facets so narrow that rounding to the grid turns them by as much as the bend does, and lays some
/// in one plane with their neighbours.
TEST(TangentEdges, RoundingOfFineFacetsMakesNone) {
  test::Draw random(5);
  for (const std::uint32_t facets : {48U, 96U, 192U})
    for (const double radius : {2000.0, 5000.0, 10000.0, 30000.0})
      for (int i = 0; i < 6; ++i) {
        const geometry::Mat3d turn = i == 0 ? geometry::Mat3d{} : random.rotation();
        const Sheet sheet{.facets = facets, .inner_radius = radius};
        const std::size_t tangent = smooth(bent(sheet, turn), hlr::Smooth::tangent);
        EXPECT_LE(tangent, 4U) << facets << " " << radius << " " << i;
        // Where it takes a grid unit or two to tell facets, the first ones count as flat.
        const double step = std::numbers::pi / 2 / facets;
        if (radius * step * step > 3) {
          EXPECT_GE(tangent, 2U) << facets << " " << radius << " " << i;
        }
      }
}

/// Wider than the plates beside it, and no plane; but the source says that it is one face.
TEST(TangentEdges, ABendThatIsOneFaceBeginsAndEnds) {
  test::Draw random(7);
  for (int i = 0; i < 8; ++i) {
    const geometry::Mat3d turn = i == 0 ? geometry::Mat3d{} : random.rotation();
    const Sheet sheet{
        .facets = 12, .inner_radius = 60000, .plate = 3000, .bend = 30, .one_face = true};
    EXPECT_EQ(smooth(bent(sheet, turn), hlr::Smooth::tangent), 4U) << i;
    EXPECT_EQ(smooth(bent(sheet, turn), hlr::Smooth::all), 4U) << i;
  }
}

TEST(TangentEdges, AFoldByLessThanTheSharpAngleIsOne) {
  const Sheet sheet{.facets = 1, .bend = 15};
  EXPECT_EQ(smooth(bent(sheet, {}), hlr::Smooth::tangent),
            smooth(bent(sheet, {}), hlr::Smooth::all));
}

}  // namespace
}  // namespace strake
