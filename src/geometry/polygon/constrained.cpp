// SPDX-License-Identifier: Apache-2.0
#include "geometry/polygon/constrained.hpp"

#include <algorithm>
#include <utility>

#include "geometry/polygon/delaunay.hpp"

namespace strake::geometry::polygon {
namespace {

/// The sweep is quick for the few points of most faces, and quadratic where its front is long: a
/// comb, swept along its teeth.
constexpr std::size_t kMostSwept = 128;

constexpr std::uint32_t after(std::uint32_t i) { return i == 2 ? 0 : i + 1; }
constexpr std::uint32_t before(std::uint32_t i) { return i == 0 ? 2 : i - 1; }

}  // namespace

int side_of(const Point2& p, const Point2& q, const Point2& r) {
  const std::int64_t area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  return area > 0 ? 1 : area < 0 ? -1 : 0;
}

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

int Constrained::side(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  return side_of(points_[a], points_[b], points_[c]);
}

bool Constrained::in_circle(const Cell& cell, std::uint32_t point) const {
  const auto& v = cell.vertex;
  return inside_circle(points_[v[0]], points_[v[1]], points_[v[2]], points_[point]);
}

std::uint32_t Constrained::index_of(const Cell& cell, std::uint32_t vertex) const {
  return cell.vertex[0] == vertex ? 0 : cell.vertex[1] == vertex ? 1 : 2;
}

std::uint32_t Constrained::add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const auto cell = static_cast<std::uint32_t>(cells_.size());
  cells_.push_back({{a, b, c}, {kNone, kNone, kNone}, {}, {}});
  for (const std::uint32_t v : {a, b, c}) cell_of_[v] = cell;
  return cell;
}

/// Makes two triangles neighbours over the edge that runs from -> to in s.
void Constrained::join(std::uint32_t s, std::uint32_t t, std::uint32_t from, std::uint32_t to) {
  Cell &a = cells_[s], &b = cells_[t];
  a.neighbour[after(index_of(a, to))] = t;
  b.neighbour[after(index_of(b, from))] = s;
}

void Constrained::set_hull(std::uint32_t cell, std::uint32_t index) {
  hull_cell_[cells_[cell].vertex[after(index)]] = cell;
}

/// Joins the first points, as long as they are collinear, with the first that is not; returns the
/// number of points used, or 0 when all are collinear.
std::uint32_t Constrained::start_fan() {
  const auto count = static_cast<std::uint32_t>(points_.size());
  std::uint32_t apex = 2;
  while (apex < count && side(0, 1, apex) == 0) ++apex;
  if (apex >= count) return 0;
  const bool left = side(0, 1, apex) > 0;
  std::vector<std::uint32_t> hull;
  for (std::uint32_t i = 0; i < apex; ++i) hull.push_back(left ? i : apex - 1 - i);
  std::uint32_t previous = kNone;
  for (std::size_t i = 0; i + 1 < hull.size(); ++i) {
    const std::uint32_t cell = add(hull[i], hull[i + 1], apex);
    if (previous != kNone) join(previous, cell, hull[i], apex);
    previous = cell;
  }
  hull.push_back(apex);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const std::uint32_t a = hull[i], b = hull[i + 1 == hull.size() ? 0 : i + 1];
    hull_next_[a] = b;
    hull_previous_[b] = a;
  }
  for (std::uint32_t cell = 0; cell < cells_.size(); ++cell)
    for (std::uint32_t k = 0; k < 3; ++k)
      if (cells_[cell].neighbour[k] == kNone) set_hull(cell, k);
  return apex + 1;
}

/// Adds a point beyond all others: it sees the hull edges round the last one.
void Constrained::insert(std::uint32_t point) {
  const std::uint32_t last = point - 1;
  std::uint32_t ahead = last, behind = last, first_ahead = kNone, first_behind = kNone;
  std::uint32_t newest = kNone;
  while (side(ahead, hull_next_[ahead], point) < 0) {
    const std::uint32_t next = hull_next_[ahead];
    const std::uint32_t cell = add(next, ahead, point);
    join(cell, hull_cell_[ahead], next, ahead);
    if (newest != kNone) join(newest, cell, point, ahead);
    if (first_ahead == kNone) first_ahead = cell;
    doubtful_.push_back({cell, 2});
    newest = cell;
    ahead = next;
  }
  std::uint32_t newest_behind = kNone;
  while (side(hull_previous_[behind], behind, point) < 0) {
    const std::uint32_t next = hull_previous_[behind];
    const std::uint32_t cell = add(behind, next, point);
    join(cell, hull_cell_[next], behind, next);
    if (newest_behind != kNone) join(newest_behind, cell, behind, point);
    if (first_behind == kNone) first_behind = cell;
    doubtful_.push_back({cell, 2});
    newest_behind = cell;
    behind = next;
  }
  if (first_ahead != kNone && first_behind != kNone) join(first_ahead, first_behind, last, point);
  hull_next_[behind] = point;
  hull_previous_[point] = behind;
  hull_next_[point] = ahead;
  hull_previous_[ahead] = point;
  hull_cell_[behind] = newest_behind != kNone ? newest_behind : first_ahead;
  hull_cell_[point] = newest != kNone ? newest : first_behind;
  legalise();
}

Constrained::Constrained(std::vector<Point2> points) : points_(std::move(points)) {
  cell_of_.assign(points_.size(), kNone);
  hull_next_.assign(points_.size(), kNone);
  hull_previous_.assign(points_.size(), kNone);
  hull_cell_.assign(points_.size(), kNone);
  if (points_.size() < 3) return;
  if (points_.size() <= kMostSwept) {
    sweep();
    return;
  }
  cells_ = delaunay(points_);
  for (std::uint32_t c = 0; c < cells_.size(); ++c)
    for (const std::uint32_t v : cells_[c].vertex) cell_of_[v] = c;
}

void Constrained::sweep() {
  const std::uint32_t used = start_fan();
  if (used == 0) return;
  cells_.reserve(points_.size() * 2);
  for (std::uint32_t p = used; p < points_.size(); ++p) insert(p);
}

void Constrained::attach(std::uint32_t cell, std::uint32_t index, std::uint32_t neighbour,
                         bool fixed, bool odd) {
  Cell& c = cells_[cell];
  c.neighbour[index] = neighbour;
  c.fixed[index] = fixed;
  c.odd[index] = odd;
  if (neighbour == kNone) {
    set_hull(cell, index);
    return;
  }
  Cell& other = cells_[neighbour];
  // The neighbour's edge runs the other way round.
  other.neighbour[after(index_of(other, c.vertex[after(index)]))] = cell;
}

/// Replaces the edge opposite corner `index` by the other diagonal of its quadrilateral.
void Constrained::flip(std::uint32_t cell, std::uint32_t index) {
  const Cell t = cells_[cell];
  const std::uint32_t other = t.neighbour[index];
  const Cell u = cells_[other];
  const std::uint32_t p = t.vertex[index], a = t.vertex[after(index)], b = t.vertex[before(index)];
  const std::uint32_t ia = after(index), ib = before(index);
  const std::uint32_t ua = index_of(u, a), ub = index_of(u, b);
  const std::uint32_t q = u.vertex[after(ua) == ub ? before(ua) : after(ua)];
  cells_[cell] = {{p, a, q}, {kNone, other, kNone}, {}, {}};
  cells_[other] = {{p, q, b}, {kNone, kNone, cell}, {}, {}};
  attach(cell, 0, u.neighbour[ub], u.fixed[ub], u.odd[ub]);   // a-q
  attach(cell, 2, t.neighbour[ib], t.fixed[ib], t.odd[ib]);   // p-a
  attach(other, 0, u.neighbour[ua], u.fixed[ua], u.odd[ua]);  // q-b
  attach(other, 1, t.neighbour[ia], t.fixed[ia], t.odd[ia]);  // b-p
  cell_of_[p] = cell_of_[a] = cell_of_[q] = cell;
  cell_of_[b] = other;
}

void Constrained::legalise() {
  while (!doubtful_.empty()) {
    const Corner at = doubtful_.back();
    doubtful_.pop_back();
    const Cell& cell = cells_[at.cell];
    const std::uint32_t other = cell.neighbour[at.index];
    if (other == kNone || cell.fixed[at.index]) continue;
    const Cell& u = cells_[other];
    const std::uint32_t a = cell.vertex[after(at.index)], b = cell.vertex[before(at.index)];
    std::uint32_t q = u.vertex[0];
    for (const std::uint32_t v : u.vertex)
      if (v != a && v != b) q = v;
    if (!in_circle(cell, q)) continue;
    flip(at.cell, at.index);
    doubtful_.push_back({at.cell, 0});
    doubtful_.push_back({at.cell, 2});
    doubtful_.push_back({other, 0});
    doubtful_.push_back({other, 1});
  }
}

void Constrained::improve() {
  for (std::uint32_t c = 0; c < cells_.size(); ++c)
    for (std::uint32_t k = 0; k < 3; ++k) doubtful_.push_back({c, k});
  legalise();
}

/// Calls visit(corner of the vertex) for the triangles round it until it returns true.
template <class Visit>
void Constrained::visit_star(std::uint32_t vertex, Visit&& visit) const {
  const std::uint32_t start = cell_of_[vertex];
  std::uint32_t cell = start;
  do {
    const std::uint32_t index = index_of(cells_[cell], vertex);
    if (visit(Corner{cell, index})) return;
    cell = cells_[cell].neighbour[after(index)];
  } while (cell != kNone && cell != start);
  if (cell == start) return;
  // Met the hull: the rest lies the other way.
  cell = cells_[start].neighbour[before(index_of(cells_[start], vertex))];
  while (cell != kNone) {
    const std::uint32_t index = index_of(cells_[cell], vertex);
    if (visit(Corner{cell, index})) return;
    cell = cells_[cell].neighbour[before(index)];
  }
}

/// The corner opposite the edge a-b, in either sense.
Constrained::Corner Constrained::find_edge(std::uint32_t a, std::uint32_t b) const {
  Corner found;
  visit_star(a, [&](const Corner& at) {
    const Cell& cell = cells_[at.cell];
    if (cell.vertex[after(at.index)] == b) found = {at.cell, before(at.index)};
    if (cell.vertex[before(at.index)] == b) found = {at.cell, after(at.index)};
    return found.cell != kNone;
  });
  return found;
}

void Constrained::fix(std::uint32_t a, std::uint32_t b) {
  const Corner at = find_edge(a, b);
  Cell& cell = cells_[at.cell];
  cell.fixed[at.index] = true;
  cell.odd[at.index] = !cell.odd[at.index];
  if (cell.neighbour[at.index] == kNone) return;
  Cell& other = cells_[cell.neighbour[at.index]];
  for (std::uint32_t k = 0; k < 3; ++k)
    if (other.neighbour[k] == at.cell) {
      const bool same = (other.vertex[after(k)] == a && other.vertex[before(k)] == b) ||
                        (other.vertex[after(k)] == b && other.vertex[before(k)] == a);
      if (!same) continue;
      other.fixed[k] = true;
      other.odd[k] = cell.odd[at.index];
    }
}

/// Walks from a towards b, noting what is crossed, to b or to the first vertex on the way; false
/// where a segment is in the way.
bool Constrained::collect(std::uint32_t a, std::uint32_t b, Corner start, Cavity& cavity) const {
  Corner at = start;
  std::uint32_t right = cells_[at.cell].vertex[after(at.index)];
  std::uint32_t left = cells_[at.cell].vertex[before(at.index)];
  std::uint32_t entered = kNone;
  cavity.right = {right};
  cavity.left = {left};
  for (;;) {
    const Cell& cell = cells_[at.cell];
    if (cell.fixed[at.index]) return false;
    cavity.add(at.cell, cell, entered, at.index);
    const std::uint32_t next = cell.neighbour[at.index];
    const Cell& beyond = cells_[next];
    std::uint32_t apex_index = 0;
    while (beyond.vertex[apex_index] == left || beyond.vertex[apex_index] == right) ++apex_index;
    const std::uint32_t apex = beyond.vertex[apex_index];
    const int where = apex == b ? 0 : side(a, b, apex);
    entered = apex_index;
    if (where == 0) {
      cavity.add(next, beyond, entered, kNone);
      cavity.end = apex;
      return true;
    }
    // Leave through the edge that the segment still separates.
    at = {next, index_of(beyond, where > 0 ? left : right)};
    (where > 0 ? left : right) = apex;
    (where > 0 ? cavity.left : cavity.right).push_back(apex);
  }
}

void Constrained::Cavity::add(std::uint32_t number, const Cell& cell, std::uint32_t entered,
                              std::uint32_t left_through) {
  cells.push_back(number);
  for (std::uint32_t k = 0; k < 3; ++k)
    if (k != entered && k != left_through)
      rim.push_back({cell.vertex[after(k)], cell.vertex[before(k)], cell.neighbour[k],
                     cell.fixed[k], cell.odd[k]});
}

/// Adds the triangles of the pseudo-polygon to the left of p -> q, whose other vertices are
/// chain, from p to q: the one on p -> q has the vertex whose circle holds no other, and what is
/// left of the chain lies beyond its two other edges.
void Constrained::fill(std::uint32_t p, std::uint32_t q, std::span<const std::uint32_t> chain,
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
        if (side(piece.p, c, chain[best + 1]) > 0) best = i;
      } else if (inside_circle(points_[piece.p], points_[piece.q], points_[c], points_[v])) {
        best = i;
      }
    }
    triangles.push_back({piece.p, piece.q, chain[best]});
    open.push_back({piece.p, chain[best], piece.first, best});
    open.push_back({chain[best], piece.q, best + 1, piece.last});
  }
}

/// Puts triangles in the place of the cavity's cells and ties them to each other and to its rim.
void Constrained::replace(Cavity& cavity, std::span<const std::array<std::uint32_t, 3>> triangles) {
  struct Side {
    Edge edge;
    std::uint32_t cell, index;
  };
  std::vector<Side> sides;
  sides.reserve(triangles.size() * 3);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const std::uint32_t number = cavity.cells[t];
    cells_[number] = {triangles[t], {kNone, kNone, kNone}, {}, {}};
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto& v = triangles[t];
      cell_of_[v[k]] = number;
      sides.push_back({{v[after(k)], v[before(k)]}, number, k});
    }
  }
  const auto by_edge = [](const Side& x, const Side& y) { return x.edge < y.edge; };
  std::sort(sides.begin(), sides.end(), by_edge);
  std::sort(cavity.rim.begin(), cavity.rim.end(), [](const RimEdge& x, const RimEdge& y) {
    return std::pair(x.from, x.to) < std::pair(y.from, y.to);
  });
  for (const Side& at : sides) {
    const auto rim = std::lower_bound(
        cavity.rim.begin(), cavity.rim.end(), at.edge,
        [](const RimEdge& x, const Edge& edge) { return std::pair(x.from, x.to) < edge; });
    const bool on_rim = rim != cavity.rim.end() && Edge(rim->from, rim->to) == at.edge;
    // A hanging edge is on the rim twice, with cells of the cavity on both sides.
    const Side turned{{at.edge.second, at.edge.first}, 0, 0};
    const auto across = std::lower_bound(sides.begin(), sides.end(), turned, by_edge);
    const bool within = across != sides.end() && across->edge == turned.edge;
    attach(at.cell, at.index,
           within   ? across->cell
           : on_rim ? rim->neighbour
                    : kNone,
           on_rim && rim->fixed, on_rim && rim->odd);
  }
}

/// Makes a - cavity.end an edge.
bool Constrained::open_way(std::uint32_t a, Cavity& cavity) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(cavity.cells.size());
  fill(a, cavity.end, cavity.left, triangles);
  std::reverse(cavity.right.begin(), cavity.right.end());
  fill(cavity.end, a, cavity.right, triangles);
  for (const auto& t : triangles)
    if (side(t[0], t[1], t[2]) <= 0) return false;
  replace(cavity, triangles);
  return true;
}

bool Constrained::force(std::uint32_t a, std::uint32_t b) {
  while (a != b) {
    std::uint32_t end = kNone;
    Corner start;
    visit_star(a, [&](const Corner& at) {
      const Cell& cell = cells_[at.cell];
      const std::uint32_t u = cell.vertex[after(at.index)], v = cell.vertex[before(at.index)];
      const int su = u == b ? 0 : side(a, b, u), sv = v == b ? 0 : side(a, b, v);
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
    fix(a, end);
    a = end;
  }
  return true;
}

std::vector<bool> Constrained::inside() const {
  constexpr std::uint8_t kUnknown = 2;
  std::vector<std::uint8_t> state(cells_.size(), kUnknown);
  std::vector<std::uint32_t> stack;
  for (std::uint32_t c = 0; c < cells_.size(); ++c)
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
  std::vector<bool> inside(cells_.size());
  for (std::size_t c = 0; c < cells_.size(); ++c) inside[c] = state[c] == 1;
  return inside;
}

}  // namespace strake::geometry::polygon
