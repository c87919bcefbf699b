// SPDX-License-Identifier: Apache-2.0
#include "hlr/incremental/bounds_projection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "hlr/visibility/visibility_scene.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::hlr {
namespace {

using geometry::Box3l;
using geometry::Vec3l;

/// Coordinates on paper stay below this: see prepare_view().
constexpr double kFarthest = 1152921504606846976.0;  // 2^60

std::array<Vec3l, 8> corners_of(const Box3l& box, const Vec3l& origin) {
  std::array<Vec3l, 8> corners;
  for (unsigned i = 0; i < corners.size(); ++i)
    corners[i] = Vec3l{(i & 1U) != 0 ? box.hi.x : box.lo.x, (i & 2U) != 0 ? box.hi.y : box.lo.y,
                       (i & 4U) != 0 ? box.hi.z : box.lo.z} -
                 origin;
  return corners;
}

double nearest_depth(const View& view, const Box3l& drawn) {
  const double near_plane = view.perspective->near_mm * geometry::kGridPerMm;
  if (drawn.empty()) return near_plane;
  double nearest = 1e300;
  for (const Vec3l& corner : corners_of(drawn, view.perspective->eye))
    nearest = std::min(nearest, -dot(axes_of(view).toward, corner.as<double>()));
  return std::max(nearest, near_plane);
}

/// Rounds a coordinate of a box outwards and turns its depth round.
ViewBox turned_round(const SegmentQuery& query) {
  const auto low = [](double x) {
    return static_cast<std::int64_t>(std::floor(std::clamp(x, -kFarthest, kFarthest)));
  };
  const auto high = [](double x) {
    return static_cast<std::int64_t>(std::ceil(std::clamp(x, -kFarthest, kFarthest)));
  };
  const std::int64_t depth = high(-query.w0);
  return {{low(query.u0), low(query.v0), depth}, {high(query.u1), high(query.v1), depth}};
}

}  // namespace

BoundsProjection::BoundsProjection(const View& view, const Box3l& drawn)
    : projection_(in_lowest_terms(view.direction)), limits_(view.limits), window_(window(view)) {
  for (int k = 0; k < 3; ++k) {
    largest_ = std::max(largest_, std::abs(projection_.direction()[k]));
    if (!drawn.empty()) origin_[k] = drawn.lo[k] + (drawn.hi[k] - drawn.lo[k]) / 2;
  }
  if (!view.perspective) return;
  origin_ = view.perspective->eye;
  map_.emplace(view, nearest_depth(view, drawn));
}

bool BoundsProjection::reaches(const Box3l& box) const {
  double reach = 0;
  for (int k = 0; k < 3; ++k)
    reach = std::max({reach,
                      std::fabs(static_cast<double>(box.lo[k]) - static_cast<double>(origin_[k])),
                      std::fabs(static_cast<double>(box.hi[k]) - static_cast<double>(origin_[k]))});
  return 4 * reach * static_cast<double>(largest_) < kFarthest;
}

ViewBox BoundsProjection::box_of(const Box3l& whole) const {
  const Box3l box = limits_ ? whole.common(*limits_) : whole;
  if (box.empty()) return {};
  const auto corners = corners_of(box, origin_);
  if (map_) return map_->box_of(corners);
  ViewBox on_paper;
  for (const Vec3l& corner : corners) on_paper.include(projection_(corner));
  return on_paper;
}

std::optional<SegmentQuery> BoundsProjection::edge(const Vec3l& a, const Vec3l& b) const {
  EdgeQuery drawn;
  drawn.a = a - origin_;
  drawn.b = b - origin_;
  RationalParam lo = RationalParam::zero(), hi = RationalParam::one();
  const auto limits = [&] { return Box3l{limits_->lo - origin_, limits_->hi - origin_}; };
  if (!drawn.clip(window_, lo, hi) ||
      (limits_ && reaches(*limits_) && !drawn.clip(limits(), lo, hi)))
    return std::nullopt;
  if (!map_) return orthographic(projection_(drawn.a), projection_(drawn.b));
  if (const auto segment = map_->segment(drawn.a, drawn.b, lo.value, hi.value))
    return segment->make_query(lo.value, hi.value);
  constexpr double kPaperLimit = PerspectiveMap::kPaperLimit;
  SegmentQuery everywhere;
  everywhere.u0 = everywhere.v0 = everywhere.w0 = -kPaperLimit;
  everywhere.u1 = everywhere.v1 = kPaperLimit;
  return everywhere;
}

SegmentQuery BoundsProjection::orthographic(const ViewPoint& a, const ViewPoint& b) const {
  ViewBox box;
  box.include(a);
  box.include(b);
  return on_segment(a, b, box);
}

OccludeeTree::OccludeeTree(std::vector<SegmentQuery> queries) : queries_(std::move(queries)) {
  std::vector<ViewBox> boxes;
  boxes.reserve(queries_.size());
  for (const SegmentQuery& query : queries_) boxes.push_back(turned_round(query));
  tree_ = ViewBvh(boxes);
}

bool OccludeeTree::may_be_hidden_by(const ViewBox& box) const {
  if (box.empty()) return false;
  const LooseBox hides = rounded_outwards(box);
  SegmentQuery query = anything_in(box);
  query.w0 = -hides.w1;
  bool found = false;
  tree_.traverse(query, [&](std::uint32_t i) {
    found = queries_[i].may_be_hidden_by(hides);
    return !found;
  });
  return found;
}

}  // namespace strake::hlr
