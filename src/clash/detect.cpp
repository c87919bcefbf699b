// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clash/candidate.hpp"
#include "clash/cases.hpp"
#include "clash/curves.hpp"
#include "clash/narrow.hpp"
#include "clash/object_pairs.hpp"
#include "clash/options.hpp"
#include "clash/pair_log.hpp"
#include "clash/pair_rules.hpp"
#include "clash/parts.hpp"
#include "clash/places.hpp"
#include "clash/reduce.hpp"
#include "clash/regions.hpp"
#include "clash/spheres.hpp"
#include "clash/tally.hpp"
#include "clash/telling.hpp"
#include "clash/volumes.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/geometry/meeting_places.hpp"
#include "strake/parallel/collect.hpp"
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

class Engine {
 public:
  Engine(const model::Scene& scene, const Sets& sets, const Options& options, const Policy& policy,
         const parallel::Context& context)
      : scene_(scene),
        sets_(sets),
        options_(options),
        context_(context),
        rules_(policy, options, *scene.model) {
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
    // The baseline has no triangles to tell places by.
    if (options_.narrow_phase != NarrowPhase::exact) report.options.most_regions = 0;
    report.in_a = sets_.in_a;
    report.in_b = sets_.in_b;
    report.within_files = sets_.group.empty();
    rules_.open(sets_, report);
    auto parts = list_parts(scene_, sets_, options_.curves, context_);
    if (!parts) return parts.error();
    list_ = std::move(*parts);
    auto pairs = near_pairs(list_, sets_, search_reach(rules_.reach_mm() * geometry::kGridPerMm),
                            options_, context_);
    if (!pairs) return pairs.error();
    pairs_ = std::move(*pairs);
    if (const Status s = rules_.exempt(list_, pairs_, context_, report); !s) return s.error();
    auto cases = tell_cases_apart();
    if (!cases) return cases.error();
    cases_ = std::move(*cases);
    auto objects = ObjectPairs::find(pairs_, list_, context_);
    if (!objects) return objects.error();
    objects_ = std::move(*objects);
    candidates_.resize(cases_.first.size());
    const bool exact = options_.narrow_phase == NarrowPhase::exact;
    if (const Status s = exact ? narrow_phase() : test_spheres(); !s) return s.error();
    if (exact)
      if (const Status s = places(); !s) return s.error();
    const auto found = answers(report);
    if (!found) return found.error();
    const PartFindings findings{*found, pairs_, list_, rules_};
    auto joined = join_by_objects(findings, context_);
    if (!joined) return joined.error();
    report.pairs = std::move(*joined);
    if (report.options.most_regions > 0)
      if (const Status s = list_regions(findings, context_, report); !s) return s.error();
    if (options_.volumes == Volumes::on)
      if (const Status s = measure_volumes({list_, pairs_, *found, trees_}, context_, report); !s)
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
    return parallel::for_each(
        context_, {.name = "simple pairs", .n = candidates_.size(), .grain = kGrain},
        [&](std::size_t i) {
          const PartRef &a = list_.parts[pair_of(i).first], &b = list_.parts[pair_of(i).second];
          Candidate& c = candidates_[i];
          c.too_large = !geometry::fits_pair(a.placed, b.placed);
          if (c.too_large) return;
          if (has_wire(*a.placed.part, *b.placed.part)) return;
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
    const auto unsettled =
        some_of("unsettled pairs", [](const Candidate& c) { return !c.done && !c.too_large; });
    if (!unsettled) return unsettled.error();
    auto frames = build_for<geometry::PartFrame>(*unsettled, "part frames", [&](std::uint32_t u) {
      return geometry::make_frame(*list_.unique[u]);
    });
    if (!frames) return frames.error();
    frames_ = std::move(*frames);
    const Status status =
        over(*unsettled, "parting planes", kGrain, [&](std::size_t i, const IndexPair& p) {
          const PartRef &a = list_.parts[p.first], &b = list_.parts[p.second];
          const NarrowOptions options = narrow_options(a, b);
          Candidate& c = candidates_[i];
          c.look.gap = gap_between(framed_part(a), framed_part(b), options);
          c.done = c.look.gap >= parting_gap(*a.placed.part, *b.placed.part, options);
        });
    if (!status) return status;
    auto open = some_of("open pairs", [](const Candidate& c) { return !c.done && !c.too_large; });
    if (!open) return open.error();
    open_ = std::move(*open);
    return {};
  }

  /// The candidates that pass a test, ascending.
  template <class Test>
  Result<std::vector<std::size_t>> some_of(std::string_view name, Test&& test) const {
    return parallel::collect<std::size_t>(context_,
                                          {.name = name, .n = candidates_.size(), .grain = kBlock},
                                          [&](std::size_t i, std::vector<std::size_t>& out) {
                                            if (test(candidates_[i])) out.push_back(i);
                                          });
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
      const NarrowPart x = treed_part(a), y = treed_part(b);
      const NarrowOptions options = narrow_options(a, b);
      if (has_wire(*a.placed.part, *b.placed.part))
        c.look.answer = judge_wire(x, y, options, c.work);
      else
        c.look = look_at(x, y, options, c.look.gap, c.separated, c.work);
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

  /// A case whose distance may show in the answer of a pair of objects, as far as `far`.
  struct Wanted {
    std::uint32_t number = 0;
    double far = 0;
  };

  /// How far apart the others are; where two objects meet, only as far as it could matter.
  Status distances() {
    const auto wanted = parallel::collect<Wanted>(
        context_, {.name = "distances wanted", .n = objects_.size(), .grain = kBlock},
        [&](std::size_t k, std::vector<Wanted>& out) { want_distances(k, out); });
    if (!wanted) return wanted.error();
    std::vector<double> reach(candidates_.size(), 0);
    for (const Wanted& w : *wanted) reach[w.number] = std::max(reach[w.number], w.far);
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

  [[nodiscard]] Judged judged() const { return {list_, pairs_, cases_, candidates_}; }

  /// Tells the places of pairs of parts apart where that shows.
  Status places() {
    const auto telling = how_to_tell(judged(), objects_, rules_, options_, context_);
    if (!telling) return telling.error();
    std::vector<std::size_t> alone, asking;
    for (std::size_t i = 0; i < telling->size(); ++i) {
      if ((*telling)[i] == Telling::if_several) alone.push_back(i);
      if ((*telling)[i] == Telling::each) asking.push_back(i);
    }
    places_.resize(candidates_.size());
    if (const auto taken = take_simple(alone); !taken) return taken.error();
    const auto simple = take_simple(asking);
    if (!simple) return simple.error();
    if (const Status s = measure_simple(*simple); !s) return s;
    asking.insert(asking.end(), alone.begin(), alone.end());
    if (const Status s = plant_missing_trees(asking); !s) return s;
    return over(asking, "places", 1, [&](std::size_t i, const IndexPair& p) {
      Candidate& c = candidates_[i];
      const PartRef &a = list_.parts[p.first], &b = list_.parts[p.second];
      auto found = places_of(treed_part(a), treed_part(b), c.look.answer, narrow_options(a, b),
                             (*telling)[i] == Telling::each, c.work);
      c.too_near_to_tell = !found;
      if (found) places_[i] = std::move(*found);
    });
  }

  /// Dents that a place cannot be told by: the touch gap bridges them.
  [[nodiscard]] double convex_slack() const {
    double gap = std::numeric_limits<double>::infinity();
    for (const NarrowOptions& n : narrow_) gap = std::min(gap, n.touch_gap);
    return std::max(1.0, gap / 4);
  }

  /// Takes those cases out that certainly have one place: where one flat face of each meets, and of
  /// two convex parts.
  Result<std::vector<std::size_t>> take_simple(std::vector<std::size_t>& some) const {
    const auto flat = parallel::transform(
        context_, {.name = "flat places", .n = some.size(), .grain = kGrain}, [&](std::size_t i) {
          const IndexPair& p = pair_of(some[i]);
          return static_cast<std::uint8_t>(in_flat_place(
              candidates_[some[i]].look.answer, list_.parts[p.first], list_.parts[p.second]));
        });
    if (!flat) return flat.error();
    std::vector<std::size_t> taken, others;
    for (std::size_t i = 0; i < some.size(); ++i)
      ((*flat)[i] != 0 ? taken : others).push_back(some[i]);
    const auto convex = build_for<std::uint8_t>(others, "convex parts", [&](std::uint32_t u) {
      return static_cast<std::uint8_t>(geometry::nearly_convex(*list_.unique[u], convex_slack()));
    });
    if (!convex) return convex.error();
    some.clear();
    for (const std::size_t i : others) {
      const IndexPair& p = pair_of(i);
      const bool both = (*convex)[list_.parts[p.first].unique] != 0 &&
                        (*convex)[list_.parts[p.second].unique] != 0;
      (both ? taken : some).push_back(i);
    }
    return taken;
  }

  /// The boxes of cases that have one place.
  Status measure_simple(const std::vector<std::size_t>& some) {
    const auto frames = build_for<geometry::PartFrame>(
        some, "frames of places",
        [&](std::uint32_t u) { return geometry::make_frame(*list_.unique[u]); });
    if (!frames) return frames.error();
    return over(some, "simple places", kGrain, [&](std::size_t i, const IndexPair& p) {
      const PartRef &a = list_.parts[p.first], &b = list_.parts[p.second];
      const PartAnswer& answer = candidates_[i].look.answer;
      const double reach = place_reach(bare_part(a), bare_part(b), answer, narrow_options(a, b));
      places_[i] = {{answer, geometry::common_extent({a.placed, &(*frames)[a.unique]},
                                                     {b.placed, &(*frames)[b.unique]}, reach)}};
    });
  }

  [[nodiscard]] bool in_flat_place(const PartAnswer& answer, const PartRef& a,
                                   const PartRef& b) const {
    if (answer.separation.interiors_meet || answer.judgement.cls != Class::contact) return false;
    const NarrowPart x = framed_part(a), y = framed_part(b);
    return geometry::in_one_flat_place({x.treed.placed, x.frame}, {y.treed.placed, y.frame},
                                       place_reach(x, y, answer, narrow_options(a, b)));
  }

  /// Pairs that were settled without trees have none yet.
  Status plant_missing_trees(const std::vector<std::size_t>& some) {
    std::vector<std::size_t> bare;
    const auto planted = [&](std::uint32_t part) {
      const std::uint32_t unique = list_.parts[part].unique;
      return unique < trees_.size() && !trees_[unique].nodes().empty();
    };
    for (const std::size_t i : some)
      if ((!planted(pair_of(i).first) || !planted(pair_of(i).second)) && wants_trees(i))
        bare.push_back(i);
    auto trees = build_for<geometry::PartTree>(
        bare, "part trees", [&](std::uint32_t u) { return geometry::PartTree(*list_.unique[u]); });
    if (!trees) return trees.error();
    trees_.resize(list_.unique.size());
    for (std::size_t u = 0; u < trees_.size(); ++u)
      if (trees_[u].nodes().empty()) trees_[u] = std::move((*trees)[u]);
    return {};
  }

  /// Small parts that only touch are walked faster than a tree is built.
  [[nodiscard]] bool wants_trees(std::size_t number) const {
    constexpr std::size_t kMostWalked = 512;
    return candidates_[number].look.answer.separation.interiors_meet ||
           triangles(pair_of(number)) > kMostWalked;
  }

  /// How far the distances of one pair of objects' parts may show in its answer. Parts that meet
  /// are more severe than parts that are apart, unless the sag of those hides that they meet too.
  void want_distances(std::size_t objects, std::vector<Wanted>& wanted) const {
    const std::size_t first = objects_.begin(objects), end = objects_.end(objects);
    const Judged judged = this->judged();
    bool hit = false, meeting = false;
    // Where a rule may allow the worst of them, every other one counts.
    const bool all = rules_.may_allow(judged.a(first).object, judged.b(first).object);
    for (std::size_t i = first; i < end && !all; ++i) {
      const PartAnswer& answer = judged.of(i).look.answer;
      hit = hit || answer.judgement.cls == Class::hit;
      meeting = meeting || (answer.judgement.cls >= Class::contact && answer.separation.d <= 0);
    }
    const bool regions = options_.most_regions > 0;
    for (std::size_t i = first; i < end && (!hit || regions); ++i) {
      if (judged.of(i).look.next != FirstLook::Next::distance) continue;
      double far = std::numeric_limits<double>::infinity();
      if (hit || meeting) {
        const PartRef &a = judged.a(i), &b = judged.b(i);
        const Part &x = *a.placed.part, &y = *b.placed.part;
        const Thresholds limits = thresholds(x, y, narrow_options(a, b));
        far = x.sag + y.sag - limits.overlap;
        // Contacts elsewhere are regions of their own.
        if (regions) far = std::max(far, x.sag + y.sag + limits.gap + 1);
      }
      wanted.push_back({cases_.of[i], far});
    }
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

  /// The answers that can show in a report; tells of the pairs that were skipped.
  Result<std::vector<Found>> answers(Report& report) const {
    const Judged all = judged();
    if (const Status s = note_too_large(all, *scene_.model, context_, report.diagnostics); !s)
      return s.error();
    return parallel::collect<Found>(
        context_, {.name = "answers", .n = pairs_.size(), .grain = kBlock},
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
    for (const PartPlace& place : places_[number])
      found.push_back({pair, &place.answer, &place.extent, false});
  }

  Status finish(Report& report) const {
    if (const Status s = rules_.close(context_, report); !s) return s.error();
    auto hash = hash_of(report, *scene_.model, context_);
    if (!hash) return hash.error();
    report.hash = std::move(*hash);
    if (const Status s = tally(judged(), objects_, rules_, context_, report); !s) return s.error();
    describe_sets(report);
    if (const Status s = note_unknown_sag(list_, *scene_.model, context_, report.diagnostics); !s)
      return s.error();
    return options_.log_pairs ? log_pairs(judged(), objects_, rules_, context_, report) : Status{};
  }

  void describe_sets(Report& report) const {
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
  ObjectPairs objects_;
  std::vector<geometry::PartFrame> frames_;      ///< by unique part, as far as wanted
  std::vector<geometry::PartTree> trees_;        ///< likewise
  std::vector<geometry::SupportPlanes> planes_;  ///< likewise
  std::vector<Candidate> candidates_;            ///< one per case
  std::vector<std::size_t> open_;                ///< cases that want trees
  std::vector<std::vector<PartPlace>> places_;   ///< by case, where told apart
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
