// SPDX-License-Identifier: Apache-2.0
#include "clash/narrow.hpp"

#include "clash/canonical_order.hpp"
#include "clash/closed_form.hpp"
#include "clash/pair_limits.hpp"
#include "clash/pair_of_parts.hpp"
#include "clash/relation.hpp"
#include "strake/geometry/flush_contact.hpp"

namespace strake::clash {

std::optional<PartAnswer> judge_analytic(const NarrowPart& a, const NarrowPart& b,
                                         const NarrowOptions& options) {
  const auto judge = [&](const NarrowPart& x, const NarrowPart& y) -> std::optional<PartAnswer> {
    const auto form = closed_form(x, y, reach_of(options));
    if (!form || form->tie) return std::nullopt;
    NarrowWork work;
    return PairOfParts(x, y, options, work).analytic(*form);
  };
  return in_order(a, b, judge);
}

std::optional<PartAnswer> judge_flush(const NarrowPart& a, const NarrowPart& b,
                                      const NarrowOptions& options, bool& separated) {
  const auto judge = [&](const NarrowPart& x, const NarrowPart& y) -> std::optional<PartAnswer> {
    const auto contact = geometry::flush_contact(x.treed.placed, y.treed.placed);
    separated = contact.separated;
    if (!contact.touching) return std::nullopt;
    if (may_be_one_sheet(x.treed, y.treed, options.contact_distance)) {
      // How much of them lies on the other is for their trees to say.
      separated = false;
      return std::nullopt;
    }
    NarrowWork work;
    return PairOfParts(x, y, options, work).flush(contact.point);
  };
  return in_order(a, b, judge);
}

geometry::PartingGap gap_between(const NarrowPart& a, const NarrowPart& b,
                                 const NarrowOptions& options) {
  const bool ordered = in_canonical_order(a.treed, b.treed);
  const NarrowPart &x = ordered ? a : b, &y = ordered ? b : a;
  return geometry::frame_gap({x.treed.placed, x.frame}, {y.treed.placed, y.frame},
                             parting_gap(*x.treed.placed.part, *y.treed.placed.part, options));
}

std::optional<PartAnswer> judge_flush_askew(const NarrowPart& a, const NarrowPart& b,
                                            const NarrowOptions& options,
                                            const geometry::PartingGap& gap, bool& asked,
                                            NarrowWork& work) {
  return in_order(a, b, [&](const NarrowPart& x, const NarrowPart& y) {
    return PairOfParts(x, y, options, work).flush_across(gap, asked);
  });
}

FirstLook look_at(const NarrowPart& a, const NarrowPart& b, const NarrowOptions& options,
                  const KnownBefore& known, NarrowWork& work) {
  return in_order(a, b, [&](const NarrowPart& x, const NarrowPart& y) {
    return PairOfParts(x, y, options, work).look(known);
  });
}

PartAnswer judge_distance(const NarrowPart& a, const NarrowPart& b, const NarrowOptions& options,
                          double reach, NarrowWork& work) {
  return in_order(a, b, [&](const NarrowPart& x, const NarrowPart& y) {
    return PairOfParts(x, y, options, work).distance(reach);
  });
}

PartAnswer judge_depth(const NarrowPart& a, const NarrowPart& b, const FirstLook& look,
                       const KnownBefore& known, const NarrowOptions& options, NarrowWork& work) {
  return in_order(a, b, [&](const NarrowPart& x, const NarrowPart& y) {
    return PairOfParts(x, y, options, work).depth(look, known);
  });
}

}  // namespace strake::clash
