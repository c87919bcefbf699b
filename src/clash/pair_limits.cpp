// SPDX-License-Identifier: Apache-2.0
#include "clash/pair_limits.hpp"

#include <algorithm>

namespace strake::clash {

using geometry::Part;
using geometry::PartKind;

double apart_within(const Part& a, const Part& b, const NarrowOptions& options) {
  if (a.kind != PartKind::sheet || b.kind != PartKind::sheet) return options.contact_distance;
  return std::min(options.contact_distance, thresholds(a, b, options).overlap);
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
  Thresholds t{options.touch_overlap, options.touch_gap, options.clearance};
  if (!options.thickness_cap) return t;
  for (const Part* part : {&a, &b})
    if (part->kind == PartKind::solid) t.overlap = std::min(t.overlap, part->thickness() / 4);
  return t;
}

double reach_of(const NarrowOptions& options) {
  // A unit more than the thresholds: what lies exactly at one is for judge() to see.
  return std::max(options.touch_gap, options.clearance) + 1;
}

double parting_gap(const Part& a, const Part& b, const NarrowOptions& options) {
  return reach_of(options) + a.sag + b.sag;
}

}  // namespace strake::clash
