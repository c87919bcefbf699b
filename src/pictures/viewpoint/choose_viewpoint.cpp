// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/numeric/trig.hpp"
#include "pictures/scenery/clash_place.hpp"
#include "pictures/viewpoint.hpp"
#include "pictures/viewpoint/candidates.hpp"

namespace strake::pictures {
namespace {

using geometry::Vec3d;

/// Of what shows without all others, so much must be seen for nothing to be cut away.
constexpr double kEnough = 0.5;
/// Less than this of the window is not seen.
constexpr double kMinShare = 0.004;
/// Nobody needs to see more of the two than this for a view to be good.
constexpr double kWellVisible = 0.12;
/// How far before the point cuts are tried, shares of the reach: the first that shows enough.
constexpr std::array kCuts{0.6, 0.25, 0.0};
/// The side of the window that is judged, a share of what is shown.
constexpr double kSampledReach = 0.75;

struct ChosenDirection {
  ViewCandidate candidate;
  std::optional<double> cut_mm;
};

class ViewpointSearch {
 public:
  ViewpointSearch(std::vector<NearTriangle> triangles, const Vec3d& away, const Sight& sight,
                  const parallel::Context& context)
      : triangles_(std::move(triangles)),
        directions_(candidate_directions(away)),
        sight_(sight),
        context_(context) {}

  Result<ChosenDirection> run(double reach_mm) const {
    const Result<BestCandidates> whole = best(sight_);
    if (!whole) return whole.error();
    ChosenDirection chosen{whole->best, {}};
    if (is_enough(whole->best, whole->alone.share)) return chosen;
    for (const double cut : kCuts) {
      Sight cut_open = sight_;
      cut_open.cut_mm = cut * reach_mm;
      const Result<BestCandidates> found = best(cut_open);
      if (!found) return found.error();
      if (found->best.rank > chosen.candidate.rank) chosen = {found->best, cut_open.cut_mm};
      if (is_enough(found->best, whole->alone.share)) break;
    }
    return chosen;
  }

 private:
  static bool is_enough(const ViewCandidate& candidate, double possible) {
    return candidate.share >= kMinShare &&
           candidate.share >= kEnough * std::min(possible, kWellVisible);
  }

  Result<BestCandidates> best(const Sight& sight) const {
    return find_best(triangles_, directions_, sight, context_);
  }

  NearTriangles triangles_;
  std::vector<Vec3d> directions_;
  Sight sight_;
  const parallel::Context& context_;
};

/// Returns the triangles of which some direction may show something: those that come near enough.
std::vector<NearTriangle> kept_within(std::vector<NearTriangle> triangles, double radius_mm) {
  std::erase_if(triangles, [&](const NearTriangle& t) {
    geometry::Box3d box = geometry::empty_box<double>();
    for (const Vec3d& p : t.at) box.include(p);
    Vec3d nearest;
    for (int k = 0; k < 3; ++k) nearest[k] = std::clamp(0.0, box.lo[k], box.hi[k]);
    return dot(nearest, nearest) > radius_mm * radius_mm;
  });
  return triangles;
}

Status check(const ViewpointOptions& options) {
  constexpr double kNarrow = 0.2, kWide = 5, kFar = 0.05, kNear = 20;
  if (!(options.aspect >= kNarrow && options.aspect <= kWide))
    return Error{ErrorCode::usage, "the aspect of a picture is not between 0.2 and 5", "picture",
                 "4:3 is the usual one"};
  if (!(options.zoom >= kFar && options.zoom <= kNear))
    return Error{ErrorCode::usage, "the zoom of a picture is not between 0.05 and 20", "picture",
                 "1 shows what is near the clash"};
  return {};
}

}  // namespace

Result<ClashViewpoint> choose_viewpoint(const Scenery& scenery, const Subject& subject,
                                        const ViewpointOptions& options,
                                        const parallel::Context& context) {
  if (const Status status = check(options); !status) return status.error();
  if (const Status status = check_subject(scenery.contents(), subject); !status)
    return status.error();
  const clash::Pair& pair = pair_of(scenery.contents(), subject.results.front());
  const Roles roles(scenery.contents(), subject);
  const geometry::Vec3l point = grid_point(pair.point_mm);
  const double reach = reach_of(scenery, roles, pair) / options.zoom;
  // Half of the box's side, so that its corners lie before the eye.
  constexpr double kBox = 1.5;
  const double half = kBox * reach * std::max(options.aspect, 1.0), eye = 2 * half;
  const Result<ChosenDirection> choice =
      ViewpointSearch(kept_within(triangles_near(scenery, roles, point, eye), eye + reach),
                      pair.away, {kSampledReach * reach, eye}, context)
          .run(reach);
  if (!choice) return choice.error();
  const Axes axes = Axes::towards(choice->candidate.viewer);
  ClashViewpoint viewpoint;
  viewpoint.target_mm = geometry::to_mm(point);
  viewpoint.eye_mm = viewpoint.target_mm + axes.toward * eye;
  viewpoint.direction = -axes.toward;
  viewpoint.up = axes.up;
  viewpoint.half_height_mm = reach;
  constexpr double kDegrees = 180 / geometry::kPi;
  viewpoint.field_of_view_deg = 2 * geometry::arc_tan2(reach, eye) * kDegrees;
  viewpoint.aspect = options.aspect;
  viewpoint.box_mm = geometry::Box3d{viewpoint.target_mm, viewpoint.target_mm}.inflated(half);
  viewpoint.visible_share = choice->candidate.share;
  if (choice->cut_mm)
    viewpoint.clipping_planes.push_back(
        {viewpoint.target_mm + axes.toward * *choice->cut_mm, axes.toward});
  return viewpoint;
}

}  // namespace strake::pictures
