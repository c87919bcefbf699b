// SPDX-License-Identifier: Apache-2.0
#include "geometry/plane_section/section_caps.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "geometry/triangulation/constrained_delaunay.hpp"
#include "strake/geometry/wide_int.hpp"

namespace strake::geometry::plane_section {
namespace {

using CapPoint = triangulation::Point2;
using triangulation::TriangulationFace;

/// How often crossings are looked for: rounding one may make another, hardly ever twice.
constexpr int kRounds = 6;
constexpr std::int64_t kReach = std::int64_t{1} << 29;

bool is_closed(std::span<const Directed> outline, std::size_t vertices) {
  std::vector<std::int32_t> balance(vertices);
  for (const auto& [from, to] : outline) {
    --balance[from];
    ++balance[to];
  }
  return std::ranges::all_of(balance, [](std::int32_t b) { return b == 0; });
}

/// The same line there and back says nothing about what it surrounds.
std::vector<Directed> netted(std::span<const Directed> outline) {
  std::map<Directed, int> net;
  for (const auto& [from, to] : outline)
    net[{std::min(from, to), std::max(from, to)}] += from < to ? 1 : -1;
  std::vector<Directed> result;
  for (const auto& [ends, count] : net)
    for (int i = 0; i < std::abs(count); ++i)
      result.push_back(count > 0 ? ends : Directed{ends[1], ends[0]});
  return result;
}

/// An outline seen along an axis: what it surrounds is on the left of its lines.
class CapTriangulator {
 public:
  CapTriangulator(const CutPlane& plane, std::vector<Directed> outline,
                  std::vector<Vec3l>& vertices)
      : plane_(plane), axes_(plane.normal), lines_(std::move(outline)), vertices_(vertices) {}

  bool run(std::vector<Triangle>& triangles) {
    if (!find_middle()) return false;
    for (int round = 0; round < kRounds; ++round) {
      number_points();
      if (triangulate(triangles)) return true;
      if (!cut_crossings()) return false;
    }
    return false;
  }

 private:
  bool find_middle() {
    Box3l box = empty_box<std::int64_t>();
    for (const auto& line : lines_)
      for (const std::uint32_t v : line) box.include(Vec3l{flat(v).x, flat(v).y, 0});
    const Vec3l half = (box.hi - box.lo);
    middle_ = {box.lo.x + half.x / 2, box.lo.y + half.y / 2};
    return half.x / 2 < kReach && half.y / 2 < kReach;
  }

  [[nodiscard]] CapPoint flat(std::uint32_t v) const {
    return {vertices_[v][axes_.u] - middle_.x, vertices_[v][axes_.v] - middle_.y};
  }

  /// Points in their order, each with the lowest vertex that is seen there.
  void number_points() {
    std::vector<std::pair<CapPoint, std::uint32_t>> flat_points;
    for (const auto& line : lines_)
      for (const std::uint32_t v : line) flat_points.emplace_back(flat(v), v);
    std::ranges::sort(flat_points);
    points_.clear();
    vertex_.clear();
    number_.clear();
    for (const auto& [point, v] : flat_points) {
      if (points_.empty() || points_.back() != point) {
        points_.push_back(point);
        vertex_.push_back(v);
      }
      number_[v] = static_cast<std::uint32_t>(points_.size() - 1);
    }
  }

  [[nodiscard]] std::array<CapPoint, 2> ends(const Directed& line) const {
    return {flat(line[0]), flat(line[1])};
  }

  bool triangulate(std::vector<Triangle>& triangles) {
    triangulation::ConstrainedDelaunay mesh(points_);
    if (mesh.cells().empty()) return true;  // all on one line: it surrounds nothing
    for (const auto& [from, to] : lines_)
      if (!mesh.insert_constraint(number_[from], number_[to])) return false;
    mesh.restore_delaunay();
    const std::vector<TriangulationFace>& cells = mesh.cells();
    std::vector<std::int8_t> filled(cells.size(), kUnknown);
    for (std::uint32_t seed = 0; seed < cells.size(); ++seed) {
      if (filled[seed] == kUnknown) spread(cells, seed, winding(cells[seed]) != 0 ? 1 : 0, filled);
      if (filled[seed] != 1) continue;
      const auto& v = cells[seed].vertex;
      triangles.push_back({vertex_[v[0]], vertex_[v[1]], vertex_[v[2]]});
    }
    return true;
  }

  static constexpr std::int8_t kUnknown = -1;

  /// Says of all cells that no line parts from this one what holds of it.
  static void spread(const std::vector<TriangulationFace>& cells, std::uint32_t seed,
                     std::int8_t value, std::vector<std::int8_t>& filled) {
    std::vector<std::uint32_t> stack{seed};
    filled[seed] = value;
    while (!stack.empty()) {
      const TriangulationFace& cell = cells[stack.back()];
      stack.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t next = cell.neighbour[k];
        if (cell.constrained[k] || next == triangulation::kNone || filled[next] != kUnknown)
          continue;
        filled[next] = value;
        stack.push_back(next);
      }
    }
  }

  /// How often the lines go round the middle of a cell, which no line meets.
  [[nodiscard]] int winding(const TriangulationFace& cell) const {
    CapPoint m{0, 0};  // three times the middle
    for (const std::uint32_t v : cell.vertex) m = {m.x + points_[v].x, m.y + points_[v].y};
    int turns = 0;
    for (const auto& line : lines_) {
      const auto [p, q] = ends(line);
      const bool up = 3 * p.y <= m.y && m.y < 3 * q.y, down = 3 * q.y <= m.y && m.y < 3 * p.y;
      if (!up && !down) continue;
      const Int128 side = static_cast<Int128>(q.x - p.x) * (m.y - 3 * p.y) -
                          static_cast<Int128>(q.y - p.y) * (m.x - 3 * p.x);
      if (up && side > 0) ++turns;
      if (down && side < 0) --turns;
    }
    return turns;
  }

  /// Where two lines cross inside both, rounded.
  static std::optional<CapPoint> crossing(const std::array<CapPoint, 2>& a,
                                          const std::array<CapPoint, 2>& b) {
    const int a0 = side_of(b[0], b[1], a[0]), a1 = side_of(b[0], b[1], a[1]);
    const int b0 = side_of(a[0], a[1], b[0]), b1 = side_of(a[0], a[1], b[1]);
    if (a0 * a1 >= 0 || b0 * b1 >= 0) return std::nullopt;
    const auto area = [](const CapPoint& p, const CapPoint& q, const CapPoint& r) {
      return static_cast<Int128>(q.x - p.x) * (r.y - p.y) -
             static_cast<Int128>(q.y - p.y) * (r.x - p.x);
    };
    Int128 num = area(b[0], b[1], a[0]), den = num - area(b[0], b[1], a[1]);
    if (den < 0) {
      num = -num;
      den = -den;
    }
    bool exact = true;
    return CapPoint{rounded(a[0].x * den + (a[1].x - a[0].x) * num, den, exact),
                    rounded(a[0].y * den + (a[1].y - a[0].y) * num, den, exact)};
  }

  /// Cuts lines that cross; false when none do.
  bool cut_crossings() {
    std::vector<std::vector<CapPoint>> at(lines_.size());
    std::vector<std::uint32_t> order(lines_.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto low = [&](std::uint32_t i) {
      const auto [p, q] = ends(lines_[i]);
      return std::min(p.x, q.x);
    };
    std::ranges::sort(order, {}, low);
    bool any = false;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const auto a = ends(lines_[order[i]]);
      const std::int64_t end = std::max(a[0].x, a[1].x);
      for (std::size_t j = i + 1; j < order.size() && low(order[j]) <= end; ++j)
        if (const auto p = crossing(a, ends(lines_[order[j]]))) {
          at[order[i]].push_back(*p);
          at[order[j]].push_back(*p);
          any = true;
        }
    }
    if (any) insert(at);
    return any;
  }

  void insert(std::vector<std::vector<CapPoint>>& at) {
    std::vector<Directed> pieces;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const std::array<CapPoint, 2> line = ends(lines_[i]);
      std::ranges::sort(at[i], {}, [&](const CapPoint& c) {
        return std::pair(std::abs(c.x - line[0].x) + std::abs(c.y - line[0].y), c);
      });
      std::uint32_t from = lines_[i][0];
      for (const CapPoint& c : at[i]) {
        const std::uint32_t to = vertex_at(c);
        if (flat(from) != c) pieces.push_back({from, to});
        from = to;
      }
      if (flat(from) != line[1]) pieces.push_back({from, lines_[i][1]});
    }
    lines_ = std::move(pieces);
  }

  std::uint32_t vertex_at(const CapPoint& p) {
    const auto found = std::ranges::lower_bound(points_, p);
    if (found != points_.end() && *found == p)
      return vertex_[static_cast<std::size_t>(found - points_.begin())];
    vertices_.push_back(on_plane(plane_, axes_, p.x + middle_.x, p.y + middle_.y));
    return static_cast<std::uint32_t>(vertices_.size() - 1);
  }

  const CutPlane& plane_;
  PlaneAxes axes_;
  std::vector<Directed> lines_;
  std::vector<Vec3l>& vertices_;
  CapPoint middle_;
  std::vector<CapPoint> points_;                   ///< ascending
  std::vector<std::uint32_t> vertex_;              ///< of each point
  std::map<std::uint32_t, std::uint32_t> number_;  ///< the point of a vertex
};

}  // namespace

bool triangulate_cap(const CutPlane& plane, std::span<const Directed> outline,
                     std::vector<Vec3l>& vertices, std::vector<Triangle>& triangles) {
  if (!is_closed(outline, vertices.size())) return false;
  std::vector<Directed> net = netted(outline);
  if (net.empty()) return true;
  return CapTriangulator(plane, std::move(net), vertices).run(triangles);
}

namespace {

constexpr std::uint32_t kNone = 0xffffffffU;

Directed ascending(const Directed& ends) {
  return {std::min(ends[0], ends[1]), std::max(ends[0], ends[1])};
}

/// The links at a vertex: the segments that end and begin there, where they are one each.
struct VertexLinks {
  std::uint32_t in = kNone, out = kNone;
  std::uint32_t count = 0;
};

}  // namespace

SectionOutline find_outline(std::vector<OutlineSegment> segments, std::span<const Vec3l> vertices,
                            const std::function<bool(std::uint32_t, std::uint32_t)>& coplanar) {
  std::map<std::uint32_t, VertexLinks> meetings;
  std::map<Directed, std::uint32_t> lying;  // how many lie on each other
  for (const OutlineSegment& s : segments) ++lying[ascending(s.ends)];
  for (std::uint32_t i = 0; i < segments.size(); ++i) {
    VertexLinks &from = meetings[segments[i].ends[0]], &to = meetings[segments[i].ends[1]];
    from.out = i;
    to.in = i;
    ++from.count;
    ++to.count;
  }
  SectionOutline result;
  std::vector<std::uint32_t> next(segments.size(), kNone), last(segments.size(), kNone);
  for (const auto& [vertex, m] : meetings) {
    if (m.count % 2 != 0) ++result.open_ends;
    if (m.count != 2 || m.in == kNone || m.out == kNone || m.in == m.out) continue;
    const OutlineSegment &in = segments[m.in], &out = segments[m.out];
    if (lying[ascending(in.ends)] > 1 || lying[ascending(out.ends)] > 1) continue;
    if (!coplanar(in.triangle, out.triangle)) continue;
    next[m.in] = m.out;
    last[m.out] = m.in;
  }
  std::set<Directed> drawn;
  for (std::uint32_t i = 0; i < segments.size(); ++i) {
    if (last[i] != kNone) continue;
    std::uint32_t end = i;
    while (next[end] != kNone) end = next[end];
    const Directed ends = ascending({segments[i].ends[0], segments[end].ends[1]});
    if (!drawn.insert(ends).second) continue;
    const Vec3l &p = vertices[ends[0]], &q = vertices[ends[1]];
    if (p != q) result.lines.push_back({std::min(p, q), std::max(p, q)});
  }
  return result;
}

}  // namespace strake::geometry::plane_section
