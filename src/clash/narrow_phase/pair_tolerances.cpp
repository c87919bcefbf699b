// SPDX-License-Identifier: Apache-2.0
#include "clash/narrow_phase/pair_tolerances.hpp"

#include <algorithm>
#include <limits>

#include "clash/broad_phase/broad_phase.hpp"
#include "clash/rules/options.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/reduce.hpp"

namespace strake::clash {

using geometry::Part;
using geometry::PartKind;

double apart_within(const Part& a, const Part& b, const PairTolerances& options) {
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

Thresholds thresholds(const Part& a, const Part& b, const PairTolerances& options) {
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

double reach_of(const PairTolerances& options) {
  // More than the thresholds: classify() takes into account what the snap may have moved beyond
  // one.
  return std::max({options.touch_gap, options.clearance, options.step}) + kSnapMargin;
}

double reach_with_sag(const Part& a, const Part& b, const PairTolerances& options) {
  return reach_of(options) + a.sag + b.sag;
}

PairToleranceTable::PairToleranceTable(const RuleMatcher& rules, const Options& options,
                                       const model::Model& model)
    : rules_(rules), options_(options), model_(model) {
  for (const Tolerances& t : rules.all())
    narrow_.push_back({.touch_overlap = t.touch_overlap_mm * geometry::kGridPerMm,
                       .touch_gap = t.touch_gap_mm * geometry::kGridPerMm,
                       .clearance = t.clearance_mm * geometry::kGridPerMm,
                       .thickness_cap = t.thickness_cap == ThicknessCap::on});
}

PairTolerances PairToleranceTable::of(const ScenePart& a, const ScenePart& b) const {
  const PairToleranceKey key = settings(a, b);
  PairTolerances options = narrow_[key.tolerances];
  options.contact_distance = key.contact_distance;
  options.snap = key.snap;
  if (key.added_clearance_mm > 0)
    options.clearance =
        (rules_.all()[key.tolerances].clearance_mm + key.added_clearance_mm) * geometry::kGridPerMm;
  options.step = static_cast<double>(std::max(a.step, b.step));
  return options;
}

PairToleranceKey PairToleranceTable::settings(const ScenePart& a, const ScenePart& b) const {
  return {static_cast<std::uint32_t>(rules_.tolerances(a.object, b.object)),
          std::max(band(a), band(b)), snap(a, b), rules_.added_clearance_mm(a.object, b.object),
          rules_.may_allow(a.object, b.object)};
}

Result<double> PairToleranceTable::widest_band(std::span<const ScenePart> parts,
                                               const parallel::Context& context) const {
  // Only shares the work out: between 1024 and 16'384 no difference can be seen (decision 0073).
  constexpr std::size_t kGrain = 4096;
  return parallel::reduce(
      context, {.name = "widest contact distance", .n = parts.size(), .grain = kGrain},
      contact_distance(options_, 0),
      [&](double& widest, std::size_t i) { widest = std::max(widest, band(parts[i])); },
      [](double& into, const double& partial) { into = std::max(into, partial); });
}

double PairToleranceTable::min_touch_gap() const {
  double least = std::numeric_limits<double>::infinity();
  for (const PairTolerances& n : narrow_) least = std::min(least, n.touch_gap);
  return least;
}

double PairToleranceTable::snap(const ScenePart& a, const ScenePart& b) {
  return static_cast<double>(a.snap) + static_cast<double>(b.snap);
}

double PairToleranceTable::band(const ScenePart& part) const {
  return contact_distance(options_, model_.bodies[part.body].precision_um);
}

}  // namespace strake::clash
