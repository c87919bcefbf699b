// SPDX-License-Identifier: Apache-2.0
#include "hlr/occluders/polygon_fan.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

namespace strake::hlr {
namespace {

/// Steps of a full turn: far wider than what rounding makes of an angle.
constexpr double kFullTurn = 0x1p42;

/// Returns a value that grows with the angle of a direction, from 0 up to a full turn.
double angle_of(const PaperCorner& from, std::int64_t u, std::int64_t v) {
  const double du = static_cast<double>(u - from.u), dv = static_cast<double>(v - from.v);
  const double slope = dv / (std::fabs(du) + std::fabs(dv));
  const double quarters = du < 0 ? 2 - slope : dv < 0 ? 4 + slope : slope;
  return quarters * (kFullTurn / 4);
}

bool before(const PaperCorner& x, const PaperCorner& y) {
  return std::tie(x.u, x.v) < std::tie(y.u, y.v);
}

/// An interval of angles, with a margin for rounding.
ViewBox angle_interval(double from, double to, std::int64_t nearest) {
  ViewBox box;
  box.include(ViewPoint{static_cast<std::int64_t>(std::floor(from)) - 1, 0, nearest});
  box.include(ViewPoint{static_cast<std::int64_t>(std::ceil(to)) + 1, 0, nearest});
  return box;
}

}  // namespace

PolygonFan::PolygonFan(const PaperCorner& at, std::vector<std::uint32_t> numbers,
                       std::span<const OccluderPolygon> polygons,
                       std::span<const PaperCorner> corners)
    : at_(at), numbers_(std::move(numbers)) {
  std::vector<ViewBox> boxes, intervals;
  const auto add = [&](std::uint32_t i, double from, double to, std::int64_t nearest) {
    angles_.push_back(i);
    intervals.push_back(angle_interval(from, to, nearest));
  };
  for (std::uint32_t i = 0; i < numbers_.size(); ++i) {
    const OccluderPolygon& p = polygons[numbers_[i]];
    boxes.push_back(p.box);
    const auto round = corners.subspan(p.first_corner, p.corners);
    for (std::size_t k = 0; k < round.size(); ++k) {
      if (round[k].u != at.u || round[k].v != at.v) continue;
      // The inside lies from the next corner to the last one, counter-clockwise.
      const PaperCorner &next = round[(k + 1) % round.size()],
                        &last = round[(k + round.size() - 1) % round.size()];
      const double from = angle_of(at, next.u, next.v), to = angle_of(at, last.u, last.v);
      if (from <= to) {
        add(i, from, to, p.box.hi.w);
      } else {
        add(i, from, kFullTurn, p.box.hi.w);
        add(i, 0, to, p.box.hi.w);
      }
    }
  }
  by_box_ = ViewBvh(boxes);
  by_angle_ = ViewBvh(intervals);
}

std::optional<SegmentQuery> PolygonFan::directions(const ViewPoint& a, const ViewPoint& b,
                                                   double nearest) const {
  // Beyond that, boxes cull as much; and it is less than half a turn, so that an edge is seen
  // between its ends.
  constexpr double kMax = kFullTurn / 8;
  const bool from_a = a.u == at_.u && a.v == at_.v, from_b = b.u == at_.u && b.v == at_.v;
  if (from_a && from_b) return std::nullopt;
  const double to_a = from_a ? angle_of(at_, b.u, b.v) : angle_of(at_, a.u, a.v);
  const double to_b = from_b ? to_a : angle_of(at_, b.u, b.v);
  if (std::fabs(to_a - to_b) > kMax) return std::nullopt;
  SegmentQuery range;
  range.u0 = std::min(to_a, to_b) - 1;
  range.u1 = std::max(to_a, to_b) + 1;
  range.w0 = nearest;
  return range;
}

std::vector<PolygonFan> extract_fans(std::vector<PaperCorner> hubs,
                                     std::span<const OccluderPolygon> polygons,
                                     std::span<const PaperCorner> corners,
                                     std::vector<ViewBox>& boxes) {
  std::vector<PolygonFan> fans;
  if (hubs.empty()) return fans;
  std::ranges::sort(hubs, before);
  std::vector<std::vector<std::uint32_t>> round(hubs.size());
  for (std::uint32_t i = 0; i < polygons.size(); ++i) {
    const OccluderPolygon& p = polygons[i];
    for (const PaperCorner& c : corners.subspan(p.first_corner, p.corners)) {
      const auto hub = std::ranges::lower_bound(hubs, c, before);
      if (hub == hubs.end() || before(c, *hub)) continue;
      round[static_cast<std::size_t>(hub - hubs.begin())].push_back(i);
      break;  // a polygon belongs to one fan
    }
  }
  for (std::size_t h = 0; h < hubs.size(); ++h) {
    if (round[h].size() < kMinInFan) continue;
    for (const std::uint32_t i : round[h]) boxes[i] = {};
    fans.emplace_back(hubs[h], std::move(round[h]), polygons, corners);
  }
  return fans;
}

}  // namespace strake::hlr
