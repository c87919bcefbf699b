// SPDX-License-Identifier: Apache-2.0
// What is closed up to the precision of its source is a solid: what stands in it is found, as deep
// as in the clean body; what is open to an engineer stays open.
#include "support/near_closed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "support/clash_model.hpp"
#include "support/rounds.hpp"

namespace strake {
namespace {

using geometry::Mat3d;
using geometry::PartKind;
using geometry::TriangleMesh;
using geometry::Vec3d;
using test::ClashModel;
using test::ClosedBody;
using test::Draw;

/// A box that stands in the largest ball of a body.
TriangleMesh box_within(const ClosedBody& body) {
  const double half = body.radius / 4;
  const Vec3d by{half, half, half};
  return test::box_mesh(body.centre - by, body.centre + by);
}

model::Scene scene_of(const ClashModel& m, double weld_mm) {
  model::SceneOptions options = clash::scene_options({});
  options.weld_mm = weld_mm;
  return make_scene(m.model, options, {}).value();
}

std::uint64_t count_of(const model::Scene& scene, PartKind kind) {
  std::uint64_t count = 0;
  for (const model::GridShape& shape : scene.shapes)
    for (const geometry::Part& part : shape.parts) count += part.kind == kind ? 1U : 0U;
  return count;
}

/// The body and the box in it, in this order or the other.
ClashModel pair_of(const TriangleMesh& body, const TriangleMesh& within, bool swapped,
                   double precision_mm = 0) {
  ClashModel m;
  if (swapped)
    m.object("within").body(within).object("body").body(body);
  else
    m.object("body").body(body).object("within").body(within);
  for (model::Body& b : m.model.bodies) b.precision_um = static_cast<float>(precision_mm * 1000);
  return m;
}

clash::Report found(const model::Scene& scene) {
  return clash::detect(scene, clash::one_set(scene), {}, {}).value();
}

/// The pair is a hit, as deep as that of the clean body to within what its corners moved.
void expect_same_hit(const ClashModel& clean, const model::Scene& scene, double within_mm) {
  const model::Scene plain = scene_of(clean, 0);
  const clash::Report right = found(plain), report = found(scene);
  ASSERT_EQ(right.pairs.size(), 1U);
  ASSERT_EQ(report.pairs.size(), 1U);
  const clash::Pair &is = report.pairs[0], &was = right.pairs[0];
  EXPECT_EQ(is.cls, clash::Class::hit);
  EXPECT_EQ(is.relation, was.relation);
  EXPECT_LE(is.d_lower_mm - within_mm, was.d_upper_mm);
  EXPECT_GE(is.d_upper_mm + within_mm, was.d_lower_mm);
  EXPECT_EQ(is.flags & clash::kOpen, 0);
}

class NearClosed : public ::testing::TestWithParam<std::uint64_t> {};

// Corners of one point are no farther apart than twice the jitter, and each is snapped.
TEST_P(NearClosed, SoupWithCornersALittleOff) {
  Draw draw(GetParam());
  const ClosedBody body = test::drawn_body(draw);
  for (const double weld_mm : {0.003, 0.02, 0.1}) {
    SCOPED_TRACE(weld_mm);
    const Mat3d turn = draw.rotation();
    const Vec3d by{draw.between(-1e5, 1e5), draw.between(-1e5, 1e5), draw.between(-1e5, 1e5)};
    TriangleMesh clean = body.mesh, within = box_within(body);
    TriangleMesh soup = test::soup_of(body.mesh);
    test::split_sides_mm(soup, static_cast<int>(draw.below(12)), 4 * weld_mm, draw);
    soup = test::soup_of(soup);
    test::jitter(soup, (weld_mm - 0.0018) / 2, draw);
    test::shuffle(soup, draw);
    for (TriangleMesh* const mesh : {&clean, &within, &soup}) test::place_mesh(*mesh, turn, by);
    const bool swapped = draw.one_in(2);
    const ClashModel m = pair_of(soup, within, swapped);
    const model::Scene scene = scene_of(m, weld_mm);
    EXPECT_EQ(count_of(scene, PartKind::sheet), 0U);
    EXPECT_EQ(count_of(scene, PartKind::solid), 2U);
    expect_same_hit(pair_of(clean, within, swapped), scene, 4 * weld_mm);
  }
}

// Two units in the last place, whatever the way from the origin.
TEST_P(NearClosed, Float32FarFromTheOrigin) {
  Draw draw(GetParam());
  const ClosedBody body = test::drawn_body(draw);
  for (const double away : {0.0, 3e5, 5e6}) {
    SCOPED_TRACE(away);
    const Mat3d turn = draw.rotation();
    TriangleMesh soup = test::soup_of(body.mesh), clean = body.mesh, within = box_within(body);
    test::split_sides_mm(soup, 6, 2, draw);
    soup = test::soup_of(soup);
    for (TriangleMesh* const mesh : {&clean, &within, &soup})
      test::place_mesh(*mesh, turn, {away, away / 2, -away});
    const double precision = test::through_float32(soup);
    const ClashModel m = pair_of(soup, within, false, precision);
    const model::Scene scene = scene_of(m, -1);
    EXPECT_EQ(count_of(scene, PartKind::sheet), 0U);
    expect_same_hit(pair_of(clean, within, false), scene, 16 * precision + 0.01);
  }
}

// What is wider than the corners of one point may be stays open, and what was absent is.
TEST_P(NearClosed, AGapThreeTimesAsWideStaysOpen) {
  Draw draw(GetParam());
  const double weld_mm = draw.between(0.003, 0.2);
  const double x = draw.between(50, 2000), y = draw.between(50, 2000), z = draw.between(50, 2000);
  TriangleMesh box = test::closed_box(x, y, z).mesh;
  for (geometry::Triangle& t : box.triangles) {
    bool lid = true;
    for (const std::uint32_t v : t) lid = lid && box.vertices[v].z > 0;
    for (std::uint32_t& v : t) {
      if (!lid) continue;
      box.vertices.push_back(box.vertices[v] + Vec3d{0, 0, 3 * weld_mm + 0.003});
      v = static_cast<std::uint32_t>(box.vertices.size() - 1);
    }
  }
  const Mat3d turn = draw.rotation();
  TriangleMesh within = test::box_mesh({-5, -5, -5}, {5, 5, 5});
  for (TriangleMesh* const mesh : {&box, &within}) test::place_mesh(*mesh, turn, {100, 200, 300});
  const ClashModel m = pair_of(box, within, draw.one_in(2));
  const model::Scene scene = scene_of(m, weld_mm), exact = scene_of(m, 0);
  EXPECT_EQ(count_of(scene, PartKind::sheet), 1U);
  EXPECT_EQ(scene.diagnostics.count("mesh-welded"), 0U);
  const auto same = [](const geometry::Part& p, const geometry::Part& q) {
    return p.vertices == q.vertices && p.triangles == q.triangles;
  };
  ASSERT_EQ(scene.shapes.size(), exact.shapes.size());
  for (std::size_t s = 0; s < scene.shapes.size(); ++s)
    EXPECT_TRUE(std::ranges::equal(scene.shapes[s].parts, exact.shapes[s].parts, same));
}

/// A box with a lid of its own, so far above the walls, and as large as they reach.
TriangleMesh lid_above(const Vec3d& size, double gap) {
  TriangleMesh box = test::closed_box(size.x, size.y, size.z).mesh;
  const std::vector<Vec3d> all = box.vertices;
  for (geometry::Triangle& t : box.triangles) {
    if (!std::ranges::all_of(t, [&](std::uint32_t v) { return all[v].z > 0; })) continue;
    for (std::uint32_t& v : t) {
      box.vertices.push_back(all[v] + Vec3d{0, 0, gap});
      v = static_cast<std::uint32_t>(box.vertices.size() - 1);
    }
  }
  return box;
}

/// What is reported a lidded box and a block that stands `d` above the lid, or as deep in it.
clash::Report lid_and_block(double gap, double d, Draw& draw, const clash::Options& options) {
  const double x = draw.between(100, 900), y = draw.between(100, 900), z = draw.between(100, 900);
  TriangleMesh box = lid_above({x, y, z}, gap);
  const double top = z / 2 + gap + d;
  TriangleMesh block = test::box_mesh({-20, -20, top}, {20, 20, top + 40});
  const Mat3d turn = draw.one_in(2) ? draw.rotation() : Mat3d{};
  const Vec3d by{draw.between(-1e4, 1e4), draw.between(-1e4, 1e4), draw.between(-1e4, 1e4)};
  for (TriangleMesh* const mesh : {&box, &block}) test::place_mesh(*mesh, turn, by);
  const ClashModel m = pair_of(box, block, draw.one_in(2));
  const model::Scene scene = scene_of(m, gap + 0.004);
  EXPECT_EQ(count_of(scene, PartKind::solid), 2U);
  return clash::detect(scene, clash::one_set(scene), options, {}).value();
}

// The lid comes down to the walls, or these up to it: the bracket holds what the source says.
TEST_P(NearClosed, TheBracketHoldsWhereTheLidWas) {
  Draw draw(GetParam());
  for (const double gap : {0.002, 0.0031, 0.4, 4.9}) {
    const double d = draw.between(-3, 8);
    SCOPED_TRACE(std::to_string(gap) + ' ' + std::to_string(d));
    const clash::Report report = lid_and_block(gap, d, draw, {.tolerances = {.clearance_mm = 30}});
    ASSERT_EQ(report.pairs.size(), 1U);
    EXPECT_LE(report.pairs[0].d_lower_mm, d);
    EXPECT_GE(report.pairs[0].d_upper_mm, d);
    EXPECT_LE(report.pairs[0].d_upper_mm - report.pairs[0].d_lower_mm, 4 * gap + 0.05);
  }
}

// A weld takes nothing out of a tolerance unsaid.
TEST_P(NearClosed, WhatTheLidWasNearerThanIsReported) {
  Draw draw(GetParam());
  for (const double gap : {0.002, 0.0031, 0.4, 4.9})
    for (const double d : {0.0, 7.9}) {
      SCOPED_TRACE(std::to_string(gap) + ' ' + std::to_string(d));
      const clash::Options options{
          .tolerances = {.clearance_mm = d + 0.0001, .touch_gap_mm = 0, .touch_overlap_mm = 0}};
      const clash::Report report = lid_and_block(gap, d, draw, options);
      ASSERT_EQ(report.pairs.size(), 1U);
      EXPECT_GE(report.pairs[0].severest, clash::Class::clearance_violation);
      if (d == 0 && gap > 0.1) {
        EXPECT_GE(report.pairs[0].severest, clash::Class::contact);
      }
    }
}

// What the numbers of the source close is closed whatever is requested besides.
TEST_P(NearClosed, AWiderWeldClosesNoLess) {
  Draw draw(GetParam());
  const ClosedBody body = test::drawn_body(draw);
  TriangleMesh soup = test::soup_of(body.mesh), clean = body.mesh, within = box_within(body);
  test::jitter(soup, 0.0005, draw);
  test::shuffle(soup, draw);
  const Mat3d turn = draw.rotation();
  for (TriangleMesh* const mesh : {&clean, &within, &soup})
    test::place_mesh(*mesh, turn, {7, 8, 9});
  const bool swapped = draw.one_in(2);
  const ClashModel m = pair_of(soup, within, swapped);
  for (const double weld_mm : {-1.0, 0.02, 0.5, 2.0, 10.0, 300.0}) {
    SCOPED_TRACE(weld_mm);
    const model::Scene scene = scene_of(m, weld_mm);
    EXPECT_EQ(count_of(scene, PartKind::sheet), 0U);
    expect_same_hit(pair_of(clean, within, swapped), scene, 0.02);
  }
}

// A body in many places is one shape, however exact its places are.
TEST(NearClosedScenes, InstancesShareAShape) {
  const TriangleMesh box = test::closed_box(100, 200, 300).mesh;
  ClashModel m;
  m.object("all").body(box);
  for (int i = 1; i < 20; ++i) m.again({{}, {1000.0 * i, 0, 0}});
  for (std::size_t i = 0; i < m.model.bodies.size(); ++i)
    m.model.bodies[i].precision_um = static_cast<float>(1U << (i % 5));
  EXPECT_EQ(scene_of(m, -1).shapes.size(), 1U);
}

// How far corners were moved is reported in the unit that suits it.
TEST(NearClosedScenes, ALongWeldIsReportedInMillimetres) {
  ClashModel m;
  m.object("box").body(lid_above({300, 200, 100}, 4.9));
  const auto reported = [&](double weld_mm) {
    const model::Scene scene = scene_of(m, weld_mm);
    for (const Diagnostic& d : scene.diagnostics.kept())
      if (d.code == "mesh-welded") return d.message;
    return std::string();
  };
  EXPECT_NE(reported(5).find("4.900 mm"), std::string::npos) << reported(5);
  m = {};
  m.object("box").body(lid_above({300, 200, 100}, 0.05));
  EXPECT_NE(reported(1).find("50 um"), std::string::npos) << reported(1);
}

INSTANTIATE_TEST_SUITE_P(Drawn, NearClosed,
                         test::seeds(test::rounds(std::uint64_t{60}, std::uint64_t{2000})));

}  // namespace
}  // namespace strake
