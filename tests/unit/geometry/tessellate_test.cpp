// SPDX-License-Identifier: Apache-2.0
#include "geometry/primitives/tessellate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <string>

#include "geometry/mesh_repair/mesh_repair.hpp"
#include "geometry/mesh_repair/snap_to_grid.hpp"
#include "geometry/numeric/trig.hpp"
#include "strake/geometry/grid.hpp"
#include "support/pipe_frame.hpp"
#include "support/true_surface.hpp"

namespace strake::geometry {
namespace {

using Random = std::mt19937_64;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Vec3d unit(const Vec3d& v) { return v * (1 / std::sqrt(dot(v, v))); }

Mat3d random_rotation(Random& random) {
  const auto direction = [&] {
    return unit({uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)});
  };
  const Vec3d z = direction(), helper = direction();
  const Vec3d x = unit(cross(helper, z));
  return test::from_columns(x, cross(z, x), z);
}

Primitive random_primitive(std::size_t kind, Random& random) {
  const auto length = [&] { return uniform(random, 5, 400); };
  const auto shear = [&] { return uniform(random, -0.4, 0.4); };
  switch (kind) {
    case 0:
      return BoxPrimitive{length(), length(), length()};
    case 1:
      return PyramidPrimitive{length(),
                              length(),
                              random() % 3 == 0 ? 0 : length(),
                              random() % 3 == 0 ? 0 : length(),
                              shear() * 100,
                              shear() * 100,
                              length()};
    case 2:
      return CylinderPrimitive{length(), length()};
    case 3: {
      SnoutPrimitive s;
      s.bottom_radius = uniform(random, 20, 60);
      s.top_radius = random() % 3 == 0 ? s.bottom_radius : uniform(random, 20, 60);
      s.height = uniform(random, 150, 300);
      if (random() % 2 == 0) {
        s.offset_x = shear() * 100;
        s.offset_y = shear() * 100;
      }
      if (random() % 2 == 0) {
        s.bottom_shear_x = shear();
        s.bottom_shear_y = shear();
        s.top_shear_x = shear();
        s.top_shear_y = shear();
      } else if (random() % 3 == 0) {
        s.top_radius = 0;
      }
      return s;
    }
    case 4:
      return SpherePrimitive{length()};
    case 5:
      return EllipticalDishPrimitive{length(), length()};
    case 6: {
      const double radius = length();
      return SphericalDishPrimitive{radius, radius * uniform(random, 0.05, 3)};
    }
    case 7: {
      const double tube = uniform(random, 10, 60);
      const double angle = random() % 4 == 0 ? 2 * kPi : uniform(random, 0.1, 6);
      return CircularTorusPrimitive{tube * uniform(random, random() % 3 == 0 ? 0 : 1.1, 5), tube,
                                    angle};
    }
    case 8: {
      const double inner = random() % 3 == 0 ? 0 : length();
      const double angle = random() % 4 == 0 ? 2 * kPi : uniform(random, 0.1, 6);
      return RectangularTorusPrimitive{inner, inner + length(), length(), angle};
    }
    default:
      return LinePrimitive{1, length()};
  }
}

/// The one part that a tessellation is on the grid.
Part part_of(const Tessellation& t) {
  auto placed = snap_to_grid(t.mesh, {});
  EXPECT_TRUE(placed.has_value());
  RepairedMesh analysis = repair_mesh(std::move(placed->mesh));
  EXPECT_EQ(analysis.parts.size(), 1U);
  return analysis.parts.empty() ? Part{} : std::move(analysis.parts[0]);
}

class EveryKind : public ::testing::TestWithParam<std::size_t> {};

TEST_P(EveryKind, IsAClosedManifoldTurnedOutwardInAnyFrame) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Primitive primitive = random_primitive(GetParam(), random);
    Mat3d linear = random_rotation(random);
    if (seed % 3 == 1) linear.row[0] = linear.row[0] * -1.0;
    if (seed % 3 == 2) linear.row[1] = linear.row[1] * 0.5 + linear.row[2] * 0.3;
    const Tessellation t = tessellate(primitive, linear, 0.5);
    ASSERT_EQ(t.fault, "");
    const Part part = part_of(t);
    EXPECT_EQ(part.kind, PartKind::solid);
    EXPECT_FALSE(part.flags.inverted);
    EXPECT_FALSE(part.flags.non_manifold);
    EXPECT_EQ(part.shell_count, 1U);
    for (std::size_t e = 0; e + 1 < part.edges.size(); ++e)
      ASSERT_EQ(part.edges[e + 1].first_triangle - part.edges[e].first_triangle, 2U);
  }
}

TEST_P(EveryKind, KeepsTheSagBothWays) {
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Primitive primitive = random_primitive(GetParam(), random);
    const double sag = std::exp(uniform(random, std::log(0.1), std::log(5)));
    const Tessellation t = tessellate(primitive, {}, sag);
    ASSERT_EQ(t.fault, "");
    EXPECT_LE(t.mesh.sag_mm, sag * (1 + 1e-12));
    for (int i = 0; i < 300; ++i) {
      const Triangle& w = t.mesh.triangles[random() % t.mesh.triangles.size()];
      const double a = std::sqrt(uniform(random, 0, 1)), b = uniform(random, 0, 1);
      const Vec3d p = t.mesh.vertices[w[0]] * (1 - a) + t.mesh.vertices[w[1]] * (a * (1 - b)) +
                      t.mesh.vertices[w[2]] * (a * b);
      ASSERT_LE(test::distance_to_primitive(primitive, p), t.mesh.sag_mm + 1e-7);
    }
    for (const Vec3d& p : test::surface_points(primitive, 16, random))
      ASSERT_LE(test::distance_to_mesh(t.mesh, p), t.mesh.sag_mm + 1e-7);
  }
}

TEST_P(EveryKind, KeepsTheSagAfterATurnAndAScale) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Primitive primitive = random_primitive(GetParam(), random);
    Mat3d linear = random_rotation(random);
    const double scale = uniform(random, 0.2, 4);
    for (Vec3d& row : linear.row) row = row * scale;
    const Tessellation t = tessellate(primitive, linear, 0.4);
    ASSERT_EQ(t.fault, "");
    EXPECT_LE(t.mesh.sag_mm, 0.4 * (1 + 1e-9));
    for (const Vec3d& p : test::surface_points(primitive, 16, random))
      ASSERT_LE(test::distance_to_mesh(t.mesh, linear * p), t.mesh.sag_mm + 1e-7);
  }
}

TEST_P(EveryKind, TrianglesOfAFaceAreCoplanar) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    if (GetParam() == 7) continue;  // the quads of a twisted elbow are nearly planar only
    const Tessellation t = tessellate(random_primitive(GetParam(), random), {}, 0.5);
    ASSERT_EQ(t.mesh.faces.size(), t.mesh.triangles.size());
    std::map<std::uint32_t, std::size_t> first;
    for (std::size_t i = 0; i < t.mesh.triangles.size(); ++i) {
      const auto [found, fresh] = first.try_emplace(t.mesh.faces[i], i);
      if (fresh) continue;
      const Triangle &a = t.mesh.triangles[found->second], &b = t.mesh.triangles[i];
      const auto& v = t.mesh.vertices;
      const Vec3d n = cross(v[a[1]] - v[a[0]], v[a[2]] - v[a[0]]);
      if (dot(n, n) < 1e-12) continue;
      for (const std::uint32_t k : b)
        ASSERT_LT(std::fabs(dot(unit(n), v[k] - v[a[0]])), 1e-6) << t.mesh.faces[i];
    }
  }
}

std::string name_of(const ::testing::TestParamInfo<std::size_t>& kind) {
  Random random(0);
  return std::string(kind_name(random_primitive(kind.param, random)));
}

// All but the last, the line.
INSTANTIATE_TEST_SUITE_P(Tessellate, EveryKind,
                         ::testing::Range<std::size_t>(0, std::variant_size_v<Primitive> - 1),
                         name_of);

std::vector<Vec3d> near_plane(const TriangleMesh& mesh, const Vec3d& origin, const Vec3d& normal) {
  std::vector<Vec3d> on;
  for (const Vec3d& v : mesh.vertices)
    if (std::fabs(dot(v - origin, normal)) < 1e-6) on.push_back(v);
  return on;
}

// A pipe and its elbow meet vertex to vertex at both ends, whatever frames they were drawn in.
TEST(Tessellate, RimsOfPipeAndElbowMeet) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double tube = uniform(random, 10, 300), bend = tube * uniform(random, 1.2, 4);
    const double angle = seed % 2 == 0 ? kPi / 2 : uniform(random, 0.1, 3);
    Mat3d elbow = random_rotation(random);
    if (seed % 4 == 0)  // in the planes of the model's axes
      elbow =
          test::from_columns({0, 0, 1}, {seed % 8 == 0 ? 0.0 : 1.0, seed % 8 == 0 ? 1.0 : 0.0, 0},
                             {seed % 8 == 0 ? -1.0 : 0.0, seed % 8 == 0 ? 0.0 : 1.0, 0});
    const Tessellation t = tessellate(CircularTorusPrimitive{bend, tube, angle}, elbow, 0.5);
    ASSERT_EQ(t.fault, "");
    for (const double at : {0.0, angle}) {
      const Mat3d frame = test::pipe_frame(elbow, at, uniform(random, 0, 6));
      const Tessellation pipe = tessellate(CylinderPrimitive{tube, 2000}, frame, 0.5);
      const Vec3d centre = elbow * Vec3d{bend * std::cos(at), bend * std::sin(at), 0};
      const Vec3d along = frame * Vec3d{0, 0, 1};
      const auto elbow_rim = near_plane(t.mesh, centre, along);
      std::vector<Vec3d> pipe_rim;
      for (const Vec3d& v : near_plane(pipe.mesh, along * 1000.0, along))
        pipe_rim.push_back(v - along * 1000.0 + centre);
      ASSERT_GE(elbow_rim.size(), pipe_rim.size());
      for (const Vec3d& v : pipe_rim) {
        double nearest = 1e9;
        for (const Vec3d& w : elbow_rim) nearest = std::min(nearest, std::sqrt(dot(v - w, v - w)));
        EXPECT_LT(nearest, 1e-6);
      }
    }
  }
}

TEST(Tessellate, RimsDoNotDependOnTheLocalFrameOrTheSenseOfTheAxis) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    const Mat3d frame = seed % 5 == 0 ? Mat3d{} : random_rotation(random);
    const double roll = uniform(random, 0, 6);
    const Vec3d x = frame * Vec3d{1, 0, 0}, y = frame * Vec3d{0, 1, 0}, z = frame * Vec3d{0, 0, 1};
    const Mat3d other = test::from_columns(y * std::cos(roll) - x * std::sin(roll),
                                           x * std::cos(roll) + y * std::sin(roll), z * -1.0);
    const CylinderPrimitive pipe{57.15, 100};
    const Tessellation a = tessellate(pipe, frame, 0.5), b = tessellate(pipe, other, 0.5);
    ASSERT_EQ(a.mesh.vertices.size(), b.mesh.vertices.size());
    for (const Vec3d& v : a.mesh.vertices) {
      double nearest = 1e9;
      for (const Vec3d& w : b.mesh.vertices)
        nearest = std::min(nearest, std::sqrt(dot(v - w, v - w)));
      EXPECT_LT(nearest, 1e-9);
    }
  }
}

TEST(Tessellate, QuadrantsAreExact) {
  const Part part = part_of(tessellate(CylinderPrimitive{50, 10}, {}, 0.5));
  EXPECT_EQ(part.box, (Box3i{{-50000, -50000, -5000}, {50000, 50000, 5000}}));
  const Part ball = part_of(tessellate(SpherePrimitive{100}, {}, 0.5));
  EXPECT_EQ(ball.box, (Box3i{{-50000, -50000, -50000}, {50000, 50000, 50000}}));
}

TEST(Tessellate, ShearedConeEndsLieOnTheConeAndThePlane) {
  SnoutPrimitive s;
  s.bottom_radius = 100;
  s.top_radius = 40;
  s.height = 200;
  s.offset_x = 30;
  s.top_shear_x = 0.3;
  s.bottom_shear_y = -0.2;
  const Tessellation t = tessellate(s, {}, 0.1);
  ASSERT_EQ(t.fault, "");
  for (const Vec3d& v : t.mesh.vertices) {
    const double k = v.z / s.height + 0.5;
    EXPECT_NEAR(std::hypot(v.x - s.offset_x * (k - 0.5), v.y), 100 - 60 * k, 1e-9);
    const double bottom = -100 + std::tan(-0.2) * v.y;
    const double top = 100 + std::tan(0.3) * (v.x - 15);
    EXPECT_LT(std::min(std::fabs(v.z - bottom), std::fabs(v.z - top)), 1e-9);
  }
}

/// Cut along its skin, a cone that widens has an outline that bends far more than its circles do.
TEST(Tessellate, ShearedConeEndsKeepTheSag) {
  std::size_t tried = 0, tight = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const auto length = [&](double least, double most) {
      return std::exp(uniform(random, std::log(least), std::log(most)));
    };
    const auto shear = [&] { return random() % 3 == 0 ? 0 : uniform(random, -1.2, 1.2); };
    SnoutPrimitive s{length(0.1, 100), length(0.1, 100), length(0.1, 200)};
    if (random() % 2 == 0) {
      s.offset_x = uniform(random, -30, 30);
      s.offset_y = uniform(random, -30, 30);
    }
    s.bottom_shear_x = shear();
    s.bottom_shear_y = shear();
    s.top_shear_x = shear();
    s.top_shear_y = shear();
    const double sag = length(0.01, 5);
    std::optional<Vec3d> towards;
    if (random() % 2 == 0)
      towards = unit({uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)});
    const Tessellation t = tessellate(s, {}, sag, towards);
    if (!t.fault.empty()) continue;
    ++tried;
    constexpr std::size_t kMaxSegments = 4096;
    if (t.mesh.vertices.size() < 2 * kMaxSegments) {
      // Beside a contour a chord is up to a quarter longer.
      ASSERT_LE(t.mesh.sag_mm, sag * (towards ? 1.6 : 1 + 1e-12));
    }
    double worst = 0;
    for (const Vec3d& p : test::snout_outlines(s, 120))
      worst = std::max(worst, test::distance_to_mesh(t.mesh, p));
    ASSERT_LE(worst, t.mesh.sag_mm + 1e-7);
    if (worst > t.mesh.sag_mm / 2) ++tight;
  }
  EXPECT_GT(tried, 100U);
  EXPECT_GT(tight, tried / 2);
}

/// In a view too, whatever its contours: the rim of a straight reducer is that of the pipe.
TEST(Tessellate, ReducersHaveAsManySegmentsAsTheirPipe) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double r = uniform(random, 20, 300), sag = uniform(random, 0.02, 0.5);
    const Vec3d towards =
        unit({uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)});
    SnoutPrimitive reducer{r, r * uniform(random, 0.4, 0.95), r * uniform(random, 0.5, 4)};
    reducer.offset_x = random() % 2 == 0 ? 0 : r - reducer.top_radius;
    const auto pipe = tessellate(CylinderPrimitive{r, 100}, {}, sag, towards);
    const auto beside = tessellate(reducer, {}, sag, towards);
    // But for the two contours, which are added and take the place of their neighbours.
    EXPECT_LE(beside.mesh.vertices.size() / 2, pipe.mesh.vertices.size() / 2 + 2);
  }
}

TEST(Tessellate, FlatPrimitivesAreSheets) {
  const std::vector<Primitive> flat{
      BoxPrimitive{10, 20, 0},
      CylinderPrimitive{10, 0},
      EllipticalDishPrimitive{10, 0},
      SphericalDishPrimitive{10, 0},
      RectangularTorusPrimitive{5, 10, 0, 2},
      RectangularTorusPrimitive{0, 10, 0, 2 * kPi},
      RectangularTorusPrimitive{10, 10, 5, 2},
      PyramidPrimitive{10, 10, 10, 10, 0, 0, 0},
  };
  for (const Primitive& p : flat) {
    SCOPED_TRACE(kind_name(p));
    const Tessellation t = tessellate(p, {}, 0.5);
    ASSERT_EQ(t.fault, "");
    EXPECT_EQ(part_of(t).kind, PartKind::sheet);
  }
}

TEST(Tessellate, NonsenseIsRefusedWithAReason) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double huge = std::numeric_limits<double>::max();
  SnoutPrimitive crossing{50, 50, 10, 0, 0, 0.5, 0, -0.5, 0};
  SnoutPrimitive steep{50, 50, 10, 0, 0, kPi / 2, 0, 0, 0};
  const std::vector<Primitive> bad{
      BoxPrimitive{nan, 1, 1},
      BoxPrimitive{-1, 1, 1},
      BoxPrimitive{huge, 1, 1},
      PyramidPrimitive{1, 1, 1, 1, nan, 0, 1},
      CylinderPrimitive{0, 1},
      CylinderPrimitive{nan, 1},
      CylinderPrimitive{huge, huge},
      SnoutPrimitive{},
      crossing,
      steep,
      SnoutPrimitive{1, 1, 1, 0, 0, nan, 0, 0, 0},
      SpherePrimitive{0},
      SpherePrimitive{huge},
      EllipticalDishPrimitive{nan, 1},
      SphericalDishPrimitive{1, nan},
      SphericalDishPrimitive{huge, 1e-300},
      CircularTorusPrimitive{10, 0, 1},
      CircularTorusPrimitive{10, 1, 0},
      CircularTorusPrimitive{10, 1, nan},
      RectangularTorusPrimitive{20, 10, 1, 1},
      RectangularTorusPrimitive{1, 10, 1, -1},
      LinePrimitive{1, 0},
  };
  for (std::size_t i = 0; i < bad.size(); ++i)
    EXPECT_NE(tessellate(bad[i], {}, 0.5).fault, "") << i << ' ' << kind_name(bad[i]);
  Mat3d broken;
  broken.row[0].x = nan;
  EXPECT_NE(tessellate(BoxPrimitive{1, 1, 1}, broken, 0.5).fault, "");
  EXPECT_NE(tessellate(BoxPrimitive{1, 1, 1}, Mat3d{{Vec3d{}, Vec3d{}, Vec3d{}}}, 0.5).fault, "");
}

TEST(Tessellate, ALineIsAChainOfTwoPoints) {
  const Tessellation t = tessellate(LinePrimitive{5, 100}, {}, 0.5);
  EXPECT_EQ(t.lines.points, (std::vector<Vec3d>{{0, 0, -50}, {0, 0, 50}}));
}

}  // namespace
}  // namespace strake::geometry
