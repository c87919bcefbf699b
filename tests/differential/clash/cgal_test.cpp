// SPDX-License-Identifier: Apache-2.0
// Against CGAL's exact kernel: of the same integers both must say the same, without a tolerance.
// Surfaces that share a point, the exact squared distance, one body inside the other, and by Nef
// polyhedra whether interiors meet.
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "support/solid_pairs.hpp"

namespace strake::clash {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Predicates = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using test::SolidPair;
using test::StrakeAnswer;
using testing::IndexedMesh;

template <class Kernel>
using Triangles = std::vector<typename Kernel::Triangle_3>;

template <class Kernel>
typename Kernel::Point_3 point(const geometry::Vec3i& v) {
  return {v.x, v.y, v.z};
}

template <class Kernel>
Triangles<Kernel> triangles_of(const IndexedMesh& mesh) {
  Triangles<Kernel> all;
  for (const auto& t : mesh.triangles)
    all.emplace_back(point<Kernel>(mesh.vertices[t[0]]), point<Kernel>(mesh.vertices[t[1]]),
                     point<Kernel>(mesh.vertices[t[2]]));
  return all;
}

bool surfaces_meet(const IndexedMesh& a, const IndexedMesh& b) {
  using Primitive =
      CGAL::AABB_triangle_primitive<Predicates, Triangles<Predicates>::const_iterator>;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Predicates, Primitive>>;
  const auto in_a = triangles_of<Predicates>(a), in_b = triangles_of<Predicates>(b);
  const Tree tree(in_a.begin(), in_a.end());
  for (const auto& t : in_b)
    if (tree.do_intersect(t)) return true;
  return false;
}

double squared_gap(const CGAL::Bbox_3& a, const CGAL::Bbox_3& b) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const double gap = std::max({0.0, a.min(k) - b.max(k), b.min(k) - a.max(k)});
    sum += gap * gap;
  }
  return sum;
}

/// The least squared distance, to the last digit but one. Boxes farther apart than `cutoff`, which
/// is Strake's answer, are passed over: nothing nearer can be missed.
std::optional<double> squared_distance(const IndexedMesh& a, const IndexedMesh& b, double cutoff) {
  const auto in_a = triangles_of<Exact>(a), in_b = triangles_of<Exact>(b);
  std::vector<CGAL::Bbox_3> box_b;
  for (const auto& t : in_b) box_b.push_back(t.bbox());
  std::optional<Exact::FT> least;
  std::size_t visited = 0;
  for (const auto& t : in_a) {
    const CGAL::Bbox_3 box = t.bbox();
    for (std::size_t j = 0; j < in_b.size(); ++j) {
      if (squared_gap(box, box_b[j]) > cutoff * (1 + 1e-9)) continue;
      if (++visited > 4000) return std::nullopt;
      const Exact::FT d = CGAL::squared_distance(t, in_b[j]);
      if (!least || d < *least) least = d;
    }
  }
  return least ? CGAL::to_double(CGAL::exact(*least)) : INFINITY;
}

template <class Kernel>
using Mesh = CGAL::Surface_mesh<typename Kernel::Point_3>;

/// Nothing where edges or vertices are shared by more than a surface has, or where the triangles
/// of a body snapped to the grid cross each other.
template <class Kernel>
std::optional<Mesh<Kernel>> manifold(const IndexedMesh& mesh) {
  const geometry::Part part = testing::build_part(mesh);
  std::vector<typename Kernel::Point_3> points;
  for (const auto& v : part.vertices) points.push_back(point<Kernel>(v));
  std::vector<std::array<std::size_t, 3>> faces;
  for (const auto& t : part.triangles) faces.push_back({t[0], t[1], t[2]});
  if (!pmp::is_polygon_soup_a_polygon_mesh(faces)) return std::nullopt;
  Mesh<Kernel> m;
  pmp::polygon_soup_to_polygon_mesh(points, faces, m);
  if (!CGAL::is_closed(m) || pmp::does_self_intersect(m)) return std::nullopt;
  return m;
}

/// Whether a vertex of the one lies inside the other; skins known to be apart.
std::optional<bool> vertex_inside(const IndexedMesh& inner, const IndexedMesh& outer) {
  const auto mesh = manifold<Predicates>(outer);
  if (!mesh) return std::nullopt;
  const CGAL::Side_of_triangle_mesh<Mesh<Predicates>, Predicates> side(*mesh);
  return side(point<Predicates>(inner.vertices[inner.triangles[0][0]])) == CGAL::ON_BOUNDED_SIDE;
}

std::optional<bool> interiors_meet(const IndexedMesh& a, const IndexedMesh& b) {
  if (a.triangles.size() + b.triangles.size() > 100) return std::nullopt;
  auto x = manifold<Exact>(a), y = manifold<Exact>(b);
  if (!x || !y) return std::nullopt;
  using Nef = CGAL::Nef_polyhedron_3<Exact>;
  const Nef p(*x), q(*y);
  return !(p.interior() * q.interior()).is_empty();
}

void compare(const SolidPair& pair, const StrakeAnswer& strake,
             std::map<std::string, std::uint64_t>& requested) {
  ASSERT_EQ(surfaces_meet(pair.a, pair.b), strake.surfaces_meet);
  ++requested["surfaces"];
  if (const auto d = squared_distance(pair.a, pair.b, strake.squared_distance)) {
    ++requested["distance"];
    EXPECT_DOUBLE_EQ(*d, strake.squared_distance);  // CGAL cuts digits off where Strake rounds
    if (strake.cls == Class::clearance_violation) {
      EXPECT_DOUBLE_EQ(strake.d_mm, std::sqrt(*d) / 1000);
    }
  }
  if (!strake.surfaces_meet) {
    const auto b_in_a = vertex_inside(pair.b, pair.a), a_in_b = vertex_inside(pair.a, pair.b);
    if (a_in_b && b_in_a) {
      EXPECT_EQ(*b_in_a, strake.relation == Relation::b_in_a);
      EXPECT_EQ(*a_in_b, strake.relation == Relation::a_in_b);
      ++requested[*a_in_b || *b_in_a ? "inside" : "outside"];
    }
  }
  if (const auto meet = interiors_meet(pair.a, pair.b)) {
    ++requested[*meet ? "interiors" : strake.surfaces_meet ? "touch" : "apart"];
    EXPECT_EQ(*meet, strake.cls == Class::hit);
  }
}

TEST(ClashAgainstCgal, ExactAnswersAreTheSame) {
  const char* count = std::getenv("STRAKE_PEER_PAIRS");
  const std::uint64_t pairs = count != nullptr ? std::strtoull(count, nullptr, 10) : 4000;
  std::map<std::string, std::uint64_t> requested;
  for (std::uint64_t seed = 1; seed <= pairs; ++seed) {
    const SolidPair pair = test::draw_solid_pair(seed);
    const auto strake = test::strake_answer(pair);
    if (!strake) continue;
    SCOPED_TRACE(pair.recipe + ": " + std::string(name(strake->cls)) + ' ' +
                 std::string(name(strake->relation)) + " d " + std::to_string(strake->d_mm));
    compare(pair, *strake, requested);
  }
  for (const char* question :
       {"surfaces", "distance", "inside", "outside", "interiors", "touch", "apart"}) {
    EXPECT_GT(requested[question], pairs / 50) << question;
    RecordProperty(question, std::to_string(requested[question]));
  }
}

}  // namespace
}  // namespace strake::clash
