// SPDX-License-Identifier: Apache-2.0
#include "clash/tally.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

#include "strake/parallel/collect.hpp"
#include "strake/parallel/reduce.hpp"

namespace strake::clash {
namespace {

constexpr std::size_t kGrain = 16384;

Status count_work(const Judged& judged, const parallel::Context& context, Counters& counters) {
  const auto sum = parallel::reduce(
      context, {.name = "count work", .n = judged.candidates.size(), .grain = kGrain}, NarrowCost{},
      [&](NarrowCost& partial, std::size_t i) { partial.add(judged.candidates[i].cost); },
      [](NarrowCost& into, const NarrowCost& partial) { into.add(partial); });
  if (!sum) return sum.error();
  counters.triangle_pairs = sum->pair.triangle_pairs;
  counters.exact_fallbacks = sum->pair.exact_fallbacks;
  counters.depth_cells = sum->depth_cells;
  return {};
}

constexpr std::string_view kTooLarge = "pair-too-large", kInOpen = "pair-in-open-surface";

/// The code of why a pair of objects was not compared; empty where it was.
std::string_view why_not_compared(const Judged& judged, const ObjectPairs& objects,
                                  std::size_t pair) {
  bool in_open = false, hit = false;
  for (std::size_t i = objects.begin(pair); i < objects.end(pair); ++i) {
    const Candidate& c = judged.of(i);
    if (c.too_large) return kTooLarge;
    in_open = in_open || c.in_open;
    hit = hit || c.look.answer.judgement.cls == Class::hit;
  }
  return in_open && !hit ? kInOpen : std::string_view{};
}

}  // namespace

Status note_not_compared(const Judged& judged, const ObjectPairs& objects,
                         const model::Scene& scene, const parallel::Context& context,
                         Report& report) {
  for (const model::Lacking& lacking : scene.lacking)
    if (report.in_a[index(lacking.object)] || report.in_b[index(lacking.object)])
      report.not_compared.push_back({lacking.object, {}, lacking.code});
  const auto pairs = parallel::collect<NotCompared>(
      context, {.name = "pairs not compared", .n = objects.size(), .grain = kGrain},
      [&](std::size_t k, std::vector<NotCompared>& out) {
        const std::string_view code = why_not_compared(judged, objects, k);
        const std::size_t first = objects.begin(k);
        if (!code.empty())
          out.push_back({model::ObjectId{judged.a(first).object},
                         model::ObjectId{judged.b(first).object}, code});
      });
  if (!pairs) return pairs.error();
  for (const NotCompared& pair : *pairs) {
    report.not_compared.push_back(pair);
    report.diagnostics.add(
        Severity::skipped, pair.code,
        pair.code == kTooLarge
            ? "the pair spans more than 2.1 km and was not compared"
            : "one lies within the other, whose surface does not close: meant as solids, they hit",
        scene.model->object(pair.a).id + " and " + scene.model->object(*pair.b).id);
  }
  return {};
}

void note_sheets(const PartList& list, Report& report) {
  constexpr std::uint8_t kMost = 255;
  report.sheets.assign(report.in_a.size(), 0);
  for (const PartRef& part : list.parts)
    if (std::uint8_t& sheets = report.sheets[part.object];
        part.placed.part->kind == geometry::PartKind::sheet && sheets < kMost)
      ++sheets;
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
