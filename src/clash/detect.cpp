// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "clash/cases.hpp"
#include "clash/narrow.hpp"
#include "clash/options.hpp"
#include "clash/pair_log.hpp"
#include "clash/pair_rules.hpp"
#include "clash/parts.hpp"
#include "clash/reduce.hpp"
#include "clash/spheres.hpp"
#include "clash/volumes.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/order.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::clash {
namespace {

using geometry::IndexPair;
using geometry::Part;

/// Items per block of the narrow phase: small enough that a heavy pair holds up few others.
constexpr std::size_t kGrain = 8;
/// Pairs per block where each is done in no time.
constexpr std::size_t kBlock = 4096;

/// One case of a pair of parts on its way through the engine.
struct Candidate {
  FirstLook look;
  NarrowWork work;
  bool separated = false;  ///< a coordinate plane lies between the two
  bool done = false;
  bool too_large = false;
};

class Engine {
 public:
  Engine(const model::Scene& scene, const Sets& sets, const Options& options, const Policy& policy,
         const parallel::Context& context)
      : scene_(scene),
        sets_(sets),
        options_(options),
        context_(context),
        rules_(policy, options, *scene.model),
        list_(list_parts(scene, sets)) {
    for (const Tolerances& t : rules_.all())
      narrow_.push_back({.touch_overlap = t.touch_overlap_mm * geometry::kGridPerMm,
                         .touch_gap = t.touch_gap_mm * geometry::kGridPerMm,
                         .clearance = t.clearance_mm * geometry::kGridPerMm,
                         .thickness_cap = t.thickness_cap == ThicknessCap::on});
    for (const model::SourceFile& file : scene.model->files)
      bands_.push_back(contact_distance(options, file.precision_mm));
  }

  Result<Report> run() {
    Report report;
    report.set_a = sets_.name_a;
    report.set_b = sets_.name_b;
    report.options = options_;
    report.in_a = sets_.in_a;
    report.in_b = sets_.in_b;
    report.within_files = sets_.group.empty();
    rules_.open(sets_, report);
    auto pairs = near_pairs(list_, sets_, search_reach(rules_.reach_mm() * geometry::kGridPerMm),
                            options_, context_);
    if (!pairs) return pairs.error();
    pairs_ = std::move(*pairs);
    if (const Status s = rules_.exempt(list_, pairs_, context_, report); !s) return s.error();
    auto cases = tell_cases_apart();
    if (!cases) return cases.error();
    cases_ = std::move(*cases);
    const bool exact = options_.narrow_phase == NarrowPhase::exact;
    if (const Status s = exact ? narrow_phase() : test_spheres(); !s) return s.error();
    const std::vector<Found> found = answers(report);
    auto joined = join_by_objects(found, pairs_, list_, rules_, context_);
    if (!joined) return joined.error();
    report.pairs = std::move(*joined);
    if (options_.volumes == Volumes::on)
      if (const Status s = measure_volumes({list_, pairs_, found, trees_}, context_, report); !s)
        return s.error();
    if (const Status s = finish(report); !s) return s.error();
    return report;
  }

 private:
  Result<Cases> tell_cases_apart() const {
    const auto settings = parallel::transform(
        context_, {.name = "settings of pairs", .n = pairs_.size(), .grain = kBlock},
        [&](std::size_t i) {
          const PartRef &a = list_.parts[pairs_[i].first], &b = list_.parts[pairs_[i].second];
          return CaseSettings{static_cast<std::uint32_t>(rules_.tolerances(a.object, b.object)),
                              std::max(band(a), band(b))};
        });
    if (!settings) return settings.error();
    return find_cases(pairs_, list_, *settings, context_);
  }

  /// The first pair that is the case.
  [[nodiscard]] const IndexPair& pair_of(std::size_t number) const {
    return pairs_[cases_.first[number]];
  }

  Status narrow_phase() {
    if (const Status s = settle_simple_pairs(); !s) return s;
    if (const Status s = part_distant_pairs(); !s) return s;
    if (const Status s = first_look(); !s) return s;
    if (const Status s = depths(); !s) return s;
    return distances();
  }

  /// The baseline: every case by halving its common box.
  Status test_spheres() {
    candidates_.resize(cases_.first.size());
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      const PartRef &a = list_.parts[pair_of(i).first], &b = list_.parts[pair_of(i).second];
      candidates_[i].too_large = !geometry::fits_pair(a.placed, b.placed);
      if (!candidates_[i].too_large) open_.push_back(i);
    }
    if (const Status s = plant_trees(); !s) return s;
    return over(open_, "sphere subdivision", 1, [&](std::size_t i, const IndexPair& p) {
      const PartRef &a = list_.parts[p.first], &b = list_.parts[p.second];
      Candidate& c = candidates_[i];
      c.look.answer = judge_spheres(treed_part(a), treed_part(b), narrow_options(a, b),
                                    options_.most_spheres, c.work);
    });
  }

  /// Closed forms, and contacts in coordinate planes, which are most of them, need no trees.
  Status settle_simple_pairs() {
    candidates_.resize(cases_.first.size());
    return parallel::for_each(
        context_, {.name = "simple pairs", .n = candidates_.size(), .grain = kGrain},
        [&](std::size_t i) {
          const PartRef &a = list_.parts[pair_of(i).first], &b = list_.parts[pair_of(i).second];
          Candidate& c = candidates_[i];
          c.too_large = !geometry::fits_pair(a.placed, b.placed);
          if (c.too_large) return;
          const NarrowPart x = bare_part(a), y = bare_part(b);
          const NarrowOptions options = narrow_options(a, b);
          auto answer = judge_analytic(x, y, options);
          if (!answer) answer = judge_flush(x, y, options, c.separated);
          c.done = answer.has_value();
          if (c.done) c.look.answer = *answer;
        });
  }

  /// Boxes along the coordinate axes of what stands askew meet far more often than the bodies do.
  Status part_distant_pairs() {
    std::vector<std::size_t> unsettled;
    for (std::size_t i = 0; i < candidates_.size(); ++i)
      if (!candidates_[i].done && !candidates_[i].too_large) unsettled.push_back(i);
    auto frames = build_for<geometry::PartFrame>(unsettled, "part frames", [&](std::uint32_t u) {
      return geometry::make_frame(*list_.unique[u]);
    });
    if (!frames) return frames.error();
    frames_ = std::move(*frames);
    const Status status =
        over(unsettled, "parting planes", kGrain, [&](std::size_t i, const IndexPair& p) {
          const PartRef &a = list_.parts[p.first], &b = list_.parts[p.second];
          const NarrowOptions options = narrow_options(a, b);
          Candidate& c = candidates_[i];
          c.look.gap = gap_between(framed_part(a), framed_part(b), options);
          c.done = c.look.gap >= parting_gap(*a.placed.part, *b.placed.part, options);
        });
    if (!status) return status;
    for (const std::size_t i : unsettled)
      if (!candidates_[i].done) open_.push_back(i);
    return {};
  }

  Status plant_trees() {
    auto trees = build_for<geometry::PartTree>(
        open_, "part trees", [&](std::uint32_t u) { return geometry::PartTree(*list_.unique[u]); });
    if (!trees) return trees.error();
    trees_ = std::move(*trees);
    return {};
  }

  Status first_look() {
    if (const Status s = plant_trees(); !s) return s;
    return over(open_, "narrow phase", kGrain, [&](std::size_t i, const IndexPair& p) {
      Candidate& c = candidates_[i];
      const PartRef &a = list_.parts[p.first], &b = list_.parts[p.second];
      c.look = look_at(treed_part(a), treed_part(b), narrow_options(a, b), c.look.gap, c.separated,
                       c.work);
    });
  }

  /// Something built once for each of the unique parts of some cases, in parallel, then only read.
  template <class T, class Make>
  Result<std::vector<T>> build_for(const std::vector<std::size_t>& some, std::string_view name,
                                   Make&& make) const {
    std::vector<bool> wanted(list_.unique.size(), false);
    for (const std::size_t i : some)
      for (const std::uint32_t p : {pair_of(i).first, pair_of(i).second})
        wanted[list_.parts[p].unique] = true;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t u = 0; u < list_.unique.size(); ++u)
      if (wanted[u]) indices.push_back(u);
    const auto order = parallel::longest_first(
        indices.size(), [&](std::size_t i) { return list_.unique[indices[i]]->triangles.size(); });
    std::vector<T> all(list_.unique.size());
    const Status status =
        parallel::for_each(context_, {.name = name, .n = indices.size(), .order = order},
                           [&](std::size_t i) { all[indices[i]] = make(indices[i]); });
    if (!status) return status.error();
    return all;
  }

  /// Runs over some of the candidates, those with most triangles first.
  template <class Work>
  Status over(const std::vector<std::size_t>& some, std::string_view name, std::size_t grain,
              Work&& work) {
    const auto order =
        parallel::longest_first((some.size() + grain - 1) / grain, [&](std::size_t block) {
          std::size_t cost = 0;
          for (std::size_t i = block * grain; i < std::min(some.size(), (block + 1) * grain); ++i)
            cost += triangles(pair_of(some[i]));
          return cost;
        });
    return parallel::for_each(context_,
                              {.name = name, .n = some.size(), .grain = grain, .order = order},
                              [&](std::size_t i) { work(some[i], pair_of(some[i])); });
  }

  [[nodiscard]] std::size_t triangles(const IndexPair& p) const {
    return list_.parts[p.first].placed.part->triangles.size() +
           list_.parts[p.second].placed.part->triangles.size();
  }

  Status depths() {
    std::vector<std::size_t> deep, asking;
    for (const std::size_t i : open_) {
      if (candidates_[i].look.next == FirstLook::Next::depth) deep.push_back(i);
      if (candidates_[i].look.next != FirstLook::Next::nothing) asking.push_back(i);
    }
    auto planes = build_for<geometry::SupportPlanes>(
        asking, "support planes",
        [&](std::uint32_t u) { return geometry::make_support_planes(*list_.unique[u]); });
    if (!planes) return planes.error();
    planes_ = std::move(*planes);
    return over(deep, "depth", 1, [&](std::size_t i, const IndexPair& p) {
      Candidate& c = candidates_[i];
      const PartRef &a = list_.parts[p.first], &b = list_.parts[p.second];
      c.look.answer =
          judge_depth(planed_part(a), planed_part(b), c.look, narrow_options(a, b), c.work);
    });
  }

  /// How far apart the others are; where two objects meet, only as far as it could matter.
  Status distances() {
    std::vector<double> reach(candidates_.size(), 0);
    for (std::size_t first = 0; first < pairs_.size();) {
      std::size_t end = first + 1;
      while (end < pairs_.size() && same_objects(pairs_[first], pairs_[end])) ++end;
      add_distances(first, end, reach);
      first = end;
    }
    std::vector<std::size_t> apart;
    for (std::size_t i = 0; i < reach.size(); ++i)
      if (reach[i] > 0) apart.push_back(i);
    return over(apart, "distance", kGrain, [&](std::size_t i, const IndexPair& p) {
      Candidate& c = candidates_[i];
      const PartRef &a = list_.parts[p.first], &b = list_.parts[p.second];
      c.look.answer =
          judge_distance(planed_part(a), planed_part(b), narrow_options(a, b), reach[i], c.work);
    });
  }

  [[nodiscard]] const Candidate& candidate_of(std::size_t pair) const {
    return candidates_[cases_.of[pair]];
  }

  /// How far the distances of one pair of objects' parts may show in its answer. Parts that meet
  /// are more severe than parts that are apart, unless the sag of those hides that they meet too.
  void add_distances(std::size_t first, std::size_t end, std::vector<double>& reach) const {
    bool hit = false, meeting = false;
    // Where a rule may allow the worst of them, every other one counts.
    const bool all = rules_.may_allow(list_.parts[pairs_[first].first].object,
                                      list_.parts[pairs_[first].second].object);
    for (std::size_t i = first; i < end && !all; ++i) {
      const PartAnswer& answer = candidate_of(i).look.answer;
      hit = hit || answer.judgement.cls == Class::hit;
      meeting = meeting || (answer.judgement.cls >= Class::contact && answer.separation.d <= 0);
    }
    for (std::size_t i = first; i < end && !hit; ++i) {
      if (candidate_of(i).look.next != FirstLook::Next::distance) continue;
      double far = std::numeric_limits<double>::infinity();
      if (meeting) {
        const PartRef &a = list_.parts[pairs_[i].first], &b = list_.parts[pairs_[i].second];
        const Part &x = *a.placed.part, &y = *b.placed.part;
        far = x.sag + y.sag - thresholds(x, y, narrow_options(a, b)).overlap;
      }
      reach[cases_.of[i]] = std::max(reach[cases_.of[i]], far);
    }
  }

  [[nodiscard]] bool same_objects(const IndexPair& p, const IndexPair& q) const {
    return list_.parts[p.first].object == list_.parts[q.first].object &&
           list_.parts[p.second].object == list_.parts[q.second].object;
  }

  [[nodiscard]] NarrowPart bare_part(const PartRef& p) const {
    return {{p.placed, nullptr}, nullptr, nullptr, &scene_.model->bodies[p.body].placement};
  }

  [[nodiscard]] NarrowPart framed_part(const PartRef& p) const {
    NarrowPart part = bare_part(p);
    if (!frames_.empty()) part.frame = &frames_[p.unique];
    return part;
  }

  [[nodiscard]] NarrowPart treed_part(const PartRef& p) const {
    NarrowPart part = framed_part(p);
    part.treed.tree = &trees_[p.unique];
    return part;
  }

  [[nodiscard]] NarrowPart planed_part(const PartRef& p) const {
    NarrowPart part = treed_part(p);
    part.planes = &planes_[p.unique];
    return part;
  }

  [[nodiscard]] NarrowOptions narrow_options(const PartRef& a, const PartRef& b) const {
    NarrowOptions options = narrow_[rules_.tolerances(a.object, b.object)];
    options.contact_distance = std::max(band(a), band(b));
    return options;
  }

  [[nodiscard]] double band(const PartRef& p) const {
    return bands_[scene_.model->objects[p.object].file];
  }

  /// The answers that can show in a report; counts the work and what was skipped.
  std::vector<Found> answers(Report& report) const {
    std::vector<Found> found;
    for (const Candidate& c : candidates_) count(c.work, report.counters);
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const Candidate& c = candidate_of(i);
      if (c.too_large)
        report_too_large(pairs_[i], report.diagnostics);
      else if (c.look.answer.judgement.severest != Class::no_hit)
        found.push_back({i, &c.look.answer});
    }
    return found;
  }

  Status finish(Report& report) const {
    rules_.close(report);
    auto hash = hash_of(report, *scene_.model, context_);
    if (!hash) return hash.error();
    report.hash = std::move(*hash);
    report.counters.part_pairs = pairs_.size();
    count_objects(report);
    note_unknown_sag(report.diagnostics);
    if (options_.log_pairs) log(report);
    return {};
  }

  void log(Report& report) const {
    PairLog log(list_);
    for (std::size_t i = 0; i < pairs_.size(); ++i)
      log.add(pairs_[i], candidate_of(i).work, cases_.first[cases_.of[i]] != i);
    for (LoggedPair& pair : log.pairs())
      pair.may_be_allowed = rules_.may_allow(index(pair.a), index(pair.b));
    log.close(report);
  }

  static void count(const NarrowWork& work, Counters& counters) {
    counters.triangle_pairs += work.pair.triangle_pairs;
    counters.exact_fallbacks += work.pair.exact_fallbacks;
    counters.depth_cells += work.depth_cells;
  }

  void count_objects(Report& report) const {
    const IndexPair* last = nullptr;
    for (const IndexPair& p : pairs_) {
      if (last == nullptr || !same_objects(*last, p)) {
        ++report.counters.candidate_pairs;
        rules_.count_candidate(list_.parts[p.first].object, list_.parts[p.second].object, report);
      }
      last = &p;
    }
    report.objects_a =
        static_cast<std::uint64_t>(std::count(sets_.in_a.begin(), sets_.in_a.end(), true));
    report.objects_b =
        static_cast<std::uint64_t>(std::count(sets_.in_b.begin(), sets_.in_b.end(), true));
    for (const double b : bands_)
      report.contact_distance_mm = std::max(report.contact_distance_mm, b / geometry::kGridPerMm);
    if (report.objects_a == 0 || report.objects_b == 0)
      report.diagnostics.add(
          Severity::warning, "empty-set", "a set without objects clashes with nothing",
          report.objects_a == 0 ? "set A, " + sets_.name_a : "set B, " + sets_.name_b);
  }

  void report_too_large(const IndexPair& p, Diagnostics& diagnostics) const {
    const model::Model& model = *scene_.model;
    diagnostics.add(Severity::skipped, "pair-too-large",
                    "the pair spans more than a kilometre and was not compared",
                    model.objects[list_.parts[p.first].object].id + " and " +
                        model.objects[list_.parts[p.second].object].id);
  }

  void note_unknown_sag(Diagnostics& diagnostics) const {
    std::vector<bool> unknown(scene_.model->files.size(), false);
    for (const PartRef& p : list_.parts)
      if (p.placed.part->flags.unknown_sag) unknown[scene_.model->objects[p.object].file] = true;
    for (std::size_t f = 0; f < unknown.size(); ++f)
      if (unknown[f])
        diagnostics.add(Severity::note, "unknown-sag",
                        "meshes are taken as the true surfaces: how far they lie from them is "
                        "not known",
                        scene_.model->files[f].label);
  }

  const model::Scene& scene_;
  const Sets& sets_;
  const Options& options_;
  const parallel::Context& context_;
  PairRules rules_;
  PartList list_;
  std::vector<NarrowOptions> narrow_;  ///< by number of tolerances
  std::vector<double> bands_;          ///< contact distance per file
  std::vector<IndexPair> pairs_;
  Cases cases_;
  std::vector<geometry::PartFrame> frames_;      ///< by unique part, as far as wanted
  std::vector<geometry::PartTree> trees_;        ///< likewise
  std::vector<geometry::SupportPlanes> planes_;  ///< likewise
  std::vector<Candidate> candidates_;            ///< one per case
  std::vector<std::size_t> open_;                ///< cases that want trees
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
