// SPDX-License-Identifier: Apache-2.0
#include "hlr/edges/joint_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "geometry/numeric/vector_math.hpp"
#include "hlr/edges/feature_edges.hpp"

namespace strake::hlr {
namespace {

using geometry::Part;
using geometry::PlacedPart;
using geometry::Segment;
using geometry::Vec3d;
using geometry::Vec3l;

/// A bound for how far rounding its ends to the grid takes a line off the faces that it lies on.
constexpr double kOffFace = 2;

double length_of(const Segment& s) { return geometry::length((s[1] - s[0]).as<double>()); }

/// Returns the ends and the middle, which stand for all of a line.
std::array<Vec3d, 3> samples(const Segment& line) {
  const Vec3d a = line[0].as<double>(), b = line[1].as<double>();
  return {a, (a + b) * 0.5, b};
}

double distance(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d along = b - a;
  const double t = std::clamp(dot(p - a, along) / dot(along, along), 0.0, 1.0);
  return geometry::length(p - (a + along * t));
}

/// A part in the coordinates of the first of two.
class JointSurface {
 public:
  JointSurface(const PlacedPart& placed, const Vec3l& origin, std::vector<FeatureEdge> edges)
      : part_(*placed.part), at_((placed.origin - origin).as<double>()), edges_(std::move(edges)) {}

  /// Returns whether all of a line lies that near to edges that are drawn in every view.
  [[nodiscard]] bool has_edge_along(const Segment& line, double within) const {
    return std::ranges::all_of(samples(line), [&](const Vec3d& p) {
      return std::ranges::any_of(edges_, [&](const FeatureEdge& e) {
        return distance(p, e.a.as<double>() + at_, e.b.as<double>() + at_) <= within;
      });
    });
  }

  /// Returns the normals of the triangles that hold a point.
  [[nodiscard]] std::vector<Vec3d> normals_at(const Vec3d& point) const {
    const Vec3d p = point - at_;
    std::vector<Vec3d> normals;
    for (std::uint32_t t = 0; t < part_.triangles.size(); ++t)
      if (holds(t, p)) normals.push_back(normal(t));
    return normals;
  }

 private:
  [[nodiscard]] Vec3d corner(std::uint32_t t, std::size_t k) const {
    return part_.vertices[part_.triangles[t][k % 3]].as<double>();
  }
  /// Returns the unit normal of a triangle.
  [[nodiscard]] Vec3d normal(std::uint32_t t) const {
    const Vec3d n = cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
    return n * (1 / geometry::length(n));
  }
  [[nodiscard]] bool holds(std::uint32_t t, const Vec3d& p) const {
    for (int k = 0; k < 3; ++k) {
      const double x = corner(t, 0)[k], y = corner(t, 1)[k], z = corner(t, 2)[k];
      if (p[k] < std::min({x, y, z}) - kOffFace || p[k] > std::max({x, y, z}) + kOffFace)
        return false;
    }
    const Vec3d n = normal(t);
    if (std::fabs(dot(n, p - corner(t, 0))) > kOffFace) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d side = corner(t, k + 1) - corner(t, k);
      if (dot(cross(n, side), p - corner(t, k)) < -kOffFace * geometry::length(side)) return false;
    }
    return true;
  }

  const Part& part_;
  Vec3d at_;
  std::vector<FeatureEdge> edges_;
};

/// Ends of pipes that are flush face each other within less than this: a milliradian.
constexpr double kCosFlush = 1 - 5e-7;

/// Returns whether the skins turn by more than the sharp angle at a line, and are not flush.
bool turns_sharply(const JointSurface& a, const JointSurface& b, const Segment& line,
                   double cos_sharp) {
  const Vec3d middle = samples(line)[1];
  const std::vector<Vec3d> of_b = b.normals_at(middle);
  return std::ranges::none_of(a.normals_at(middle), [&](const Vec3d& n) {
    return std::ranges::any_of(
        of_b, [&](const Vec3d& m) { return dot(n, m) >= cos_sharp || dot(n, m) <= -kCosFlush; });
  });
}

/// The graph of lines: their ends, numbered, and the lines between them.
class LineGraph {
 public:
  explicit LineGraph(const std::vector<Segment>& lines) : lines_(lines) {
    for (const Segment& line : lines) points_.insert(points_.end(), line.begin(), line.end());
    std::ranges::sort(points_);
    points_.erase(std::ranges::unique(points_).begin(), points_.end());
    at_.resize(points_.size());
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (const Vec3l& end : lines[i])
        if (const auto p = find(end)) at_[*p].push_back(i);
  }

  /// Marks the lines of the shortest paths from the first of the ends in each connected component
  /// to all others in it.
  [[nodiscard]] std::vector<bool> shortest_paths_between(const std::vector<Vec3l>& ends) const {
    std::vector<bool> kept(lines_.size()), wanted(points_.size()), done(points_.size());
    for (const Vec3l& end : ends)
      if (const auto p = find(end)) wanted[*p] = true;
    for (std::size_t p = 0; p < points_.size(); ++p)
      if (wanted[p] && !done[p]) mark_from(p, wanted, done, kept);
    return kept;
  }

 private:
  [[nodiscard]] std::optional<std::size_t> find(const Vec3l& point) const {
    const auto found = std::ranges::lower_bound(points_, point);
    if (found == points_.end() || *found != point) return std::nullopt;
    return static_cast<std::size_t>(found - points_.begin());
  }

  void mark_from(std::size_t start, const std::vector<bool>& wanted, std::vector<bool>& done,
                 std::vector<bool>& kept) const {
    constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    std::vector<double> way(points_.size(), std::numeric_limits<double>::infinity());
    std::vector<std::size_t> by(points_.size(), kNone);  // the line by which a point is reached
    way[start] = 0;
    for (;;) {
      std::size_t next = kNone;
      for (std::size_t p = 0; p < points_.size(); ++p)
        if (!done[p] &&
            way[p] < (next == kNone ? std::numeric_limits<double>::infinity() : way[next]))
          next = p;
      if (next == kNone) break;
      done[next] = true;
      for (const std::size_t i : at_[next]) {
        const std::size_t to = other_end(i, next);
        const double length = way[next] + length_of(lines_[i]);
        if (length >= way[to]) continue;
        way[to] = length;
        by[to] = i;
      }
    }
    for (std::size_t p = 0; p < points_.size(); ++p)
      if (wanted[p] && by[p] != kNone)
        for (std::size_t q = p; by[q] != kNone && !kept[by[q]]; q = other_end(by[q], q))
          kept[by[q]] = true;
  }

  [[nodiscard]] std::size_t other_end(std::size_t line, std::size_t point) const {
    const std::size_t first = find(lines_[line][0]).value_or(point);
    return first == point ? find(lines_[line][1]).value_or(point) : first;
  }

  const std::vector<Segment>& lines_;
  std::vector<Vec3l> points_;
  std::vector<std::vector<std::size_t>> at_;  ///< by point: lines that end there
};

}  // namespace

Result<std::vector<Segment>> joint_lines(const PlacedPart& a, const PlacedPart& b,
                                         std::int64_t contact, double cos_sharp,
                                         std::vector<Segment> lines) {
  if (lines.empty()) return lines;
  auto edges_a = view_independent_edges(*a.part, cos_sharp);
  if (!edges_a) return edges_a.error();
  auto edges_b = view_independent_edges(*b.part, cos_sharp);
  if (!edges_b) return edges_b.error();
  const JointSurface x(a, a.origin, std::move(*edges_a)), y(b, a.origin, std::move(*edges_b));
  const double within = a.part->sag + b.part->sag + static_cast<double>(contact);
  std::vector<Segment> joints, others;
  std::vector<Vec3l> ends;
  for (const Segment& line : lines) {
    const bool is_edge = !x.has_edge_along(line, within) && !y.has_edge_along(line, within) &&
                         turns_sharply(x, y, line, cos_sharp);
    (is_edge ? joints : others).push_back(line);
    if (is_edge) ends.insert(ends.end(), line.begin(), line.end());
  }
  const std::vector<bool> kept = LineGraph(others).shortest_paths_between(ends);
  for (std::size_t i = 0; i < others.size(); ++i)
    if (kept[i]) joints.push_back(others[i]);
  std::ranges::sort(joints);
  return joints;
}

}  // namespace strake::hlr
