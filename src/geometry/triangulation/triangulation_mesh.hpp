// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace strake::geometry::triangulation {

/// A point of the projected face; |coordinate| <= 2^29.
struct Point2 {
  std::int64_t x = 0, y = 0;

  friend bool operator==(const Point2&, const Point2&) = default;
  friend auto operator<=>(const Point2&, const Point2&) = default;
};

inline constexpr std::uint32_t kNone = 0xffffffffU;

/// Returns the side of the line through p and q on which r lies: 1 left, -1 right, 0 on it.
[[nodiscard]] constexpr int side_of(const Point2& p, const Point2& q, const Point2& r) {
  const std::int64_t area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  return area > 0 ? 1 : area < 0 ? -1 : 0;
}

/// Whether d lies within the circle through a, b and c, which are counter-clockwise.
[[nodiscard]] bool inside_circle(const Point2& a, const Point2& b, const Point2& c,
                                 const Point2& d);

/// Corner numbers of a triangle in cyclic order.
constexpr std::uint32_t after(std::uint32_t i) { return i == 2 ? 0 : i + 1; }
constexpr std::uint32_t before(std::uint32_t i) { return i == 0 ? 2 : i - 1; }

/// A triangle, counter-clockwise and with an area. Edge i lies opposite vertex i.
struct TriangulationFace {
  std::array<std::uint32_t, 3> vertex{};
  std::array<std::uint32_t, 3> neighbour{kNone, kNone, kNone};
  std::array<bool, 3> constrained{};  ///< lies on a segment
  std::array<bool, 3> odd{};          ///< lies on an odd number of segments
};

/// Vertex `index` of a triangle, or the edge opposite it.
struct FaceCorner {
  std::uint32_t cell = kNone;
  std::uint32_t index = 0;
};

/// A triangle mesh over points with neighbours, which edge flips transform.
class TriangulationMesh {
 public:
  /// Makes a mesh without triangles.
  explicit TriangulationMesh(std::vector<Point2> points)
      : points_(std::move(points)), cell_of_(points_.size(), kNone) {}
  TriangulationMesh(std::vector<Point2> points, std::vector<TriangulationFace> cells);

  [[nodiscard]] const std::vector<Point2>& points() const { return points_; }
  [[nodiscard]] const std::vector<TriangulationFace>& all() const { return cells_; }
  [[nodiscard]] const TriangulationFace& operator[](std::uint32_t cell) const {
    return cells_[cell];
  }
  [[nodiscard]] TriangulationFace& operator[](std::uint32_t cell) { return cells_[cell]; }

  [[nodiscard]] int side(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return side_of(points_[a], points_[b], points_[c]);
  }
  [[nodiscard]] static std::uint32_t index_of(const TriangulationFace& cell, std::uint32_t vertex) {
    return cell.vertex[0] == vertex ? 0 : cell.vertex[1] == vertex ? 1 : 2;
  }

  /// Calls visit(corner of the vertex) for the triangles round a vertex until it returns true.
  template <class Visit>
  void visit_star(std::uint32_t vertex, const Visit& visit) const;

  void reserve(std::size_t cells) { cells_.reserve(cells); }
  /// Adds a triangle without neighbours.
  std::uint32_t add(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  /// Replaces a triangle by one without neighbours.
  void set(std::uint32_t cell, const std::array<std::uint32_t, 3>& vertices);
  /// Makes two triangles neighbours over the edge that runs from -> to in s.
  void join(std::uint32_t s, std::uint32_t t, std::uint32_t from, std::uint32_t to);
  /// Sets the neighbour beyond an edge, which may be none, and the neighbour's link back.
  void attach(const FaceCorner& edge, std::uint32_t neighbour, bool constrained, bool odd);

  /// Notes an edge that may not be Delaunay.
  void doubt(const FaceCorner& edge) { doubtful_.push_back(edge); }
  /// Flips doubtful edges that lie on no segment until all are Delaunay: flipped(cell) is called
  /// for both triangles each time.
  template <class Flipped>
  void legalise(const Flipped& flipped);

 private:
  /// Whether an edge with a neighbour is Delaunay.
  [[nodiscard]] bool is_delaunay(const FaceCorner& edge) const;
  /// Replaces an edge by the other diagonal of its quadrilateral.
  void flip(const FaceCorner& edge);

  std::vector<Point2> points_;
  std::vector<TriangulationFace> cells_;
  std::vector<std::uint32_t> cell_of_;  ///< some triangle at each vertex
  std::vector<FaceCorner> doubtful_;
};

template <class Visit>
void TriangulationMesh::visit_star(std::uint32_t vertex, const Visit& visit) const {
  const std::uint32_t start = cell_of_[vertex];
  std::uint32_t cell = start;
  do {
    const std::uint32_t index = index_of(cells_[cell], vertex);
    if (visit(FaceCorner{cell, index})) return;
    cell = cells_[cell].neighbour[after(index)];
  } while (cell != kNone && cell != start);
  if (cell == start) return;
  // The hull is reached: the rest lies in the other direction.
  cell = cells_[start].neighbour[before(index_of(cells_[start], vertex))];
  while (cell != kNone) {
    const std::uint32_t index = index_of(cells_[cell], vertex);
    if (visit(FaceCorner{cell, index})) return;
    cell = cells_[cell].neighbour[before(index)];
  }
}

template <class Flipped>
void TriangulationMesh::legalise(const Flipped& flipped) {
  while (!doubtful_.empty()) {
    const FaceCorner at = doubtful_.back();
    doubtful_.pop_back();
    const TriangulationFace& cell = cells_[at.cell];
    const std::uint32_t other = cell.neighbour[at.index];
    if (other == kNone || cell.constrained[at.index] || is_delaunay(at)) continue;
    flip(at);
    flipped(at.cell);
    flipped(other);
    doubtful_.push_back({at.cell, 0});
    doubtful_.push_back({at.cell, 2});
    doubtful_.push_back({other, 0});
    doubtful_.push_back({other, 1});
  }
}

}  // namespace strake::geometry::triangulation
