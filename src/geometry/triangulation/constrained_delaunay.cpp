// SPDX-License-Identifier: Apache-2.0
#include "geometry/triangulation/constrained_delaunay.hpp"

#include <algorithm>
#include <utility>

#include "geometry/triangulation/delaunay.hpp"

namespace strake::geometry::triangulation {
namespace {

/// Up to so many points the sweep is the quicker of the two. A comb of 50,000 points, swept along
/// its teeth, takes it 66 s; halves take 0.1 s (decision 0005).
constexpr std::size_t kMaxSwept = 128;

TriangulationMesh triangulated(std::vector<Point2> points) {
  if (points.size() <= kMaxSwept) return sweep_delaunay(std::move(points));
  std::vector<TriangulationFace> cells = delaunay(points);
  return {std::move(points), std::move(cells)};
}

}  // namespace

ConstrainedDelaunay::ConstrainedDelaunay(std::vector<Point2> points)
    : cells_(triangulated(std::move(points))) {}

void ConstrainedDelaunay::restore_delaunay() {
  for (std::uint32_t c = 0; c < cells_.all().size(); ++c)
    for (std::uint32_t k = 0; k < 3; ++k) cells_.doubt({c, k});
  cells_.legalise([](std::uint32_t) {});
}

/// The corner opposite the edge a-b, in either sense.
FaceCorner ConstrainedDelaunay::find_edge(std::uint32_t a, std::uint32_t b) const {
  FaceCorner found;
  cells_.visit_star(a, [&](const FaceCorner& at) {
    const TriangulationFace& cell = cells_[at.cell];
    if (cell.vertex[after(at.index)] == b) found = {at.cell, before(at.index)};
    if (cell.vertex[before(at.index)] == b) found = {at.cell, after(at.index)};
    return found.cell != kNone;
  });
  return found;
}

void ConstrainedDelaunay::mark_constrained(std::uint32_t a, std::uint32_t b) {
  const FaceCorner at = find_edge(a, b);
  TriangulationFace& cell = cells_[at.cell];
  cell.constrained[at.index] = true;
  cell.odd[at.index] = !cell.odd[at.index];
  if (cell.neighbour[at.index] == kNone) return;
  TriangulationFace& other = cells_[cell.neighbour[at.index]];
  for (std::uint32_t k = 0; k < 3; ++k)
    if (other.neighbour[k] == at.cell) {
      const bool same = (other.vertex[after(k)] == a && other.vertex[before(k)] == b) ||
                        (other.vertex[after(k)] == b && other.vertex[before(k)] == a);
      if (!same) continue;
      other.constrained[k] = true;
      other.odd[k] = cell.odd[at.index];
    }
}

/// Walks from a towards b, noting what is crossed, to b or to the first vertex on the way; false
/// where a segment is in the way.
bool ConstrainedDelaunay::collect(std::uint32_t a, std::uint32_t b, FaceCorner start,
                                  Cavity& cavity) const {
  FaceCorner at = start;
  std::uint32_t right = cells_[at.cell].vertex[after(at.index)];
  std::uint32_t left = cells_[at.cell].vertex[before(at.index)];
  std::uint32_t entered = kNone;
  cavity.right = {right};
  cavity.left = {left};
  for (;;) {
    const TriangulationFace& cell = cells_[at.cell];
    if (cell.constrained[at.index]) return false;
    cavity.add(at.cell, cell, entered, at.index);
    const std::uint32_t next = cell.neighbour[at.index];
    const TriangulationFace& beyond = cells_[next];
    std::uint32_t apex_index = 0;
    while (beyond.vertex[apex_index] == left || beyond.vertex[apex_index] == right) ++apex_index;
    const std::uint32_t apex = beyond.vertex[apex_index];
    const int where = apex == b ? 0 : cells_.side(a, b, apex);
    entered = apex_index;
    if (where == 0) {
      cavity.add(next, beyond, entered, kNone);
      cavity.end = apex;
      return true;
    }
    // Leave through the edge that the segment still separates.
    at = {next, TriangulationMesh::index_of(beyond, where > 0 ? left : right)};
    (where > 0 ? left : right) = apex;
    (where > 0 ? cavity.left : cavity.right).push_back(apex);
  }
}

void ConstrainedDelaunay::Cavity::add(std::uint32_t number, const TriangulationFace& cell,
                                      std::uint32_t entered, std::uint32_t left_through) {
  cells.push_back(number);
  for (std::uint32_t k = 0; k < 3; ++k)
    if (k != entered && k != left_through)
      rim.push_back({cell.vertex[after(k)], cell.vertex[before(k)], cell.neighbour[k],
                     cell.constrained[k], cell.odd[k]});
}

/// Adds the triangles of the pseudo-polygon to the left of p -> q, whose other vertices are
/// chain, from p to q: the one on p -> q has the vertex whose circle holds no other, and what is
/// left of the chain lies beyond its two other edges.
void ConstrainedDelaunay::fill(std::uint32_t p, std::uint32_t q,
                               std::span<const std::uint32_t> chain,
                               std::vector<std::array<std::uint32_t, 3>>& triangles) const {
  struct Piece {
    std::uint32_t p, q;
    std::size_t first, last;
  };
  std::vector<Piece> open{{p, q, 0, chain.size()}};
  while (!open.empty()) {
    const Piece piece = open.back();
    open.pop_back();
    if (piece.first == piece.last) continue;
    std::size_t best = piece.first;
    for (std::size_t i = best + 1; i < piece.last; ++i) {
      const std::uint32_t c = chain[best], v = chain[i];
      if (c == v) {
        // An edge hangs in the cavity by this vertex: on which side of the triangle is it?
        if (cells_.side(piece.p, c, chain[best + 1]) > 0) best = i;
      } else if (inside_circle(cells_.points()[piece.p], cells_.points()[piece.q],
                               cells_.points()[c], cells_.points()[v])) {
        best = i;
      }
    }
    triangles.push_back({piece.p, piece.q, chain[best]});
    open.push_back({piece.p, chain[best], piece.first, best});
    open.push_back({chain[best], piece.q, best + 1, piece.last});
  }
}

/// Puts triangles in the place of the cavity's cells and ties them to each other and to its rim.
void ConstrainedDelaunay::replace(Cavity& cavity,
                                  std::span<const std::array<std::uint32_t, 3>> triangles) {
  struct Side {
    Edge edge;
    std::uint32_t cell, index;
  };
  std::vector<Side> sides;
  sides.reserve(triangles.size() * 3);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const std::uint32_t number = cavity.cells[t];
    const auto& v = triangles[t];
    cells_.set(number, v);
    for (std::uint32_t k = 0; k < 3; ++k) sides.push_back({{v[after(k)], v[before(k)]}, number, k});
  }
  const auto by_edge = [](const Side& x, const Side& y) { return x.edge < y.edge; };
  std::sort(sides.begin(), sides.end(), by_edge);
  std::sort(cavity.rim.begin(), cavity.rim.end(), [](const CavityEdge& x, const CavityEdge& y) {
    return std::pair(x.from, x.to) < std::pair(y.from, y.to);
  });
  for (const Side& at : sides) {
    const auto rim = std::lower_bound(
        cavity.rim.begin(), cavity.rim.end(), at.edge,
        [](const CavityEdge& x, const Edge& edge) { return std::pair(x.from, x.to) < edge; });
    const bool on_rim = rim != cavity.rim.end() && Edge(rim->from, rim->to) == at.edge;
    // A hanging edge is on the rim twice, with cells of the cavity on both sides.
    const Side turned{{at.edge.second, at.edge.first}, 0, 0};
    const auto across = std::lower_bound(sides.begin(), sides.end(), turned, by_edge);
    const bool within = across != sides.end() && across->edge == turned.edge;
    cells_.attach({at.cell, at.index},
                  within   ? across->cell
                  : on_rim ? rim->neighbour
                           : kNone,
                  on_rim && rim->constrained, on_rim && rim->odd);
  }
}

/// Makes a - cavity.end an edge.
bool ConstrainedDelaunay::open_way(std::uint32_t a, Cavity& cavity) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(cavity.cells.size());
  fill(a, cavity.end, cavity.left, triangles);
  std::reverse(cavity.right.begin(), cavity.right.end());
  fill(cavity.end, a, cavity.right, triangles);
  for (const auto& t : triangles)
    if (cells_.side(t[0], t[1], t[2]) <= 0) return false;
  replace(cavity, triangles);
  return true;
}

bool ConstrainedDelaunay::insert_constraint(std::uint32_t a, std::uint32_t b) {
  while (a != b) {
    std::uint32_t end = kNone;
    FaceCorner start;
    cells_.visit_star(a, [&](const FaceCorner& at) {
      const TriangulationFace& cell = cells_[at.cell];
      const std::uint32_t u = cell.vertex[after(at.index)], v = cell.vertex[before(at.index)];
      const int su = u == b ? 0 : cells_.side(a, b, u), sv = v == b ? 0 : cells_.side(a, b, v);
      // A vertex on the line lies towards b when it does so in lexicographic order.
      if (su == 0 && (u > a) == (b > a)) end = u;
      if (sv == 0 && (v > a) == (b > a)) end = v;
      if (end == kNone && su < 0 && sv > 0) start = at;
      return end != kNone || start.cell != kNone;
    });
    if (end == kNone) {
      Cavity cavity;
      if (start.cell == kNone || !collect(a, b, start, cavity)) return false;
      if (!open_way(a, cavity)) return false;
      end = cavity.end;
    }
    mark_constrained(a, end);
    a = end;
  }
  return true;
}

std::vector<bool> ConstrainedDelaunay::inside() const {
  constexpr std::uint8_t kUnknown = 2;
  std::vector<std::uint8_t> state(cells_.all().size(), kUnknown);
  std::vector<std::uint32_t> stack;
  for (std::uint32_t c = 0; c < cells_.all().size(); ++c)
    for (std::size_t k = 0; k < 3; ++k)
      if (cells_[c].neighbour[k] == kNone && state[c] == kUnknown) {
        state[c] = cells_[c].odd[k] ? 1 : 0;
        stack.push_back(c);
      }
  while (!stack.empty()) {
    const std::uint32_t c = stack.back();
    stack.pop_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t n = cells_[c].neighbour[k];
      if (n == kNone || state[n] != kUnknown) continue;
      state[n] = state[c] ^ (cells_[c].odd[k] ? 1U : 0U);
      stack.push_back(n);
    }
  }
  std::vector<bool> inside(cells_.all().size());
  for (std::size_t c = 0; c < cells_.all().size(); ++c) inside[c] = state[c] == 1;
  return inside;
}

}  // namespace strake::geometry::triangulation
