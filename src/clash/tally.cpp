// SPDX-License-Identifier: Apache-2.0
#include "clash/tally.hpp"

#include <cstdint>
#include <vector>

#include "strake/parallel/collect.hpp"
#include "strake/parallel/reduce.hpp"

namespace strake::clash {
namespace {

constexpr std::size_t kGrain = 16384;

void add(const NarrowWork& work, NarrowWork& sum) {
  sum.pair.triangle_pairs += work.pair.triangle_pairs;
  sum.pair.exact_fallbacks += work.pair.exact_fallbacks;
  sum.depth_cells += work.depth_cells;
}

Status count_work(const Judged& judged, const parallel::Context& context, Counters& counters) {
  const auto sum = parallel::reduce(
      context, {.name = "count work", .n = judged.candidates.size(), .grain = kGrain}, NarrowWork{},
      [&](NarrowWork& partial, std::size_t i) { add(judged.candidates[i].work, partial); },
      [](NarrowWork& into, const NarrowWork& partial) { add(partial, into); });
  if (!sum) return sum.error();
  counters.triangle_pairs = sum->pair.triangle_pairs;
  counters.exact_fallbacks = sum->pair.exact_fallbacks;
  counters.depth_cells = sum->depth_cells;
  return {};
}

}  // namespace

Status note_too_large(const Judged& judged, const model::Model& model,
                      const parallel::Context& context, Diagnostics& diagnostics) {
  const auto pairs = parallel::collect<std::size_t>(
      context, {.name = "pairs too large", .n = judged.pairs.size(), .grain = kGrain},
      [&](std::size_t i, std::vector<std::size_t>& out) {
        if (judged.of(i).too_large) out.push_back(i);
      });
  if (!pairs) return pairs.error();
  for (const std::size_t i : *pairs)
    diagnostics.add(
        Severity::skipped, "pair-too-large",
        "the pair spans more than a kilometre and was not compared",
        model.objects[judged.a(i).object].id + " and " + model.objects[judged.b(i).object].id);
  return {};
}

Status note_unknown_sag(const PartList& list, const model::Model& model,
                        const parallel::Context& context, Diagnostics& diagnostics) {
  using Unknown = std::vector<std::uint8_t>;
  const auto unknown = parallel::reduce(
      context, {.name = "parts of unknown sag", .n = list.parts.size(), .grain = kGrain},
      Unknown(model.files.size(), 0),
      [&](Unknown& partial, std::size_t i) {
        const PartRef& p = list.parts[i];
        if (p.placed.part->flags.unknown_sag) partial[model.objects[p.object].file] = 1;
      },
      [](Unknown& into, const Unknown& partial) {
        for (std::size_t f = 0; f < into.size(); ++f) into[f] |= partial[f];
      });
  if (!unknown) return unknown.error();
  for (std::size_t f = 0; f < unknown->size(); ++f)
    if ((*unknown)[f] != 0)
      diagnostics.add(Severity::note, "unknown-sag",
                      "meshes are taken as the true surfaces: how far they lie from them is "
                      "not known",
                      model.files[f].label);
  return {};
}

Status tally(const Judged& judged, const ObjectPairs& objects, const PairRules& rules,
             const parallel::Context& context, Report& report) {
  report.counters.part_pairs = judged.pairs.size();
  report.counters.candidate_pairs = objects.size();
  if (const Status s = count_work(judged, context, report.counters); !s) return s.error();
  return rules.count_candidates(judged, objects, context, report);
}

}  // namespace strake::clash
