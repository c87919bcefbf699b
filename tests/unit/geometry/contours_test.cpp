// SPDX-License-Identifier: Apache-2.0
// Tessellations for a view: the contours of round primitives are edges, and lie on the true ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "geometry/mesh_repair/mesh_repair.hpp"
#include "geometry/mesh_repair/snap_to_grid.hpp"
#include "geometry/numeric/trig.hpp"
#include "geometry/primitives/tessellate.hpp"
#include "support/contour_edges.hpp"
#include "support/pipe_frame.hpp"
#include "support/random_primitives.hpp"
#include "support/rounds.hpp"
#include "support/true_surface.hpp"

namespace strake::geometry {
namespace {

using test::loose_ends;
using test::Net;
using test::normal_at;
using test::PrimitiveDraw;
using test::worst_end_from;

/// How far |normal · direction| of the true surface is from 0 at the ends of the contours.
double worst_end(const Primitive& primitive, const Tessellation& t, const Vec3d& towards) {
  double worst = 0;
  for (const auto& [a, b] : Net(t.mesh).contours(towards))
    for (const Vec3d& p : {a, b})
      worst = std::max(worst, std::fabs(dot(normal_at(primitive, p), towards)));
  return worst;
}

TEST(Contours, OfACylinderAreTwoGenerators) {
  PrimitiveDraw draw(1);
  for (int i = 0; i < test::rounds(200); ++i) {
    const CylinderPrimitive pipe{draw.between(1, 500), draw.between(1, 3000)};
    const Vec3d towards = draw.direction();
    if (std::hypot(towards.x, towards.y) < 0.01) continue;
    const Tessellation t = tessellate(pipe, {}, 0.5, towards);
    ASSERT_EQ(t.fault, "");
    EXPECT_LE(t.mesh.sag_mm, 0.5);
    const auto contours = Net(t.mesh).contours(towards);
    EXPECT_EQ(contours.size(), 2U);
    EXPECT_LT(worst_end(pipe, t, towards), 1e-12);
  }
}

TEST(Contours, OfASnoutAreTwoGeneratorsOrNone) {
  PrimitiveDraw draw(2);
  int two = 0;
  for (int i = 0; i < test::rounds(400); ++i) {
    SnoutPrimitive s{draw.between(20, 80), draw.between(0, 80), draw.between(60, 200)};
    if (i % 2 == 0) s.offset_x = draw.between(-60, 60), s.offset_y = draw.between(-60, 60);
    if (i % 3 == 0) s.bottom_shear_x = draw.between(-0.2, 0.2);
    const Vec3d towards = draw.direction();
    const Tessellation t = tessellate(s, {}, 0.5, towards);
    if (!t.fault.empty()) continue;
    EXPECT_LE(t.mesh.sag_mm, 0.8);
    const auto contours = Net(t.mesh).contours(towards);
    if (contours.size() != 2) {
      // None, or two within a quarter of a step of each other.
      EXPECT_LE(contours.size(), 2U);
      continue;
    }
    ++two;
    if (worst_end(s, t, towards) > 1e-9) --two;
  }
  EXPECT_GT(two, test::rounds(250));
}

TEST(Contours, OfABallAreItsEquator) {
  PrimitiveDraw draw(3);
  for (int i = 0; i < test::rounds(100); ++i) {
    const SpherePrimitive ball{draw.between(2, 900)};
    const Vec3d towards = draw.direction();
    const Tessellation t = tessellate(ball, {}, 0.5, towards);
    const auto contours = Net(t.mesh).contours(towards);
    EXPECT_GE(contours.size(), 8U);
    EXPECT_LT(worst_end(ball, t, towards), 1e-12);
    EXPECT_LE(t.mesh.sag_mm, 0.5);
  }
}

TEST(Contours, OfAnEllipticalDishRunFromRimToRim) {
  PrimitiveDraw draw(4);
  int visible_count = 0;
  for (int i = 0; i < test::rounds(200); ++i) {
    const EllipticalDishPrimitive dish{draw.between(10, 900), draw.between(10, 900)};
    const Vec3d towards = draw.direction();
    const Tessellation t = tessellate(dish, {}, 0.5, towards);
    const auto contours = Net(t.mesh).contours(towards);
    const double worst = worst_end(dish, t, towards);
    if (worst > 1e-9) continue;  // near the rim it is left out
    ++visible_count;
    std::map<std::array<double, 3>, int> ends;
    for (const auto& [a, b] : contours) ++ends[{a.x, a.y, a.z}], ++ends[{b.x, b.y, b.z}];
    int loose = 0;
    for (const auto& [p, n] : ends) {
      EXPECT_LE(n, 2);
      if (n == 1) {
        ++loose;
        EXPECT_NEAR(p[2], 0, 1e-9);
      }
    }
    EXPECT_EQ(loose, contours.empty() ? 0 : 2);
  }
  EXPECT_GT(visible_count, test::rounds(150));
}

TEST(Contours, OfASphericalDishRunFromRimToRim) {
  PrimitiveDraw draw(14);
  int crossed = 0, spared = 0;
  for (int i = 0; i < test::rounds(600); ++i) {
    const double radius = draw.between(10, 900);
    const SphericalDishPrimitive dish{radius, radius * draw.between(0.05, i % 5 == 0 ? 3 : 1)};
    const Vec3d towards = draw.direction();
    const double ball = (radius * radius / dish.height + dish.height) / 2;
    const double level = std::hypot(towards.x, towards.y);
    const double at = towards.z * (dish.height - ball) / level;
    const Tessellation t = tessellate(dish, {}, 0.5, towards);
    ASSERT_EQ(t.fault, "");
    const auto contours = Net(t.mesh).contours(towards);
    if (!(std::fabs(at) < radius)) {
      // Less than half a ball is seen as a whole, from within or without.
      if (dish.height < radius) {
        EXPECT_TRUE(contours.empty()) << i;
      }
      continue;
    }
    if (contours.empty() || worst_end(dish, t, towards) > 1e-9) {
      ++spared;  // it hardly rises over the rim
      EXPECT_GT(std::fabs(at), radius * 0.8) << i;
      continue;
    }
    ++crossed;
    const std::vector<Vec3d> loose = loose_ends(contours);
    ASSERT_EQ(loose.size(), 2U) << i;
    for (const Vec3d& p : loose) {
      EXPECT_NEAR(p.z, 0, 1e-9);
      EXPECT_NEAR(std::hypot(p.x, p.y), radius, 1e-9);
    }
    EXPECT_LE(t.mesh.sag_mm, 0.8);
  }
  EXPECT_GT(crossed, test::rounds(400));
  EXPECT_LT(spared, 20);
}

// But for those near the contour's ends.
TEST(Contours, RimsOfPipeAndSphericalDishMeet) {
  PrimitiveDraw draw(15);
  std::size_t met = 0, missed = 0;
  for (int i = 0; i < test::rounds(100); ++i) {
    const double radius = draw.between(20, 600);
    const SphericalDishPrimitive dish{radius, radius * draw.between(0.1, 1)};
    const Vec3d towards = draw.direction();
    const Tessellation t = tessellate(dish, {}, 0.5, towards);
    const Tessellation pipe = tessellate(CylinderPrimitive{radius, 1000}, {}, 0.5, towards);
    const test::RimMeeting rims = test::rims_of(t, pipe, 1e-9);
    met += rims.met;
    missed += rims.missed;
    EXPECT_LE(rims.missed, 2U) << i;
  }
  EXPECT_GT(met, 20 * missed);
}

/// Sections at which a ring is seen edge-on are those of one turn, however many are stated.
TEST(Contours, OfATorusThatTurnsOftenAreThoseOfARing) {
  const Vec3d towards{1, 0, 0};
  const auto mesh_of = [&](double angle) {
    return tessellate(CircularTorusPrimitive{100, 10, angle}, {}, 1, towards).mesh;
  };
  const TriangleMesh ring = mesh_of(2 * kPi);
  for (const double angle : {7.0, 1e9, 1e300}) {
    const TriangleMesh mesh = mesh_of(angle);
    EXPECT_EQ(mesh.vertices, ring.vertices) << angle;
    EXPECT_EQ(mesh.triangles, ring.triangles) << angle;
  }
}

TEST(Contours, OfATorusLieOnTheTrueOnes) {
  PrimitiveDraw draw(5);
  double worst = 0;
  for (int i = 0; i < test::rounds(200); ++i) {
    const double tube = draw.between(10, 200);
    const CircularTorusPrimitive bend{tube * draw.between(1.2, 5), tube,
                                      i % 4 == 0   ? 2 * kPi
                                      : i % 4 == 1 ? kPi / 2
                                                   : draw.between(0.2, 6)};
    const Vec3d towards = draw.direction();
    if (std::fabs(towards.z) < 0.1) continue;
    const Tessellation t = tessellate(bend, {}, 0.5, towards);
    ASSERT_EQ(t.fault, "");
    EXPECT_LE(t.mesh.sag_mm, 2);
    EXPECT_LT(worst_end(bend, t, towards), 1e-9) << i;
    worst = std::max(worst, worst_end(bend, t, towards));
  }
  RecordProperty("worst", std::to_string(worst));
}

// In every view, whatever frames they were drawn in.
TEST(Contours, RimsOfPipeAndElbowMeet) {
  PrimitiveDraw draw(6);
  for (int i = 0; i < 60; ++i) {
    const double tube = draw.between(10, 300), bend = tube * draw.between(1.2, 4);
    const double angle = i % 2 == 0 ? kPi / 2 : draw.between(0.1, 3);
    const Mat3d elbow = i % 3 == 0 ? Mat3d{} : draw.rotation();
    const Vec3d towards = i % 5 == 0   ? Vec3d{0, 0, 1}
                          : i % 5 == 1 ? Vec3d{1, -1, 1}
                          : i % 5 == 2 ? Vec3d{0, -1, 0}
                                       : draw.direction();
    const Tessellation t =
        tessellate(CircularTorusPrimitive{bend, tube, angle}, elbow, 0.5, towards);
    ASSERT_EQ(t.fault, "");
    for (const double at : {0.0, angle}) {
      const Mat3d frame = test::pipe_frame(elbow, at, draw.between(0, 6));
      const Tessellation pipe = tessellate(CylinderPrimitive{tube, 2000}, frame, 0.5, towards);
      const Vec3d centre = elbow * Vec3d{bend * std::cos(at), bend * std::sin(at), 0};
      const Vec3d along = frame * Vec3d{0, 0, 1};
      std::size_t rim = 0;
      for (const Vec3d& v : pipe.mesh.vertices) {
        if (dot(v, along) < 0) continue;
        ++rim;
        double nearest = 1e9;
        for (const Vec3d& w : t.mesh.vertices) {
          const Vec3d off = v - along * 1000.0 + centre - w;
          nearest = std::min(nearest, std::sqrt(dot(off, off)));
        }
        EXPECT_LT(nearest, 1e-6) << i;
      }
      EXPECT_GE(rim, 8U);
    }
  }
}

/// An eye so many radii from the z axis, and up to as far along it.
Vec3d eye_beside(PrimitiveDraw& draw, double radius, double least, double most) {
  const double away = radius * draw.between(least, most), angle = draw.between(-4, 4);
  return {away * std::cos(angle), away * std::sin(angle), away * draw.between(-1, 1)};
}

TEST(ContoursFromAnEye, OfACylinderAreTwoGenerators) {
  PrimitiveDraw draw(11);
  for (int i = 0; i < test::rounds(200); ++i) {
    const CylinderPrimitive pipe{draw.between(1, 500), draw.between(1, 3000)};
    const Vec3d eye = eye_beside(draw, pipe.radius, 1.05, i % 2 == 0 ? 3 : 100);
    const Tessellation t = tessellate_from(eye, pipe, {}, 0.5);
    ASSERT_EQ(t.fault, "");
    EXPECT_LE(t.mesh.sag_mm, 0.6);
    EXPECT_EQ(Net(t.mesh).contours_from(eye).size(), 2U);
    EXPECT_LT(worst_end_from(eye, pipe, t), 1e-9);
  }
}

TEST(ContoursFromAnEye, AreNoneInAPipeAndAtItsSkin) {
  for (const double away : {0.0, 50.0, 101.0}) {
    const Tessellation t = tessellate_from({away, 0, 20}, CylinderPrimitive{100, 1000}, {}, 0.5);
    const Tessellation usual = tessellate(CylinderPrimitive{100, 1000}, {}, 0.5);
    EXPECT_EQ(t.mesh.vertices, usual.mesh.vertices) << away;
  }
}

TEST(ContoursFromAnEye, OfASnoutAreTwoGeneratorsOrNone) {
  PrimitiveDraw draw(12);
  int two = 0;
  for (int i = 0; i < test::rounds(400); ++i) {
    const SnoutPrimitive s{draw.between(20, 80), draw.between(0, 80), draw.between(60, 200),
                           draw.between(-40, 40), draw.between(-40, 40)};
    const Vec3d eye = eye_beside(draw, 100, 2, 40);
    const Tessellation t = tessellate_from(eye, s, {}, 0.5);
    ASSERT_EQ(t.fault, "");
    const auto contours = Net(t.mesh).contours_from(eye);
    EXPECT_TRUE(contours.size() == 2 || contours.empty()) << contours.size();
    if (contours.size() == 2) ++two;
    EXPECT_LT(worst_end_from(eye, s, t), 1e-9) << i;
  }
  EXPECT_GT(two, 100);
}

TEST(ContoursFromAnEye, OfABallIsACircle) {
  PrimitiveDraw draw(13);
  for (int i = 0; i < test::rounds(100); ++i) {
    const SpherePrimitive ball{draw.between(10, 2000)};
    const Vec3d eye = draw.direction() * (ball.diameter / 2 * draw.between(1.05, 30));
    const Tessellation t = tessellate_from(eye, ball, {}, 0.5);
    ASSERT_EQ(t.fault, "");
    EXPECT_LE(t.mesh.sag_mm, 0.5);
    EXPECT_GE(Net(t.mesh).contours_from(eye).size(), 8U);
    EXPECT_LT(worst_end_from(eye, ball, t), 1e-9) << i;
  }
}

TEST(ContoursFromAnEye, OfATorusLieOnTheTrueOnes) {
  PrimitiveDraw draw(14);
  for (int i = 0; i < test::rounds(200); ++i) {
    const double tube = draw.between(10, 200);
    const CircularTorusPrimitive bend{tube * draw.between(1.2, 5), tube,
                                      i % 4 == 0   ? 2 * kPi
                                      : i % 4 == 1 ? kPi / 2
                                                   : draw.between(0.2, 6)};
    Vec3d eye = draw.direction() * (tube * draw.between(10, 200));
    eye.z = std::copysign(std::max(std::fabs(eye.z), 3.5 * tube), eye.z);
    if (std::fabs(eye.z) < 0.18 * std::sqrt(dot(eye, eye))) continue;
    const Tessellation t = tessellate_from(eye, bend, {}, 0.5);
    ASSERT_EQ(t.fault, "");
    EXPECT_LE(t.mesh.sag_mm, 2);
    EXPECT_GE(Net(t.mesh).contours_from(eye).size(), 2U);
    EXPECT_LT(worst_end_from(eye, bend, t), 1e-9) << i;
  }
}

// There, slivers of its triangles would hide pieces of a contour along its net.
TEST(ContoursFromAnEye, OfABendFromLowOverItsPlaneAreThoseOfTheScene) {
  const CircularTorusPrimitive bend{225, 150, kPi / 2};
  const auto is_of_scene = [&](double elevation_deg) {
    const double angle = elevation_deg * kPi / 180;
    const Vec3d eye = Vec3d{1, -1, std::sqrt(2.0) * std::tan(angle)} * 8000;
    return tessellate_from(eye, bend, {}, 0.5).mesh.vertices ==
           tessellate(bend, {}, 0.5).mesh.vertices;
  };
  for (const double low : {4.0, 6.0, 8.0, -7.0}) EXPECT_TRUE(is_of_scene(low)) << low;
  for (const double high : {12.0, 30.0, -45.0}) EXPECT_FALSE(is_of_scene(high)) << high;
}

// Whatever frames they were drawn in.
TEST(ContoursFromAnEye, RimsOfPipeAndElbowMeet) {
  PrimitiveDraw draw(15);
  for (int i = 0; i < 60; ++i) {
    const double tube = draw.between(10, 300), bend = tube * draw.between(1.2, 4);
    const double angle = i % 2 == 0 ? kPi / 2 : draw.between(0.1, 3);
    const Mat3d elbow = i % 3 == 0 ? Mat3d{} : draw.rotation();
    const Vec3d eye = elbow * Vec3d{tube * draw.between(-9, 9), tube * draw.between(-9, 9),
                                    tube * draw.between(3.1, 30)};
    const Tessellation t =
        tessellate_from(eye, CircularTorusPrimitive{bend, tube, angle}, elbow, 0.5);
    ASSERT_EQ(t.fault, "");
    for (const double at : {0.0, angle}) {
      const Mat3d frame = test::pipe_frame(elbow, at, draw.between(0, 6));
      const Vec3d along = frame * Vec3d{0, 0, 1};
      const Vec3d end = elbow * Vec3d{bend * std::cos(at), bend * std::sin(at), 0};
      const Vec3d middle = end - along * 1000.0;
      const Tessellation pipe =
          tessellate_from(eye - middle, CylinderPrimitive{tube, 2000}, frame, 0.5);
      std::size_t rim = 0;
      for (const Vec3d& v : pipe.mesh.vertices) {
        if (dot(v, along) < 0) continue;
        ++rim;
        double nearest = 1e9;
        for (const Vec3d& w : t.mesh.vertices) {
          const Vec3d off = v + middle - w;
          nearest = std::min(nearest, std::sqrt(dot(off, off)));
        }
        EXPECT_LT(nearest, 1e-6) << i;
      }
      EXPECT_GE(rim, 8U);
    }
  }
}

/// Checks that a mesh is closed, turned outward, and as near to the true surface as it says.
void check_mesh(const Primitive& primitive, const Mat3d& linear, const Tessellation& t,
                bool measured, PrimitiveDraw& draw, std::mt19937_64& random) {
  auto placed = snap_to_grid(t.mesh, {});
  ASSERT_TRUE(placed.has_value());
  const RepairedMesh analysis = repair_mesh(std::move(placed->mesh));
  ASSERT_EQ(analysis.parts.size(), 1U);
  EXPECT_EQ(analysis.parts[0].kind, PartKind::solid);
  EXPECT_FALSE(analysis.parts[0].flags.inverted);
  if (!measured) return;
  for (int k = 0; k < 60; ++k) {
    const Triangle& w = t.mesh.triangles[random() % t.mesh.triangles.size()];
    const double a = std::sqrt(draw.between(0, 1)), b = draw.between(0, 1);
    const Vec3d p = t.mesh.vertices[w[0]] * (1 - a) + t.mesh.vertices[w[1]] * (a * (1 - b)) +
                    t.mesh.vertices[w[2]] * (a * b);
    const Mat3d inverse = [&] {
      Mat3d m;  // of a rotation or mirror
      const auto& r = linear.row;
      m.row = {Vec3d{r[0].x, r[1].x, r[2].x}, Vec3d{r[0].y, r[1].y, r[2].y},
               Vec3d{r[0].z, r[1].z, r[2].z}};
      return m;
    }();
    ASSERT_LE(test::distance_to_primitive(primitive, inverse * p), t.mesh.sag_mm + 1e-3);
  }
  for (const Vec3d& p : test::surface_points(primitive, 8, random))
    ASSERT_LE(test::distance_to_mesh(t.mesh, linear * p), t.mesh.sag_mm + 1e-3);
}

// Closed, turned outward, and as near to the true surface as they say.
TEST(Contours, MeshesKeepWhatTheyState) {
  PrimitiveDraw draw(7);
  std::mt19937_64 random(7);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    const double tube = draw.between(10, 60);
    const Primitive primitive =
        i % 3 == 0 ? Primitive(CircularTorusPrimitive{tube * draw.between(0.5, 4), tube,
                                                      i % 2 == 0 ? 2 * kPi : draw.between(0.1, 6)})
                   : draw.convex(2 + draw.below(5), 400);
    const Mat3d linear = draw.linear(i % 2 == 0);
    const Vec3d towards = draw.direction();
    const Tessellation t = tessellate(primitive, linear, 0.5, towards);
    if (!t.fault.empty()) continue;
    check_mesh(primitive, linear, t, i % 2 == 0, draw, random);
  }
}

// Wherever the eye is, in the primitive too.
TEST(ContoursFromAnEye, MeshesKeepWhatTheyState) {
  PrimitiveDraw draw(16);
  std::mt19937_64 random(16);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    const double tube = draw.between(10, 60);
    const Primitive primitive =
        i % 3 == 0 ? Primitive(CircularTorusPrimitive{tube * draw.between(0.5, 4), tube,
                                                      i % 2 == 0 ? 2 * kPi : draw.between(0.1, 6)})
                   : draw.convex(2 + draw.below(5), 400);
    const Mat3d linear = draw.linear(i % 2 == 0);
    const Vec3d eye = draw.direction() * draw.between(20, 4000);
    const Tessellation t = tessellate_from(eye, primitive, linear, 0.5);
    if (!t.fault.empty()) continue;
    check_mesh(primitive, linear, t, i % 2 == 0, draw, random);
  }
}

}  // namespace
}  // namespace strake::geometry
