// SPDX-License-Identifier: Apache-2.0
#include "clash/pair_limits.hpp"

#include <algorithm>

#include "clash/parts.hpp"

namespace strake::clash {

using geometry::Part;
using geometry::PartKind;

double apart_within(const Part& a, const Part& b, const NarrowOptions& options) {
  if (a.kind != PartKind::sheet || b.kind != PartKind::sheet) return options.contact_distance;
  const Thresholds t = thresholds(a, b, options);
  return std::min(options.contact_distance, std::max(t.overlap, t.step));
}

std::uint16_t part_flags(const Part& a, const Part& b) {
  std::uint16_t flags = 0;
  for (const Part* part : {&a, &b}) {
    if (part->kind == PartKind::sheet) flags |= kOpen;
    if (part->flags.inverted) flags |= kInverted;
  }
  return flags;
}

Thresholds thresholds(const Part& a, const Part& b, const NarrowOptions& options) {
  Thresholds t{options.touch_overlap, options.touch_gap, options.clearance, options.step,
               a.weld + b.weld};
  if (!options.thickness_cap) return t;
  for (const Part* part : {&a, &b}) {
    if (part->kind != PartKind::solid) continue;
    t.overlap = std::min(t.overlap, part->thickness() / 4);
    t.step = std::min(t.step, part->thickness() / 4);
  }
  return t;
}

double reach_of(const NarrowOptions& options) {
  // More than the thresholds: what the snap may have moved beyond one is for judge() to see.
  return std::max({options.touch_gap, options.clearance, options.step}) + kSnapReach;
}

double parting_gap(const Part& a, const Part& b, const NarrowOptions& options) {
  return reach_of(options) + a.sag + b.sag;
}

}  // namespace strake::clash
