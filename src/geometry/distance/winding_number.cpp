// SPDX-License-Identifier: Apache-2.0
#include "geometry/distance/winding_number.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/numeric/trig.hpp"
#include "geometry/numeric/vector_math.hpp"

namespace strake::geometry {
namespace {

constexpr std::size_t kDeepest = 64;
/// A parameter beyond the end of any ray.
constexpr double kNoHit = 1e300;

/// The least share of odd directions (those that meet an odd number of triangles) from a point
/// inside: objects in a body or walls across it make some of them even, as in a bore all are.
constexpr double kMinOdd = 0.25;

/// Returns half the solid angle of a triangle as seen from the origin (A. van Oosterom and J.
/// Strackee, 1983).
double half_solid_angle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double x = length(a), y = length(b), z = length(c);
  return arc_tan2(dot(a, cross(b, c)), x * y * z + dot(a, b) * z + dot(b, c) * x + dot(c, a) * y);
}

/// Whether a ray meets a box before parameter `far`.
bool meets(const Box3d& box, const Vec3d& from, const Vec3d& way, double far) {
  double first = 0, last = far;
  for (int k = 0; k < 3; ++k) {
    if (way[k] == 0) {
      if (from[k] < box.lo[k] || from[k] > box.hi[k]) return false;
      continue;
    }
    const double one = (box.lo[k] - from[k]) / way[k], other = (box.hi[k] - from[k]) / way[k];
    first = std::max(first, std::min(one, other));
    last = std::min(last, std::max(one, other));
  }
  return first <= last;
}

/// Returns where a ray meets a triangle, in lengths of `way` (T. Möller and B. Trumbore, 1997).
std::optional<double> meet(const Vec3d& from, const Vec3d& way, const Vec3d& a, const Vec3d& b,
                           const Vec3d& c) {
  const Vec3d u = b - a, v = c - a, across = cross(way, v), off = from - a;
  const double det = dot(u, across);
  if (det == 0) return std::nullopt;
  const double s = dot(off, across) / det;
  const Vec3d turned = cross(off, u);
  const double t = dot(way, turned) / det;
  if (s < 0 || t < 0 || s + t > 1) return std::nullopt;
  return dot(v, turned) / det;
}

/// Whether a triangle runs from the lower vertex of its edge to the higher one.
bool runs_up(const Triangle& t, const PartEdge& e) {
  for (std::size_t k = 0; k < 3; ++k)
    if (t[k] == e.v0) return t[(k + 1) % 3] == e.v1;
  return false;
}

/// Whether a part is one surface, no edge of which has more than two triangles, and these the same
/// side.
bool faces_one_way(const Part& part) {
  if (part.shell_count > 1) return false;
  for (std::size_t e = 0; e + 1 < part.edges.size(); ++e) {
    const std::uint32_t first = part.edges[e].first_triangle;
    const std::uint32_t count = part.edges[e + 1].first_triangle - first;
    if (count > 2) return false;
    if (count < 2) continue;
    const auto up = [&](std::uint32_t k) {
      return runs_up(part.triangles[part.edge_triangles[first + k]], part.edges[e]);
    };
    if (up(0) == up(1)) return false;
  }
  return true;
}

}  // namespace

WindingNumber::WindingNumber(const Part& part)
    : triangles_(part.triangles.begin(), part.triangles.end()), one_way_(faces_one_way(part)) {
  vertices_.reserve(part.vertices.size());
  for (const Vec3i& v : part.vertices) vertices_.push_back(v.as<double>());
  if (triangles_.empty()) return;
  Node all;
  all.count = static_cast<std::uint32_t>(triangles_.size());
  nodes_.push_back(all);
  for (std::size_t n = 0; n < nodes_.size(); ++n) split(n);
}

const Vec3d& WindingNumber::corner(std::uint32_t triangle, std::size_t k) const {
  return vertices_[triangles_[triangle][k]];
}

void WindingNumber::measure(Node& node) const {
  node.box = empty_box<double>();
  for (std::uint32_t t = node.first; t < node.first + node.count; ++t) {
    const Vec3d &a = corner(t, 0), &b = corner(t, 1), &c = corner(t, 2);
    for (const Vec3d& v : {a, b, c}) node.box.include(v);
    const Vec3d area = cross(b - a, c - a) * 0.5;
    const double size = length(area);
    node.area = node.area + area;
    node.centre = node.centre + (a + b + c) * (size / 3);
    node.size += size;
  }
  node.centre = node.centre * (1 / node.size);
}

void WindingNumber::split(std::size_t n) {
  // Between 2 and 32 ships show no difference (decision 0073).
  constexpr std::uint32_t kLeaf = 8;
  Node node = nodes_[n];
  measure(node);
  if (node.count > kLeaf) {
    const Vec3d size = node.box.hi - node.box.lo;
    int axis = size.y > size.x ? 1 : 0;
    if (size.z > size[axis]) axis = 2;
    const auto twice = [&](const Triangle& t) {
      return vertices_[t[0]][axis] + vertices_[t[1]][axis] + vertices_[t[2]][axis];
    };
    const auto first = triangles_.begin() + node.first;
    const std::uint32_t half = node.count / 2;
    std::sort(first, first + node.count, [&](const Triangle& s, const Triangle& t) {
      const double x = twice(s), y = twice(t);
      return x != y ? x < y : s < t;
    });
    node.left = static_cast<std::uint32_t>(nodes_.size());
    Node child;
    child.first = node.first;
    child.count = half;
    nodes_.push_back(child);
    child.first = node.first + half;
    child.count = node.count - half;
    nodes_.push_back(child);
  }
  nodes_[n] = node;
}

double WindingNumber::at(const Vec3d& at) const {
  // A node counts as a whole from so many of its radii away: the sum is then off by about a
  // hundredth (decision 0035).
  constexpr double kFar = 2;
  constexpr double kFull = 4 * 3.14159265358979323846;
  double filled = 0;
  std::array<std::uint32_t, kDeepest> waiting{};
  for (std::size_t count = nodes_.empty() ? 0 : 1; count > 0;) {
    const Node& node = nodes_[waiting[--count]];
    const Vec3d off = node.centre - at, half = node.box.hi - node.box.lo;
    const double distance = length(off);
    // No corner of the box is farther from the centre than the box is long.
    if (distance > kFar * length(half)) {
      filled += dot(node.area, off) / (distance * distance * distance);
    } else if (node.left != 0) {
      waiting[count++] = node.left;
      waiting[count++] = node.left + 1;
    } else {
      for (std::uint32_t t = node.first; t < node.first + node.count; ++t)
        filled += 2 * half_solid_angle(corner(t, 0) - at, corner(t, 1) - at, corner(t, 2) - at);
    }
  }
  return filled / kFull;
}

/// Calls visit(parameter of the hit, in lengths of `way`) for the triangles that a ray meets;
/// `far`, which may fall meanwhile, is its end.
template <class Visit>
void WindingNumber::along(const Vec3d& from, const Vec3d& way, const double& far,
                          const Visit& visit) const {
  std::array<std::uint32_t, kDeepest> waiting{};
  for (std::size_t count = nodes_.empty() ? 0 : 1; count > 0;) {
    const Node& node = nodes_[waiting[--count]];
    if (!meets(node.box, from, way, far)) continue;
    if (node.left != 0) {
      waiting[count++] = node.left;
      waiting[count++] = node.left + 1;
      continue;
    }
    for (std::uint32_t t = node.first; t < node.first + node.count; ++t)
      if (const auto hit = meet(from, way, corner(t, 0), corner(t, 1), corner(t, 2))) visit(*hit);
  }
}

std::optional<double> WindingNumber::first_hit(const Vec3d& from, const Vec3d& way) const {
  constexpr double kStart = 1e-6;
  double far = kNoHit;
  along(from, way, far, [&](double hit) {
    if (hit > kStart) far = std::min(far, hit);
  });
  return far < kNoHit ? std::optional(far) : std::nullopt;
}

int WindingNumber::crossings(const Vec3d& from, const Vec3d& way) const {
  int met = 0;
  along(from, way, kNoHit, [&](double hit) { met += hit > 0 ? 1 : 0; });
  return met;
}

/// Returns the share of the directions from a point that lead out; nothing where it is `limit` or
/// more, or where too few meet an odd number of triangles. That often shows long before the last.
std::optional<double> WindingNumber::share_out(const Vec3d& from, int rays, double limit) const {
  // The same in three dimensions, for evenly distributed directions of points in a ball.
  constexpr double kStepX = 0.8191725133961645, kStepY = 0.6710436067037893,
                   kStepZ = 0.5497004779019703;
  int out = 0, odd = 0, visited = 0;
  for (int i = 1; visited < rays; ++i) {
    const Vec3d way{2 * std::fmod(i * kStepX, 1) - 1, 2 * std::fmod(i * kStepY, 1) - 1,
                    2 * std::fmod(i * kStepZ, 1) - 1};
    const double squared = dot(way, way);
    if (squared > 1 || squared == 0) continue;
    const int met = crossings(from, way);
    out += met == 0 ? 1 : 0;
    odd += met % 2;
    ++visited;
    if (static_cast<double>(out) / rays >= limit) return std::nullopt;
    if (static_cast<double>(odd + rays - visited) / rays < kMinOdd) return std::nullopt;
  }
  return static_cast<double>(out) / rays;
}

/// Returns the share of directions that lead out from a point; nothing where the point is not
/// inside.
std::optional<double> WindingNumber::out_of(const Vec3d& at) const {
  constexpr double kHalf = 0.5;
  if (one_way_) {
    // Slightly negative values are rounding and kept, so that it cancels on average.
    const double winding = std::fabs(this->at(at));
    if (winding <= kHalf) return std::nullopt;
    return winding > 1 + kHalf ? winding - 1 : 1 - winding;
  }
  constexpr int kRays = 64;
  return share_out(at, kRays, kHalf);
}

bool WindingNumber::surrounds(const Vec3d& at) const {
  if (one_way_) return out_of(at).has_value();
  constexpr int kRays = 256;
  // Between a fin and the surface that it stands on a quarter of the directions leads out.
  constexpr double kMaxOut = 0.2;
  return share_out(at, kRays, kMaxOut).has_value();
}

double WindingNumber::openness(double limit) const {
  constexpr int kSamples = 48;
  constexpr double kHalf = 0.5;
  // Multiples of these numbers are evenly distributed in 0 to 1, also jointly (R. Kronecker).
  constexpr double kStepS = 0.7548776662466927, kStepT = 0.5698402909980532;
  if (nodes_.empty()) return 1;
  const Node& all = nodes_.front();
  // Where so much of the area does not cancel, as much is missing, and half of its directions lead
  // out.
  if (one_way_ && length(all.area) > 2 * limit * all.size) return 1;
  double out = 0, passed = 0;
  int inside = 0, sample = 0, samples_left = 2 * kSamples;
  for (std::uint32_t i = 0; i < triangles_.size() && sample < kSamples; ++i) {
    const Vec3d &a = corner(i, 0), &b = corner(i, 1), &c = corner(i, 2);
    const Vec3d normal = cross(b - a, c - a);
    passed += length(normal) / 2;
    for (; sample < kSamples && passed * kSamples >= (sample + kHalf) * all.size; ++sample) {
      double s = std::fmod((sample + 1) * kStepS, 1), t = std::fmod((sample + 1) * kStepT, 1);
      if (s + t > 1) s = 1 - s, t = 1 - t;
      const Vec3d on = a + (b - a) * s + (c - a) * t;
      const Vec3d back = normal * (-length(all.box.hi - all.box.lo) / length(normal));
      for (const Vec3d& way : {back, back * -1.0}) {
        // Whatever the others are, they are too few inside, or too much leads out: shares of rays
        // are never negative.
        if (2 * (inside + samples_left) < kSamples) return 1;
        if (!one_way_ && out > limit * (inside + samples_left)) return 1;
        --samples_left;
        const auto hit = first_hit(on, way);
        if (!hit) continue;
        const auto leads_out = out_of(on + way * (*hit / 2));
        if (!leads_out) continue;
        ++inside;
        out += *leads_out;
      }
    }
  }
  return inside * 2 >= kSamples ? out / inside : 1;
}

}  // namespace strake::geometry
