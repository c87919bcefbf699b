// SPDX-License-Identifier: Apache-2.0
// Round bodies seen along their axis while limits cut their near end away: the mantle is edge-on
// but for what rounding its corners to the grid did, and hides no rim.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <ostream>
#include <tuple>

#include "hlr/edges/edge_on.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "support/clash_model.hpp"
#include "support/draw.hpp"
#include "support/prism.hpp"
#include "support/rounds.hpp"
#include "support/scene_builder.hpp"

namespace strake {
namespace {

using geometry::Vec3d;
using geometry::Vec3l;

/// A body along an axis that is a direction of whole numbers, so that a view can look along it.
struct Tube {
  Vec3l axis;  ///< from the far end to the viewer
  double radius = 50, length = 2000;
  std::uint32_t sides = 0;  ///< of a prism; 0: a cylinder
  double turn = 0;          ///< about the axis
  Vec3d at;                 ///< the middle of the far end
};

std::ostream& operator<<(std::ostream& out, const Tube& t) {
  return out << "along " << t.axis.x << ',' << t.axis.y << ',' << t.axis.z << ", radius "
             << t.radius << ", length " << t.length << ", " << t.sides << " sides, turn " << t.turn
             << ", at " << t.at.x << ',' << t.at.y << ',' << t.at.z;
}

Tube random_tube(test::Draw& draw) {
  Tube t;
  const auto component = [&] { return static_cast<std::int64_t>(draw.whole(-9, 10)); };
  t.axis.x = component();
  t.axis.y = component();
  t.axis.z = component();
  if (t.axis == Vec3l{}) t.axis.z = 1;
  t.radius = std::exp(draw.between(std::log(2.0), std::log(3000.0)));
  t.length = t.radius * draw.between(8, 60);
  if (draw.one_in(2)) t.sides = static_cast<std::uint32_t>(draw.whole(3, 60));
  t.turn = draw.between(0, 2 * std::numbers::pi);
  t.at.x = draw.between(-20'000, 20'000);
  t.at.y = draw.between(-20'000, 20'000);
  t.at.z = draw.between(-20'000, 20'000);
  return t;
}

Vec3d unit(const Vec3l& v) {
  const auto d = v.as<double>();
  return d * (1 / std::sqrt(dot(d, d)));
}

/// Its own z axis becomes the tube's.
geometry::Mat3d rotation(const Tube& t) {
  const Vec3d z = unit(t.axis);
  const Vec3d side = std::abs(z.x) < 0.7 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  Vec3d x = cross(side, z);
  x = x * (1 / std::sqrt(dot(x, x)));
  const Vec3d y = cross(z, x);
  const double c = std::cos(t.turn), s = std::sin(t.turn);
  const Vec3d u = x * c + y * s, v = y * c - x * s;
  geometry::Mat3d m;
  m.row = {Vec3d{u.x, v.x, z.x}, Vec3d{u.y, v.y, z.y}, Vec3d{u.z, v.z, z.z}};
  return m;
}

test::ClashModel model_of(const Tube& t) {
  test::ClashModel model;
  const geometry::Placement placement{rotation(t), t.at + unit(t.axis) * (t.length / 2)};
  if (t.sides == 0)
    model.object("tube").body(geometry::Primitive{geometry::CylinderPrimitive{t.radius, t.length}},
                              placement);
  else
    model.object("tube").body(test::prism(t.sides, -t.length / 2, t.length / 2,
                                          [&](double angle, double z) {
                                            return Vec3d{t.radius * std::cos(angle),
                                                         t.radius * std::sin(angle), z};
                                          }),
                              placement);
  return model;
}

/// Along the axis, from the far end to about the middle.
hlr::View view_of(const Tube& t) {
  hlr::View view;
  view.direction = t.axis;
  view.up = t.axis.x == 0 && t.axis.y == 0 ? Vec3l{0, 1, 0} : Vec3l{0, 0, 1};
  int k = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(t.axis[i]) > std::abs(t.axis[k])) k = i;
  constexpr std::int64_t kFar = 1'000'000'000;
  geometry::Box3l limits{{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}};
  const Vec3d middle = t.at + unit(t.axis) * (t.length / 2);
  const double mm = k == 0 ? middle.x : k == 1 ? middle.y : middle.z;
  (t.axis[k] > 0 ? limits.hi[k] : limits.lo[k]) = std::llround(mm * 1000);
  view.limits = limits;
  return view;
}

/// law(draw, tube, scene) for so many tubes, until one breaks it.
template <class Law>
void over_tubes(std::uint64_t tubes, const Law& law) {
  for (std::uint64_t seed = 1; seed <= tubes; ++seed) {
    test::Draw draw(seed);
    const Tube tube = random_tube(draw);
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ": " << tube);
    const test::ClashModel model = model_of(tube);
    const auto scene = model::make_scene(model.model, {}, {});
    ASSERT_TRUE(scene);
    law(draw, tube, *scene);
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(EdgeOnFacets, HideNoRim) {
  over_tubes(test::rounds<std::uint64_t>(200, 2000), [](test::Draw&, const Tube& tube,
                                                        const model::Scene& scene) {
    const auto drawing = hlr::draw(scene, {}, view_of(tube), {}, {});
    ASSERT_TRUE(drawing) << drawing.error().text();
    std::size_t rim = 0;
    for (const hlr::EdgePiece& p : drawing->pieces) {
      const Vec3d a = p.a.as<double>() * 1e-3 - tube.at, b = p.b.as<double>() * 1e-3 - tube.at;
      if (std::max(std::abs(dot(a, unit(tube.axis))), std::abs(dot(b, unit(tube.axis)))) > 0.1)
        continue;
      ++rim;
      EXPECT_EQ(p.state, hlr::State::visible)
          << p.edge << " over " << std::sqrt(dot(a - b, a - b)) << " mm";
    }
    EXPECT_GE(rim, 3U);
  });
}

bool same(const hlr::EdgePiece& x, const hlr::EdgePiece& y) {
  return std::tie(x.edge, x.kind, x.state, x.a, x.b) == std::tie(y.edge, y.kind, y.state, y.a, y.b);
}

TEST(EdgeOnFacets, AreTheSameForAllSolvers) {
  over_tubes(test::rounds<std::uint64_t>(40, 400),
             [](test::Draw& draw, const Tube& tube, const model::Scene& scene) {
               hlr::View view = view_of(tube);
               if (draw.one_in(2)) view.limits.reset();
               hlr::Options options;
               options.keep_specks = draw.one_in(4);
               const auto gathered = hlr::draw(scene, {}, view, options, {});
               ASSERT_TRUE(gathered);
               for (const hlr::Solver solver : {hlr::Solver::brute_force, hlr::Solver::push}) {
                 options.solver = solver;
                 const auto other = hlr::draw(scene, {}, view, options, {});
                 ASSERT_TRUE(other);
                 EXPECT_TRUE(std::ranges::equal(gathered->pieces, other->pieces, same));
               }
             });
}

/// Whether a triangle may be edge-on along z, its corners as they are or rounded.
bool may_be_edge_on(const std::array<Vec3d, 3>& corners) {
  test::HandPart hand;
  for (const Vec3d& p : corners)
    hand.vertices.push_back({static_cast<std::int32_t>(std::lround(p.x)),
                             static_cast<std::int32_t>(std::lround(p.y)),
                             static_cast<std::int32_t>(std::lround(p.z))});
  hand.triangles = {{0, 1, 2}};
  return hlr::may_be_edge_on(test::make_part(hand), 0, {0, 0, 1});
}

TEST(EdgeOnFacets, AreThoseThatRoundingTurned) {
  std::size_t turned = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    SCOPED_TRACE(seed);
    test::Draw draw(seed);
    const double angle = draw.between(0, 2 * std::numbers::pi);
    const Vec3d along{std::cos(angle), std::sin(angle), 0}, across{-along.y, along.x, 0};
    const auto corner = [&](double u, double z) {
      const double slack = draw.between(-20, 20);
      return along * (u + slack) + Vec3d{0, 0, z + slack};
    };
    std::array<Vec3d, 3> corners;
    corners.at(0) = corner(0, 0);
    corners.at(1) = corner(draw.between(500, 50'000), 0);
    corners.at(2) = corner(0, draw.between(500, 500'000));
    EXPECT_TRUE(may_be_edge_on(corners));
    // Half a unit along each axis takes a corner √½ off on paper, and the others the other way.
    std::array<Vec3d, 3> beside = corners;
    beside.at(2) = beside.at(2) + across * draw.between(4.5, 100);
    EXPECT_FALSE(may_be_edge_on(beside));
    beside.at(2) = corners.at(2) + across * draw.between(-0.6, 0.6);
    turned += may_be_edge_on(beside) ? 1U : 0U;
    // Of one that is two units wide rounding alone tells which way it looks.
    std::array<Vec3d, 3> narrow = corners;
    narrow.at(2) = corners.at(1) + Vec3d{0, 0, 2};
    EXPECT_FALSE(may_be_edge_on(narrow));
  }
  EXPECT_GT(turned, 1500U);
}

}  // namespace
}  // namespace strake
