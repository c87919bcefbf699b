// SPDX-License-Identifier: Apache-2.0
#include "geometry/intersect/coplanar_faces.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "geometry/bvh/traversal.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/predicates.hpp"
#include "strake/geometry/wide_int.hpp"

namespace strake::geometry {
namespace {

constexpr std::size_t kMaxTests = 1'000'000;

struct FacePoint {
  std::int64_t u = 0, v = 0;
  friend bool operator==(const FacePoint&, const FacePoint&) = default;
};

/// The part of a triangle that lies in the plane: a corner, an edge or all of it.
struct Patch {
  std::array<FacePoint, 3> point;
  std::size_t count = 0;
  FacePoint lo, hi;

  void add(const FacePoint& p) {
    if (count == 0) lo = hi = p;
    lo = {std::min(lo.u, p.u), std::min(lo.v, p.v)};
    hi = {std::max(hi.u, p.u), std::max(hi.v, p.v)};
    point[count++] = p;
  }
};

bool boxes_meet(const Patch& x, const FacePoint& lo, const FacePoint& hi) {
  return x.lo.u <= hi.u && lo.u <= x.hi.u && x.lo.v <= hi.v && lo.v <= x.hi.v;
}

int turn(const FacePoint& a, const FacePoint& b, const FacePoint& c) {
  const __int128 left = static_cast<__int128>(b.u - a.u) * (c.v - a.v);
  const __int128 right = static_cast<__int128>(b.v - a.v) * (c.u - a.u);
  return left > right ? 1 : left < right ? -1 : 0;
}

bool on_segment(const FacePoint& p, const FacePoint& a, const FacePoint& b) {
  return turn(a, b, p) == 0 && std::min(a.u, b.u) <= p.u && p.u <= std::max(a.u, b.u) &&
         std::min(a.v, b.v) <= p.v && p.v <= std::max(a.v, b.v);
}

bool contains(const Patch& x, const FacePoint& p) {
  if (x.count == 1) return x.point[0] == p;
  if (x.count == 2) return on_segment(p, x.point[0], x.point[1]);
  int least = 1, largest = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const int side = turn(x.point[i], x.point[(i + 1) % 3], p);
    least = std::min(least, side);
    largest = std::max(largest, side);
  }
  return least >= 0 || largest <= 0;
}

using Point2d = std::array<double, 2>;

Point2d as_double(const FacePoint& p) {
  return {static_cast<double>(p.u), static_cast<double>(p.v)};
}

/// Returns where two segments cross at interior points, if they do.
std::optional<Point2d> crossing(const FacePoint& a, const FacePoint& b, const FacePoint& c,
                                const FacePoint& d) {
  if (turn(a, b, c) * turn(a, b, d) >= 0 || turn(c, d, a) * turn(c, d, b) >= 0) return std::nullopt;
  const Point2d p = as_double(a), q = as_double(b), r = as_double(c), s = as_double(d);
  const double num = (r[0] - p[0]) * (s[1] - r[1]) - (r[1] - p[1]) * (s[0] - r[0]);
  const double den = (q[0] - p[0]) * (s[1] - r[1]) - (q[1] - p[1]) * (s[0] - r[0]);
  return Point2d{p[0] + (q[0] - p[0]) * (num / den), p[1] + (q[1] - p[1]) * (num / den)};
}

/// Returns a point that two patches share: decided exactly, by corners in the other and edges that
/// cross.
std::optional<Point2d> common_point(const Patch& x, const Patch& y) {
  for (std::size_t i = 0; i < x.count; ++i)
    if (contains(y, x.point[i])) return as_double(x.point[i]);
  for (std::size_t j = 0; j < y.count; ++j)
    if (contains(x, y.point[j])) return as_double(y.point[j]);
  if (x.count < 2 || y.count < 2) return std::nullopt;
  for (std::size_t i = 0; i < (x.count == 3 ? 3U : 1U); ++i)
    for (std::size_t j = 0; j < (y.count == 3 ? 3U : 1U); ++j)
      if (const auto p = crossing(x.point[i], x.point[(i + 1) % x.count], y.point[j],
                                  y.point[(j + 1) % y.count]))
        return p;
  return std::nullopt;
}

/// The plane that coordinate `axis` = `at` describes, and the part of it that both boxes share.
struct Plane {
  int axis = 0;
  std::int64_t at = 0;
  FacePoint lo, hi;

  [[nodiscard]] FacePoint project(const Vec3l& p) const {
    return {p[(axis + 1) % 3], p[(axis + 2) % 3]};
  }
};

std::int32_t Vec3i::* coordinate(int axis) {
  return axis == 0 ? &Vec3i::x : axis == 1 ? &Vec3i::y : &Vec3i::z;
}

/// Returns the patches of a part in the plane. `whole`: its triangles there, on which bodies rest;
/// otherwise the edges and corners of the others.
std::vector<Patch> patches_in(const Part& part, const Vec3l& shift, const Plane& plane,
                              bool whole) {
  std::vector<Patch> patches;
  // The plane touches the part's box, so that its position fits the part's coordinates.
  const auto at = static_cast<std::int32_t>(plane.at - shift[plane.axis]);
  std::int32_t Vec3i::* const along = coordinate(plane.axis);
  const auto on = [&](std::uint32_t v) { return part.vertices[v].*along == at; };
  for (const Triangle& t : part.triangles) {
    if (whole ? !(on(t[0]) && on(t[1]) && on(t[2])) : !(on(t[0]) || on(t[1]) || on(t[2]))) continue;
    Patch patch;
    for (const std::uint32_t v : t)
      if (on(v)) patch.add(plane.project(part.vertices[v].as<std::int64_t>() + shift));
    if ((whole || patch.count < 3) && boxes_meet(patch, plane.lo, plane.hi))
      patches.push_back(patch);
  }
  // Edges before corners, each in the order of the triangles.
  std::vector<Patch> sorted;
  sorted.reserve(patches.size());
  for (const std::size_t corners : {3U, 2U, 1U})
    for (const Patch& patch : patches)
      if (patch.count == corners) sorted.push_back(patch);
  return sorted;
}

/// The plane in which two boxes meet, with the patches of the two bodies in it.
class ContactPlane {
 public:
  ContactPlane(const PlacedPart& a, const PlacedPart& b, const Plane& plane)
      : a_(*a.part), b_(*b.part), shift_(b.origin - a.origin), plane_(plane) {}

  /// Returns a common point in the plane: of two whole triangles, if there is one, or else of any
  /// two patches; nothing also when there are too many.
  [[nodiscard]] std::optional<Point2d> find() const {
    const std::vector<Patch> whole_a = patches_in(a_, {}, plane_, true);
    std::vector<Patch> whole_b;
    if (!whole_a.empty()) whole_b = patches_in(b_, shift_, plane_, true);
    if (const auto point = common(whole_a, whole_b)) return point;
    const std::vector<Patch> rest_a = patches_in(a_, {}, plane_, false);
    if (whole_a.empty() && rest_a.empty()) return std::nullopt;
    if (whole_a.empty()) whole_b = patches_in(b_, shift_, plane_, true);
    const std::vector<Patch> rest_b = patches_in(b_, shift_, plane_, false);
    if (const auto point = common(whole_a, rest_b)) return point;
    if (const auto point = common(rest_a, whole_b)) return point;
    return common(rest_a, rest_b);
  }

 private:
  static std::optional<Point2d> common(const std::vector<Patch>& of_a,
                                       const std::vector<Patch>& of_b) {
    if (of_a.size() * of_b.size() > kMaxTests) return std::nullopt;
    for (const Patch& p : of_a)
      for (const Patch& q : of_b) {
        if (!boxes_meet(p, q.lo, q.hi)) continue;
        if (const auto point = common_point(p, q)) return point;
      }
    return std::nullopt;
  }

  const Part &a_, &b_;
  Vec3l shift_;
  const Plane& plane_;
};

}  // namespace

CoplanarContact find_coplanar_contact(const PlacedPart& a, const PlacedPart& b) {
  CoplanarContact result;
  const Vec3l shift = b.origin - a.origin;
  const Box3l x = a.part->box.as<std::int64_t>();
  const Box3l y = b.part->box.as<std::int64_t>().moved(shift);
  int axis = -1;
  for (int k = 0; k < 3; ++k) {
    if (x.hi[k] <= y.lo[k] || y.hi[k] <= x.lo[k]) axis = k;
    if (x.hi[k] < y.lo[k] || y.hi[k] < x.lo[k])
      return {.separated = true, .touching = false, .point = {}};
  }
  if (axis < 0) return result;
  result.separated = true;
  Plane plane{
      .axis = axis, .at = x.hi[axis] == y.lo[axis] ? x.hi[axis] : x.lo[axis], .lo = {}, .hi = {}};
  const Box3l common = x.common(y);
  plane.lo = plane.project(common.lo);
  plane.hi = plane.project(common.hi);
  const auto point = ContactPlane(a, b, plane).find();
  if (!point) return result;
  result.touching = true;
  result.point[axis] = static_cast<double>(plane.at);
  result.point[(axis + 1) % 3] = (*point)[0];
  result.point[(axis + 2) % 3] = (*point)[1];
  return result;
}

namespace {

/// Planes with fewer triangles are traversed as quickly; at most so many planes are handled. A
/// cylinder in another of 128,000 triangles in all, flush at one end, takes 0.28 CPU s; by a
/// traversal of everything it took 87 (decision 0024).
constexpr std::size_t kFewestTriangles = 16, kMaxPlanes = 8;
/// The least share of all pairs of triangles that has to lie in the planes, as a divisor.
constexpr std::size_t kShare = 64;

/// A triangle in a coordinate plane.
struct Lying {
  int axis = 0;
  std::int64_t height = 0;
  std::uint32_t triangle = 0;
  bool along = false;  ///< its normal points along the axis

  [[nodiscard]] auto plane() const { return std::tie(axis, height); }
};

std::vector<Lying> lying(const PairLocalPart& view) {
  std::vector<Lying> all;
  for (std::uint32_t t = 0; t < view.part().triangles.size(); ++t) {
    const auto c = view.corners(t);
    for (int k = 0; k < 3; ++k) {
      if (c[0][k] != c[1][k] || c[0][k] != c[2][k]) continue;
      all.push_back({k, c[0][k], t, orient2d(c[0], c[1], c[2], k) > 0});
    }
  }
  std::ranges::sort(all, [](const Lying& p, const Lying& q) {
    return std::tie(p.axis, p.height, p.triangle) < std::tie(q.axis, q.height, q.triangle);
  });
  return all;
}

/// The triangles of a part in each plane, if many and all facing one way.
struct PlaneFaces {
  const Lying* first = nullptr;
  std::vector<std::uint32_t> triangles;
};

std::vector<PlaneFaces> faces_of(const std::vector<Lying>& all) {
  std::vector<PlaneFaces> faces;
  for (auto from = all.begin(); from != all.end();) {
    const auto to =
        std::find_if(from, all.end(), [&](const Lying& l) { return l.plane() != from->plane(); });
    const bool one_way =
        std::all_of(from, to, [&](const Lying& l) { return l.along == from->along; });
    if (one_way && static_cast<std::size_t>(to - from) >= kFewestTriangles) {
      PlaneFaces& plane = faces.emplace_back();
      plane.first = &*from;
      for (auto l = from; l != to; ++l) plane.triangles.push_back(l->triangle);
    }
    from = to;
  }
  return faces;
}

std::vector<std::uint32_t> through(const PairLocalPart& view, const CoplanarFaces& plane,
                                   const std::vector<std::uint32_t>& in_plane) {
  const Part& part = view.part();
  const std::int64_t height = plane.height - view.shift()[plane.axis];
  const auto lies = [&](std::uint32_t t) { return std::ranges::binary_search(in_plane, t); };
  std::vector<std::uint32_t> others;
  for (std::uint32_t t = 0; t < part.triangles.size(); ++t) {
    const Triangle& c = part.triangles[t];
    int above = 0, below = 0;
    std::array<std::uint32_t, 3> on{};
    std::size_t count = 0;
    for (const std::uint32_t v : c) {
      const std::int64_t at = part.vertices[v][plane.axis];
      if (at > height)
        ++above;
      else if (at < height)
        ++below;
      else
        on[count++] = v;
    }
    const auto on_rim = [&] {
      const auto round = incident_triangles(part, edge_between(part, on[0], on[1]));
      return std::ranges::any_of(round, lies);
    };
    if ((above > 0 && below > 0) || (count == 2 && !on_rim())) others.push_back(t);
  }
  return others;
}

}  // namespace

std::vector<CoplanarFaces> find_coplanar_faces(const PairLocalPart& a, const PairLocalPart& b) {
  const std::vector<Lying> lying_a = lying(a), lying_b = lying(b);
  const std::vector<PlaneFaces> faces_a = faces_of(lying_a), faces_b = faces_of(lying_b);
  std::vector<CoplanarFaces> planes;
  for (auto x = faces_a.begin(), y = faces_b.begin(); x != faces_a.end() && y != faces_b.end();) {
    const auto of_x = x->first->plane(), of_y = y->first->plane();
    if (of_x == of_y)
      planes.push_back({x->first->axis, x->first->height, x->triangles, y->triangles, {}, {}});
    if (of_x <= of_y) ++x;
    if (of_y <= of_x) ++y;
  }
  const auto pairs = [](const CoplanarFaces& p) { return p.a.size() * p.b.size(); };
  std::ranges::sort(planes, [&](const CoplanarFaces& p, const CoplanarFaces& q) {
    return std::tuple(pairs(q), p.axis, p.height) < std::tuple(pairs(p), q.axis, q.height);
  });
  if (planes.size() > kMaxPlanes) planes.resize(kMaxPlanes);
  std::size_t all = 0;
  for (const CoplanarFaces& plane : planes) all += pairs(plane);
  if (all < a.part().triangles.size() * b.part().triangles.size() / kShare) return {};
  for (CoplanarFaces& plane : planes) {
    plane.through_a = through(a, plane, plane.a);
    plane.through_b = through(b, plane, plane.b);
  }
  return planes;
}

/// The boxes of the two segments meet: for collinear segments that decides.
bool FaceBoundary::share_point(const std::array<Vec3l, 2>& s, const std::array<Vec3l, 2>& t) const {
  const auto parted_by = [&](const std::array<Vec3l, 2>& x, const std::array<Vec3l, 2>& y) {
    return orient2d(x[0], x[1], y[0], axis_) * orient2d(x[0], x[1], y[1], axis_) > 0;
  };
  return !parted_by(s, t) && !parted_by(t, s);
}

FaceBoundary::FaceBoundary(const PairLocalPart& view, std::span<const std::uint32_t> triangles,
                           int axis)
    : view_(view), axis_(axis) {
  const Part& part = view.part();
  const auto in_plane = [&](std::uint32_t t) { return std::ranges::binary_search(triangles, t); };
  std::vector<Triangle> segments;
  for (const std::uint32_t t : triangles) {
    const Triangle& c = part.triangles[t];
    for (int i = 0; i < 3; ++i) {
      const auto from = c[static_cast<std::size_t>(i)],
                 to = c[static_cast<std::size_t>((i + 1) % 3)];
      const auto round = incident_triangles(part, edge_between(part, from, to));
      if (round.size() == 2 && in_plane(round[0]) && in_plane(round[1])) continue;
      sides_.push_back({t, i});
      segments.push_back({from, to, to});
    }
  }
  if (!triangles.empty()) {
    const auto c = view.corners(triangles.front());
    facing_ = orient2d(c[0], c[1], c[2], axis);
  }
  segments_.vertices = part.vertices;
  segments_.triangles = std::move(segments);
  tree_ = TriangleBvh(segments_);
}

std::array<Vec3l, 2> FaceBoundary::ends(const TriangleEdge& side) const {
  const Triangle& c = view_.part().triangles[side.triangle];
  const auto i = static_cast<std::size_t>(side.number);
  return {view_.vertex(c[i]), view_.vertex(c[(i + 1) % 3])};
}

bool FaceBoundary::meets(const std::array<Vec3l, 2>& segment) const {
  const Box3l box = box_of(segment);
  return !traverse_bvh(
      tree_, [&](const TriangleBvh::Node& node) { return view_.box(node.box).meets(box); },
      [&](std::uint32_t i) {
        const std::array<Vec3l, 2> other = ends(sides_[i]);
        return !box_of(other).meets(box) || !share_point(segment, other);
      });
}

std::optional<std::uint32_t> FaceBoundary::face_containing(const Vec3l& p) const {
  const int along = (axis_ + 1) % 3, across = (axis_ + 2) % 3;
  const auto near = [&](const TriangleBvh::Node& node) {
    const Box3l box = view_.box(node.box);
    return box.hi[along] >= p[along] && box.lo[across] <= p[across] && box.hi[across] >= p[across];
  };
  // Cast a ray along the first coordinate; an edge includes its lower end, not its upper one.
  int winding = 0;
  std::optional<std::uint32_t> nearest;
  Int128 first = 0, first_rise = 0;
  (void)traverse_bvh(tree_, near, [&](std::uint32_t i) {
    auto [low, high] = ends(sides_[i]);
    if ((low[across] <= p[across]) == (high[across] <= p[across])) return true;
    const int up = low[across] < high[across] ? 1 : -1;
    if (up < 0) std::swap(low, high);
    if (orient2d(low, high, p, axis_) < 0) return true;  // the ray starts beyond it
    winding += up;
    if (up != facing_) return true;  // the face lies on the far side
    // The hit's distance from p as a ratio.
    const Int128 rise = high[across] - low[across];
    const Int128 way = (low[along] - p[along]) * rise +
                       Int128{p[across] - low[across]} * (high[along] - low[along]);
    if (!nearest || way * first_rise < first * rise) {
      nearest = sides_[i].triangle;
      first = way;
      first_rise = rise;
    }
    return true;
  });
  return winding == 0 ? std::nullopt : nearest;
}

}  // namespace strake::geometry
