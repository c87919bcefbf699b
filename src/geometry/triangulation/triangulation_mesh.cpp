// SPDX-License-Identifier: Apache-2.0
#include "geometry/triangulation/triangulation_mesh.hpp"

namespace strake::geometry::triangulation {

bool inside_circle(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  const std::array<std::int64_t, 3> x{a.x - d.x, b.x - d.x, c.x - d.x};
  const std::array<std::int64_t, 3> y{a.y - d.y, b.y - d.y, c.y - d.y};
  std::array<std::int64_t, 3> s{};
  for (std::size_t k = 0; k < 3; ++k) s[k] = x[k] * x[k] + y[k] * y[k];
  // Differences have 30 bits, so terms have at most 122.
  const auto minor = [&](std::size_t i, std::size_t k) { return x[i] * y[k] - x[k] * y[i]; };
  return static_cast<__int128>(s[0]) * minor(1, 2) + static_cast<__int128>(s[1]) * minor(2, 0) +
             static_cast<__int128>(s[2]) * minor(0, 1) >
         0;
}

TriangulationMesh::TriangulationMesh(std::vector<Point2> points,
                                     std::vector<TriangulationFace> cells)
    : points_(std::move(points)), cells_(std::move(cells)), cell_of_(points_.size(), kNone) {
  for (std::uint32_t c = 0; c < cells_.size(); ++c)
    for (const std::uint32_t v : cells_[c].vertex) cell_of_[v] = c;
}

std::uint32_t TriangulationMesh::add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const auto cell = static_cast<std::uint32_t>(cells_.size());
  cells_.emplace_back();
  set(cell, {a, b, c});
  return cell;
}

void TriangulationMesh::set(std::uint32_t cell, const std::array<std::uint32_t, 3>& vertices) {
  cells_[cell] = {vertices, {kNone, kNone, kNone}, {}, {}};
  for (const std::uint32_t v : vertices) cell_of_[v] = cell;
}

void TriangulationMesh::join(std::uint32_t s, std::uint32_t t, std::uint32_t from,
                             std::uint32_t to) {
  TriangulationFace &a = cells_[s], &b = cells_[t];
  a.neighbour[after(index_of(a, to))] = t;
  b.neighbour[after(index_of(b, from))] = s;
}

void TriangulationMesh::attach(const FaceCorner& edge, std::uint32_t neighbour, bool constrained,
                               bool odd) {
  TriangulationFace& c = cells_[edge.cell];
  c.neighbour[edge.index] = neighbour;
  c.constrained[edge.index] = constrained;
  c.odd[edge.index] = odd;
  if (neighbour == kNone) return;
  TriangulationFace& other = cells_[neighbour];
  // The neighbour's edge runs the other way round.
  other.neighbour[after(index_of(other, c.vertex[after(edge.index)]))] = edge.cell;
}

bool TriangulationMesh::is_delaunay(const FaceCorner& edge) const {
  const TriangulationFace& cell = cells_[edge.cell];
  const TriangulationFace& u = cells_[cell.neighbour[edge.index]];
  const std::uint32_t a = cell.vertex[after(edge.index)], b = cell.vertex[before(edge.index)];
  std::uint32_t q = u.vertex[0];
  for (const std::uint32_t v : u.vertex)
    if (v != a && v != b) q = v;
  return !inside_circle(points_[cell.vertex[0]], points_[cell.vertex[1]], points_[cell.vertex[2]],
                        points_[q]);
}

void TriangulationMesh::flip(const FaceCorner& edge) {
  const TriangulationFace t = cells_[edge.cell];
  const std::uint32_t cell = edge.cell, other = t.neighbour[edge.index];
  const TriangulationFace u = cells_[other];
  const std::uint32_t ia = after(edge.index), ib = before(edge.index);
  const std::uint32_t p = t.vertex[edge.index], a = t.vertex[ia], b = t.vertex[ib];
  const std::uint32_t ua = index_of(u, a), ub = index_of(u, b);
  const std::uint32_t q = u.vertex[after(ua) == ub ? before(ua) : after(ua)];
  cells_[cell] = {{p, a, q}, {kNone, other, kNone}, {}, {}};
  cells_[other] = {{p, q, b}, {kNone, kNone, cell}, {}, {}};
  attach({cell, 0}, u.neighbour[ub], u.constrained[ub], u.odd[ub]);   // a-q
  attach({cell, 2}, t.neighbour[ib], t.constrained[ib], t.odd[ib]);   // p-a
  attach({other, 0}, u.neighbour[ua], u.constrained[ua], u.odd[ua]);  // q-b
  attach({other, 1}, t.neighbour[ia], t.constrained[ia], t.odd[ia]);  // b-p
  cell_of_[p] = cell_of_[a] = cell_of_[q] = cell;
  cell_of_[b] = other;
}

}  // namespace strake::geometry::triangulation
