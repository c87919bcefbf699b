// SPDX-License-Identifier: Apache-2.0
#include "clash/detect.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "clash/narrow_phase/narrow_phase.hpp"
#include "clash/narrow_phase/source_errors.hpp"
#include "clash/pairs/pair_tasks.hpp"
#include "clash/regions/object_regions.hpp"
#include "clash/regions/part_regions.hpp"
#include "clash/results/object_results.hpp"
#include "clash/results/reported.hpp"
#include "clash/results/result_counts.hpp"
#include "clash/results/result_hash.hpp"
#include "clash/rules/options.hpp"
#include "clash/rules/rule_matcher.hpp"
#include "clash/volumes/common_volumes.hpp"
#include "clash/volumes/limited_volumes.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/report.hpp"
#include "strake/parallel/slots.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::clash {
namespace {

using geometry::IndexPair;

class Engine {
 public:
  /// `changed`, `cell`: what the run is about where it is not about all objects, or pairs.
  Engine(const model::Scene& scene, const Sets& sets, const Options& options, const Policy& policy,
         const ChangedObjects* changed, const Cell* cell, const parallel::Context& context)
      : scene_(scene),
        sets_(sets),
        options_(options),
        changed_(changed),
        cell_(cell),
        context_(context),
        rules_(
            policy, options, *scene.model,
            changed == nullptr ? std::optional<std::span<const std::uint32_t>>() : changed->tested),
        pair_tolerances_(rules_, options, *scene.model),
        cache_(list_, *scene.model) {}

  /// Returns nothing where changed objects have too many pairs.
  Result<std::optional<Report>> run() {
    Report report = begin();
    const auto begun = run_broad_phase(report);
    if (!begun) return begun.error();
    if (!*begun) return std::optional<Report>();
    if (const Status s = run_narrow_phase(); !s) return s.error();
    const parallel::StageTimer timer(context_.report, "result by objects");
    auto found = collect_results(report);
    if (!found) return found.error();
    const PartResults results{*found, pairs_, list_, rules_};
    if (const Status s =
            measure_limited_volumes(results, *found, common_volumes_, cache_, context_, report);
        !s)
      return s.error();
    if (const Status s = aggregate(results, report); !s) return s.error();
    if (const Status s = finish(report); !s) return s.error();
    return std::optional(std::move(report));
  }

  /// Returns what joins the report of a cell, which ran, with those of the others.
  [[nodiscard]] TileReport tile_report(Report report) const {
    TileReport tile;
    tile.hash_sum = report.kept->hash_sum;
    tile.hashed = report.pairs.size() + report.unlisted.contacts + report.unlisted.allowed;
    tile.box_pairs = report.kept->box_pairs;
    const auto boxes = object_boxes(list_, rules_.reach(), sets_.in_a.size());
    for (const ScenePart& part : list_.parts)
      if (cell_->contains(boxes[part.object].lo)) ++tile.parts;
    tile.unknown_sag = unknown_sag_;
    report.kept.reset();
    tile.report = std::move(report);
    return tile;
  }

 private:
  // Only shares the work out: between 1024 and 16'384 no difference can be seen (decision 0073).
  static constexpr std::size_t kGrain = 4096;

  [[nodiscard]] bool exact() const { return options_.engine.narrow_phase == NarrowPhase::exact; }

  [[nodiscard]] Report begin() const {
    Report report;
    report.set_a = sets_.name_a;
    report.set_b = sets_.name_b;
    report.options = options_;
    // The baseline has no triangles to tell regions by.
    if (!exact()) report.options.engine.max_regions = 0;
    report.in_a = sets_.in_a;
    report.in_b = sets_.in_b;
    report.within_files = sets_.group.empty();
    if (options_.engine.keep_for_changes || cell_ != nullptr) report.kept.emplace();
    rules_.begin_report(sets_, report);
    return report;
  }

  /// The first stage finds which pairs of parts go on to the narrow phase, and which of them are
  /// equal. Returns whether there are not too many.
  Result<bool> run_broad_phase(Report& report) {
    const parallel::StageTimer timer(context_.report, "stage 1: pairs by boxes");
    auto parts = collect_scene_parts(scene_, sets_of_changed(), options_.engine.curves, context_);
    if (!parts) return parts.error();
    list_ = std::move(*parts);
    if (const Status s = set_source_errors(scene_, options_, list_, context_); !s) return s.error();
    auto found = find_pairs();
    if (!found) return found.error();
    if (!*found) return false;
    pairs_ = std::move((*found)->pairs);
    if (report.kept) {
      report.kept->box_pairs = (*found)->boxes;
      report.kept->framed = (*found)->framed;
    }
    if (const Status s = rules_.exempt(list_, pairs_, context_, report); !s) return s.error();
    auto unique_pairs = find_equal_pairs();
    if (!unique_pairs) return unique_pairs.error();
    unique_pairs_ = std::move(*unique_pairs);
    auto objects = ObjectPairs::find(pairs_, list_, context_);
    if (!objects) return objects.error();
    objects_ = std::move(*objects);
    auto candidates = parallel::slots<Candidate>(unique_pairs_.first.size(), context_);
    if (!candidates) return candidates.error();
    candidates_ = std::move(*candidates);
    return true;
  }

  /// Returns the sets without objects that the run does not ask about.
  [[nodiscard]] Sets sets_of_changed() const {
    if (changed_ == nullptr) return sets_;
    Sets tested;
    tested.in_a.assign(sets_.in_a.size(), false);
    tested.in_b = tested.in_a;
    for (const std::uint32_t o : changed_->tested) {
      tested.in_a[o] = sets_.in_a[o];
      tested.in_b[o] = sets_.in_b[o];
    }
    return tested;
  }

  [[nodiscard]] Result<std::optional<CandidatePairs>> find_pairs() const {
    if (changed_ != nullptr)
      return find_changed_pairs(list_, sets_, rules_.reach(), changed_->change,
                                changed_->max_box_pairs, context_);
    auto all = cell_ != nullptr
                   ? find_pairs_of_cell(list_, sets_, rules_.reach(), options_, *cell_, context_)
                   : find_candidate_pairs(list_, sets_, rules_.reach(), options_, context_);
    if (!all) return all.error();
    return std::optional(std::move(*all));
  }

  Result<UniquePairs> find_equal_pairs() const {
    const auto settings = parallel::transform(
        context_, {.name = "settings of pairs", .n = pairs_.size(), .grain = PairTasks::kBlock},
        [&](std::size_t i) {
          return pair_tolerances_.settings(list_.parts[pairs_[i].first],
                                           list_.parts[pairs_[i].second]);
        });
    if (!settings) return settings.error();
    return find_unique_pairs(pairs_, list_, *settings, context_);
  }

  [[nodiscard]] EvaluatedPairs evaluated() const {
    return {list_, pairs_, unique_pairs_, candidates_};
  }

  /// The second stage computes the results of all unique pairs, and their regions where these are
  /// reported.
  Status run_narrow_phase() {
    const parallel::StageTimer timer(context_.report, "stage 2: detailed work");
    const PairTasks work(list_, pairs_, unique_pairs_, context_);
    const StageInputs stage{work, objects_, rules_, pair_tolerances_, options_, cache_};
    if (!exact()) return run_sphere_narrow_phase(stage, candidates_);
    if (const Status s = run_exact_narrow_phase(stage, evaluated(), candidates_); !s) return s;
    if (const Status s = mark_enclosed(stage, candidates_); !s) return s;
    auto regions = compute_part_regions(stage, evaluated(), candidates_);
    if (!regions) return regions.error();
    regions_ = std::move(*regions);
    return {};
  }

  /// Returns the results that can appear in a report, and records what was not compared.
  Result<std::vector<PartResult>> collect_results(Report& report) const {
    const EvaluatedPairs all = evaluated();
    if (const Status s = record_not_compared(all, objects_, scene_, context_, report); !s)
      return s.error();
    return parallel::collect<PartResult>(
        context_, {.name = "answers", .n = pairs_.size(), .grain = PairTasks::kBlock},
        [&](std::size_t i, std::vector<PartResult>& out) {
          const Candidate& c = all.of(i);
          if (!c.too_large && c.evaluation.answer.classification.severest != Class::no_hit)
            append_regions(i, c, out);
        });
  }

  /// Appends the regions of a pair of parts, or its result as a whole.
  void append_regions(std::size_t pair, const Candidate& c, std::vector<PartResult>& found) const {
    const std::uint32_t number = unique_pairs_.of[pair];
    const std::span<const PartRegion> regions = regions_.of(pair, number);
    if (regions.empty()) {
      found.push_back(
          {pair, &c.evaluation.answer, nullptr, regions_.is_count_uncertain(pair, number)});
      return;
    }
    const EvaluatedPairs all = evaluated();
    const bool each = rules_.may_allow(all.a(pair).object, all.b(pair).object);
    for (const PartRegion& region : regions)
      found.push_back({pair, &region.answer, &region.extent, false, each || region.is_whole});
  }

  /// Aggregates by objects what was found about parts.
  Status aggregate(const PartResults& results, Report& report) {
    auto joined = aggregate_by_object(results, context_);
    if (!joined) return joined.error();
    report.pairs = std::move(*joined);
    // The log has the classes of all, whatever is reported of them.
    if (options_.engine.log_pairs)
      if (const Status s = log_pairs(evaluated(), objects_, rules_, context_, report); !s) return s;
    if (const Status s = filter_reported(results, sets_, context_, report); !s) return s;
    if (report.options.engine.max_regions > 0 || !report.allowed.empty()) {
      if (const Status s = aggregate_regions(results, context_, report); !s) return s;
    } else {
      // Where nothing requests regions it would go on being the place of a pair's part results,
      // which a run that follows changes has others of.
      const Status s = parallel::for_each(
          context_, {.name = "no regions", .n = report.pairs.size(), .grain = kGrain},
          [&](std::size_t i) { report.pairs[i].first_region = 0; });
      if (!s) return s;
    }
    if (options_.engine.volumes == Volumes::on)
      return measure_volumes(results, cache_, context_, report);
    return {};
  }

  Status finish(Report& report) {
    if (const Status s = rules_.finish_report(context_, report); !s) return s.error();
    auto elements = hash_elements();
    if (!elements) return elements.error();
    const auto sum = sum_of_hashes(report, *elements, context_);
    if (!sum) return sum.error();
    report.hash = result_hash(*sum, report.pairs.size());
    if (report.kept) {
      report.kept->hash_sum = *sum;
      report.kept->elements = std::move(*elements);
    }
    if (const Status s = fill_counters(evaluated(), objects_, rules_, context_, report); !s)
      return s.error();
    const auto widest = pair_tolerances_.widest_band(list_.parts, context_);
    if (!widest) return widest.error();
    report.contact_distance_mm = *widest / geometry::kGridPerMm;
    report.weld_mm = scene_.weld_mm;
    describe_sets(report);
    if (const Status s = count_sheets(list_, context_, report); !s) return s;
    auto unknown_sag = files_of_unknown_sag(list_, *scene_.model, context_);
    if (!unknown_sag) return unknown_sag.error();
    unknown_sag_ = std::move(*unknown_sag);
    report_unknown_sag(unknown_sag_, *scene_.model, report.diagnostics);
    return options_.engine.contacts == Contacts::count ? leave_out_contacts(context_, report)
                                                       : Status{};
  }

  /// Returns KeptForChanges::elements, without those of objects that the run does not ask about.
  [[nodiscard]] Result<std::vector<std::uint64_t>> hash_elements() const {
    const ElementHashes elements(*scene_.model);
    auto made = parallel::slots<std::uint64_t>(scene_.model->objects.size(), context_);
    if (!made) return made.error();
    std::vector<std::uint64_t>& low = *made;
    const std::size_t n = changed_ == nullptr ? low.size() : changed_->tested.size();
    const Status hashed = parallel::for_each(
        context_, {.name = "hashes of ids", .n = n, .grain = kGrain}, [&](std::size_t i) {
          const std::uint32_t o =
              changed_ == nullptr ? static_cast<std::uint32_t>(i) : changed_->tested[i];
          low[o] = elements.of(o).low;
        });
    if (!hashed) return hashed.error();
    return made;
  }

  const model::Scene& scene_;
  const Sets& sets_;
  const Options& options_;
  const ChangedObjects* changed_;  ///< null: the run is about all
  const Cell* cell_;               ///< null: the run is about all pairs of these
  const parallel::Context& context_;
  RuleMatcher rules_;
  PairToleranceTable pair_tolerances_;
  ScenePartList list_;
  AccelerationCache cache_;
  std::vector<IndexPair> pairs_;
  UniquePairs unique_pairs_;
  ObjectPairs objects_;
  std::vector<Candidate> candidates_;         ///< one per unique pair
  PartRegions regions_;                       ///< where distinguished
  std::vector<CommonVolume> common_volumes_;  ///< where a rule or the test limits them
  std::vector<std::uint8_t> unknown_sag_;     ///< an entry for each file
};

}  // namespace

void describe_sets(Report& report) {
  report.objects_a =
      static_cast<std::uint64_t>(std::count(report.in_a.begin(), report.in_a.end(), true));
  report.objects_b =
      static_cast<std::uint64_t>(std::count(report.in_b.begin(), report.in_b.end(), true));
  if (report.objects_a == 0 || report.objects_b == 0)
    report.diagnostics.add(
        Severity::warning, "empty-set", "a set without objects clashes with nothing",
        report.objects_a == 0 ? "set A, " + report.set_a : "set B, " + report.set_b);
}

Status check_inputs(const model::Scene& scene, const Sets& sets, const Options& options,
                    const Policy& policy) {
  if (Status s = check(options, sets, scene.model->objects.size()); !s) return s;
  for (const Tolerances& t : policy.tolerances)
    if (Status s = check(t, scene.model->objects.size()); !s) return s;
  if (Status s = check(policy, scene.model->objects.size()); !s) return s;
  return check_narrow_phase(policy, options);
}

Result<std::optional<Report>> detect_among(const model::Scene& scene, const Sets& sets,
                                           const Options& options, const Policy& policy,
                                           const ChangedObjects& changed,
                                           const parallel::Context& context) {
  return Engine(scene, sets, options, policy, &changed, nullptr, context).run();
}

Result<Report> detect(const model::Scene& scene, const Sets& sets, const Options& options,
                      const Policy& policy, const parallel::Context& context) {
  if (const Status s = check_inputs(scene, sets, options, policy); !s) return s.error();
  auto report = Engine(scene, sets, options, policy, nullptr, nullptr, context).run();
  if (!report) return report.error();
  return std::move(**report);
}

Result<TileReport> detect_tile(const model::Scene& scene, const Sets& sets, const Options& options,
                               const Policy& policy, const Cell& cell,
                               const parallel::Context& context) {
  if (const Status s = check_inputs(scene, sets, options, policy); !s) return s.error();
  Engine engine(scene, sets, options, policy, nullptr, &cell, context);
  auto report = engine.run();
  if (!report) return report.error();
  return engine.tile_report(std::move(**report));
}

Result<Report> detect(const model::Scene& scene, const Sets& sets, const Options& options,
                      const parallel::Context& context) {
  return detect(scene, sets, options, {}, context);
}

}  // namespace strake::clash
