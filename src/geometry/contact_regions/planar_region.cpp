// SPDX-License-Identifier: Apache-2.0
// The ends of parts at a plane, for contacts in one planar region.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "core/union_find.hpp"
#include "geometry/contact_regions/contact_regions.hpp"
#include "geometry/distance/elementary_distance.hpp"
#include "geometry/numeric/triangle_math.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {
namespace {

/// A point in a plane.
struct PointInPlane {
  double x, y;  // not initialised: large arrays of these are filled in part
};

/// The reach of a contact and the band that counts as one plane: a share of the reach, but at least
/// what the snap may have moved. Grid units.
struct PlanarReach {
  static constexpr double kShare = 0.05, kSnap = 4;

  double reach = 0, band = 0;

  explicit PlanarReach(double near) : reach(near), band(std::max(kSnap, kShare * near)) {}
};

/// A plane perpendicular to a unit axis, with coordinates in it.
struct PlaneFrame : PlanarReach {
  Vec3d u, w;

  PlaneFrame(const Vec3d& axis, const PlanarReach& near);

  [[nodiscard]] PointInPlane put(const Vec3d& p) const { return {dot(u, p), dot(w, p)}; }
};

/// A part, a direction out of it along a plane's axis, and how far the part reaches in that
/// direction.
struct DirectedPart {
  const Part& part;
  Vec3d way;
  double top = 0;
  Vec3d shift;  ///< from the part's coordinates into those of the pair
};

/// The end of a part within reach of a plane: faces in it, and walls that leave it steeply.
class PlanarEnd {
 public:
  /// Returns the end of a part; nothing where more of the part is near, or leaves the plane at a
  /// flat angle.
  static std::optional<PlanarEnd> of(const DirectedPart& side, const PlaneFrame& plane);

  /// Whether the end is one convex face.
  [[nodiscard]] bool is_convex() const;

  /// An edge of only one triangle in the plane, with the direction from it into that triangle.
  struct OutlineEdge {
    std::uint32_t from = 0, to = 0;  ///< vertices of the part, ascending
    PointInPlane at_from, at_to, inward;
  };
  /// Returns the border edges of the faces, including holes.
  [[nodiscard]] std::vector<OutlineEdge> rim() const;

  /// Whether the triangles in the plane are connected over their edges, and each vertex that
  /// reaches the plane is in one of them.
  [[nodiscard]] bool is_one_face() const;

  PlanarEnd(const DirectedPart& side, const PlaneFrame& plane)
      : part_(side.part),
        shift_(side.shift),
        plane_(plane),
        at_top_(side.part.vertices.size(), 0) {}

 private:
  /// Faces with more corners are left to other methods.
  static constexpr std::size_t kMaxCorners = 512;

  [[nodiscard]] bool gather(const DirectedPart& side);
  [[nodiscard]] bool add_faces(const Vec3d& way);
  [[nodiscard]] bool lies_in_plane(const Triangle& t) const {
    return at_top_[t[0]] + at_top_[t[1]] + at_top_[t[2]] == 3;
  }
  /// Returns the only triangle in the plane at an edge; null otherwise.
  [[nodiscard]] const Triangle* only_face(std::uint32_t edge) const;

  const Part& part_;
  Vec3d shift_;
  const PlaneFrame& plane_;
  std::vector<std::uint8_t> at_top_;  ///< by vertex
  std::array<PointInPlane, kMaxCorners> corners_;
  std::size_t count_ = 0;
  double area_ = 0;  ///< twice the area
};

/// The cosine of the flattest angle between a wall and the plane.
constexpr double kSteep = 0.7;

double orientation(const PointInPlane& o, const PointInPlane& p, const PointInPlane& q) {
  return (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
}

struct ConvexOutline {
  double area = 0;  ///< twice
  double rim = 0;
};

/// Returns the convex hull by Andrew's monotone chain.
template <std::size_t kMax>
ConvexOutline convex_hull_of(std::span<const PointInPlane> corners) {
  std::array<PointInPlane, kMax> sorted;
  const std::span<PointInPlane> points = std::span(sorted).first(corners.size());
  std::ranges::copy(corners, points.begin());
  std::ranges::sort(points, [](const PointInPlane& p, const PointInPlane& q) {
    return p.x != q.x ? p.x < q.x : p.y < q.y;
  });
  std::array<PointInPlane, 2 * kMax> chain;
  std::size_t size = 0;
  for (int side = 0; side < 2; ++side) {
    const std::size_t start = size;
    for (const PointInPlane& p : points) {
      while (size >= start + 2 && orientation(chain[size - 2], chain[size - 1], p) <= 0) --size;
      chain[size++] = p;
    }
    --size;
    std::ranges::reverse(points);
  }
  ConvexOutline hull;
  for (std::size_t i = 0; i < size; ++i) {
    const PointInPlane &p = chain[i], &q = chain[(i + 1) % size];
    hull.area += orientation(chain[0], p, q);
    hull.rim += std::hypot(q.x - p.x, q.y - p.y);
  }
  return hull;
}

PlaneFrame::PlaneFrame(const Vec3d& axis, const PlanarReach& near)
    : PlanarReach(near), u(perpendicular_to(axis)), w(cross(axis, u)) {}

std::optional<PlanarEnd> PlanarEnd::of(const DirectedPart& side, const PlaneFrame& plane) {
  std::optional<PlanarEnd> end(std::in_place, side, plane);
  if (!end->gather(side) || !end->add_faces(side.way)) end.reset();
  return end;
}

bool PlanarEnd::gather(const DirectedPart& side) {
  for (std::size_t v = 0; v < part_.vertices.size(); ++v) {
    const Vec3d p = part_.vertices[v].as<double>();
    const double at = dot(side.way, p);
    if (at >= side.top - plane_.band) {
      if (count_ == kMaxCorners) return false;
      corners_[count_++] = plane_.put(p + shift_);
      at_top_[v] = 1;
    } else if (at >= side.top - plane_.reach - 2 * plane_.band) {
      return false;
    }
  }
  return count_ >= 3;
}

bool PlanarEnd::add_faces(const Vec3d& way) {
  for (const Triangle& t : part_.triangles) {
    const int at_the_top = at_top_[t[0]] + at_top_[t[1]] + at_top_[t[2]];
    if (at_the_top == 0) continue;
    const Vec3d n = normal_of(corners_of(part_, t));
    if (at_the_top == 3)
      area_ += dot(n, way);
    else if (std::fabs(dot(n, way)) > kSteep * std::sqrt(dot(n, n)))
      return false;
  }
  area_ = std::fabs(area_);
  return true;
}

bool PlanarEnd::is_convex() const {
  const ConvexOutline hull = convex_hull_of<kMaxCorners>(std::span(corners_).first(count_));
  // Neither area nor border alone decides: a hole is small beside the tolerance along the border of
  // a large plate, and a notch adds little to the border. Two small feet near each other have about
  // the border of one.
  const double open = hull.area - area_;
  if (open > 2 * plane_.band * hull.rim) return false;
  if (open > 2 * PlanarReach::kSnap * hull.rim && !is_one_face()) return false;
  double rim = 0;
  for (std::uint32_t e = 0; e + 1 < part_.edges.size(); ++e) {
    if (only_face(e) == nullptr) continue;
    const PartEdge& edge = part_.edges[e];
    rim += length((part_.vertices[edge.v1] - part_.vertices[edge.v0]).as<double>());
  }
  return rim <= hull.rim + plane_.reach;
}

const Triangle* PlanarEnd::only_face(std::uint32_t edge) const {
  const PartEdge& e = part_.edges[edge];
  if (at_top_[e.v0] == 0 || at_top_[e.v1] == 0) return nullptr;
  const Triangle* only = nullptr;
  for (const std::uint32_t t : incident_triangles(part_, edge)) {
    if (!lies_in_plane(part_.triangles[t])) continue;
    if (only != nullptr) return nullptr;
    only = &part_.triangles[t];
  }
  return only;
}

std::vector<PlanarEnd::OutlineEdge> PlanarEnd::rim() const {
  std::vector<OutlineEdge> rim;
  const auto put = [&](std::uint32_t v) {
    return plane_.put(part_.vertices[v].as<double>() + shift_);
  };
  for (std::uint32_t e = 0; e + 1 < part_.edges.size(); ++e) {
    const Triangle* face = only_face(e);
    if (face == nullptr) continue;
    const PartEdge& edge = part_.edges[e];
    const std::uint32_t third = (*face)[0] ^ (*face)[1] ^ (*face)[2] ^ edge.v0 ^ edge.v1;
    const PointInPlane from = put(edge.v0), to = put(edge.v1);
    const double sign = orientation(from, to, put(third)) < 0 ? -1 : 1;
    rim.push_back({edge.v0, edge.v1, from, to, {sign * (from.y - to.y), sign * (to.x - from.x)}});
  }
  return rim;
}

bool PlanarEnd::is_one_face() const {
  UnionFind sets;
  sets.reset(part_.triangles.size());
  std::vector<std::uint8_t> covered(part_.vertices.size(), 0);
  std::size_t faces = 0;
  for (const Triangle& t : part_.triangles) {
    if (!lies_in_plane(t)) continue;
    ++faces;
    for (const std::uint32_t v : t) covered[v] = 1;
  }
  if (faces == 0 || covered != at_top_) return false;
  for (std::uint32_t e = 0; e + 1 < part_.edges.size(); ++e) {
    std::optional<std::uint32_t> first;
    for (const std::uint32_t t : incident_triangles(part_, e)) {
      if (!lies_in_plane(part_.triangles[t])) continue;
      if (first) sets.join(*first, t);
      first = first.value_or(t);
    }
  }
  return sets.count() == part_.triangles.size() - faces + 1;
}

// If the borders of two faces run along each other, each point of one face has a counterpart in the
// other within reach. Whatever else is near is connected with that: along the walls to the borders,
// and from a point of one border to a point of the other through the face between them. Only across
// a gap in the face, a notch or a hole narrower than the reach, there is no such path, so there
// must be none.

using OutlineEdge = PlanarEnd::OutlineEdge;

/// Borders with more near pairs of edges, per edge, are not decided. Two corrugated boxes of 524
/// triangles end to end take 0.2 ms so, 9 triangle by triangle (decision 0012).
constexpr std::size_t kMaxNearTriangles = 16;

struct OutlineVertex {
  PointInPlane at;
  std::uint32_t vertex = 0;
};

std::vector<OutlineVertex> outline_corners(std::span<const OutlineEdge> rim) {
  std::vector<OutlineVertex> corners;
  for (const OutlineEdge& e : rim) {
    corners.push_back({e.at_from, e.from});
    corners.push_back({e.at_to, e.to});
  }
  std::ranges::sort(corners, [](const OutlineVertex& p, const OutlineVertex& q) {
    return std::tie(p.at.x, p.at.y, p.vertex) < std::tie(q.at.x, q.at.y, q.vertex);
  });
  const auto rest = std::ranges::unique(corners, {}, &OutlineVertex::vertex);
  corners.erase(rest.begin(), rest.end());
  return corners;
}

/// By vertex of the first part: the only vertex of the second at the same point.
using MatchingVertices = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

std::optional<MatchingVertices> matching_vertices(std::span<const OutlineVertex> a,
                                                  std::span<const OutlineVertex> b, double margin) {
  if (a.size() != b.size()) return std::nullopt;
  MatchingVertices likes;
  std::vector<std::uint32_t> taken;
  for (const OutlineVertex& p : a) {
    const auto first = std::ranges::lower_bound(b, p.at.x - margin, {},
                                                [](const OutlineVertex& q) { return q.at.x; });
    std::optional<std::uint32_t> like;
    for (auto q = first; q != b.end() && q->at.x <= p.at.x + margin; ++q) {
      if (std::hypot(q->at.x - p.at.x, q->at.y - p.at.y) > margin) continue;
      if (like) return std::nullopt;
      like = q->vertex;
    }
    if (!like) return std::nullopt;
    likes.emplace_back(p.vertex, *like);
    taken.push_back(*like);
  }
  std::ranges::sort(taken);
  if (std::ranges::adjacent_find(taken) != taken.end()) return std::nullopt;
  std::ranges::sort(likes);
  return likes;
}

/// Whether each edge of the one border has a counterpart in the other.
bool run_along_each_other(std::span<const OutlineEdge> a, std::span<const OutlineEdge> b,
                          double margin) {
  const auto likes = matching_vertices(outline_corners(a), outline_corners(b), margin);
  if (!likes) return false;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const OutlineEdge& e : b) edges.emplace_back(e.from, e.to);
  std::ranges::sort(edges);
  const auto like = [&](std::uint32_t v) {
    return std::ranges::lower_bound(*likes, v, {}, &MatchingVertices::value_type::first)->second;
  };
  return std::ranges::all_of(a, [&](const OutlineEdge& e) {
    const std::uint32_t from = like(e.from), to = like(e.to);
    return std::ranges::binary_search(edges, std::pair(std::min(from, to), std::max(from, to)));
  });
}

/// Whether two border edges without a common vertex are near each other and not their face, but a
/// gap, lies between them.
struct OutlineGap {
  bool near = false, open = false;
};

OutlineGap outline_gap(const OutlineEdge& e, const OutlineEdge& f, double reach) {
  const auto raised = [](const PointInPlane& p) { return Vec3d{p.x, p.y, 0}; };
  const Vec3d p = raised(e.at_from), d = raised(e.at_to) - p;
  const Vec3d q = raised(f.at_from), g = raised(f.at_to) - q;
  const auto [s, t] = closest_on_segments(p, d, q, g);
  const Vec3d way = (q + g * t) - (p + d * s);
  if (!(dot(way, way) <= reach * reach)) return {};
  return {true, !(dot(way, raised(e.inward)) > 0 && dot(way, raised(f.inward)) < 0)};
}

/// Whether a gap in the face is narrower than the reach. Found by a sweep along x.
bool has_narrow_gap(std::vector<OutlineEdge> rim, double reach) {
  const auto low = [](const OutlineEdge& e) { return std::min(e.at_from.x, e.at_to.x); };
  const auto high = [](const OutlineEdge& e) { return std::max(e.at_from.x, e.at_to.x); };
  std::ranges::sort(rim, {}, low);
  const auto apart_in_y = [&](const OutlineEdge& e, const OutlineEdge& f) {
    const auto [e0, e1] = std::minmax(e.at_from.y, e.at_to.y);
    const auto [f0, f1] = std::minmax(f.at_from.y, f.at_to.y);
    return std::max(e0 - f1, f0 - e1) > reach;
  };
  const auto share_corner = [](const OutlineEdge& e, const OutlineEdge& f) {
    return e.from == f.from || e.from == f.to || e.to == f.from || e.to == f.to;
  };
  std::size_t left = kMaxNearTriangles * rim.size();
  for (std::size_t i = 0; i < rim.size(); ++i)
    for (std::size_t j = i + 1; j < rim.size() && low(rim[j]) <= high(rim[i]) + reach; ++j) {
      if (apart_in_y(rim[i], rim[j]) || share_corner(rim[i], rim[j])) continue;
      const OutlineGap gap = outline_gap(rim[i], rim[j], reach);
      if (gap.open || (gap.near && left-- == 0)) return true;
    }
  return false;
}

/// Whether the faces of two ends have the same outline, so that they share one face, and nothing
/// else comes within reach; `gap` grid units lie between their planes.
bool outlines_coincide(const PlanarEnd& a, const PlanarEnd& b, const PlaneFrame& plane,
                       double gap) {
  // Points of the two faces may be farther apart than their planes.
  const double across = std::fabs(gap) + 2 * plane.band;
  if (!(across < plane.reach)) return false;
  const double margin =
      std::min(plane.band, std::sqrt(plane.reach * plane.reach - across * across));
  const std::vector<OutlineEdge> outline_a = a.rim(), outline_b = b.rim();
  return outline_a.size() == outline_b.size() &&
         run_along_each_other(outline_a, outline_b, margin) && a.is_one_face() && b.is_one_face() &&
         !has_narrow_gap(outline_a, plane.reach + 2 * margin);
}

// Two convex faces in one plane have one convex polygon in common, and two of one outline that
// outline. The rest of either body within reach of the plane is a collar round its face; it leaves
// the plane steeply, so that it adds no more than a strip about as wide as the reach.

/// Whether the plane between two sides, perpendicular to the first one's direction, holds one
/// region of both.
bool face_to_face(const DirectedPart& x, const DirectedPart& y, const PlanarReach& near) {
  const double gap = dot(x.way, y.shift - x.shift) - y.top - x.top;
  if (!(gap >= -near.band && gap <= near.reach)) return false;
  const PlaneFrame plane(x.way, near);
  const std::optional<PlanarEnd> end_x = PlanarEnd::of(x, plane);
  if (!end_x) return false;
  const std::optional<PlanarEnd> end_y = PlanarEnd::of(y, plane);
  if (!end_y) return false;
  return (end_x->is_convex() && end_y->is_convex()) ||
         outlines_coincide(*end_x, *end_y, plane, gap);
}

double top_along(const Part& part, const Vec3d& way) {
  double top = -std::numeric_limits<double>::infinity();
  for (const Vec3i& v : part.vertices) top = std::max(top, dot(way, v.as<double>()));
  return top;
}

/// Tries the axes of the first part's oriented box; `shift` takes the other's coordinates to the
/// first one's.
bool along_frame(const PartWithObb& of, const Part& other, const Vec3d& shift,
                 const PlanarReach& near) {
  if (of.frame == nullptr) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d& axis = of.frame->axis[i];
    if (!(dot(axis, axis) > 0)) continue;  // a frame that was not made
    for (const double sign : {1.0, -1.0}) {
      const Vec3d way = axis * sign;
      const DirectedPart own{
          *of.placed.part, way, sign > 0 ? of.frame->hi[i] : -of.frame->lo[i], {}};
      if (face_to_face(own, {other, -way, top_along(other, -way), shift}, near)) return true;
    }
  }
  return false;
}

}  // namespace

bool meet_in_one_planar_region(const PartWithObb& a, const PartWithObb& b, double reach) {
  const Part &x = *a.placed.part, &y = *b.placed.part;
  // Visiting each vertex would cost more than finding the regions by a tree.
  if (std::max(x.vertices.size(), y.vertices.size()) >= kManyVertices) return false;
  const Vec3d shift = (b.placed.origin - a.placed.origin).as<double>();
  const PlanarReach near(reach);
  for (int k = 0; k < 3; ++k)
    for (const double sign : {1.0, -1.0}) {
      Vec3d way;
      way[k] = sign;
      const DirectedPart of_a{
          x, way, sign > 0 ? x.box.hi[k] : -static_cast<double>(x.box.lo[k]), {}};
      const DirectedPart of_b{y, -way, sign > 0 ? -static_cast<double>(y.box.lo[k]) : y.box.hi[k],
                              shift};
      if (face_to_face(of_a, of_b, near)) return true;
    }
  return along_frame(a, y, shift, near) || along_frame(b, x, -shift, near);
}

}  // namespace strake::geometry
