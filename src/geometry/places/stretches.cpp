// SPDX-License-Identifier: Apache-2.0
#include "geometry/places/stretches.hpp"

#include <algorithm>
#include <optional>
#include <tuple>

#include "geometry/depth/nearest.hpp"
#include "geometry/places/segment_near.hpp"

namespace strake::geometry {

std::vector<EdgeStop> Stretches::stops_on(const Line& line, std::span<const std::uint32_t> listed,
                                          double squared) const {
  const PlacesSide& side = near_.side;
  std::vector<EdgeStop> stops;
  for (const std::uint32_t i : listed) {
    const Corners t = as_doubles(side.other.corners(side.other_of(near_.pairs[i])));
    if (const std::optional<double> along = near_along(line.from, line.to, t, squared))
      stops.push_back({0, 0, i, *along});
  }
  std::ranges::sort(stops, [](const EdgeStop& x, const EdgeStop& y) {
    return std::tie(x.along, x.pair) < std::tie(y.along, y.pair);
  });
  return stops;
}

std::size_t Stretches::join(const Line& line, std::span<const EdgeStop> stops) {
  std::size_t joins = 0;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    const EdgeStop &s = stops[i], &t = stops[i + 1];
    if (!(s.along < t.along) || sets_.joined(s.pair, t.pair)) continue;
    if (!is_inside(line.at((s.along + t.along) / 2))) continue;
    const std::uint32_t from = first_seen(line.at(s.along), s.pair);
    joins += sets_.join(from, first_seen(line.at(t.along), t.pair)) ? 1U : 0U;
  }
  return joins;
}

std::uint32_t Stretches::first_seen(const Vec3d& from, std::uint32_t pair) const {
  const PlacesSide& side = near_.side;
  const Corners t = as_doubles(side.other.corners(side.other_of(near_.pairs[pair])));
  const Line line{from, nearest_on_triangle(from, t)};
  const Vec3d gap = line.to - from;
  if (dot(gap, gap) <= kMeets * kMeets) return pair;
  const auto stops = stops_on(line, near_.own.group(near_.own.row[pair]), kMeets * kMeets);
  return stops.empty() ? pair : stops.front().pair;
}

}  // namespace strake::geometry
