// SPDX-License-Identifier: Apache-2.0
#include "clash/broad_phase/oriented_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "geometry/obb/oriented_box.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::clash {
namespace {

using geometry::Box3d;
using geometry::Box3l;
using geometry::Mat3d;
using geometry::Part;
using geometry::Vec3d;
using geometry::Vec3i;

// Only shares the work out: between 1024 and 16'384 no difference can be seen (decision 0073).
constexpr std::size_t kPairsPerBlock = 4096;
/// How many times smaller a part's own box has to be than that along the coordinate axes.
constexpr double kGain = 8;
/// How many times larger than its own box a part's box in a frame of others may be.
constexpr double kLoss = 2;
/// The most frames that are kept, since each is joined with each.
constexpr std::size_t kMaxFrames = 16;

/// Returns the extent of the vertices, in the part's own coordinates rotated into a frame.
Box3d extent_in(const Mat3d& axes, const Part& part) {
  Box3d box = geometry::empty_box<double>();
  for (const Vec3i& v : part.vertices) box.include(axes * v.as<double>());
  return box;
}

/// Returns the volume of a part's box in a frame, with what it is inflated by.
double box_volume_in(const Mat3d& axes, const Part& part, double reach) {
  const Box3d box = extent_in(axes, part);
  const Vec3d d = box.hi - box.lo;
  return (d.x + reach) * (d.y + reach) * (d.z + reach);
}

struct TiltedPart {
  std::uint32_t unique = 0;
  double volume = 0;  ///< volume of its own box; 0 for a part that is not rotated
  double gain = 0;
  Mat3d axes;

  /// The part that gains most goes first; parts that are alike may go in any order.
  [[nodiscard]] bool before(const TiltedPart& other) const {
    return std::tie(other.gain, volume, axes.row) < std::tie(gain, other.volume, other.axes.row);
  }
};

TiltedPart tighter_box_of(const Part& part, std::uint32_t unique, double reach) {
  if (part.triangles.empty()) return {};
  const Mat3d axes{geometry::orthonormal_axes(geometry::make_oriented_box(part))};
  const double own = box_volume_in(axes, part, reach), straight = box_volume_in({}, part, reach);
  if (!(own * kGain < straight)) return {};
  return {.unique = unique, .volume = own, .gain = straight / own, .axes = axes};
}

/// A frame for each unique part; the first, for parts that are not rotated, is that of the
/// coordinates.
struct Frames {
  std::vector<Mat3d> all{{}};
  std::vector<std::uint32_t> of_unique;

  void take(const ScenePartList& list, std::vector<TiltedPart> askew, double reach) {
    of_unique.assign(list.unique.size(), 0);
    std::erase_if(askew, [](const TiltedPart& a) { return !(a.volume > 0); });
    std::ranges::sort(askew, [](const TiltedPart& x, const TiltedPart& y) { return x.before(y); });
    for (const TiltedPart& a : askew)
      of_unique[a.unique] = frame_for(a, *list.unique[a.unique], reach);
  }

 private:
  std::uint32_t frame_for(const TiltedPart& askew, const Part& part, double reach) {
    std::pair<double, std::uint32_t> tightest{askew.gain * askew.volume, 0};
    for (std::uint32_t f = 1; f < all.size(); ++f) {
      const double volume = box_volume_in(all[f], part, reach);
      if (volume <= kLoss * askew.volume) return f;
      tightest = std::min(tightest, {volume, f});
    }
    if (all.size() >= kMaxFrames) return tightest.second;
    all.push_back(askew.axes);
    return static_cast<std::uint32_t>(all.size() - 1);
  }
};

/// Rounds a box outward.
Box3l on_grid(const Box3d& box) {
  const auto each = [](const Vec3d& v, auto&& round) {
    return geometry::Vec3l{static_cast<std::int64_t>(round(v.x)),
                           static_cast<std::int64_t>(round(v.y)),
                           static_cast<std::int64_t>(round(v.z))};
  };
  return {each(box.lo, [](double x) { return std::floor(x); }),
          each(box.hi, [](double x) { return std::ceil(x); })};
}

}  // namespace

Result<geometry::BoxesInFrames> make_oriented_boxes(const ScenePartList& list,
                                                    const SearchReach& reach,
                                                    const parallel::Context& context) {
  auto askew = parallel::transform(
      context, {.name = "parts askew", .n = list.unique.size(), .grain = 64}, [&](std::size_t u) {
        return tighter_box_of(*list.unique[u], static_cast<std::uint32_t>(u), reach.of_all);
      });
  if (!askew) return askew.error();
  Frames frames;
  frames.take(list, std::move(*askew), reach.of_all);
  geometry::BoxesInFrames boxes;
  boxes.frames = frames.all;
  if (frames.all.size() == 1) return boxes;
  const auto extents = parallel::transform(
      context, {.name = "extents askew", .n = list.unique.size(), .grain = 64},
      [&](std::size_t u) { return extent_in(frames.all[frames.of_unique[u]], *list.unique[u]); });
  if (!extents) return extents.error();
  boxes.origin = list.parts.front().placed.origin;
  boxes.frame.reserve(list.parts.size());
  for (const ScenePart& ref : list.parts) boxes.frame.push_back(frames.of_unique[ref.unique]);
  auto placed = parallel::transform(
      context, {.name = "boxes askew", .n = list.parts.size(), .grain = kPairsPerBlock},
      [&](std::size_t i) {
        const ScenePart& ref = list.parts[i];
        const Vec3d away = (ref.placed.origin - boxes.origin).as<double>();
        const Vec3d at = frames.all[boxes.frame[i]] * away;
        // Rounding may change its position by this much.
        const double margin = 1 + 1e-12 * (std::fabs(at.x) + std::fabs(at.y) + std::fabs(at.z));
        return on_grid((*extents)[ref.unique].moved(at).inflated(
            std::ceil(reach.of(ref) / 2 + ref.placed.part->sag) + margin));
      });
  if (!placed) return placed.error();
  boxes.box = std::move(*placed);
  return boxes;
}

}  // namespace strake::clash
