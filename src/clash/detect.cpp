// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "clash/case_work.hpp"
#include "clash/enclosed.hpp"
#include "clash/hash.hpp"
#include "clash/narrow_stage.hpp"
#include "clash/options.hpp"
#include "clash/pair_log.hpp"
#include "clash/place_stage.hpp"
#include "clash/policy.hpp"
#include "clash/reduce.hpp"
#include "clash/regions.hpp"
#include "clash/source_errors.hpp"
#include "clash/tally.hpp"
#include "clash/volumes.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/report.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::clash {
namespace {

using geometry::IndexPair;

class Engine {
 public:
  Engine(const model::Scene& scene, const Sets& sets, const Options& options, const Policy& policy,
         const parallel::Context& context)
      : scene_(scene),
        sets_(sets),
        options_(options),
        context_(context),
        rules_(policy, options, *scene.model),
        pair_options_(rules_, options, *scene.model),
        aids_(list_, *scene.model) {}

  Result<Report> run() {
    Report report = begin();
    if (const Status s = pair_up(report); !s) return s.error();
    if (const Status s = judge(); !s) return s.error();
    const parallel::StageTimer timer(context_.report, "result by objects");
    const auto found = answers(report);
    if (!found) return found.error();
    if (const Status s = tell({*found, pairs_, list_, rules_}, report); !s) return s.error();
    if (const Status s = finish(report); !s) return s.error();
    return report;
  }

 private:
  [[nodiscard]] bool exact() const { return options_.narrow_phase == NarrowPhase::exact; }

  [[nodiscard]] Report begin() const {
    Report report;
    report.set_a = sets_.name_a;
    report.set_b = sets_.name_b;
    report.options = options_;
    // The baseline has no triangles to tell places by.
    if (!exact()) report.options.most_regions = 0;
    report.in_a = sets_.in_a;
    report.in_b = sets_.in_b;
    report.within_files = sets_.group.empty();
    rules_.open(sets_, report);
    return report;
  }

  /// The first stage: which pairs of parts go on to the detailed one, and which of them are the
  /// same question.
  Status pair_up(Report& report) {
    const parallel::StageTimer timer(context_.report, "stage 1: pairs by boxes");
    auto parts = list_parts(scene_, sets_, options_.curves, context_);
    if (!parts) return parts.error();
    list_ = std::move(*parts);
    if (const Status s = note_source_errors(scene_, options_, list_, context_); !s) return s;
    auto pairs = near_pairs(list_, sets_, search_reach(rules_.reach_mm() * geometry::kGridPerMm),
                            options_, context_);
    if (!pairs) return pairs.error();
    pairs_ = std::move(*pairs);
    if (const Status s = rules_.exempt(list_, pairs_, context_, report); !s) return s;
    auto cases = tell_cases_apart();
    if (!cases) return cases.error();
    cases_ = std::move(*cases);
    auto objects = ObjectPairs::find(pairs_, list_, context_);
    if (!objects) return objects.error();
    objects_ = std::move(*objects);
    candidates_.resize(cases_.first.size());
    return {};
  }

  Result<Cases> tell_cases_apart() const {
    const auto settings = parallel::transform(
        context_, {.name = "settings of pairs", .n = pairs_.size(), .grain = CaseWork::kBlock},
        [&](std::size_t i) {
          return pair_options_.settings(list_.parts[pairs_[i].first],
                                        list_.parts[pairs_[i].second]);
        });
    if (!settings) return settings.error();
    return find_cases(pairs_, list_, *settings, context_);
  }

  [[nodiscard]] Judged judged() const { return {list_, pairs_, cases_, candidates_}; }

  /// The second stage: the answers of all cases, and their places where that shows.
  Status judge() {
    const parallel::StageTimer timer(context_.report, "stage 2: detailed work");
    const CaseWork work(list_, pairs_, cases_, context_);
    const Stage stage{work, objects_, rules_, pair_options_, options_, aids_};
    if (!exact()) return judge_by_spheres(stage, candidates_);
    if (const Status s = judge_exactly(stage, judged(), candidates_); !s) return s;
    if (const Status s = mark_enclosed(stage, candidates_); !s) return s;
    auto places = tell_places(stage, judged(), candidates_);
    if (!places) return places.error();
    places_ = std::move(*places);
    return {};
  }

  /// The answers that can show in a report; tells of what was not compared.
  Result<std::vector<Found>> answers(Report& report) const {
    const Judged all = judged();
    if (const Status s = note_not_compared(all, objects_, scene_, context_, report); !s)
      return s.error();
    return parallel::collect<Found>(
        context_, {.name = "answers", .n = pairs_.size(), .grain = CaseWork::kBlock},
        [&](std::size_t i, std::vector<Found>& out) {
          const Candidate& c = all.of(i);
          if (!c.too_large && c.look.answer.judgement.severest != Class::no_hit)
            append_places(i, c, out);
        });
  }

  /// The places of a pair of parts, or its answer as a whole.
  void append_places(std::size_t pair, const Candidate& c, std::vector<Found>& found) const {
    const std::uint32_t number = cases_.of[pair];
    if (places_.empty() || places_[number].empty()) {
      found.push_back({pair, &c.look.answer, nullptr, c.too_near_to_tell});
      return;
    }
    const Judged all = judged();
    const bool each = rules_.may_allow(all.a(pair).object, all.b(pair).object);
    for (const PartPlace& place : places_[number])
      found.push_back({pair, &place.answer, &place.extent, false, each || place.is_whole});
  }

  /// Tells of objects what was found about parts.
  Status tell(const PartFindings& findings, Report& report) {
    auto joined = join_by_objects(findings, context_);
    if (!joined) return joined.error();
    report.pairs = std::move(*joined);
    if (report.options.most_regions > 0 || !report.allowed.empty())
      if (const Status s = list_regions(findings, context_, report); !s) return s;
    if (options_.volumes == Volumes::on) return measure_volumes(findings, aids_, context_, report);
    return {};
  }

  Status finish(Report& report) const {
    if (const Status s = rules_.close(context_, report); !s) return s.error();
    auto hash = hash_of(report, *scene_.model, context_);
    if (!hash) return hash.error();
    report.hash = std::move(*hash);
    if (const Status s = tally(judged(), objects_, rules_, context_, report); !s) return s.error();
    const auto widest = pair_options_.widest_band(list_.parts, context_);
    if (!widest) return widest.error();
    report.contact_distance_mm = *widest / geometry::kGridPerMm;
    report.weld_mm = scene_.weld_mm;
    describe_sets(report);
    note_sheets(list_, report);
    if (const Status s = note_unknown_sag(list_, *scene_.model, context_, report.diagnostics); !s)
      return s.error();
    return options_.log_pairs ? log_pairs(judged(), objects_, rules_, context_, report) : Status{};
  }

  void describe_sets(Report& report) const {
    report.objects_a =
        static_cast<std::uint64_t>(std::count(sets_.in_a.begin(), sets_.in_a.end(), true));
    report.objects_b =
        static_cast<std::uint64_t>(std::count(sets_.in_b.begin(), sets_.in_b.end(), true));
    if (report.objects_a == 0 || report.objects_b == 0)
      report.diagnostics.add(
          Severity::warning, "empty-set", "a set without objects clashes with nothing",
          report.objects_a == 0 ? "set A, " + sets_.name_a : "set B, " + sets_.name_b);
  }

  const model::Scene& scene_;
  const Sets& sets_;
  const Options& options_;
  const parallel::Context& context_;
  PairRules rules_;
  PairOptions pair_options_;
  PartList list_;
  PartAids aids_;
  std::vector<IndexPair> pairs_;
  Cases cases_;
  ObjectPairs objects_;
  std::vector<Candidate> candidates_;           ///< one per case
  std::vector<std::vector<PartPlace>> places_;  ///< by case, where told apart
};

}  // namespace

Result<Report> detect(const model::Scene& scene, const Sets& sets, const Options& options,
                      const Policy& policy, const parallel::Context& context) {
  if (const Status s = check(options, sets, scene.model->objects.size()); !s) return s.error();
  for (const Tolerances& t : policy.tolerances)
    if (const Status s = check(t); !s) return s.error();
  if (const Status s = check(policy, scene.model->objects.size()); !s) return s.error();
  return Engine(scene, sets, options, policy, context).run();
}

Result<Report> detect(const model::Scene& scene, const Sets& sets, const Options& options,
                      const parallel::Context& context) {
  return detect(scene, sets, options, {}, context);
}

}  // namespace strake::clash
