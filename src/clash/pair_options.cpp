// SPDX-License-Identifier: Apache-2.0
#include "clash/pair_options.hpp"

#include <algorithm>
#include <limits>

#include "clash/options.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/reduce.hpp"

namespace strake::clash {

PairOptions::PairOptions(const PairRules& rules, const Options& options, const model::Model& model)
    : rules_(rules), options_(options), model_(model) {
  for (const Tolerances& t : rules.all())
    narrow_.push_back({.touch_overlap = t.touch_overlap_mm * geometry::kGridPerMm,
                       .touch_gap = t.touch_gap_mm * geometry::kGridPerMm,
                       .clearance = t.clearance_mm * geometry::kGridPerMm,
                       .thickness_cap = t.thickness_cap == ThicknessCap::on});
}

NarrowOptions PairOptions::of(const PartRef& a, const PartRef& b) const {
  NarrowOptions options = narrow_[rules_.tolerances(a.object, b.object)];
  options.contact_distance = std::max(band(a), band(b));
  options.snap = snap(a, b);
  options.step = static_cast<double>(std::max(a.step, b.step));
  return options;
}

CaseSettings PairOptions::settings(const PartRef& a, const PartRef& b) const {
  return {static_cast<std::uint32_t>(rules_.tolerances(a.object, b.object)),
          std::max(band(a), band(b)), snap(a, b)};
}

Result<double> PairOptions::widest_band(std::span<const PartRef> parts,
                                        const parallel::Context& context) const {
  constexpr std::size_t kGrain = 4096;
  return parallel::reduce(
      context, {.name = "widest contact distance", .n = parts.size(), .grain = kGrain},
      contact_distance(options_, 0),
      [&](double& widest, std::size_t i) { widest = std::max(widest, band(parts[i])); },
      [](double& into, const double& partial) { into = std::max(into, partial); });
}

double PairOptions::least_touch_gap() const {
  double least = std::numeric_limits<double>::infinity();
  for (const NarrowOptions& n : narrow_) least = std::min(least, n.touch_gap);
  return least;
}

double PairOptions::snap(const PartRef& a, const PartRef& b) {
  return static_cast<double>(a.snap) + static_cast<double>(b.snap);
}

double PairOptions::band(const PartRef& part) const {
  return contact_distance(options_, model_.bodies[part.body].precision_um);
}

}  // namespace strake::clash
