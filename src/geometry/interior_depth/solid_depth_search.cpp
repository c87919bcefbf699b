// SPDX-License-Identifier: Apache-2.0
// Decision 0015 says what bounds over concave surfaces were before this search.
// Decision 0016 says what a search over blocks gave before this one.
// Decision 0017 says what bodies that fit each other ask of any search.
#include "geometry/interior_depth/solid_depth_search.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/interior_depth/level_search/level_search.hpp"
#include "geometry/interior_depth/local_depth_maximum.hpp"

namespace strake::geometry {
namespace {

/// Distance of the first level searched above the deepest point known, relative to its depth.
constexpr double kNearestLevel = 5e-4;
/// For shallow depths up to twice that, since a level is easier the farther it is; but no farther
/// than this, relative to the goal's tolerance. With a first level 4 µm away whatever the depth,
/// two of 800 pipes in line differed by 3.2 µm when turned (decision 0055).
constexpr double kFarStep = 0.5;
/// Least distance of a level above the deepest point known: relative to the goal's tolerance, and
/// in any case, grid units.
constexpr double kMinStep = 0.15, kFinestStep = 1.0 / 64;
/// Factors by which the next level is farther above it, where it took too much work, or where a
/// point was too near to the level to be distinguished from it. With 16 for the former the second
/// level was beyond what a bracket may be wide.
constexpr double kAfterWork = 8, kAfterPlace = 2;
/// A bracket no wider than this, relative to the depth, counts as complete.
constexpr double kComplete = 0.01;
/// Cells of a level that count as one of the goal's.
constexpr std::uint64_t kPerCell = 16;

class SolidDepthSearch {
 public:
  SolidDepthSearch(const DistanceField& a, const DistanceField& b, const DepthOptions& goal,
                   Depth& depth, QueryContext& work)
      : a_(a), b_(b), goal_(goal), depth_(depth), work_(work) {
    double extent = 0;
    for (const Box3d& box : {a.box(), b.box()})
      for (int k = 0; k < 3; ++k) extent = std::max(extent, box.hi[k] - box.lo[k]);
    margin_ = kFieldError * extent;
  }

  void run(std::span<const Vec3d> seeds) {
    for (const Vec3d& seed : seeds) climb(seed);
    if (!bracket_suffices(depth_, goal_)) narrow();
    // The goal may request more, for as long as there is work left.
    depth_.complete = is_tight(depth_, goal_, kComplete);
  }

 private:
  /// Lowers the upper bound by one level after the other.
  void narrow() {
    hull_a_ = half_spaces_of(a_);
    hull_b_ = half_spaces_of(b_);
    const double least = std::max(kMinStep * goal_.tolerance, kFinestStep);
    double farther = 1;
    while (const std::uint64_t left = cells_left()) {
      const double near = std::min(kNearestLevel, goal_.relative / 2) * depth_.value;
      const double step = std::max({least, near, std::min(kFarStep * goal_.tolerance, 2 * near)});
      const double level = depth_.value + farther * step;
      if (level >= depth_.upper) return;
      // Most of the work goes to the nearest level: those farther off are easier and gain less.
      switch (search_level(level, left - left / 4)) {
        case LevelOutcome::none:
          depth_.upper = level;
          return;
        case LevelOutcome::deeper:
          break;
        case LevelOutcome::too_large:
          return;
        case LevelOutcome::too_much:
          farther *= kAfterWork;
          break;
        case LevelOutcome::too_near:
          farther *= kAfterPlace;
      }
    }
  }

  enum class LevelOutcome : std::uint8_t { none, deeper, too_large, too_much, too_near };

  /// Whether some point is deeper than a level.
  LevelOutcome search_level(double level, std::uint64_t max_cells) {
    LevelQuery question{.level = level,
                        .known = depth_.value,
                        .ceiling = depth_.upper,
                        .slack = 1.0 / 1024 + margin_,
                        .max_cells = max_cells};
    for (const bool in_a : {true, false}) {
      question.hull_of = in_a ? hull_a_ : hull_b_;
      question.hull_in = in_a ? hull_b_ : hull_a_;
      const LevelResult answer =
          search_above_level(in_a ? a_ : b_, in_a ? b_ : a_, question, goal_, work_);
      cells_ += answer.cells;
      depth_.cells = cells_ / kPerCell;
      if (answer.deeper && climb(*answer.deeper)) return LevelOutcome::deeper;
      if (answer.too_large) return LevelOutcome::too_large;
      if (!answer.none)
        return answer.cells > max_cells ? LevelOutcome::too_much : LevelOutcome::too_near;
    }
    return LevelOutcome::none;
  }

  [[nodiscard]] std::uint64_t cells_left() const {
    const std::uint64_t largest =
        kPerCell * (is_decided(depth_, goal_) ? goal_.cells_decided : goal_.cells_undecided);
    return largest - std::min(largest, cells_);
  }

  /// Climbs from a point; returns whether that leads to a deeper one.
  bool climb(const Vec3d& from) {
    const double known = depth_.value;
    deepens(from);
    deepens(local_depth_maximum(a_, b_, from, goal_.within));
    deepens(local_depth_maximum(b_, a_, from, goal_.within));
    return depth_.value > known;
  }

  /// Whether a point is deeper than the known one, which it then replaces.
  void deepens(const Vec3d& p) {
    const Vec3d q = on_field_grid(p);
    const double depth = greater_distance(a_, b_, q);
    if (!(depth > depth_.value) || !a_.contains(q, work_) || !b_.contains(q, work_) ||
        !goal_.counts(q))
      return;
    depth_.value = depth;
    depth_.lower = std::max(0.0, depth - margin_);
    depth_.point = q;
  }

  const DistanceField &a_, &b_;
  const DepthOptions& goal_;
  Depth& depth_;
  QueryContext& work_;
  std::vector<HalfSpace> hull_a_, hull_b_;
  double margin_ = 0;
  std::uint64_t cells_ = 0;
};

}  // namespace

void search_solid_depth(const DistanceField& a, const DistanceField& b, const DepthOptions& goal,
                        std::span<const Vec3d> seeds, Depth& depth, QueryContext& work) {
  SolidDepthSearch(a, b, goal, depth, work).run(seeds);
}

}  // namespace strake::geometry
