// SPDX-License-Identifier: Apache-2.0
#include "clash/narrow_phase/sphere_subdivision.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "clash/narrow_phase/canonical_order.hpp"
#include "clash/narrow_phase/pair_tolerances.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::clash {
namespace {

using geometry::Box3d;
using geometry::Part;
using geometry::PartKind;
using geometry::PartWithBvh;
using geometry::PointSide;
using geometry::Vec3d;
using geometry::Vec3l;

/// The smallest sphere: a twentieth of a millimetre, in grid units.
constexpr double kSmallest = 50;
/// Points are located on this fraction of the grid.
constexpr std::int64_t kDenominator = 16;

/// A part as the sphere test sees it.
struct SphereOperand {
  const PartWithBvh& treed;
  Vec3l shift;  ///< from the part's coordinates to the pair's

  [[nodiscard]] bool solid() const { return treed.placed.part->kind == PartKind::solid; }

  [[nodiscard]] Box3d box() const {
    return treed.placed.part->box.as<std::int64_t>().moved(shift).as<double>();
  }

  /// Returns the distance of a point to the part's surface; negative inside a solid.
  [[nodiscard]] double signed_distance(const Vec3d& p, geometry::QueryContext& work) const {
    const double distance = nearest_on_surface(treed, p - shift.as<double>()).distance;
    if (!solid()) return distance;
    const Vec3l numerator{std::llround(p.x * kDenominator), std::llround(p.y * kDenominator),
                          std::llround(p.z * kDenominator)};
    const PointSide side =
        geometry::side_of(treed, numerator - shift * kDenominator, kDenominator, work);
    return side == PointSide::inside ? -distance : distance;
  }
};

class SphereSearch {
 public:
  SphereSearch(const PairOperand& a, const PairOperand& b, const PairTolerances& options,
               std::uint64_t max_cells, NarrowWork& work)
      : part_a_(*a.treed.placed.part),
        part_b_(*b.treed.placed.part),
        a_{a.treed, {}},
        b_{b.treed, b.treed.placed.origin - a.treed.placed.origin},
        options_(options),
        thresholds_(thresholds(part_a_, part_b_, options)),
        // This is fine enough to tell a touch from a clash.
        resolution_(std::max(std::min(thresholds_.overlap, thresholds_.gap) / 2, kSmallest)),
        max_cells_(max_cells),
        work_(work) {}

  [[nodiscard]] std::uint64_t cells() const { return cells_; }

  PartPairResult run() {
    // The search starts from a corner of one and its distance to the other.
    point_ = part_a_.vertices.front().as<double>();
    best_ = std::max(b_.signed_distance(point_, work_.pair), 0.0);
    // Half the reach from either suffices: the middle of the closest pair of points lies in both.
    const Box3d root = a_.box().common(b_.box()).inflated(reach() / 2);
    if (root.empty()) return concluded();
    stack_.push_back(root);
    while (!stack_.empty() && !done_ && !is_stopped()) {
      const Box3d cell = stack_.back();
      stack_.pop_back();
      visit_cell(cell);
    }
    return concluded();
  }

 private:
  [[nodiscard]] double reach() const { return reach_of(options_) + thresholds_.weld; }

  /// Whether the run was cancelled: one pair may take hours, and its answer is dropped then.
  [[nodiscard]] bool is_stopped() const {
    constexpr std::uint64_t kStopInterval = 1024;
    return cells_ % kStopInterval == 0 && work_.pair.team != nullptr &&
           work_.pair.team->stop.stop_requested();
  }

  void visit_cell(const Box3d& cell) {
    if (++cells_ > max_cells_) {
      exhausted_ = done_ = true;
      return;
    }
    const Vec3d centre = (cell.lo + cell.hi) * 0.5, half = (cell.hi - cell.lo) * 0.5;
    const double radius = std::sqrt(dot(half, half));
    const double margin = radius + reach() / 2;
    const double in_a = a_.signed_distance(centre, work_.pair);
    if (in_a > margin) return;
    const double in_b = b_.signed_distance(centre, work_.pair);
    if (in_b > margin) return;
    const double separation =
        in_a < 0 && in_b < 0 ? std::min(in_a, in_b) : std::max(in_a, 0.0) + std::max(in_b, 0.0);
    if (separation < best_) {
      best_ = separation;
      point_ = centre;
    }
    if (separation < -thresholds_.overlap) {
      done_ = true;
      return;
    }
    if (radius <= resolution_) {
      finest_ = std::max(finest_, radius);
      return;
    }
    halve(cell, half);
  }

  void halve(const Box3d& cell, const Vec3d& half) {
    const int axis = half.x >= half.y && half.x >= half.z ? 0 : half.y >= half.z ? 1 : 2;
    Box3d low = cell, high = cell;
    low.hi[axis] = high.lo[axis] = (cell.lo[axis] + cell.hi[axis]) / 2;
    stack_.push_back(high);
    stack_.push_back(low);
  }

  /// Distances change by no more than the way moved, and their sum by twice that: no point is
  /// better than the best centre by more than twice the finest radius, if all were looked at.
  PartPairResult concluded() const {
    PartPairResult answer;
    const Box3d x = a_.box();
    const Vec3d size = x.hi - x.lo;
    const double deepest = std::sqrt(dot(size, size)) / 2;
    const bool unknown = exhausted_ || best_ < -thresholds_.overlap;
    double lower = unknown ? -deepest : std::min(best_ - 2 * finest_, reach());
    if (!a_.solid() && !b_.solid()) lower = std::max(lower, 0.0);
    // Where nothing near was found in time, a touch is as good a guess as any, and flagged.
    answer.separation = {.d = exhausted_ && best_ > thresholds_.gap ? 0 : best_,
                         .lower = std::min(lower, best_),
                         .upper = best_,
                         .sag = part_a_.sag + part_b_.sag,
                         .moved = options_.snap + options_.step,
                         .interiors_meet = best_ < 0,
                         .depth_complete = !unknown};
    answer.witness = witness();
    answer.relation = relation();
    answer.classification = classify(answer.separation, thresholds_);
    answer.classification.flags |= part_flags(part_a_, part_b_);
    return answer;
  }

  [[nodiscard]] Witness witness() const {
    const Vec3d shift = b_.shift.as<double>();
    const geometry::SurfacePoint on_a = nearest_on_surface(a_.treed, point_);
    const geometry::SurfacePoint on_b = nearest_on_surface(b_.treed, point_ - shift);
    Witness w{.on_a = on_a.point, .on_b = on_b.point + shift};
    if (best_ < 0) {
      w.interiors_meet = true;
      w.deep_in_a = on_a.distance >= on_b.distance;
      (w.deep_in_a ? w.on_b : w.on_a) = point_;
    }
    const Vec3d way = w.on_a - w.on_b;
    const double length = std::sqrt(dot(way, way));
    if (length > 0) w.away = way * ((w.interiors_meet ? -1 : 1) / length);
    return w;
  }

  [[nodiscard]] Relation relation() const {
    if (best_ > options_.contact_distance) return Relation::separate;
    if (!a_.solid() || !b_.solid()) return Relation::cross;
    return best_ < -options_.contact_distance ? Relation::interfere : Relation::abut_outside;
  }

  const Part &part_a_, &part_b_;
  SphereOperand a_, b_;
  const PairTolerances& options_;
  Thresholds thresholds_;
  double resolution_;  ///< radius at which halving ends
  std::uint64_t max_cells_;
  NarrowWork& work_;
  std::vector<Box3d> stack_;
  std::uint64_t cells_ = 0;
  bool done_ = false, exhausted_ = false;
  double best_ = 0;    ///< the least separation found
  double finest_ = 0;  ///< the largest radius at which halving ended
  Vec3d point_;
};

}  // namespace

PartPairResult evaluate_by_spheres(const PairOperand& a, const PairOperand& b,
                                   const PairTolerances& options, std::uint64_t max_cells,
                                   NarrowWork& work) {
  return evaluate_in_canonical_order(a, b, [&](const PairOperand& x, const PairOperand& y) {
    SphereSearch search(x, y, options, max_cells, work);
    const PartPairResult answer = search.run();
    work.depth_cells += search.cells();
    return answer;
  });
}

}  // namespace strake::clash
