// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/flush_contact.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace strake::geometry {
namespace {

constexpr std::size_t kMaxTests = 1'000'000;

struct Point2 {
  std::int64_t u = 0, v = 0;
  friend bool operator==(const Point2&, const Point2&) = default;
};

/// The part of a triangle that lies in the plane: a corner, an edge or all of it.
struct Patch {
  std::array<Point2, 3> point;
  std::size_t count = 0;
  Point2 lo, hi;

  void add(const Point2& p) {
    if (count == 0) lo = hi = p;
    lo = {std::min(lo.u, p.u), std::min(lo.v, p.v)};
    hi = {std::max(hi.u, p.u), std::max(hi.v, p.v)};
    point[count++] = p;
  }
};

bool boxes_meet(const Patch& x, const Point2& lo, const Point2& hi) {
  return x.lo.u <= hi.u && lo.u <= x.hi.u && x.lo.v <= hi.v && lo.v <= x.hi.v;
}

int turn(const Point2& a, const Point2& b, const Point2& c) {
  const __int128 left = static_cast<__int128>(b.u - a.u) * (c.v - a.v);
  const __int128 right = static_cast<__int128>(b.v - a.v) * (c.u - a.u);
  return left > right ? 1 : left < right ? -1 : 0;
}

bool on_segment(const Point2& p, const Point2& a, const Point2& b) {
  return turn(a, b, p) == 0 && std::min(a.u, b.u) <= p.u && p.u <= std::max(a.u, b.u) &&
         std::min(a.v, b.v) <= p.v && p.v <= std::max(a.v, b.v);
}

bool contains(const Patch& x, const Point2& p) {
  if (x.count == 1) return x.point[0] == p;
  if (x.count == 2) return on_segment(p, x.point[0], x.point[1]);
  int least = 1, most = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const int side = turn(x.point[i], x.point[(i + 1) % 3], p);
    least = std::min(least, side);
    most = std::max(most, side);
  }
  return least >= 0 || most <= 0;
}

using Point2d = std::array<double, 2>;

Point2d as_double(const Point2& p) { return {static_cast<double>(p.u), static_cast<double>(p.v)}; }

/// Where two segments cross at interior points, if they do.
std::optional<Point2d> crossing(const Point2& a, const Point2& b, const Point2& c,
                                const Point2& d) {
  if (turn(a, b, c) * turn(a, b, d) >= 0 || turn(c, d, a) * turn(c, d, b) >= 0) return std::nullopt;
  const Point2d p = as_double(a), q = as_double(b), r = as_double(c), s = as_double(d);
  const double num = (r[0] - p[0]) * (s[1] - r[1]) - (r[1] - p[1]) * (s[0] - r[0]);
  const double den = (q[0] - p[0]) * (s[1] - r[1]) - (q[1] - p[1]) * (s[0] - r[0]);
  return Point2d{p[0] + (q[0] - p[0]) * (num / den), p[1] + (q[1] - p[1]) * (num / den)};
}

/// A point that two patches share: decided exactly, by corners in the other and edges that cross.
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
  Point2 lo, hi;

  [[nodiscard]] Point2 project(const Vec3l& p) const {
    return {p[(axis + 1) % 3], p[(axis + 2) % 3]};
  }
};

std::int32_t Vec3i::* coordinate(int axis) {
  return axis == 0 ? &Vec3i::x : axis == 1 ? &Vec3i::y : &Vec3i::z;
}

/// What of a part lies in the plane: `whole`: its triangles there, which are what bodies rest on;
/// otherwise the edges and corners of the others.
std::vector<Patch> patches_in(const Part& part, const Vec3l& shift, const Plane& plane,
                              bool whole) {
  std::vector<Patch> patches;
  // The plane touches the part's box, so that its place there fits the part's coordinates.
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

/// The plane in which two boxes meet, with what of the two bodies lies in it.
class FlushPlane {
 public:
  FlushPlane(const PlacedPart& a, const PlacedPart& b, const Plane& plane)
      : a_(*a.part), b_(*b.part), shift_(b.origin - a.origin), plane_(plane) {}

  /// A point that both have there: of two whole triangles, if there is one, or else of any two
  /// patches; nothing also when there are too many to look at.
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

FlushContact flush_contact(const PlacedPart& a, const PlacedPart& b) {
  FlushContact result;
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
  const auto point = FlushPlane(a, b, plane).find();
  if (!point) return result;
  result.touching = true;
  result.point[axis] = static_cast<double>(plane.at);
  result.point[(axis + 1) % 3] = (*point)[0];
  result.point[(axis + 2) % 3] = (*point)[1];
  return result;
}

}  // namespace strake::geometry
