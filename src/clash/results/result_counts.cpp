// SPDX-License-Identifier: Apache-2.0
#include "clash/results/result_counts.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "strake/parallel/collect.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::clash {
namespace {

// Only shares the work out: between 4096 and 65'536 no difference can be seen (decision 0073).
constexpr std::size_t kResultsPerBlock = 16384;

Status count_work(const EvaluatedPairs& evaluated, const parallel::Context& context,
                  Counters& counters) {
  const auto sum = parallel::reduce(
      context, {.name = "count work", .n = evaluated.candidates.size(), .grain = kResultsPerBlock},
      NarrowCost{},
      [&](NarrowCost& partial, std::size_t i) { partial.add(evaluated.candidates[i].cost); },
      [](NarrowCost& into, const NarrowCost& partial) { into.add(partial); });
  if (!sum) return sum.error();
  counters.triangle_pairs = sum->pair.triangle_pairs;
  counters.exact_fallbacks = sum->pair.exact_fallbacks;
  counters.depth_cells = sum->depth_cells;
  return {};
}

constexpr std::string_view kTooLarge = "pair-too-large", kInOpen = "pair-in-open-surface";

/// Returns the code of why a pair of objects was not compared; empty where it was.
std::string_view why_not_compared(const EvaluatedPairs& evaluated, const ObjectPairs& objects,
                                  std::size_t pair) {
  bool in_open = false, hit = false;
  for (std::size_t i = objects.begin(pair); i < objects.end(pair); ++i) {
    const Candidate& c = evaluated.of(i);
    if (c.too_large) return kTooLarge;
    in_open = in_open || c.in_open;
    hit = hit || c.evaluation.answer.classification.cls == Class::hit;
  }
  return in_open && !hit ? kInOpen : std::string_view{};
}

}  // namespace

Status record_not_compared(const EvaluatedPairs& evaluated, const ObjectPairs& objects,
                           const model::Scene& scene, const parallel::Context& context,
                           Report& report) {
  for (const model::IncompleteObject& lacking : scene.lacking)
    if (report.in_a[index(lacking.object)] || report.in_b[index(lacking.object)])
      report.not_compared.push_back({lacking.object, {}, lacking.code});
  const auto pairs = parallel::collect<NotCompared>(
      context, {.name = "pairs not compared", .n = objects.size(), .grain = kResultsPerBlock},
      [&](std::size_t k, std::vector<NotCompared>& out) {
        const std::string_view code = why_not_compared(evaluated, objects, k);
        const std::size_t first = objects.begin(k);
        if (!code.empty())
          out.push_back({model::ObjectId{evaluated.a(first).object},
                         model::ObjectId{evaluated.b(first).object}, code});
      });
  if (!pairs) return pairs.error();
  report.not_compared.insert(report.not_compared.end(), pairs->begin(), pairs->end());
  report_not_compared(*scene.model, report);
  return {};
}

void report_not_compared(const model::Model& model, Report& report) {
  for (const NotCompared& pair : report.not_compared)
    if (pair.b)
      report.diagnostics.add(Severity::skipped, pair.code,
                             pair.code == kTooLarge
                                 ? "the pair spans more than 2.1 km and was not compared"
                                 : "one lies within the other, whose surface does not close: meant "
                                   "as solids, they hit",
                             model.object(pair.a).id + " and " + model.object(*pair.b).id);
}

Status count_sheets(const ScenePartList& list, const parallel::Context& context, Report& report) {
  constexpr std::uint8_t kMax = 255;
  report.sheets.assign(report.in_a.size(), 0);
  // Parts are by object: the first one counts for all.
  return parallel::for_each(
      context, {.name = "sheets", .n = list.parts.size(), .grain = kResultsPerBlock},
      [&](std::size_t first) {
        const std::uint32_t object = list.parts[first].object;
        if (first > 0 && list.parts[first - 1].object == object) return;
        std::uint8_t& sheets = report.sheets[object];
        for (std::size_t i = first; i < list.parts.size() && list.parts[i].object == object; ++i)
          if (list.parts[i].placed.part->kind == geometry::PartKind::sheet && sheets < kMax)
            ++sheets;
      });
}

Result<std::vector<std::uint8_t>> files_of_unknown_sag(const ScenePartList& list,
                                                       const model::Model& model,
                                                       const parallel::Context& context) {
  using Unknown = std::vector<std::uint8_t>;
  return parallel::reduce(
      context, {.name = "parts of unknown sag", .n = list.parts.size(), .grain = kResultsPerBlock},
      Unknown(model.files.size(), 0),
      [&](Unknown& partial, std::size_t i) {
        const ScenePart& p = list.parts[i];
        if (p.placed.part->flags.unknown_sag) partial[model.objects[p.object].file] = 1;
      },
      [](Unknown& into, const Unknown& partial) {
        for (std::size_t f = 0; f < into.size(); ++f) into[f] |= partial[f];
      });
}

void report_unknown_sag(std::span<const std::uint8_t> by_file, const model::Model& model,
                        Diagnostics& diagnostics) {
  for (std::size_t f = 0; f < by_file.size(); ++f)
    if (by_file[f] != 0)
      diagnostics.add(Severity::note, "unknown-sag",
                      "meshes are used as they are; their deviation from the original surfaces "
                      "is unknown",
                      model.files[f].label);
}

Status fill_counters(const EvaluatedPairs& evaluated, const ObjectPairs& objects,
                     const RuleMatcher& rules, const parallel::Context& context, Report& report) {
  report.counters.part_pairs = evaluated.pairs.size();
  report.counters.candidate_pairs = objects.size();
  if (const Status s = count_work(evaluated, context, report.counters); !s) return s.error();
  return rules.count_candidates(evaluated, objects, context, report);
}

namespace {

// Only shares the work out: between 1024 and 16'384 no difference can be seen (decision 0073).
constexpr std::size_t kLogGrain = 4096;

/// Returns what one pair of objects cost; an earlier pair of parts may have been equal to one of
/// theirs, which then took no work of its own.
LoggedPair logged(const EvaluatedPairs& evaluated, std::size_t begin, std::size_t end,
                  const RuleMatcher& rules) {
  LoggedPair pair;
  pair.a = model::ObjectId{evaluated.a(begin).object};
  pair.b = model::ObjectId{evaluated.b(begin).object};
  pair.may_be_allowed = rules.may_allow(index(pair.a), index(pair.b));
  for (std::size_t i = begin; i < end; ++i) {
    const NarrowCost& cost = evaluated.of(i).cost;
    ++pair.part_pairs;
    if (evaluated.unique_pairs.first[evaluated.unique_pairs.of[i]] != i) ++pair.repeated_part_pairs;
    pair.node_pairs += cost.pair.node_pairs;
    pair.triangle_pairs += cost.pair.triangle_pairs;
    pair.exact_fallbacks += cost.pair.exact_fallbacks;
    pair.depth_cells += cost.depth_cells;
  }
  return pair;
}

/// Sets the classes of some logged pairs. Both lists are by objects.
void set_classes(std::span<LoggedPair> log, const std::vector<Pair>& pairs) {
  const auto before = [](const auto& x, const auto& y) {
    return std::tie(x.a, x.b) < std::tie(y.a, y.b);
  };
  auto at = std::lower_bound(pairs.begin(), pairs.end(), log.front(), before);
  for (LoggedPair& logged : log) {
    while (at != pairs.end() && before(*at, logged)) ++at;
    if (at != pairs.end() && !before(logged, *at)) logged.cls = at->cls;
  }
}

}  // namespace

Status log_pairs(const EvaluatedPairs& evaluated, const ObjectPairs& objects,
                 const RuleMatcher& rules, const parallel::Context& context, Report& report) {
  auto log = parallel::transform(
      context, {.name = "log of pairs", .n = objects.size(), .grain = kLogGrain},
      [&](std::size_t k) { return logged(evaluated, objects.begin(k), objects.end(k), rules); });
  if (!log) return log.error();
  const parallel::Region pieces{.n = log->size(), .grain = kLogGrain};
  const Status status = parallel::for_each(
      context, {.name = "classes in the log", .n = pieces.blocks()}, [&](std::size_t piece) {
        const std::size_t first = piece * kLogGrain;
        set_classes(std::span(*log).subspan(first, std::min(kLogGrain, log->size() - first)),
                    report.pairs);
      });
  if (!status) return status.error();
  report.log = std::move(*log);
  return {};
}

}  // namespace strake::clash
