// SPDX-License-Identifier: Apache-2.0
// Decision 0070 says what a run keeps for a later one, and why that is exact.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "clash/detect.hpp"
#include "clash/incremental/neighbours.hpp"
#include "clash/incremental/object_map.hpp"
#include "clash/incremental/partners.hpp"
#include "clash/incremental/renamed.hpp"
#include "clash/incremental/report_merge.hpp"
#include "clash/rules/rule_matcher.hpp"
#include "strake/clash/incremental.hpp"
#include "strake/parallel/report.hpp"

namespace strake::clash {
namespace {

/// The share of changed objects from which a full run is no slower.
constexpr std::size_t kFewChanged = 4;

bool can_follow(const Report& earlier, const Options& options) {
  return options.engine.keep_for_changes && earlier.kept && !earlier.kept->framed &&
         options.engine.narrow_phase == NarrowPhase::exact;
}

/// Returns the report of an earlier run over the same objects as one of this test: what objects add
/// to clearances is not among the values of a report that was stored.
Report taken_over(Report report, const Options& options, const Policy& policy) {
  report.options = options;
  set_cell_tolerances(policy, all_tolerances(policy, options), report);
  report.counters = {};
  report.log.clear();
  return report;
}

/// Returns a report without the lists that a run which follows it takes over.
Report head_of(Report& report) {
  auto pairs = std::exchange(report.pairs, {});
  auto regions = std::exchange(report.regions, {});
  auto exempted = std::exchange(report.exempted_pairs, {});
  auto kept = std::exchange(report.kept, {});
  Report head = report;
  report.pairs = std::move(pairs);
  report.regions = std::move(regions);
  report.exempted_pairs = std::move(exempted);
  report.kept = std::move(kept);
  return head;
}

/// Returns the report that follows the changes. `followed`, where somebody asks, takes what the two
/// runs are compared by; where the earlier report is still needed whole, it is copied.
Result<Report> run_after(const model::Scene& scene, const Sets& sets, const Options& options,
                         const Policy& policy, EarlierRun earlier, const parallel::Context& context,
                         FollowedRun* followed) {
  if (const Status s = check_inputs(scene, sets, options, policy); !s) return s.error();
  const std::size_t objects = scene.model->objects.size();
  auto map = map_objects(earlier.now, objects);
  if (!map) return map.error();
  const auto full = [&] {
    if (followed != nullptr) followed->earlier = std::move(earlier.report);
    return detect(scene, sets, options, policy, context);
  };
  if (!can_follow(earlier.report, options)) return full();
  const Error misfit{ErrorCode::usage, "the report of an earlier run is not about this test",
                     "earlier run", "give one whose rules had the same signature"};
  const KeptForChanges& kept = *earlier.report.kept;
  if (kept.elements.size() != earlier.now.size()) return misfit;
  if (earlier.partners != nullptr &&
      earlier.partners->of.size() != count_blocks(earlier.now.size()))
    return misfit;
  std::vector<std::uint64_t> names_now;
  bool same_names = earlier.same_ids && have_labels_of(kept.elements, *scene.model);
  if (!same_names) {
    auto all = hashes_of_names(*scene.model, context);
    if (!all) return all.error();
    names_now = std::move(*all);
    same_names = kept.elements == names_now;
  }
  const std::span<const std::uint64_t> names = same_names ? kept.elements : names_now;
  if (map->is_identity() && same_names && earlier.report.in_a.size() == objects) {
    if (followed != nullptr) {
      followed->earlier = head_of(earlier.report);
      followed->changes.emplace();
    }
    return taken_over(std::move(earlier.report), options, policy);
  }
  if (!same_names || map->renumbered) mark_hashed_contacts_changed(kept, names, *map);
  if (map->changed > objects / kFewChanged) return full();

  std::optional<parallel::StageTimer> timer;
  timer.emplace(context.report, "what changed");
  const SearchReach reach = search_reach(all_tolerances(policy, options));
  const auto neighbours = find_neighbours(scene, sets, options, reach, *map, context);
  if (!neighbours) return neighbours.error();
  // So few that a full run needs no boxes along faces either; it may find fewer than this counts.
  const std::uint64_t largest = max_unframed_pairs(neighbours->parts, options);
  const std::uint64_t before = kept.box_pairs;
  timer.reset();
  if (before > largest) return full();
  auto fresh = detect_among(scene, sets, options, policy,
                            {neighbours->change, neighbours->tested, largest - before}, context);
  if (!fresh) return fresh.error();
  if (!*fresh) return full();
  if (!fits(earlier.report, **fresh, earlier.now.size())) return misfit;
  timer.emplace(context.report, "results put together");
  const bool same_numbers = !map->renumbered && map->now.size() == objects;
  PairChanges* changes = nullptr;
  if (followed != nullptr) {
    followed->earlier = same_numbers ? head_of(earlier.report) : earlier.report;
    if (same_numbers) changes = &followed->changes.emplace();
  }
  return merge(
      std::move(earlier.report), std::move(**fresh),
      {policy, options, *scene.model, *map, *neighbours, names, same_names, earlier.partners},
      context, changes);
}

}  // namespace

Result<Report> detect_changes(const model::Scene& scene, const Sets& sets, const Options& options,
                              const Policy& policy, EarlierRun earlier,
                              const parallel::Context& context) {
  return run_after(scene, sets, options, policy, std::move(earlier), context, nullptr);
}

Result<FollowedRun> follow_changes(const model::Scene& scene, const Sets& sets,
                                   const Options& options, const Policy& policy, EarlierRun earlier,
                                   const parallel::Context& context) {
  FollowedRun followed;
  Result<Report> report =
      run_after(scene, sets, options, policy, std::move(earlier), context, &followed);
  if (!report) return report.error();
  followed.report = std::move(*report);
  return followed;
}

}  // namespace strake::clash
