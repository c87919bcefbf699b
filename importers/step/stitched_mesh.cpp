// SPDX-License-Identifier: Apache-2.0
#include "stitched_mesh.hpp"

#include <BRep_Tool.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "core/union_find.hpp"

namespace strake::import_step {
namespace {

using geometry::Triangle;
using geometry::Vec3d;

class Stitcher {
 public:
  explicit Stitcher(const TopoDS_Shape& shape) {
    TopExp::MapShapes(shape, TopAbs_EDGE, edges_);
    TopExp::MapShapes(shape, TopAbs_VERTEX, vertices_);
    for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next())
      add_face(TopoDS::Face(at.Current()));
  }
  StitchedMesh stitched();

 private:
  void add_face(const TopoDS_Face& face);
  void collect_edge(const TopoDS_Edge& edge, const Handle(Poly_Triangulation) & triangulation,
                    const TopLoc_Location& location, std::uint32_t base);
  void join_edges();
  void join_equal_points();

  TopTools_IndexedMapOfShape edges_, vertices_;
  std::vector<Vec3d> points_;
  std::vector<Triangle> triangles_;
  std::size_t faces_ = 0, faces_without_ = 0;
  /// Where the points of an edge are among those of a face.
  struct Side {
    int edge = 0;
    std::vector<std::uint32_t> points;  ///< in the order of the edge's parameter
    int first = 0, last = 0;            ///< its ends among the vertices, 0: none
    bool is_point = false;              ///< it has no length: all points are one
  };
  std::vector<Side> sides_;
  UnionFind same_;
};

void Stitcher::add_face(const TopoDS_Face& face) {
  ++faces_;
  TopLoc_Location location;
  const Handle(Poly_Triangulation) triangulation = BRep_Tool::Triangulation(face, location);
  if (triangulation.IsNull() || triangulation->NbTriangles() == 0) {
    ++faces_without_;
    return;
  }
  const gp_Trsf& place = location.Transformation();
  const auto base = static_cast<std::uint32_t>(points_.size());
  for (int i = 1; i <= triangulation->NbNodes(); ++i) {
    const gp_Pnt p = triangulation->Node(i).Transformed(place);
    points_.push_back({p.X(), p.Y(), p.Z()});
  }
  const bool turned = (face.Orientation() == TopAbs_REVERSED) != place.IsNegative();
  for (int i = 1; i <= triangulation->NbTriangles(); ++i) {
    int a = 0, b = 0, c = 0;
    triangulation->Triangle(i).Get(a, b, c);
    if (turned) std::swap(b, c);
    triangles_.push_back({base + static_cast<std::uint32_t>(a - 1),
                          base + static_cast<std::uint32_t>(b - 1),
                          base + static_cast<std::uint32_t>(c - 1)});
  }
  for (TopExp_Explorer at(face, TopAbs_EDGE); at.More(); at.Next())
    collect_edge(TopoDS::Edge(at.Current()), triangulation, location, base);
}

void Stitcher::collect_edge(const TopoDS_Edge& edge,
                            const Handle(Poly_Triangulation) & triangulation,
                            const TopLoc_Location& location, std::uint32_t base) {
  const Handle(Poly_PolygonOnTriangulation) polygon =
      BRep_Tool::PolygonOnTriangulation(edge, triangulation, location);
  if (polygon.IsNull()) return;
  Side side;
  side.edge = edges_.FindIndex(edge);
  for (int i = 1; i <= polygon->NbNodes(); ++i) {
    const int node = polygon->Node(i);
    if (node < 1 || node > triangulation->NbNodes()) return;
    side.points.push_back(base + static_cast<std::uint32_t>(node - 1));
  }
  if (side.points.empty()) return;
  side.is_point = BRep_Tool::Degenerated(edge);
  // The polygon follows the parameter of the edge, from its forward first vertex.
  TopoDS_Vertex first, last;
  TopExp::Vertices(TopoDS::Edge(edge.Oriented(TopAbs_FORWARD)), first, last);
  if (!first.IsNull()) side.first = vertices_.FindIndex(first);
  if (!last.IsNull()) side.last = vertices_.FindIndex(last);
  sides_.push_back(std::move(side));
}

void Stitcher::join_edges() {
  std::vector<const Side*> side_of(static_cast<std::size_t>(edges_.Extent()) + 1);
  constexpr std::uint32_t kNone = geometry::kNoIndex;
  std::vector<std::uint32_t> at_vertex(static_cast<std::size_t>(vertices_.Extent()) + 1, kNone);
  const auto join_end = [&](int vertex, std::uint32_t point) {
    if (vertex == 0) return;
    std::uint32_t& known = at_vertex[static_cast<std::size_t>(vertex)];
    if (known == kNone)
      known = point;
    else
      same_.join(known, point);
  };
  for (const Side& side : sides_) {
    join_end(side.first, side.points.front());
    join_end(side.last, side.points.back());
    if (side.is_point)
      for (const std::uint32_t point : side.points) same_.join(side.points.front(), point);
    const Side*& other = side_of[static_cast<std::size_t>(side.edge)];
    if (other == nullptr)
      other = &side;
    else if (other->points.size() == side.points.size())
      for (std::size_t i = 0; i < side.points.size(); ++i)
        same_.join(other->points[i], side.points[i]);
  }
}

/// Joins points at the same place, as where a file says an edge once for each of its faces.
void Stitcher::join_equal_points() {
  std::vector<std::uint32_t> order(points_.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](std::uint32_t i) {
    return std::tuple(points_[i].x, points_[i].y, points_[i].z, i);
  };
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  for (std::size_t i = 1; i < order.size(); ++i)
    if (points_[order[i - 1]] == points_[order[i]]) same_.join(order[i - 1], order[i]);
}

/// Whether each edge is passed once in each direction.
bool is_closed(const std::vector<Triangle>& triangles) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> forward, backward;
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = t[k], to = t[(k + 1) % 3];
      (from < to ? forward : backward).emplace_back(std::min(from, to), std::max(from, to));
    }
  std::ranges::sort(forward);
  std::ranges::sort(backward);
  return !triangles.empty() && forward == backward;
}

StitchedMesh Stitcher::stitched() {
  same_.reset(points_.size());
  join_edges();
  join_equal_points();
  StitchedMesh result;
  result.faces = faces_;
  result.faces_without = faces_without_;
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    const Vec3d off = points_[i] - points_[same_.root(i)];
    result.moved_mm = std::max(result.moved_mm, std::sqrt(dot(off, off)));
  }
  std::vector<std::uint32_t> numbers(points_.size(), geometry::kNoIndex);
  for (Triangle t : triangles_) {
    for (std::uint32_t& corner : t) corner = same_.root(corner);
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    for (std::uint32_t& corner : t) {
      std::uint32_t& number = numbers[corner];
      if (number == geometry::kNoIndex) {
        number = static_cast<std::uint32_t>(result.mesh.vertices.size());
        result.mesh.vertices.push_back(points_[corner]);
      }
      corner = number;
    }
    result.mesh.triangles.push_back(t);
  }
  result.is_closed = is_closed(result.mesh.triangles);
  return result;
}

}  // namespace

StitchedMesh stitched_mesh(const TopoDS_Shape& shape) { return Stitcher(shape).stitched(); }

}  // namespace strake::import_step
