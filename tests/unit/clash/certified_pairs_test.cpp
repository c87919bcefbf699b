// SPDX-License-Identifier: Apache-2.0
// Pairs whose separation is known by construction: the bracket of every answer must hold the truth
// and be narrow, in general position, in either order, and a thousand kilometres away.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/geometry/grid.hpp"
#include "support/clash_model.hpp"
#include "support/draw.hpp"
#include "support/revolved_meshes.hpp"

namespace strake::clash {
namespace {

using geometry::Mat3d;
using geometry::Placement;
using geometry::Primitive;
using geometry::TriangleMesh;
using geometry::Vec3d;
using test::ClashModel;

constexpr int kSeeds = 60;

class Draw : public test::Draw {
 public:
  using test::Draw::Draw;

  double operator()(double lo, double hi) { return between(lo, hi); }
  /// One of the lengths that distinguish the classes, well away from any threshold.
  double gap() {
    constexpr std::array<double, 10> kGaps{-40, -9, -2.5, -0.6, -0.02, 0.02, 0.7, 3, 11, 24};
    return kGaps[below(kGaps.size())];
  }
};

Vec3d on_grid(const Vec3d& p) { return geometry::to_mm(geometry::snap(p).value()); }

/// v in the frame whose axes are the columns of m.
Vec3d in_frame(const Mat3d& m, const Vec3d& v) {
  Vec3d r;
  for (int k = 0; k < 3; ++k) r[k] = m.row[0][k] * v.x + m.row[1][k] * v.y + m.row[2][k] * v.z;
  return r;
}

struct Body {
  model::Shape shape;
  Placement at;
};

const Options kOptions{.tolerances = {.clearance_mm = 25}};

Class class_of(double d) {
  if (d < -1) return Class::hit;
  if (d <= 1) return Class::contact;
  return d < 25 ? Class::clearance_violation : Class::no_hit;
}

std::optional<Pair> found(const Body& a, const Body& b, const Vec3d& shift = {}) {
  ClashModel m;
  Body x = a, y = b;
  x.at.translation = x.at.translation + shift;
  y.at.translation = y.at.translation + shift;
  m.object("a").body(x.shape, x.at);
  m.object("b").body(y.shape, y.at);
  const Report report = m.detect(kOptions);
  if (report.pairs.empty()) return std::nullopt;
  return report.pairs.front();
}

/// `slack_mm`: what the snap of a mesh's vertices may add to the bracket.
void expect_truth(const Body& a, const Body& b, double d_mm, double width_mm, double slack_mm,
                  const std::string& what) {
  const auto p = found(a, b);
  if (class_of(d_mm) == Class::no_hit) {
    EXPECT_FALSE(p) << what;
    return;
  }
  ASSERT_TRUE(p) << what << " d " << d_mm;
  EXPECT_EQ(name(p->cls), name(class_of(d_mm))) << what << " d " << d_mm;
  EXPECT_LE(p->d_lower_mm, d_mm + slack_mm) << what;
  EXPECT_GE(p->d_upper_mm, d_mm - slack_mm) << what;
  EXPECT_LE(p->d_upper_mm - p->d_lower_mm, width_mm) << what << " d " << d_mm;
  EXPECT_EQ(p->flags, 0) << what;
  const auto q = found(b, a);
  ASSERT_TRUE(q) << what;
  EXPECT_EQ(q->d_mm, p->d_mm) << what;
  EXPECT_EQ(q->d_lower_mm, p->d_lower_mm) << what;
  EXPECT_EQ(q->d_upper_mm, p->d_upper_mm) << what;
  EXPECT_EQ(q->cls, p->cls) << what;
  // A quarter of a million kilometres off, by whole millimetres.
  const auto far = found(a, b, {123'456'789, -98'765'432, 250'000'000});
  ASSERT_TRUE(far) << what;
  EXPECT_EQ(far->cls, p->cls) << what;
  EXPECT_NEAR(far->d_mm, p->d_mm, 4e-4) << what;
}

/// Common part of two intervals of half lengths a and b, `at` apart.
struct Span {
  double a, b, at;
  [[nodiscard]] double gap() const { return std::max(0.0, std::fabs(at) - a - b); }
  /// How deep in a its point nearest to a's centre lies that is in b too.
  [[nodiscard]] double in_a() const { return a - std::max(0.0, std::fabs(at) - b); }
  [[nodiscard]] double in_b() const { return b - std::max(0.0, std::fabs(at) - a); }
};

/// For bodies that are products of spans: docs/clash.md, "Signed separation".
template <std::size_t n>
double separation(const std::array<Span, n>& spans) {
  double squares = 0, in_a = 1e300, in_b = 1e300;
  for (const Span& s : spans) {
    squares += s.gap() * s.gap();
    in_a = std::min(in_a, s.in_a());
    in_b = std::min(in_b, s.in_b());
  }
  return squares > 0 ? std::sqrt(squares) : -std::max(in_a, in_b);
}

TEST(CertifiedPairs, BoxesInACommonFrame) {
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Draw draw(static_cast<std::uint64_t>(seed));
    const Mat3d turn = draw.rotation();
    const Vec3d a{draw(20, 900), draw(20, 900), draw(20, 900)};
    const Vec3d b{draw(20, 900), draw(20, 900), draw(20, 900)};
    Vec3d at{draw(-300, 300), draw(-300, 300), draw(-300, 300)};
    const int along = seed % 3;
    at[along] = (a[along] + b[along]) / 2 + draw.gap();
    const Placement pa{turn, on_grid({draw(-9, 9), draw(-9, 9), draw(-9, 9)})};
    const Placement pb{turn, on_grid(pa.translation + turn * at)};
    const Vec3d off = in_frame(turn, pb.translation - pa.translation);
    const double d = separation<3>(
        {{{a.x / 2, b.x / 2, off.x}, {a.y / 2, b.y / 2, off.y}, {a.z / 2, b.z / 2, off.z}}});
    if (std::fabs(d) > 24.9 && d > 0) continue;
    expect_truth({geometry::Primitive{geometry::BoxPrimitive{a.x, a.y, a.z}}, pa},
                 {geometry::Primitive{geometry::BoxPrimitive{b.x, b.y, b.z}}, pb}, d, 0.016, 0,
                 "boxes, seed " + std::to_string(seed));
  }
}

TEST(CertifiedPairs, BoxesNestedEqualAndThrough) {
  Draw draw(7);
  for (int i = 0; i < 20; ++i) {
    const Mat3d turn = draw.rotation();
    const Placement here{turn, {}}, off{turn, on_grid(turn * Vec3d{100, -50, 30})};
    const Body room{Primitive{geometry::BoxPrimitive{1000, 900, 800}}, here};
    const Vec3d at = in_frame(turn, off.translation);
    expect_truth(room, {Primitive{geometry::BoxPrimitive{100, 100, 100}}, off},
                 separation<3>({{{500, 50, at.x}, {450, 50, at.y}, {400, 50, at.z}}}), 0.016, 0,
                 "nested");
    expect_truth(room, room, -400, 0.016, 0, "equal");
    expect_truth(room, {Primitive{geometry::BoxPrimitive{60, 60, 3000}}, off},
                 separation<3>({{{500, 30, at.x}, {450, 30, at.y}, {400, 1500, at.z}}}), 0.016, 0,
                 "through");
  }
}

TEST(CertifiedPairs, BoxCornerOverAFace) {
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Draw draw(static_cast<std::uint64_t>(seed) + 1000);
    const Mat3d turn = draw.rotation(), other = draw.rotation();
    const Placement floor{turn, on_grid({draw(-9, 9), draw(-9, 9), draw(-9, 9)})};
    const geometry::BoxPrimitive box{draw(30, 200), draw(30, 200), draw(30, 200)};
    // The corner of the box that lies deepest along the floor's normal.
    const Vec3d normal = turn * Vec3d{0, 0, 1}, n = in_frame(other, normal);
    const double reach = (std::fabs(n.x) * box.length_x + std::fabs(n.y) * box.length_y +
                          std::fabs(n.z) * box.length_z) /
                         2;
    // Sharp corners only: a flat one is as deep in its own box as in the floor, or deeper.
    const double gap = std::max(-9.0, draw.gap());
    const Vec3d centre = floor.translation + turn * Vec3d{draw(-100, 100), draw(-100, 100), 0} +
                         normal * (500 + reach + gap);
    const Placement at{other, on_grid(centre)};
    const double d = dot(normal, at.translation - floor.translation) - 500 - reach;
    if (d > 24.9) continue;
    expect_truth({Primitive{geometry::BoxPrimitive{3000, 3000, 1000}}, floor}, {Primitive{box}, at},
                 d, 0.016, 0, "corner, seed " + std::to_string(seed));
  }
}

TEST(CertifiedPairs, Spheres) {
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Draw draw(static_cast<std::uint64_t>(seed) + 2000);
    const double r = draw(5, 900), s = draw(5, 900);
    const Vec3d way = draw.rotation().row[0];
    const Placement pa{draw.rotation(), on_grid({draw(-9, 9), draw(-9, 9), draw(-9, 9)})};
    const double distance = seed % 4 == 0 ? std::fabs(r - s) * draw(0.1, 0.9) : r + s + draw.gap();
    const Placement pb{draw.rotation(), on_grid(pa.translation + way * distance)};
    const Vec3d off = pb.translation - pa.translation;
    const double apart = std::sqrt(dot(off, off));
    const double d = apart >= r + s
                         ? apart - r - s
                         : -std::max(r - std::max(0.0, apart - s), s - std::max(0.0, apart - r));
    expect_truth({Primitive{geometry::SpherePrimitive{2 * r}}, pa},
                 {Primitive{geometry::SpherePrimitive{2 * s}}, pb}, d, 1e-5, 0,
                 "spheres, seed " + std::to_string(seed));
  }
}

TEST(CertifiedPairs, SphereAtAFaceAnEdgeOrACorner) {
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Draw draw(static_cast<std::uint64_t>(seed) + 3000);
    const Mat3d turn = draw.rotation();
    const double r = draw(50, 400);
    const Vec3d half{draw(100, 900), draw(100, 900), draw(100, 900)};
    // A point of the box and a way out of it there.
    Vec3d on, out;
    const int features = 1 + seed % 3;
    for (int k = 0; k < 3; ++k) {
      on[k] = k < features ? half[k] : draw(-0.9, 0.9) * half[k];
      out[k] = k < features ? draw(0.2, 1) : 0;
    }
    const Vec3d way = out * (1 / std::sqrt(dot(out, out)));
    const Placement pa{turn, on_grid({draw(-9, 9), draw(-9, 9), draw(-9, 9)})};
    const Placement pb{draw.rotation(),
                       on_grid(pa.translation + turn * (on + way * (r + draw.gap())))};
    const Vec3d c = in_frame(turn, pb.translation - pa.translation);
    Vec3d beyond;
    for (int k = 0; k < 3; ++k) beyond[k] = std::max(0.0, std::fabs(c[k]) - half[k]);
    const double d = std::sqrt(dot(beyond, beyond)) - r;
    // Deep at an edge the ball may be deeper in the box than the box in the ball: never by more
    // than the ball's own depth, which a sphere outside of the box's middle planes has.
    expect_truth({Primitive{geometry::BoxPrimitive{2 * half.x, 2 * half.y, 2 * half.z}}, pa},
                 {Primitive{geometry::SpherePrimitive{2 * r}}, pb}, d, 1e-4, 1e-5,
                 "sphere and box, seed " + std::to_string(seed));
  }
}

TEST(CertifiedPairs, CylindersSideBySideEndToEndAndInside) {
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Draw draw(static_cast<std::uint64_t>(seed) + 4000);
    const Mat3d turn = draw.rotation();
    const double r = draw(10, 300), s = draw(10, 300), h = draw(50, 900), k = draw(50, 900);
    Vec3d at{};
    if (seed % 3 == 0) at = {r + s + draw.gap(), 0, draw(-1, 1) * (h + k) / 2};
    if (seed % 3 == 1) at = {draw(-1, 1) * (r + s), 0, (h + k) / 2 + draw.gap()};
    if (seed % 3 == 2) at = {draw(0, 1) * std::fabs(r - s), 0, draw(0, 1) * std::fabs(h - k) / 2};
    if (seed % 9 < 3) at.x = 0;  // one axis
    // The second may stand on its head and turn about its axis.
    Mat3d other = turn;
    if (seed % 2 == 0) {
      const Mat3d head{{Vec3d{0.6, 0.8, 0}, Vec3d{0.8, -0.6, 0}, Vec3d{0, 0, -1}}};
      other = turn * head;
    }
    const Placement pa{turn, on_grid({draw(-9, 9), draw(-9, 9), draw(-9, 9)})};
    const Placement pb{other, on_grid(pa.translation + turn * at)};
    const Vec3d off = in_frame(turn, pb.translation - pa.translation);
    const double d =
        separation<2>({{{r, s, std::sqrt(off.x * off.x + off.y * off.y)}, {h / 2, k / 2, off.z}}});
    if (d > 24.9) continue;
    expect_truth({Primitive{geometry::CylinderPrimitive{r, h}}, pa},
                 {Primitive{geometry::CylinderPrimitive{s, k}}, pb}, d, 1e-4, 0,
                 "cylinders, seed " + std::to_string(seed));
  }
}

/// The hull of a random point set on a sphere, as the dual of nothing fancy: a tetrahedron, an
/// octahedron or a prism, squeezed and turned.
TriangleMesh convex_mesh(Draw& draw, int kind) {
  TriangleMesh m;
  if (kind == 0) {
    m.vertices = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    m.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  } else if (kind == 1) {
    m.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    m.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                   {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  } else {
    m = test::cylinder_mesh(1, 2, 1, static_cast<std::uint32_t>(kind));
    for (Vec3d& v : m.vertices) v.z -= 1;
  }
  const Vec3d size{draw(60, 300), draw(60, 300), draw(60, 300)};
  const Mat3d turn = draw.rotation();
  for (Vec3d& v : m.vertices) v = on_grid(turn * Vec3d{v.x * size.x, v.y * size.y, v.z * size.z});
  return m;
}

/// A convex body's lowest corner over the middle of the face of a huge one: apart or shallow, the
/// separation is its height.
TEST(CertifiedPairs, ConvexMeshOverAFaceOfAnother) {
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Draw draw(static_cast<std::uint64_t>(seed) + 5000);
    const TriangleMesh body = convex_mesh(draw, seed % 6 < 2 ? seed % 6 : 3 + seed % 6);
    const Mat3d turn = draw.rotation();
    TriangleMesh floor = test::box_mesh({-4000, -4000, -3000}, {4000, 4000, 0});
    for (Vec3d& v : floor.vertices) v = on_grid(turn * v);
    const Vec3d up = turn * Vec3d{0, 0, 1};
    double lowest = 1e300;
    for (const Vec3d& v : body.vertices) lowest = std::min(lowest, dot(up, v));
    const double gap = std::max(-9.0, draw.gap());
    const Placement at{{}, on_grid(up * (gap - lowest))};
    const double d = dot(up, at.translation) + lowest;
    if (d > 24.9) continue;
    expect_truth({floor, {}}, {body, at}, d, 0.016, 0.002, "convex, seed " + std::to_string(seed));
  }
}

/// A small convex body in a huge one, near one of its faces: as deep as its highest corner.
TEST(CertifiedPairs, ConvexMeshInsideAnother) {
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Draw draw(static_cast<std::uint64_t>(seed) + 6000);
    const TriangleMesh body = convex_mesh(draw, seed % 6 < 2 ? seed % 6 : 3 + seed % 6);
    const Mat3d turn = draw.rotation();
    TriangleMesh block = test::box_mesh({-4000, -4000, -6000}, {4000, 4000, 0});
    for (Vec3d& v : block.vertices) v = on_grid(turn * v);
    const Vec3d up = turn * Vec3d{0, 0, 1};
    double lowest = 1e300, highest = -1e300;
    for (const Vec3d& v : body.vertices) {
      lowest = std::min(lowest, dot(up, v));
      highest = std::max(highest, dot(up, v));
    }
    const Placement at{{}, on_grid(up * (-draw(5, 300) - highest))};
    const double d = dot(up, at.translation) + lowest;
    expect_truth({block, {}}, {body, at}, d, 0.016, 0.002, "inside, seed " + std::to_string(seed));
    const auto p = found({block, {}}, {body, at});
    ASSERT_TRUE(p);
    EXPECT_EQ(p->relation, Relation::b_in_a);
  }
}

/// A pipe's true surface stands out of its triangles: however it is turned about its axis, a mesh
/// within the touch gap of the pipe is a contact, also where the triangles are farther than that.
TEST(CertifiedPairs, PipeBesideAMeshHoweverItsTrianglesLie) {
  constexpr double kRadius = 500, kGap = 0.98;
  for (int i = 0; i < 48; ++i) {
    const double angle = 0.004 * i, c = std::cos(angle), z = std::sin(angle);
    ClashModel m;
    m.object("pipe").body(geometry::CylinderPrimitive{kRadius, 300},
                          {Mat3d{{Vec3d{c, -z, 0}, Vec3d{z, c, 0}, Vec3d{0, 0, 1}}}, {}});
    m.box("plate", {kRadius + kGap, -600, -600}, {kRadius + 20, 600, 600});
    const Report report = m.detect();
    ASSERT_EQ(report.pairs.size(), 1U) << angle;
    EXPECT_EQ(report.pairs[0].cls, Class::contact) << angle;
    EXPECT_LE(report.pairs[0].d_lower_mm, kGap + 1e-3);
    EXPECT_GE(report.pairs[0].d_upper_mm, kGap - 1e-3);
  }
}

}  // namespace
}  // namespace strake::clash
