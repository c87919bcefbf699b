// SPDX-License-Identifier: Apache-2.0
#include "geometry/depth/roof.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "geometry/box.hpp"

namespace strake::geometry {
namespace {

/// The cosine of the steepest plane that the way to a roof may take.
constexpr double kSteepest = 0.3;
constexpr std::size_t kMostPlanes = 32;
/// How often a roof is looked at again with the triangles that were in its way.
constexpr int kRounds = 6;

using Points = std::array<Vec3d, 4>;

Vec3d unit(const Vec3d& v) { return v * (1 / length(v)); }

/// Whether a triangle misses a simplex's shadow and what is just above it: it lies beyond one of
/// the shadow's sides, seen along the way, or has the shadow on one side of it.
bool beside(const Corners& triangle, const std::optional<HalfSpace>& plane, const Points& shadow,
            const Vec3d& way, double slack) {
  if (plane && on_one_side(shadow, *plane, kSnapLift + 4 * slack)) return true;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) {
      Vec3d out = cross(shadow[j] - shadow[i], way);
      const double size = length(out);
      if (!(size > 0)) continue;
      out = out * (1 / size);
      const auto height = [&](const Vec3d& p) { return dot(out, p - shadow[i]); };
      double lowest = 0, highest = 0;
      for (const Vec3d& p : shadow) {
        lowest = std::min(lowest, height(p));
        highest = std::max(highest, height(p));
      }
      const auto all_above = [&](double h) {
        return std::all_of(triangle.begin(), triangle.end(),
                           [&](const Vec3d& p) { return height(p) > h; });
      };
      const auto all_below = [&](double h) {
        return std::all_of(triangle.begin(), triangle.end(),
                           [&](const Vec3d& p) { return height(p) < h; });
      };
      if (all_above(highest + 2 * slack) || all_below(lowest - 2 * slack)) return true;
    }
  return false;
}

/// Builds a roof from the planes that turn out to be needed.
class RoofBuilder {
 public:
  RoofBuilder(const DepthField& field, const Simplex& s, const Skin& skin, double slack)
      : field_(field), simplex_(s), skin_(skin), slack_(slack) {}

  std::optional<Roof> run(std::uint32_t first, std::span<const Vec3d> outside, PairWork& work) {
    const auto own = plane_of(field_, first);
    if (!own) return std::nullopt;
    add(first, *own);
    for (int round = 0; round < kRounds; ++round) {
      if (!cast()) return std::nullopt;
      const auto seen = look();
      if (!seen) return std::nullopt;
      if (!seen->complete) continue;
      if (seen->in_the_way || !leads_out(work)) return std::nullopt;
      const bool holds_all = !seen->in_simplex && some_above(outside);
      return Roof{depths(holds_all), holds_all, std::move(triangles_)};
    }
    return std::nullopt;
  }

 private:
  struct Seen {
    bool complete = true;     ///< no plane was added or raised
    bool in_the_way = false;  ///< some skin is where the shadow is
    bool in_simplex = false;  ///< some skin is in the simplex above all planes
  };

  void add(std::uint32_t triangle, HalfSpace plane) {
    plane.offset = std::max(plane.offset, top_of(field_.placed(triangle), plane.normal));
    planes_.push_back(plane);
    triangles_.push_back(triangle);
  }

  /// The shadow along the mean of the normals; false where a plane is too steep for it.
  bool cast() {
    Vec3d sum;
    for (const HalfSpace& h : planes_) sum = sum + h.normal;
    if (!(dot(sum, sum) > 0)) return false;
    way_ = unit(sum);
    heights_.fill(-std::numeric_limits<double>::infinity());
    for (const HalfSpace& h : planes_) {
      const double slope = dot(h.normal, way_);
      if (!(slope > kSteepest)) return false;
      for (std::size_t i = 0; i < 4; ++i)
        heights_[i] =
            std::max(heights_[i],
                     (h.offset + kClear * slack_ - dot(h.normal, simplex_.corner[i].at)) / slope);
    }
    for (std::size_t i = 0; i < 4; ++i) shadow_[i] = simplex_.corner[i].at + way_ * heights_[i];
    return true;
  }

  /// Whatever of the skin is above the planes; nothing where there is too much to look at.
  std::optional<Seen> look() {
    Box3d box = box_of(shadow_);
    for (const SimplexCorner& c : simplex_.corner) box.include(c.at);
    const auto near = triangles_in(field_, box.inflated(kSnapLift + 2 * slack_));
    if (!near) return std::nullopt;
    Seen seen;
    for (const std::uint32_t t : *near) {
      const Corners c = field_.placed(t);
      if (below(c)) continue;
      const auto plane = plane_of(field_, t);
      const bool in_the_way = !beside(c, plane, shadow_, way_, slack_);
      const bool in_simplex = !skin_.apart(t);
      if (!in_the_way && !in_simplex) continue;
      if (raise(c)) {
        seen.complete = false;
        continue;
      }
      if (cut_away(c)) continue;
      if (in_the_way && plane && dot(plane->normal, way_) > kSteepest) {
        if (planes_.size() == kMostPlanes) return std::nullopt;
        add(t, *plane);
        seen.complete = false;
      }
      seen.in_the_way |= in_the_way;
      seen.in_simplex |= in_simplex;
    }
    return seen;
  }

  static double top_of(const Corners& c, const Vec3d& normal) {
    return std::max({dot(normal, c[0]), dot(normal, c[1]), dot(normal, c[2])});
  }

  [[nodiscard]] bool below(const Corners& c) const {
    return std::any_of(planes_.begin(), planes_.end(),
                       [&](const HalfSpace& h) { return top_of(c, h.normal) <= h.offset; });
  }

  /// Puts a triangle below a plane that it is a little above: a neighbour lifted by the snap.
  bool raise(const Corners& c) {
    for (HalfSpace& h : planes_) {
      const double top = top_of(c, h.normal);
      if (top > h.offset + kSnapLift) continue;
      h.offset = top;
      return true;
    }
    return false;
  }

  /// Nothing of a triangle is above all planes.
  [[nodiscard]] bool cut_away(const Corners& c) const {
    std::vector<Vec3d> rest(c.begin(), c.end()), next;
    for (const HalfSpace& h : planes_) {
      const auto height = [&](const Vec3d& p) { return dot(h.normal, p) - h.offset - slack_; };
      next.clear();
      for (std::size_t i = 0; i < rest.size(); ++i) {
        const Vec3d &p = rest[i], &q = rest[(i + 1) % rest.size()];
        const double at_p = height(p), at_q = height(q);
        if (at_p > 0) next.push_back(p);
        if ((at_p > 0) != (at_q > 0)) next.push_back(p + (q - p) * (at_p / (at_p - at_q)));
      }
      rest.swap(next);
      if (rest.empty()) return true;
    }
    return false;
  }

  /// Nothing crosses the shadow: one point speaks for all.
  bool leads_out(PairWork& work) const {
    Vec3d middle;
    for (const Vec3d& p : shadow_) middle = middle + p * 0.25;
    return !field_.contains(on_field_grid(middle), work);
  }

  [[nodiscard]] bool some_above(std::span<const Vec3d> points) const {
    return std::any_of(points.begin(), points.end(), [&](const Vec3d& p) {
      return std::all_of(planes_.begin(), planes_.end(), [&](const HalfSpace& h) {
        return dot(h.normal, p) > h.offset + 2 * slack_;
      });
    });
  }

  /// Without skin above the planes, where a point outside is, no point of the part is: heights
  /// above the roof do not count. Otherwise they are ways to the outside as good as those below.
  [[nodiscard]] std::array<double, 4> depths(bool above_is_outside) const {
    std::array<double, 4> depth{};
    for (std::size_t i = 0; i < 4; ++i)
      depth[i] = (above_is_outside ? heights_[i] : std::fabs(heights_[i])) + slack_;
    return depth;
  }

  /// How far above its planes, in slacks, the shadow is cast.
  static constexpr double kClear = 3;

  const DepthField& field_;
  const Simplex& simplex_;
  const Skin& skin_;
  double slack_;
  std::vector<HalfSpace> planes_;
  std::vector<std::uint32_t> triangles_;
  Vec3d way_;
  std::array<double, 4> heights_{};
  Points shadow_;
};

}  // namespace

std::optional<Roof> roof_over(const DepthField& field, const Simplex& s, const Skin& skin,
                              std::uint32_t triangle, std::span<const Vec3d> outside, double slack,
                              PairWork& work) {
  return RoofBuilder(field, s, skin, slack).run(triangle, outside, work);
}

}  // namespace strake::geometry
