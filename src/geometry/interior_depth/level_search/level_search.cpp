// SPDX-License-Identifier: Apache-2.0
#include "geometry/interior_depth/level_search/level_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/interior_depth/level_search/offset_cell.hpp"
#include "geometry/interior_depth/level_search/offset_surface.hpp"
#include "geometry/numeric/vector_math.hpp"

namespace strake::geometry {
namespace {

/// Nodes of a tree, visited on the way to the nearest triangle, that count as one cell. In the
/// middle of a round body all of its surface is about equally near: a copy of a bumpy ball of 6,240
/// triangles took 3 s before nodes counted, and ends after 0.3 s since (decision 0055).
constexpr std::uint64_t kVisitedPerCell = 256;
/// Number of such nodes that making a piece of a surface counts as. With 16 the bracket of one
/// spring (a kind of bench deep_pairs) stayed wide.
constexpr std::uint64_t kVisitedPerPiece = 4;
/// The least difference of the ways to two triangles that a cut goes between.
constexpr double kMinTurn = 0.1;

/// Maximum number of half-spaces used of a part: more of a round one cost more than they cut off.
constexpr std::size_t kMaxLevelPlanes = 64;

class LevelSearch {
 public:
  LevelSearch(const DistanceField& of, const DistanceField& in, const LevelQuery& query,
              const DepthOptions& goal, QueryContext& work)
      : of_(of),
        in_(in),
        q_(query),
        goal_(goal),
        work_(work),
        flat_((query.level - query.known) / 8),
        about_of_(of),
        about_in_(in) {
    const Box3d x = of.box(), y = in.box();
    Box3d within = x;
    if (goal.within) within = goal.within->inflated(query.ceiling - query.level);
    for (int k = 0; k < 3; ++k) {
      room_.lo[k] = std::max({x.lo[k], y.lo[k], within.lo[k]});
      room_.hi[k] = std::min({x.hi[k], y.hi[k], within.hi[k]});
    }
  }

  LevelResult run() {
    answer_.none = clears(boundary_cells()) &&
                   clears(offset_surface(of_, {room_, q_.hull_in}, q_.level, flat_, work_));
    answer_.cells = cells();
    return answer_;
  }

 private:
  [[nodiscard]] std::uint64_t cells() const { return cut_ + visited_ / kVisitedPerCell; }

  /// The triangle of the first part that is nearest to a point, if nearer than `limit`.
  NearestTriangle nearest(const Vec3d& p, std::uint32_t hint, double limit) {
    const NearestTriangle near = of_.nearest(p, hint, limit);
    visited_ += near.visited;
    return near;
  }

  /// Returns the surface of the second part.
  [[nodiscard]] std::optional<std::vector<OffsetCell>> boundary_cells() const {
    const auto near = triangles_near(in_, room_, 0);
    if (!near) return std::nullopt;
    std::vector<OffsetCell> cells;
    cells.reserve(near->size());
    for (const std::uint32_t t : *near) {
      cells.push_back(flat_cell(in_.placed(t), {}));
      cells.back().on_surface = true;
    }
    return cells;
  }

  /// A cell and what is known of either part about it.
  struct OpenCell {
    OffsetCell cell;
    CellCuller::CellStatus of, in;
  };

  /// Whether nothing of a surface is a point that is looked for.
  bool clears(const std::optional<std::vector<OffsetCell>>& surface) {
    answer_.too_large = !surface;
    if (!surface) return false;
    visited_ += kVisitedPerPiece * surface->size();
    std::vector<OpenCell> open;
    for (const OffsetCell& cell : *surface) {
      if (auto rest = part_in_hulls(cell)) open.push_back({std::move(*rest), {}, {}});
      while (!open.empty()) {
        OpenCell next = std::move(open.back());
        open.pop_back();
        if (next.cell.corners.size() < 3 || is_clear(next)) continue;
        if (answer_.deeper.has_value() || radius_ - slack_ < flat_) return false;
        cut_ += 2;
        if (cells() > q_.max_cells) return false;
        for (OffsetCell& part : cut(std::move(next.cell)))
          open.push_back({std::move(part), next.of, next.in});
      }
    }
    return true;
  }

  /// What of a cell is in the hulls of both, and as deep as the level in that of the first: a ball
  /// so large about any point that is looked for is in the first part.
  [[nodiscard]] std::optional<OffsetCell> part_in_hulls(OffsetCell cell) const {
    const double slack = cell.slack + q_.slack + (cell.on_surface ? 0 : flat_);
    // A ball round the cell tells for most half-spaces that all of it is inside.
    const Vec3d middle = middle_of(cell);
    const double radius = radius_of(cell, middle);
    const auto meets = [&](const HalfSpace& hull, double inset) {
      const HalfSpace room{hull.normal, hull.offset - inset + slack};
      if (dot(room.normal, middle) + radius < room.offset) return true;
      if (std::ranges::all_of(cell.corners,
                              [&](const Vec3d& p) { return dot(room.normal, p) > room.offset; }))
        return false;
      if (cell.about.empty() && goes_through(cell, room)) cell = clip_to(cell, room);
      return true;
    };
    const bool some =
        std::ranges::all_of(q_.hull_of, [&](const HalfSpace& h) { return meets(h, q_.level); }) &&
        std::ranges::all_of(q_.hull_in, [&](const HalfSpace& h) { return meets(h, 0); });
    return some ? std::optional(std::move(cell)) : std::nullopt;
  }

  /// Also tells what is known of the parts about the cell, for those that it is cut into.
  bool is_clear(OpenCell& open) {
    const OffsetCell& cell = open.cell;
    slack_ = cell.slack + q_.slack + (cell.on_surface ? 0 : flat_);
    const CellHull hull(cell, slack_);
    if (!hull.box().meets(room_)) return true;
    middle_ = on_field_grid(middle_of(cell));
    radius_ = radius_of(cell, middle_) + slack_;
    near_.clear();
    crossing_.clear();
    if (hint_ != kNoIndex && is_near_triangle(cell, hint_)) return true;
    const NearestTriangle near = nearest(middle_, hint_, q_.level + radius_);
    if (near.triangle != kNoIndex) hint_ = near.triangle;
    if (near.distance + radius_ < q_.level) return true;
    if (near.triangle != kNoIndex && is_near_triangle(cell, near.triangle)) return true;
    if (!cell.on_surface) {
      open.in = about_in_.classify(hull, open.in, middle_, crossing_, work_);
      if (open.in.side == CellCuller::CellSide::outside) return true;
    }
    open.of = about_of_.classify(hull, open.of, middle_, crossing_, work_);
    if (open.of.side == CellCuller::CellSide::outside) return true;
    const bool in_first =
        open.of.side == CellCuller::CellSide::inside || of_.contains(middle_, work_);
    if (in_first && near.distance > (q_.known + q_.level) / 2 && in_.contains(middle_, work_) &&
        goal_.counts(middle_)) {
      answer_.deeper = middle_;
      return false;
    }
    // The part of the cell in the second is next to the surface, in one piece.
    const bool one_piece = cell.on_surface || open.in.side != CellCuller::CellSide::both;
    if (one_piece && open.of.side != CellCuller::CellSide::both && goal_.belongs &&
        !goal_.belongs(middle_))
      return true;
    if (near.triangle == kNoIndex) return false;
    if (in_first && near.distance > q_.level) return false;
    return leads_out(cell, near.triangle, in_first && near.distance > q_.level - 2 * q_.slack);
  }

  [[nodiscard]] bool is_near_triangle(const OffsetCell& cell, std::uint32_t triangle) const {
    const PreparedTriangle& t = of_.triangle(triangle);
    return std::ranges::all_of(cell.corners, [&](const Vec3d& corner) {
      const Vec3d p = of_.local(corner);
      return length(p - t.nearest(p)) + slack_ < q_.level;
    });
  }

  /// Whether a move shorter than the level, out of the triangle that is nearest to its middle or to
  /// a corner, takes all of a cell out of the first part: no point of it is farther from the
  /// surface. As deep as the level, its middle is not taken out: then only these triangles are
  /// found.
  bool leads_out(const OffsetCell& cell, std::uint32_t nearest, bool as_deep) {
    near_ = {nearest};
    if (!as_deep && leads_out(cell, middle_, nearest)) return true;
    for (const Vec3d& p : cell.corners) {
      const std::uint32_t t = nearest_to_corner(p, nearest);
      if (t == kNoIndex || std::ranges::find(near_, t) != near_.end()) continue;
      near_.push_back(t);
      if (!as_deep && leads_out(cell, p, t)) return true;
    }
    return false;
  }

  /// Cells that are cut from one have most of its corners.
  std::uint32_t nearest_to_corner(const Vec3d& p, std::uint32_t hint) {
    const auto known = std::ranges::find(queried_, p, &QueryCorner::at);
    if (known != queried_.end()) return known->nearest;
    const std::uint32_t t = nearest(p, hint, q_.level).triangle;
    if (queried_.size() < kRemembered) {
      queried_.push_back({p, t});
    } else {
      queried_[oldest_] = {p, t};
      oldest_ = (oldest_ + 1) % kRemembered;
    }
    return t;
  }

  bool leads_out(const OffsetCell& cell, const Vec3d& from, std::uint32_t triangle) {
    const PreparedTriangle t = of_.triangle(triangle);
    const Vec3d way = t.nearest(of_.local(from)) - of_.local(from);
    const double size = length(way);
    const Vec3d out = size > 0 ? way * ((dot(t.unit, way) < 0 ? -1 : 1) / size) : t.unit;
    const Vec3d move = out * (q_.level - 2 * q_.slack);
    OffsetCell moved{.corners = cell.corners, .about = {}};
    for (Vec3d& p : moved.corners) p = p + move;
    const auto stays_in = [&](const Vec3d& p) { return t.has_behind(of_.local(p)); };
    if (stays_in(middle_ + move) || std::ranges::any_of(moved.corners, stays_in)) return false;
    return is_outside(of_, {moved, slack_}, on_field_grid(middle_ + move), work_);
  }

  /// Along the plane of the largest triangle that goes through a flat cell, a little above it: the
  /// part above is clear of it. Or along that of a near triangle, lowered as far as the level: a
  /// move takes out what is above. Or between two triangles that are near to different corners.
  /// Else in half.
  [[nodiscard]] std::array<OffsetCell, 2> cut(OffsetCell cell) const {
    // Curved by no more than this, it is as good as flat.
    const double smooth = 2 * flat_;
    if (cell.slack <= smooth) cell.about.clear();
    if (cell.about.empty())
      if (const auto plane = plane_to_cut_along(cell))
        return {clip_to(cell, *plane), clip_to(cell, {-plane->normal, -plane->offset})};
    return halves_of(cell);
  }

  [[nodiscard]] std::optional<HalfSpace> plane_to_cut_along(const OffsetCell& cell) const {
    const double clear = slack_ + flat_;
    std::optional<HalfSpace> best;
    double largest = 0;
    if (crossing_.size() <= kMaxCrossing)
      for (const Corners& c : crossing_) {
        const Vec3d n = normal_of(c);
        const double area = length(n);
        if (!(area > largest)) continue;
        const double top = std::max({dot(n, c[0]), dot(n, c[1]), dot(n, c[2])}) / area;
        const HalfSpace plane{n * (1 / area), top + clear};
        if (!goes_through(cell, plane)) continue;
        largest = area;
        best = plane;
      }
    if (best) return best;
    for (const DirectionToCell& way : directions_from(near_)) {
      const HalfSpace plane{-way.unit, dot(-way.unit, middle_) + way.distance + clear - q_.level};
      if (goes_through(cell, plane)) return plane;
    }
    return plane_between(cell);
  }

  /// From a triangle to the middle of the cell.
  struct DirectionToCell {
    Vec3d unit;
    double distance = 0;
  };

  [[nodiscard]] std::vector<DirectionToCell> directions_from(
      const std::vector<std::uint32_t>& triangles) const {
    std::vector<DirectionToCell> directions;
    for (const std::uint32_t t : triangles) {
      const Vec3d p = of_.local(middle_);
      const Vec3d way = p - nearest_on_triangle(p, of_.corners(t));
      if (const double size = length(way); size > 0) directions.push_back({way * (1 / size), size});
    }
    return directions;
  }

  /// Where two triangles are equally near, as it is about the middle: the plane nearest to that.
  [[nodiscard]] std::optional<HalfSpace> plane_between(const OffsetCell& cell) const {
    const std::vector<DirectionToCell> directions = directions_from(near_);
    std::optional<HalfSpace> best;
    double least = radius_;
    for (std::size_t i = 0; i < directions.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Vec3d n = directions[i].unit - directions[j].unit;
        const double size = length(n);
        if (!(size > kMinTurn)) continue;
        const double off = (directions[j].distance - directions[i].distance) / size;
        if (!(std::fabs(off) < least)) continue;
        const Vec3d normal = n * (1 / size);
        const HalfSpace plane{normal, dot(normal, middle_) + off};
        if (!goes_through(cell, plane)) continue;
        least = std::fabs(off);
        best = plane;
      }
    return best;
  }

  /// Not where it would hardly cut anything off.
  [[nodiscard]] bool goes_through(const OffsetCell& cell, const HalfSpace& plane) const {
    ProjectionInterval r;
    for (const Vec3d& p : cell.corners) r.include(dot(plane.normal, p) - plane.offset);
    return r.lo < -2 * flat_ && r.hi > 2 * flat_;
  }

  const DistanceField &of_, &in_;
  const LevelQuery& q_;
  const DepthOptions& goal_;
  QueryContext& work_;
  double flat_;
  CellCuller about_of_, about_in_;
  Box3d room_;
  LevelResult answer_;
  std::uint64_t cut_ = 0, visited_ = 0;
  // Of the cell that was looked at last.
  Vec3d middle_;
  double radius_ = 0, slack_ = 0;
  std::vector<Corners> crossing_;
  std::uint32_t hint_ = kNoIndex;
  static constexpr std::size_t kRemembered = 32;
  struct QueryCorner {
    Vec3d at;
    std::uint32_t nearest = kNoIndex;  ///< none within the level
  };
  std::vector<QueryCorner> queried_;  ///< the last
  std::size_t oldest_ = 0;
  std::vector<std::uint32_t> near_;
};

}  // namespace

std::vector<HalfSpace> half_spaces_of(const DistanceField& part) {
  std::vector<HalfSpace> hull;
  if (part.planes() == nullptr) return hull;
  const std::vector<FaceKdop::Plane>& planes = part.planes()->planes;
  // They are sorted by their normals: any share faces all directions.
  const std::size_t step =
      std::max<std::size_t>(1, (planes.size() + kMaxLevelPlanes - 1) / kMaxLevelPlanes);
  const Vec3d shift = part.local({});
  for (std::size_t i = 0; i < planes.size(); i += step)
    hull.push_back({planes[i].normal, planes[i].support - dot(planes[i].normal, shift)});
  return hull;
}

LevelResult search_above_level(const DistanceField& of, const DistanceField& in,
                               const LevelQuery& query, const DepthOptions& goal,
                               QueryContext& work) {
  return LevelSearch(of, in, query, goal, work).run();
}

}  // namespace strake::geometry
