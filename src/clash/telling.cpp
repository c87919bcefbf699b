// SPDX-License-Identifier: Apache-2.0
#include "clash/telling.hpp"

#include <algorithm>
#include <cstddef>

#include "clash/curves.hpp"
#include "strake/parallel/collect.hpp"

namespace strake::clash {
namespace {

struct Asked {
  std::uint32_t number = 0;  ///< of the case
  Telling telling = Telling::whole;
};

/// What the k-th pair of objects asks of its cases.
void ask(const Judged& judged, const ObjectPairs& objects, std::size_t k, bool may_allow,
         std::vector<Asked>& out) {
  const std::size_t first = objects.begin(k), end = objects.end(k), before = out.size();
  const auto cls = [&](std::size_t i) { return judged.of(i).look.answer.judgement.cls; };
  Class worst = Class::no_hit;
  for (std::size_t i = first; i < end; ++i) worst = std::max(worst, cls(i));
  for (std::size_t i = first; i < end; ++i) {
    if (cls(i) == Class::no_hit) continue;
    if (cls(i) == Class::clearance_violation && cls(i) != worst && !may_allow) continue;
    // Of a line and anything else the places are not told apart.
    if (has_wire(*judged.a(i).placed.part, *judged.b(i).placed.part)) continue;
    const bool copies = judged.of(i).look.answer.relation == Relation::duplicate;
    out.push_back({judged.cases.of[i], copies ? Telling::whole : Telling::if_several});
  }
  if (may_allow || out.size() - before > 1)
    for (std::size_t i = before; i < out.size(); ++i)
      out[i].telling = may_allow ? Telling::all : Telling::each;
}

}  // namespace

Result<std::vector<Telling>> how_to_tell(const Judged& judged, const ObjectPairs& objects,
                                         const PairRules& rules, const Options& options,
                                         const parallel::Context& context) {
  constexpr std::size_t kGrain = 4096;
  const auto all = parallel::collect<Asked>(
      context, {.name = "places asked for", .n = objects.size(), .grain = kGrain},
      [&](std::size_t k, std::vector<Asked>& out) {
        const std::size_t i = objects.begin(k);
        const bool may_allow = rules.may_allow(judged.a(i).object, judged.b(i).object);
        if (may_allow || options.most_regions > 0) ask(judged, objects, k, may_allow, out);
      });
  if (!all) return all.error();
  std::vector<Telling> telling(judged.candidates.size(), Telling::whole);
  for (const Asked& a : *all) telling[a.number] = std::max(telling[a.number], a.telling);
  return telling;
}

}  // namespace strake::clash
