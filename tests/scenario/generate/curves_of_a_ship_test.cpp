// SPDX-License-Identifier: Apache-2.0
// The lines of a generated ship against all its solids, by points along them: no hit is missed,
// none is made up, and each is as deep as its deepest point.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/generate/ship.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/geometry/part_pair.hpp"
#include "strake/model/scene.hpp"

namespace strake::generate {
namespace {

using geometry::Part;
using geometry::PartKind;
using geometry::Vec3d;
using geometry::Vec3l;

/// Points of a line no farther apart than this, millimetres; a depth changes by no more.
constexpr double kStepMm = 20;

struct Solid {
  std::uint32_t object = 0;
  geometry::PlacedPart placed;
  geometry::TriangleBvh tree;
};

class CurvesOfAShip : public testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    Result<Ship> made = generate_ship({1200, 7, GetParam()}, {});
    ASSERT_TRUE(made.has_value());
    ship_ = std::move(*made);
    Result<model::Scene> scene = model::make_scene(ship_.model, {}, {});
    ASSERT_TRUE(scene.has_value());
    scene_ = std::move(*scene);
    for (std::uint32_t o = 0; o < ship_.model.objects.size(); ++o)
      for (const model::GridBody& body : scene_.bodies_of(model::ObjectId{o}))
        for (const Part& part : scene_.shapes[body.grid_shape].parts) add(o, {&part, body.origin});
  }

  void add(std::uint32_t object, const geometry::PlacedPart& placed) {
    if (placed.part->kind == PartKind::wire) wires_.emplace_back(object, placed);
    if (placed.part->kind == PartKind::solid)
      solids_.push_back({object, placed, geometry::TriangleBvh(*placed.part)});
  }

  /// Raises the depths of the pairs that a point of a line is inside of.
  void check_point(std::uint32_t object, const Vec3l& p) {
    for (const Solid& solid : solids_) {
      const Vec3l at = p - solid.placed.origin;
      const auto box = solid.placed.part->box.as<std::int64_t>();
      if (solid.object == object || !box.contains({at, at})) continue;
      geometry::QueryContext work;
      const geometry::PartWithBvh treed{solid.placed, &solid.tree};
      if (side_of(treed, at, 1, work) != geometry::PointSide::inside) continue;
      const double depth = distance_to_surface(treed, at.as<double>()) * geometry::kMmPerGrid;
      double& deepest = depths_[std::minmax(object, solid.object)];
      deepest = std::max(deepest, depth);
    }
  }

  void sample() {
    for (const auto& [object, wire] : wires_) {
      const std::vector<std::uint32_t>& first = wire.part->chain_first;
      for (std::size_t c = 0; c + 1 < first.size(); ++c)
        for (std::uint32_t i = first[c]; i + 1 < first[c + 1]; ++i) {
          const Vec3d p = wire.part->vertices[i].as<double>();
          const Vec3d e = wire.part->vertices[i + 1].as<double>() - p;
          const double length = std::sqrt(dot(e, e)) * geometry::kMmPerGrid;
          const int steps = 1 + static_cast<int>(length / kStepMm);
          for (int k = 0; k <= steps; ++k) {
            const Vec3d q = p + e * (static_cast<double>(k) / steps);
            check_point(object, wire.origin +
                                    Vec3l{std::llround(q.x), std::llround(q.y), std::llround(q.z)});
          }
        }
    }
  }

  Ship ship_;
  model::Scene scene_;
  std::vector<std::pair<std::uint32_t, geometry::PlacedPart>> wires_;
  std::vector<Solid> solids_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> depths_;  ///< mm
};

TEST_P(CurvesOfAShip, PointsAlongThemAgree) {
  ASSERT_GT(wires_.size(), 20U);
  sample();
  const Result<clash::Report> report =
      clash::detect(scene_, clash::one_set(scene_), {.engine = {.curves = clash::Curves::on}}, {});
  ASSERT_TRUE(report.has_value());
  std::map<std::pair<std::uint32_t, std::uint32_t>, clash::Pair> found;
  for (const clash::Pair& p : report->pairs) found.emplace(std::pair{index(p.a), index(p.b)}, p);
  constexpr double kRounding = 0.003;
  int hits = 0;
  for (const auto& [pair, depth] : depths_) {
    if (depth <= 1) continue;
    ++hits;
    const auto it = found.find(pair);
    ASSERT_NE(it, found.end()) << pair.first << ' ' << pair.second;
    EXPECT_EQ(it->second.cls, clash::Class::hit);
    EXPECT_LE(it->second.d_lower_mm, -depth + kRounding);
  }
  EXPECT_GT(hits, 20);
  std::vector<bool> is_line(ship_.model.objects.size(), false);
  for (const auto& wire : wires_) is_line[wire.first] = true;
  for (const auto& [pair, p] : found) {
    if (p.cls != clash::Class::hit || (!is_line[pair.first] && !is_line[pair.second])) continue;
    const auto it = depths_.find(pair);
    const double sampled = it == depths_.end() ? 0 : it->second;
    EXPECT_LE(-p.d_upper_mm, sampled + kStepMm / 2 + kRounding) << pair.first << ' ' << pair.second;
  }
}

INSTANTIATE_TEST_SUITE_P(Ships, CurvesOfAShip, testing::Bool());

}  // namespace
}  // namespace strake::generate
