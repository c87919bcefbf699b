// SPDX-License-Identifier: Apache-2.0
#include "support/solid_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string_view>
#include <vector>

#include "geometry/primitives/tessellate.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/geometry/predicates.hpp"
#include "support/clash_model.hpp"
#include "support/lattice_solids.hpp"
#include "support/random_primitives.hpp"

namespace strake::test {
namespace {

using geometry::Vec3d;
using geometry::Vec3i;
using testing::IndexedMesh;
using testing::LatticeMap;

/// Every coordinate is a multiple of this, so that three turns by fifths stay on the grid.
constexpr std::int32_t kStep = 125;

Vec3i on_steps(const Vec3d& grid) {
  Vec3i v;
  for (int k = 0; k < 3; ++k)
    v[k] = kStep * static_cast<std::int32_t>(std::lround(grid[k] / kStep));
  return v;
}

void move(IndexedMesh& mesh, const Vec3i& by) {
  for (Vec3i& v : mesh.vertices) v = v + by;
}

/// Five times a turn about one axis that takes whole numbers to whole numbers.
LatticeMap fifths(int axis) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  LatticeMap m;
  for (auto& row : m.row) row = {};
  const auto at = [&](int row, int column) -> std::int32_t& {
    return m.row[static_cast<std::size_t>(row)][column];
  };
  at(axis, axis) = 5;
  at(u, u) = at(v, v) = 3;
  at(u, v) = -4;
  at(v, u) = 4;
  return m;
}

void turn_by_fifths(IndexedMesh& mesh, int axis) {
  mesh = mapped(mesh, fifths(axis));
  for (Vec3i& v : mesh.vertices)
    for (int k = 0; k < 3; ++k) v[k] /= 5;
}

class PairDraw {
 public:
  explicit PairDraw(std::uint64_t seed) : draw_(seed), rng_(seed) {}

  SolidPair pair() {
    SolidPair p;
    p.aim = static_cast<Aim>(draw_.below(kAims));
    p.pose = static_cast<Pose>(draw_.below(kPoses));
    const double size = std::pow(10, draw_.between(1.5, 3.3));
    p.a = shape(size, p.recipe);
    p.recipe += " and ";
    if (p.aim == Aim::contained) {
      p.b = shape(size / 15, p.recipe);
      put_inside(p.a, p.b, size);
    } else {
      p.b = shape(size * std::pow(10, draw_.between(-0.7, 0.7)), p.recipe);
      if (draw_.one_in(3)) turn_by_fifths(p.b, static_cast<int>(draw_.below(3)));
      put_beside(p, size);
    }
    pose(p);
    return p;
  }

 private:
  IndexedMesh shape(double size_mm, std::string& recipe) {
    if (draw_.one_in(2)) {
      recipe += "lattice solid";
      const auto cell = static_cast<std::int32_t>(std::lround(size_mm * 1000 / 5 / kStep)) * kStep;
      LatticeMap scale = testing::axis_symmetry(static_cast<int>(draw_.below(48)));
      for (Vec3i& row : scale.row) row = row * std::max(cell, 4 * kStep);
      return mapped(testing::random_pair(rng_).a.mesh, scale);
    }
    const geometry::Primitive primitive =
        draw_.one_in(4) ? draw_.torus(size_mm) : draw_.convex(size_mm);
    recipe += kind_name(primitive);
    const auto t = geometry::tessellate(primitive, {}, size_mm / 60);
    IndexedMesh m;
    for (const Vec3d& v : t.mesh.vertices) m.vertices.push_back(on_steps(v * geometry::kGridPerMm));
    m.triangles = t.mesh.triangles;
    return m;
  }

  /// A small body a little behind a random triangle of a large one.
  void put_inside(const IndexedMesh& a, IndexedMesh& b, double size_mm) {
    const geometry::Triangle t = a.triangles[draw_.below(a.triangles.size())];
    const Vec3d p = a.vertices[t[0]].as<double>(), q = a.vertices[t[1]].as<double>(),
                r = a.vertices[t[2]].as<double>();
    const Vec3d n = cross(q - p, r - p);
    const double length = std::sqrt(dot(n, n));
    const double down = length > 0 ? size_mm * draw_.between(50, 100) / length : 0;
    move(b, on_steps((p + q + r) * (1.0 / 3) - n * down - b.vertices[0].as<double>()));
  }

  /// The highest corner of a along an axis and the lowest of b, as far apart as the aim says.
  void put_beside(SolidPair& p, double size_mm) {
    const int axis = static_cast<int>(draw_.below(3));
    const auto along = [axis](const Vec3i& x, const Vec3i& y) { return x[axis] < y[axis]; };
    const Vec3i top = *std::ranges::max_element(p.a.vertices, along);
    const Vec3i low = *std::ranges::min_element(p.b.vertices, along);
    Vec3d way = (top - low).as<double>();
    const double size = size_mm * geometry::kGridPerMm;
    if (draw_.one_in(3)) way = way + draw_.point(size * 0.3);
    way[axis] = top[axis] - low[axis] + gap(p.aim, size);
    move(p.b, on_steps(way));
  }
  double gap(Aim aim, double size) {
    if (aim == Aim::touching) return 0;
    const double g =
        draw_.one_in(3) ? kStep : size * std::pow(10, draw_.between(-3.5, -0.5)) + kStep;
    return aim == Aim::crossing ? -g : g;
  }

  void pose(SolidPair& p) {
    if (p.pose == Pose::turned)
      for (IndexedMesh* m : {&p.a, &p.b}) {
        turn_by_fifths(*m, 0);
        // What is left of steps after the first is a multiple of five.
        turn_by_fifths(*m, 2);
      }
    if (p.pose == Pose::askew) {
      const geometry::Mat3d turn = draw_.turn();
      for (IndexedMesh* m : {&p.a, &p.b})
        for (Vec3i& v : m->vertices) {
          const Vec3d w = turn * v.as<double>();
          for (int k = 0; k < 3; ++k) v[k] = static_cast<std::int32_t>(std::lround(w[k]));
        }
    }
  }

  PrimitiveDraw draw_;
  std::mt19937_64 rng_;
};

/// Strake drops triangles without area; they lead FCL's test of separating axes astray.
void drop_degenerate(IndexedMesh& mesh) {
  std::erase_if(mesh.triangles, [&](const geometry::Triangle& t) {
    const auto p = mesh.vertices[t[0]].as<std::int64_t>();
    const auto n = geometry::cross_exact(mesh.vertices[t[1]].as<std::int64_t>() - p,
                                         mesh.vertices[t[2]].as<std::int64_t>() - p);
    return n.x == 0 && n.y == 0 && n.z == 0;
  });
}

bool one_solid(const model::GridShape& shape) {
  return shape.parts.size() == 1 && shape.parts[0].kind == geometry::PartKind::solid;
}

}  // namespace

geometry::TriangleMesh in_mm(const IndexedMesh& mesh) {
  geometry::TriangleMesh m;
  for (const Vec3i& v : mesh.vertices) m.vertices.push_back(to_mm(v.as<std::int64_t>()));
  m.triangles = mesh.triangles;
  return m;
}

clash::Options exact_options() {
  return {.tolerances = {.clearance_mm = 1e6, .touch_gap_mm = 0, .touch_overlap_mm = 0},
          .contact_distance_mm = 0};
}

double SolidPair::size_mm() const {
  geometry::Box3i box = geometry::empty_box<std::int32_t>();
  for (const IndexedMesh* m : {&a, &b})
    for (const Vec3i& v : m->vertices) box.include(v);
  const Vec3d extent = (box.hi.as<std::int64_t>() - box.lo.as<std::int64_t>()).as<double>();
  return std::max({extent.x, extent.y, extent.z}) * geometry::kMmPerGrid;
}

SolidPair draw_solid_pair(std::uint64_t seed) {
  SolidPair p = PairDraw(seed).pair();
  drop_degenerate(p.a);
  drop_degenerate(p.b);
  static constexpr std::array<std::string_view, kAims> kAimNames{"separated", "touching",
                                                                 "crossing", "contained"};
  static constexpr std::array<std::string_view, kPoses> kPoseNames{"aligned", "turned", "askew"};
  p.recipe = "seed " + std::to_string(seed) + ' ' + p.recipe + ", " +
             std::string(kAimNames[static_cast<std::size_t>(p.aim)]) + ", " +
             std::string(kPoseNames[static_cast<std::size_t>(p.pose)]);
  return p;
}

double StrakeAnswer::surface_distance_mm() const {
  return std::sqrt(squared_distance) * geometry::kMmPerGrid;
}

std::optional<StrakeAnswer> strake_answer(const SolidPair& pair) {
  ClashModel m;
  m.object("a").body(in_mm(pair.a));
  m.object("b").body(in_mm(pair.b));
  const clash::Options options = exact_options();
  const model::Scene scene = make_scene(m.model, clash::scene_options(options), {}).value();
  if (scene.bodies.size() != 2 || !one_solid(scene.shapes[scene.bodies[0].grid_shape]) ||
      !one_solid(scene.shapes[scene.bodies[1].grid_shape]))
    return std::nullopt;
  const clash::Report report = clash::detect(scene, clash::one_set(scene), options, {}).value();
  if (report.pairs.size() != 1) return std::nullopt;
  const clash::Pair& found = report.pairs[0];
  StrakeAnswer answer{found.cls,        found.relation, found.d_mm, found.d_lower_mm,
                      found.d_upper_mm, false,          0};

  const auto& part_a = scene.shapes[scene.bodies[0].grid_shape].parts[0];
  const auto& part_b = scene.shapes[scene.bodies[1].grid_shape].parts[0];
  const geometry::TriangleBvh tree_a(part_a), tree_b(part_b);
  const geometry::PartWithBvh a{{&part_a, scene.bodies[0].origin}, &tree_a},
      b{{&part_b, scene.bodies[1].origin}, &tree_b};
  geometry::QueryContext work;
  answer.surfaces_meet = geometry::meet(a, b, work).boundaries_meet;
  answer.squared_distance =
      geometry::find_closest_pair(a, b, std::numeric_limits<double>::infinity(), work)->squared;
  return answer;
}

}  // namespace strake::test
