// SPDX-License-Identifier: Apache-2.0
#include "geometry/interior_depth/local_depth_maximum.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geometry/interior_depth/bounds/inscribed_ball.hpp"
#include "geometry/numeric/vector_math.hpp"

namespace strake::geometry {
namespace {

/// With this limit and the next two no pair of geometry_deep_pairs_property_test comes out short by
/// more than 1 % or 0.05 mm (decision 0037).
constexpr int kMaxClimbSteps = 24;
/// Maximum number of triangles of one part within reach of a step that enter the program at once.
constexpr std::size_t kMaxNear = 64;
/// If there are more, those that stop a step are added one by one, up to this many.
constexpr int kMaxCuts = 48;
/// Grid units that a point keeps off the surface that it must not leave: it is still inside when it
/// is rounded to the field grid.
constexpr double kInset = 1.0 / 1024;
/// Grid units: a shorter reach is not worth a step.
constexpr double kShortest = 0.25;
/// A step that gains less, relative to the depth, was the last of its reach.
constexpr double kGain = 1e-4;
/// A point nearer to a triangle, grid units, lies on it.
constexpr double kOnSurface = 1e-6;

struct NearPlane {
  Vec3d away;  ///< unit, from the triangle's nearest point
  double distance = 0;
};

/// Returns the plane that bounds the distance to a triangle round a point, in the part's own
/// coordinates; nothing where it has no area and the point lies on it.
std::optional<NearPlane> near_of(const PreparedTriangle& triangle, const Vec3d& at) {
  const Vec3d way = at - triangle.nearest(at);
  const double distance = length(way);
  if (distance > kOnSurface) return NearPlane{way * (1 / distance), distance};
  // On the surface, inwards is away from it.
  if (triangle.size > 0) return NearPlane{-triangle.unit, distance};
  return std::nullopt;
}

/// The triangles no farther than `reach`; false where there are too many.
bool find_near(const DistanceField& field, const Vec3d& p, double reach,
               std::vector<NearPlane>& near) {
  const Vec3d at = field.local(p);
  near.clear();
  return field.for_each_near(p, reach, [&](std::uint32_t t) {
    const PreparedTriangle triangle = field.triangle(t);
    const double height = dot(triangle.unit, at);
    if (height - triangle.hi > reach || triangle.lo - height > reach) return true;
    const auto found = near_of(triangle, at);
    if (found && found->distance <= reach) near.push_back(*found);
    return near.size() <= kMaxNear;
  });
}

/// What a centre must not leave: a part.
class InPart {
 public:
  explicit InPart(const DistanceField& part) : part_(part) {}

  /// Looks round a point; false where there is too much to say.
  bool find_planes_near(const Vec3d& at, double reach) {
    return find_near(part_, at, reach, beside_);
  }
  void add(const Vec3d&, std::vector<BallConstraint>& rows) const {
    for (const NearPlane& near : beside_) rows.push_back({-near.away, 0, near.distance - kInset});
  }
  [[nodiscard]] static Vec3d kept(const Vec3d& p) { return p; }

 private:
  const DistanceField& part_;
  std::vector<NearPlane> beside_;
};

/// The same: a triangle or a segment.
class OnFlat {
 public:
  explicit OnFlat(std::span<const Vec3d> corners) : corners_(corners) {
    const Vec3d& origin = corners.front();
    const Vec3d first = unit(corners[1] - origin);
    if (corners.size() == 2) {
      const Vec3d side = perpendicular_to(first);
      for (const Vec3d& n : {side, cross(first, side)}) add_both(n, origin);
      sides_.push_back({-first, 0, dot(-first, origin)});
      sides_.push_back({first, 0, dot(first, corners[1])});
      return;
    }
    const Vec3d normal = unit(cross(first, corners[2] - origin));
    add_both(normal, origin);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d out = unit(cross(corners[(i + 1) % 3] - corners[i], normal));
      sides_.push_back({out, 0, dot(out, corners[i])});
    }
  }

  static bool find_planes_near(const Vec3d&, double) { return true; }
  void add(const Vec3d& at, std::vector<BallConstraint>& rows) const {
    for (const BallConstraint& side : sides_)
      rows.push_back({side.normal, 0, side.offset - dot(side.normal, at)});
  }
  /// The nearest point of it: what the program and its rounding moved off.
  [[nodiscard]] Vec3d kept(const Vec3d& p) const {
    return corners_.size() == 2 ? nearest_on_segment(p, corners_[0], corners_[1])
                                : nearest_on_triangle(p, {corners_[0], corners_[1], corners_[2]});
  }

 private:
  static Vec3d unit(const Vec3d& v) {
    const double size = length(v);
    return size > 0 ? v * (1 / size) : Vec3d{};
  }
  /// Either side of a plane, with room for rounding.
  void add_both(const Vec3d& n, const Vec3d& on) {
    for (const double sign : {1.0, -1.0})
      sides_.push_back({n * sign, 0, dot(n * sign, on) + kInset});
  }

  std::span<const Vec3d> corners_;
  std::vector<BallConstraint> sides_;
};

/// `Domain`: what the centre must not leave.
template <class Domain>
class LocalAscent {
 public:
  LocalAscent(const DistanceField& of, Domain domain, const std::optional<Box3d>& within)
      : of_(of), domain_(std::move(domain)), within_(within) {}

  Vec3d run(Vec3d at) {
    double depth = of_.nearest(at).distance;
    double reach = std::max(depth, 64 * kShortest);
    for (int step = 0; step < kMaxClimbSteps && reach > kShortest; ++step) {
      if (!domain_.find_planes_near(at, reach)) {
        reach /= 2;
        continue;
      }
      // No triangle farther than this can stop a ball whose centre moves by `reach` at most.
      const bool all = find_near(of_, at, depth + 2 * reach, above_);
      // Within the depth there is no surface that a step could cross untested.
      if (!all) reach = std::min(reach, depth);
      const InscribedBall next = all ? solve(at, depth, reach) : solve_by_cuts(at, depth, reach);
      if (next.r > depth * (1 + kGain) + kInset) {
        const Vec3d there = domain_.kept(at + next.x);
        const double found = of_.nearest(there).distance;
        if (!(found > depth)) {
          if (all) return at;
          reach /= 8;
          continue;
        }
        at = there;
        // A step that ended where it had to, not where it could have.
        if (length(next.x) > reach / 4) reach *= 2;
        depth = found;
      } else {
        reach /= 8;
      }
    }
    return at;
  }

 private:
  /// The same as solve() over all triangles within reach, where these are many, as inside a fine
  /// round body: a triangle is asked once it is what the ball would meet (cutting planes).
  InscribedBall solve_by_cuts(const Vec3d& at, double depth, double reach) {
    above_.clear();
    InscribedBall next;
    std::vector<std::uint32_t> tried;
    std::uint32_t triangle = of_.nearest(at).triangle;
    for (int cut = 0; cut < kMaxCuts; ++cut) {
      if (std::ranges::find(tried, triangle) != tried.end()) break;
      tried.push_back(triangle);
      if (const auto near = near_of(of_.triangle(triangle), of_.local(at))) above_.push_back(*near);
      next = solve(at, depth, reach);
      const NearestTriangle there = of_.nearest(at + next.x, triangle);
      if (there.distance >= next.r * (1 - kGain)) break;
      triangle = there.triangle;
    }
    return next;
  }

  [[nodiscard]] InscribedBall solve(const Vec3d& at, double depth, double reach) const {
    // Within the ball round the box that the centre may move in.
    const double half = reach / std::sqrt(3.0);
    std::vector<BallConstraint> rows;
    rows.reserve(16 + above_.size());
    for (const Vec3d& n : tetrahedral_directions()) rows.push_back({n, 1, depth + 2 * reach});
    for (int k = 0; k < 3; ++k)
      for (const double sign : {1.0, -1.0}) {
        Vec3d n;
        n[k] = sign;
        rows.push_back({n, 0, half});
        if (within_)
          rows.push_back({n, 0, sign > 0 ? within_->hi[k] - at[k] : at[k] - within_->lo[k]});
      }
    for (const NearPlane& near : above_) rows.push_back({-near.away, 1, near.distance});
    domain_.add(at, rows);
    return largest_inscribed_ball({rows, depth + 4 * reach});
  }

  const DistanceField& of_;
  Domain domain_;
  const std::optional<Box3d>& within_;
  std::vector<NearPlane> above_;
};

}  // namespace

Vec3d local_depth_maximum(const DistanceField& of, const DistanceField& in, const Vec3d& from,
                          const std::optional<Box3d>& within) {
  return LocalAscent(of, InPart(in), within).run(from);
}

Vec3d local_depth_maximum_on(const DistanceField& of, std::span<const Vec3d> corners,
                             const Vec3d& from, const std::optional<Box3d>& within) {
  return LocalAscent(of, OnFlat(corners), within).run(from);
}

}  // namespace strake::geometry
