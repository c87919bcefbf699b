// SPDX-License-Identifier: Apache-2.0
#include "geometry/interior_depth/level_search/offset_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "core/union_find.hpp"
#include "geometry/numeric/trig.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "strake/geometry/part.hpp"

namespace strake::geometry {
namespace {

/// Maximum number of triangles for which a surface is made. With 4,096 a dish in a skirt kept a
/// bracket of 250 mm.
constexpr std::size_t kMaxTriangles = 16384;
/// Rounding of heights over a triangle's plane, grid units, and of unit vectors.
constexpr double kHeightError = 1e-3, kUnitError = 1e-9;

/// The corners of a triangle that another does not have.
class CornersBeside {
 public:
  CornersBeside(const DistanceField& of, std::uint32_t triangle, std::uint32_t other) {
    const Triangle &x = of.part().triangles[triangle], &y = of.part().triangles[other];
    const Corners c = of.corners(triangle);
    for (std::size_t k = 0; k < 3; ++k)
      if (std::ranges::find(y, x[k]) == y.end()) corners_[count_++] = c[k];
  }
  [[nodiscard]] std::span<const Vec3d> all() const { return {corners_.data(), count_}; }

 private:
  Corners corners_{};
  std::size_t count_ = 0;
};

/// Whether some points are on one side of a triangle's plane, off it.
bool is_on_one_side(const PreparedTriangle& triangle, std::span<const Vec3d> points) {
  ProjectionInterval r;
  for (const Vec3d& p : points) r.include(dot(triangle.unit, p));
  return r.lo > triangle.hi + kHeightError || r.hi < triangle.lo - kHeightError;
}

/// Whether a triangle may meet another of its part beside what they have in common. Triangles of
/// one corner that do so reach with one side, opposite to it, into the other; those of one edge are
/// folded onto each other and have nothing between them.
bool is_crossed(const DistanceField& of, std::uint32_t triangle) {
  const PreparedTriangle own = of.triangle(triangle);
  const Box3d box = box_of(own.corners);
  return !of.for_each_near(of.placed(triangle), 0, [&](std::uint32_t t) {
    if (!box_of(of.corners(t)).meets(box)) return true;
    const CornersBeside own_rest(of, triangle, t), rest(of, t, triangle);
    const std::size_t count = rest.all().size();
    if (count < 2) return true;
    const PreparedTriangle other = of.triangle(t);
    if (is_on_one_side(own, rest.all()) || is_on_one_side(other, own_rest.all())) return true;
    return is_cell_apart(own_rest.all(), other.corners, 0) &&
           (count == 3 || is_cell_apart(rest.all(), own.corners, 0));
  });
}

/// Whether the part is on the outer side of a triangle too, at its middle.
bool has_part_outside(const DistanceField& of, std::uint32_t triangle, QueryContext& work) {
  constexpr double kStep = 1.0 / 64;
  const Corners c = of.placed(triangle);
  const Vec3d middle = (c[0] + c[1] + c[2]) * (1.0 / 3);
  return of.contains(on_field_grid(middle + of.triangle(triangle).unit * kStep), work);
}

class OffsetSurfaceBuilder {
 public:
  OffsetSurfaceBuilder(const DistanceField& of, std::vector<std::uint32_t> near, double distance,
                       double flat)
      : of_(of), near_(std::move(near)), distance_(distance), flat_(flat) {}

  std::vector<OffsetCell> run(QueryContext& work) {
    find_edges();
    find_inner(work);
    for (std::size_t i = 0; i < near_.size(); ++i) {
      const std::uint32_t t = near_[i];
      const Vec3d n = of_.triangle(t).unit;
      if (!(dot(n, n) > 0)) continue;
      cells_.push_back(flat_cell(of_.placed(t), n * -distance_));
      if (inner_[i] != 0) cells_.push_back(flat_cell(of_.placed(t), n * distance_));
    }
    for (const std::uint32_t e : edges_) add_edge(e);
    add_corners();
    return std::move(cells_);
  }

 private:
  using Ends = std::array<std::uint32_t, 2>;
  /// The total inward bend of the surface at the edges of a vertex.
  struct Bend {
    std::uint32_t corner = 0;
    double angle = 0;
  };

  [[nodiscard]] Vec3d at(std::uint32_t v) const {
    return of_.common(of_.part().vertices[v].as<double>());
  }

  [[nodiscard]] Ends ends_of(std::uint32_t edge) const {
    return {of_.part().edges[edge].v0, of_.part().edges[edge].v1};
  }

  /// Those of the near triangles, ascending.
  void find_edges() {
    for (const std::uint32_t t : near_)
      for (std::size_t i = 0; i < 3; ++i) {
        const Triangle& c = of_.part().triangles[t];
        edges_.push_back(edge_between(of_.part(), c[i], c[(i + 1) % 3]));
      }
    std::ranges::sort(edges_);
    const auto twice = std::ranges::unique(edges_);
    edges_.erase(twice.begin(), twice.end());
  }

  /// Of a near triangle; nothing for others.
  [[nodiscard]] std::optional<std::uint32_t> place(std::uint32_t t) const {
    const auto found = std::ranges::lower_bound(near_, t);
    if (found == near_.end() || *found != t) return std::nullopt;
    return static_cast<std::uint32_t>(found - near_.begin());
  }

  /// Those that may have the part on both sides, as where a mesh overlaps itself. From a triangle
  /// to its neighbour over an edge of two the outside stays what it is while nothing else touches
  /// either: of such a patch one triangle tells about all.
  void find_inner(QueryContext& work) {
    UnionFind patches(near_.size());
    for (const std::uint32_t t : near_) inner_.push_back(is_crossed(of_, t) ? 1 : 0);
    for (const std::uint32_t e : edges_) {
      const auto round = incident_triangles(of_.part(), e);
      if (round.size() != 2) continue;
      const auto i = place(round[0]), j = place(round[1]);
      if (i && j && inner_[*i] == 0 && inner_[*j] == 0) patches.join(*i, *j);
    }
    for (std::uint32_t i = 0; i < near_.size(); ++i) {
      if (inner_[i] != 0) continue;
      const std::uint32_t first_of_patch = patches.root(i);
      inner_[i] = first_of_patch == i ? (has_part_outside(of_, near_[i], work) ? 1 : 0)
                                      : inner_[first_of_patch];
    }
  }

  void add_edge(std::uint32_t edge) {
    const Ends ends = ends_of(edge);
    const Vec3d along = unit(at(ends[1]) - at(ends[0]));
    const auto round = incident_triangles(of_.part(), edge);
    const auto has_area = [&](std::uint32_t t) { return length(of_.triangle(t).unit) > 0; };
    const bool between_two = round.size() == 2 && !is_inner(round[0]) && !is_inner(round[1]) &&
                             has_area(round[0]) && has_area(round[1]);
    if (!between_two) {
      add_turn(ends, perpendicular_to(along), along);
      bends_.push_back({ends[0], 2 * kHalfTurn});
      bends_.push_back({ends[1], 2 * kHalfTurn});
      return;
    }
    const std::uint32_t t = round[0], u = round[1];
    const Vec3d n = of_.triangle(t).unit, m = of_.triangle(u).unit;
    double highest = -kHalfTurn / kUnitError;
    for (const std::uint32_t v : of_.part().triangles[u])
      if (v != ends[0] && v != ends[1]) highest = dot(n, at(v) - at(ends[0]));
    if (highest < -kHeightError) return;  // stands out
    const double sine = length(cross(n, m)), cosine = dot(n, m);
    const double angle =
        cosine > 0 ? std::min(2 * sine, kHalfTurn) : kHalfTurn;  // no less than it is
    bends_.push_back({ends[0], angle});
    bends_.push_back({ends[1], angle});
    if (distance_ * angle <= flat_) return;
    if (cosine > 0) {
      add_sector(ends, -n, -m);
    } else if (cosine > kSharp) {
      const Vec3d middle = unit(-(n + m));
      add_sector(ends, -n, middle);
      add_sector(ends, middle, -m);
    } else {
      add_turn(ends, perpendicular_to(along), along);
    }
  }

  void add_sector(const Ends& ends, const Vec3d& from, const Vec3d& to) {
    cells_.push_back(round_edge({at(ends[0]), at(ends[1])}, {from, to}, distance_));
  }

  /// Adds cells all round an edge.
  void add_turn(const Ends& ends, const Vec3d& across, const Vec3d& along) {
    const Vec3d up = cross(along, across);
    const std::array<Vec3d, 4> ways{across, up, -across, -up};
    for (std::size_t i = 0; i < 4; ++i) add_sector(ends, ways[i], ways[(i + 1) % 4]);
  }

  void add_corners() {
    std::vector<Ends> both;
    for (const std::uint32_t e : edges_) {
      const auto [v, w] = ends_of(e);
      both.push_back({v, w});
      both.push_back({w, v});
    }
    std::ranges::sort(both);
    std::ranges::sort(bends_, {}, [](const Bend& b) { return std::pair(b.corner, b.angle); });
    for (std::size_t i = 0; i < bends_.size();) {
      const std::uint32_t v = bends_[i].corner;
      double sum = 0;
      for (; i < bends_.size() && bends_[i].corner == v; ++i) sum += bends_[i].angle;
      if (distance_ * sum <= flat_) continue;
      if (sum > kHalfTurn) {
        add_ball(at(v));
        continue;
      }
      std::vector<Vec3d> edges;
      for (auto e = std::ranges::lower_bound(both, Ends{v, 0}); e != both.end() && (*e)[0] == v;
           ++e)
        edges.push_back(unit(at((*e)[1]) - at(v)));
      add_corner(at(v), edges);
    }
  }

  /// Adds cells all round a vertex.
  void add_ball(const Vec3d& corner) {
    for (const double x : {1.0, -1.0})
      for (const double y : {1.0, -1.0})
        for (const double z : {1.0, -1.0}) {
          const std::array<Vec3d, 3> ways{Vec3d{x, 0, 0}, Vec3d{0, y, 0}, Vec3d{0, 0, z}};
          cells_.push_back(round_corner(corner, ways, distance_));
        }
  }

  [[nodiscard]] bool is_inner(std::uint32_t t) const {
    const auto i = place(t);
    return i && inner_[*i] != 0;
  }

  /// A ball that only touches a corner has none of its edges on its side.
  void add_corner(const Vec3d& corner, const std::vector<Vec3d>& edges) {
    std::vector<Vec3d> rays;
    for (std::size_t i = 0; i < edges.size(); ++i)
      for (std::size_t j = i + 1; j < edges.size(); ++j) {
        const Vec3d square = cross(edges[i], edges[j]);
        const double size = length(square);
        if (!(size > kUnitError)) continue;
        for (const double sign : {1.0, -1.0}) {
          const Vec3d ray = square * (sign / size);
          const auto above = [&](const Vec3d& e) { return dot(ray, e) > kUnitError; };
          const auto same = [&](const Vec3d& r) { return dot(ray, r) > 1 - kUnitError; };
          if (std::ranges::none_of(edges, above) && std::ranges::none_of(rays, same))
            rays.push_back(ray);
        }
      }
    if (rays.size() < 3) return;
    Vec3d sum;
    for (const Vec3d& r : rays) sum = sum + r;
    const Vec3d middle = unit(sum), across = perpendicular_to(middle), up = cross(middle, across);
    std::ranges::sort(rays, {}, [&](const Vec3d& r) {
      return std::pair(arc_tan2(dot(r, up), dot(r, across)), r);
    });
    for (std::size_t i = 0; i < rays.size(); ++i)
      cells_.push_back(
          round_corner(corner, {middle, rays[i], rays[(i + 1) % rays.size()]}, distance_));
  }

  static constexpr double kSharp = -0.9;
  static constexpr double kHalfTurn = 3.2;  ///< and a little

  const DistanceField& of_;
  std::vector<std::uint32_t> near_;
  double distance_, flat_;
  std::vector<char> inner_;  ///< of each near triangle, whether it may have the part on both sides
  std::vector<std::uint32_t> edges_;
  std::vector<Bend> bends_;
  std::vector<OffsetCell> cells_;
};

}  // namespace

std::optional<std::vector<std::uint32_t>> triangles_near(const DistanceField& of, const Box3d& box,
                                                         double distance) {
  std::vector<std::uint32_t> near;
  const Box3d room = box.inflated(distance);
  std::array<Vec3d, 8> corners;
  for (unsigned i = 0; i < corners.size(); ++i)
    for (int k = 0; k < 3; ++k) corners[i][k] = ((i >> k) & 1U) == 0 ? room.lo[k] : room.hi[k];
  const bool all = of.for_each_near(corners, 0, [&](std::uint32_t t) {
    if (box_of(of.placed(t)).meets(room)) near.push_back(t);
    return near.size() <= kMaxTriangles;
  });
  if (!all) return std::nullopt;
  std::ranges::sort(near);
  return near;
}

std::optional<std::vector<OffsetCell>> offset_surface(const DistanceField& of,
                                                      const SearchRegion& room, double distance,
                                                      double flat, QueryContext& work) {
  auto near = triangles_near(of, room.box, distance);
  if (!near) return std::nullopt;
  const auto stays_out = [&](std::uint32_t t) {
    const Corners c = of.placed(t);
    return std::ranges::any_of(room.hull, [&](const HalfSpace& h) {
      return std::ranges::all_of(
          c, [&](const Vec3d& p) { return dot(h.normal, p) > h.offset + distance + kHeightError; });
    });
  };
  std::erase_if(*near, stays_out);
  return OffsetSurfaceBuilder(of, std::move(*near), distance, flat).run(work);
}

}  // namespace strake::geometry
