// SPDX-License-Identifier: Apache-2.0
// The contours of cones, eccentric ones and with sloped ends too, and of cylinders with sloped
// ends: the true generators are edges, in a view in one direction and from an eye.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "geometry/numeric/trig.hpp"
#include "geometry/primitives/tessellate.hpp"
#include "support/contour_edges.hpp"
#include "support/random_primitives.hpp"
#include "support/rounds.hpp"

namespace strake::geometry {
namespace {

using test::Net;
using test::PrimitiveDraw;

SnoutPrimitive some_snout(PrimitiveDraw& draw, int i) {
  SnoutPrimitive s{draw.between(20, 80), draw.between(20, 80), draw.between(60, 300)};
  if (i % 3 == 0) s.top_radius = s.bottom_radius;
  if (i % 7 == 1) s.top_radius = 0;
  if (i % 2 == 0) s.offset_x = draw.between(-60, 60), s.offset_y = draw.between(-60, 60);
  if (i % 3 != 1) {
    s.bottom_shear_x = draw.between(-0.3, 0.3), s.bottom_shear_y = draw.between(-0.3, 0.3);
    s.top_shear_x = draw.between(-0.3, 0.3), s.top_shear_y = draw.between(-0.3, 0.3);
  }
  return s;
}

/// How much a snout looks towards a viewer along the generator at an angle.
struct Viewer {
  SnoutPrimitive snout;
  Vec3d at;
  bool is_eye = false;

  [[nodiscard]] double facing(double angle) const {
    const double x = std::cos(angle), y = std::sin(angle);
    const double grow = snout.top_radius - snout.bottom_radius;
    const Vec3d normal = test::unit(
        {snout.height * x, snout.height * y, -(snout.offset_x * x + snout.offset_y * y + grow)});
    const Vec3d on_bottom{snout.bottom_radius * x - snout.offset_x / 2,
                          snout.bottom_radius * y - snout.offset_y / 2, -snout.height / 2};
    return dot(normal, is_eye ? test::unit(at - on_bottom) : at);
  }
  /// The angle of the generator through a point of the skin.
  [[nodiscard]] double angle_of(const Vec3d& p) const {
    const double k = p.z / snout.height;
    return std::atan2(p.y - snout.offset_y * k, p.x - snout.offset_x * k);
  }
  /// Where it turns away, at even steps.
  [[nodiscard]] std::vector<double> turns() const {
    std::vector<double> all;
    constexpr int kSteps = 7200;
    for (int k = 0; k < kSteps; ++k) {
      const double from = 2 * kPi * k / kSteps, to = 2 * kPi * (k + 1) / kSteps;
      if ((facing(from) > 0) != (facing(to) > 0)) all.push_back((from + to) / 2);
    }
    return all;
  }
};

/// Whether both contours are edges, and nothing else is; none where there are none, or two hardly
/// apart.
bool has_true_contours(const Viewer& viewer, const Tessellation& t) {
  const auto edges =
      viewer.is_eye ? Net(t.mesh).contours_from(viewer.at) : Net(t.mesh).contours(viewer.at);
  const std::vector<double> turns = viewer.turns();
  EXPECT_TRUE(turns.empty() || turns.size() == 2);
  if (turns.size() == 2) {
    const double apart = turns[1] - turns[0],
                 step = 4 * kPi / static_cast<double>(t.mesh.vertices.size());
    if (std::min(apart, 2 * kPi - apart) > step) {
      EXPECT_EQ(edges.size(), 2U);
    }
  } else {
    EXPECT_TRUE(edges.empty());
  }
  for (const auto& [a, b] : edges)
    for (const Vec3d& p : {a, b}) {
      // At an apex all generators meet.
      const Vec3d other =
          std::fabs(p.z - viewer.snout.height / 2) < 1e-6 ? (p.z == a.z ? b : a) : p;
      EXPECT_LT(std::fabs(viewer.facing(viewer.angle_of(other))), 1e-9);
    }
  return edges.size() == 2;
}

TEST(SnoutContours, AreTheTrueGenerators) {
  PrimitiveDraw draw(31);
  int visible_count = 0, drawn = 0;
  for (int i = 0; i < test::rounds(600); ++i) {
    SCOPED_TRACE(i);
    const SnoutPrimitive snout = some_snout(draw, i);
    const Vec3d towards = draw.direction();
    const double away = draw.between(100, i % 2 == 0 ? 600 : 20000);
    const Vec3d eye = towards * away;
    for (const bool is_eye : {false, true}) {
      const Tessellation t =
          is_eye ? tessellate_from(eye, snout, {}, 0.5) : tessellate(snout, {}, 0.5, towards);
      if (!t.fault.empty()) continue;
      ++visible_count;
      if (has_true_contours({snout, is_eye ? eye : towards, is_eye}, t)) ++drawn;
    }
  }
  EXPECT_GT(visible_count, test::rounds(600));
  EXPECT_GT(drawn, visible_count / 2);
}

}  // namespace
}  // namespace strake::geometry
