// SPDX-License-Identifier: Apache-2.0
#include "clash/incremental/report_merge.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "clash/detect.hpp"
#include "clash/incremental/partners.hpp"
#include "clash/incremental/renamed.hpp"
#include "clash/incremental/splice.hpp"
#include "clash/results/reported.hpp"
#include "clash/results/result_counts.hpp"
#include "clash/results/result_hash.hpp"
#include "clash/rules/options.hpp"
#include "clash/rules/rule_matcher.hpp"
#include "clash/rules/shadowed_rules.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::clash {
namespace {

constexpr auto kNothing = [](const auto&) {};

/// Returns what a count is now: that before, less what is gone, and what came.
std::uint64_t updated(std::uint64_t before, std::uint64_t gone, std::uint64_t came) {
  return before - gone + came;
}

/// The report of an earlier run, turned into that of this one list by list; `now_` begins as the
/// report about the pairs of changed objects.
class ReportMerge {
 public:
  ReportMerge(Report earlier, Report fresh, const MergeInputs& inputs,
              const parallel::Context& context, PairChanges* changes)
      : was_(std::move(earlier)),
        now_(std::move(fresh)),
        inputs_(inputs),
        context_(context),
        changes_(changes),
        gone_(now_.allowed.size(), now_.cells.size()) {}

  Result<Report> run() {
    now_.name = std::move(was_.name);
    if (const Status s = take_names(); !s) return s.error();
    if (const Status s = merge_contacts(); !s) return s.error();
    if (const Status s = merge_pairs(); !s) return s.error();
    update_counts();
    if (const Status s = merge_exempted(); !s) return s.error();
    if (const Status s = merge_allowances(); !s) return s.error();
    if (const Status s = merge_unreported(); !s) return s.error();
    update_hash();
    merge_objects();
    if (const Status s = merge_not_compared(); !s) return s.error();
    return std::move(now_);
  }

 private:
  /// Brings a list up to date and leaves it in the new report.
  template <class T, class Gone>
  Status take(std::vector<T>& was, std::vector<T>& now, const Gone& gone) const {
    const auto places = splice_changes(was, now, inputs_.map, context_, gone);
    if (!places) return places.error();
    now = std::move(was);
    return {};
  }

  /// Hashes the pairs that stay under the names of today; hashes of unlisted ones stay.
  Status take_names() {
    if (inputs_.same_names && !inputs_.map.renumbered) return {};
    const auto change = rehash_renamed(was_, inputs_.names, inputs_.map, context_);
    if (!change) return change.error();
    hash_gone_ = change->gone;
    now_.kept->hash_sum = sum(now_.kept->hash_sum, change->came);
    return {};
  }

  void count_gone(const Pair& pair) { gone_.add(pair, cell_number(was_, pair.a, pair.b)); }

  Status merge_contacts() {
    UnlistedContacts gone;
    const Status done =
        take(was_.kept->unlisted, now_.kept->unlisted, [&](const UnlistedContact& c) {
          Pair pair;
          pair.a = c.a;
          pair.b = c.b;
          pair.cls = Class::contact;
          pair.allowed = c.allowed;
          count_gone(pair);
          ++(c.allowed < 0 ? gone.contacts : gone.allowed);
          hash_gone_ = sum(hash_gone_, c.hash);
        });
    if (!done) return done;
    now_.unlisted.contacts = updated(was_.unlisted.contacts, gone.contacts, now_.unlisted.contacts);
    now_.unlisted.allowed = updated(was_.unlisted.allowed, gone.allowed, now_.unlisted.allowed);
    return take(was_.kept->allowed_contacts, now_.kept->allowed_contacts, kNothing);
  }

  Status merge_pairs() {
    const std::vector<std::uint64_t>& elements = was_.kept->elements;
    const std::optional<std::vector<bool>> blocks =
        inputs_.partners == nullptr
            ? std::nullopt
            : std::optional(blocks_of_changes(*inputs_.partners, inputs_.map));
    bool listed = !now_.regions.empty();
    // The new regions lie behind the others until all are put in order.
    const auto behind = static_cast<std::uint32_t>(was_.regions.size());
    for (Pair& pair : now_.pairs)
      if (listed_regions(pair, now_.options) > 0) pair.first_region += behind;
    const auto places = splice_changes(
        was_.pairs, now_.pairs, inputs_.map, context_,
        [&](const Pair& pair) {
          count_gone(pair);
          if (changes_ != nullptr) {
            changes_->gone.push_back(pair);
            changes_->gone_from.push_back(static_cast<std::size_t>(&pair - was_.pairs.data()));
          }
          hash_gone_ = sum(hash_gone_,
                           hash_of(pair, was_, elements[index(pair.a)], elements[index(pair.b)]));
          listed = listed || listed_regions(pair, was_.options) > 0;
        },
        blocks ? &*blocks : nullptr);
    if (!places) return places.error();
    now_.pairs = std::move(was_.pairs);
    if (changes_ != nullptr) changes_->put_in = *places;
    was_.regions.insert(was_.regions.end(), now_.regions.begin(), now_.regions.end());
    now_.regions = std::move(was_.regions);
    if (listed) put_regions_in_order(now_);
    return {};
  }

  void update_counts() {
    const ClassCounts& gone = gone_.all;
    now_.count_hit = updated(was_.count_hit, gone.hit, now_.count_hit);
    now_.count_contact = updated(was_.count_contact, gone.contact, now_.count_contact);
    now_.count_clearance =
        updated(was_.count_clearance, gone.clearance_violation, now_.count_clearance);
    now_.count_allowed = updated(was_.count_allowed, gone.allowed, now_.count_allowed);
    for (std::size_t r = 0; r < now_.allowed.size(); ++r)
      now_.allowed[r].pairs =
          updated(was_.allowed[r].pairs, gone_.by_rule[r], now_.allowed[r].pairs);
    for (std::size_t c = 0; c < now_.cells.size(); ++c) {
      const ClassCounts& of_cell = gone_.by_cell[c];
      const CellReport& was = was_.cells[c];
      CellReport& now = now_.cells[c];
      now.hit = updated(was.hit, of_cell.hit, now.hit);
      now.contact = updated(was.contact, of_cell.contact, now.contact);
      now.clearance_violation =
          updated(was.clearance_violation, of_cell.clearance_violation, now.clearance_violation);
      now.allowed = updated(was.allowed, of_cell.allowed, now.allowed);
    }
  }

  Status merge_exempted() {
    const bool listed = inputs_.policy.list_exempted;
    std::vector<ExemptedPair>& was = listed ? was_.exempted_pairs : was_.kept->exempted;
    std::vector<ExemptedPair>& now = listed ? now_.exempted_pairs : now_.kept->exempted;
    std::vector<std::uint64_t> gone(now_.exempted.size(), 0);
    if (const Status s = take(was, now, [&](const ExemptedPair& pair) { ++gone[pair.rule]; }); !s)
      return s;
    for (std::size_t r = 0; r < now_.exempted.size(); ++r) {
      now_.exempted[r].pairs = updated(was_.exempted[r].pairs, gone[r], now_.exempted[r].pairs);
      now_.exempted[r].shadowed_by = -1;
    }
    return record_shadowed_exemptions(inputs_.policy, now, context_, now_);
  }

  Status merge_allowances() {
    std::vector<std::uint64_t> concerned(now_.allowed.size(), 0), regions = concerned;
    std::uint64_t all_regions = 0;
    if (const Status s = take(was_.kept->concerned, now_.kept->concerned,
                              [&](const ConcernedPair& pair) { ++concerned[pair.rule]; });
        !s)
      return s;
    if (const Status s = take(was_.kept->allowed_regions, now_.kept->allowed_regions,
                              [&](const AllowedRegionCount& count) {
                                regions[count.rule] += count.regions;
                                all_regions += count.regions;
                              });
        !s)
      return s;
    for (std::size_t r = 0; r < now_.allowed.size(); ++r) {
      const AllowedCount& was = was_.allowed[r];
      AllowedCount& now = now_.allowed[r];
      now.candidates = updated(was.candidates, concerned[r], now.candidates);
      now.regions = updated(was.regions, regions[r], now.regions);
      now.shadowed_by = -1;
    }
    now_.count_allowed_regions =
        updated(was_.count_allowed_regions, all_regions, now_.count_allowed_regions);
    for (const std::vector<Pair>* const pairs : {&now_.pairs, &now_.kept->allowed_contacts})
      if (const Status s = record_shadowed_allowances(inputs_.policy, *pairs, context_, now_); !s)
        return s;
    return {};
  }

  Status merge_unreported() {
    NotReported gone;
    const Status done =
        take(was_.kept->unreported, now_.kept->unreported, [&](const UnreportedPair& pair) {
          ++count_of(pair.by_volume ? gone.by_volume : gone.by_relation, pair.cls, pair.allowed);
        });
    if (!done) return done;
    const auto update = [](const NotReported::Counts& was, const NotReported::Counts& less,
                           NotReported::Counts& now) {
      now.hit = updated(was.hit, less.hit, now.hit);
      now.contact = updated(was.contact, less.contact, now.contact);
      now.clearance_violation =
          updated(was.clearance_violation, less.clearance_violation, now.clearance_violation);
      now.allowed = updated(was.allowed, less.allowed, now.allowed);
    };
    update(was_.not_reported.by_relation, gone.by_relation, now_.not_reported.by_relation);
    update(was_.not_reported.by_volume, gone.by_volume, now_.not_reported.by_volume);
    return {};
  }

  void update_hash() {
    KeptForChanges& kept = *now_.kept;
    kept.hash_sum = sum(difference(was_.kept->hash_sum, hash_gone_), kept.hash_sum);
    now_.hash = result_hash(kept.hash_sum, now_.pairs.size() + kept.unlisted.size());
    kept.box_pairs += was_.kept->box_pairs;
  }

  /// Takes what is said of single objects, of those that did not change from before.
  void merge_objects() {
    for (std::size_t o = 0; o < inputs_.map.before.size(); ++o) {
      const std::uint32_t before = inputs_.map.before[o];
      if (before == model::kNoObject) continue;
      now_.sheets[o] = was_.sheets[before];
    }
    if (inputs_.same_names)
      now_.kept->elements = std::move(was_.kept->elements);
    else
      now_.kept->elements.assign(inputs_.names.begin(), inputs_.names.end());
    const double widest =
        std::max(contact_distance(inputs_.options, 0),
                 contact_distance(inputs_.options, inputs_.neighbours.widest_precision_um));
    now_.contact_distance_mm = widest / geometry::kGridPerMm;
  }

  Status merge_not_compared() {
    std::vector<NotComparedPair> was = pairs_of(was_.not_compared);
    std::vector<NotComparedPair> now = pairs_of(now_.not_compared);
    if (const Status s = take(was, now, kNothing); !s) return s;
    std::erase_if(now_.not_compared, [](const NotCompared& n) { return n.b.has_value(); });
    for (const NotComparedPair& pair : now)
      now_.not_compared.push_back({pair.a, pair.b, pair.code});
    now_.diagnostics = {};
    report_not_compared(inputs_.model, now_);
    describe_sets(now_);
    report_unknown_sag(inputs_.neighbours.unknown_sag, inputs_.model, now_.diagnostics);
    return {};
  }

  struct NotComparedPair {
    model::ObjectId a{}, b{};
    std::string_view code;
  };
  static std::vector<NotComparedPair> pairs_of(const std::vector<NotCompared>& all) {
    std::vector<NotComparedPair> pairs;
    for (const NotCompared& n : all)
      if (n.b) pairs.push_back({n.a, *n.b, n.code});
    return pairs;
  }

  Report was_, now_;
  const MergeInputs& inputs_;
  const parallel::Context& context_;
  PairChanges* changes_;
  ClassTotals gone_;  ///< the pairs of changed objects before
  Hash128 hash_gone_;
};

}  // namespace

bool fits(const Report& earlier, const Report& fresh, std::size_t objects) {
  return earlier.kept && earlier.kept->elements.size() == objects &&
         earlier.sheets.size() == objects &&
         (earlier.discipline.empty() || earlier.discipline.size() == objects) &&
         earlier.discipline.empty() == fresh.discipline.empty() &&
         earlier.cells.size() == fresh.cells.size() &&
         earlier.disciplines.size() == fresh.disciplines.size() &&
         earlier.exempted.size() == fresh.exempted.size() &&
         earlier.allowed.size() == fresh.allowed.size();
}

Result<Report> merge(Report earlier, Report fresh, const MergeInputs& inputs,
                     const parallel::Context& context, PairChanges* changes) {
  return ReportMerge(std::move(earlier), std::move(fresh), inputs, context, changes).run();
}

}  // namespace strake::clash
