// SPDX-License-Identifier: Apache-2.0
#include "clash/results/reported.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "clash/results/result_hash.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::clash {
namespace {

// Only shares the work out: between 1024 and 16'384 no difference can be seen (decision 0073).
constexpr std::size_t kPairsAtOnce = 4096;

/// Whether a result is reported, and what decides it.
enum class ReportDecision : std::uint8_t {
  reported,
  volume_open,  ///< reported, though it may have less in common than requested
  by_relation,  ///< not reported
  by_volume,    ///< not reported
};

class Reported {
 public:
  Reported(const PartResults& results, const Sets& sets, const Reporting& reporting)
      : results_(results), sets_(sets), reporting_(reporting) {}

  [[nodiscard]] ReportDecision of(const Pair& pair) const {
    if (!has_relation(pair)) return ReportDecision::by_relation;
    const CommonVolume* const common = results_.found[pair.first_region].common;
    if (!(reporting_.min_volume_mm3 > 0) || common == nullptr) return ReportDecision::reported;
    if (pair.cls != Class::hit)
      return ReportDecision::reported;  // an allowed hit goes by its volume as well
    if (common->is_less_than(reporting_.min_volume_mm3)) return ReportDecision::by_volume;
    return common->may_be_less_than(reporting_.min_volume_mm3) ? ReportDecision::volume_open
                                                               : ReportDecision::reported;
  }

 private:
  /// Whether the two objects, or any two parts of them, stand in a relation that is reported; what
  /// they turn out to be where that is not certain, they may.
  [[nodiscard]] bool has_relation(const Pair& pair) const {
    if (reporting_.relations.empty() || (pair.flags & kUncertain) != 0) return true;
    const std::uint32_t a = index(pair.a), b = index(pair.b);
    const bool forward = sets_.in_a[a] && sets_.in_b[b], backward = sets_.in_a[b] && sets_.in_b[a];
    if (reporting_.relations.contains(pair.relation, forward, backward)) return true;
    const std::size_t first = pair.first_region;
    for (std::size_t i = first; i < results_.found.size() && results_.same_objects(first, i); ++i) {
      // Regions other than the parts' worst say nothing of how the parts stand.
      if (!results_.found[i].decides) continue;
      const PartPairResult& answer = *results_.found[i].answer;
      if (answer.classification.cls != Class::no_hit &&
          reporting_.relations.contains(answer.relation, forward, backward))
        return true;
    }
    return false;
  }

  const PartResults& results_;
  const Sets& sets_;
  const Reporting& reporting_;
};

/// Parts side by side: the same sheet twice, or one within the other, is a contact that is seldom
/// meant.
bool is_side_by_side(Relation relation) {
  return relation == Relation::abut_outside || relation == Relation::separate;
}

bool is_left_out(const Pair& pair) {
  return is_side_by_side(pair.relation) && pair.cls == Class::contact &&
         pair.severest <= Class::contact && (pair.flags & kUncertain) == 0 &&
         pair.allowed_regions == 0;
}

/// Keeps of the contacts that are not listed what detect_changes() needs.
template <class IsUnlisted>
Status keep_unlisted(const parallel::Context& context, const IsUnlisted& is_unlisted,
                     Report& report) {
  const std::vector<std::uint64_t>& elements = report.kept->elements;
  auto contacts = parallel::collect<UnlistedContact>(
      context, {.name = "contacts kept", .n = report.pairs.size(), .grain = kPairsAtOnce},
      [&](std::size_t i, std::vector<UnlistedContact>& out) {
        const Pair& pair = report.pairs[i];
        if (is_unlisted(pair))
          out.push_back({pair.a, pair.b, pair.allowed,
                         hash_of(pair, report, elements[index(pair.a)], elements[index(pair.b)])});
      });
  if (!contacts) return contacts.error();
  report.kept->unlisted = std::move(*contacts);
  for (const Pair& pair : report.pairs)
    if (is_unlisted(pair) && pair.allowed >= 0) report.kept->allowed_contacts.push_back(pair);
  return {};
}

}  // namespace

std::uint64_t& count_of(NotReported::Counts& counts, Class cls, bool allowed) {
  if (allowed) return counts.allowed;
  if (cls == Class::hit) return counts.hit;
  return cls == Class::contact ? counts.contact : counts.clearance_violation;
}

Status filter_reported(const PartResults& results, const Sets& sets,
                       const parallel::Context& context, Report& report) {
  if (!report.options.reporting.leaves_out()) return {};
  const Reported reported(results, sets, report.options.reporting);
  const auto fates = parallel::transform(
      context, {.name = "what is reported", .n = report.pairs.size(), .grain = kPairsAtOnce},
      [&](std::size_t i) { return reported.of(report.pairs[i]); });
  if (!fates) return fates.error();
  std::vector<Pair> kept;
  for (std::size_t i = 0; i < fates->size(); ++i) {
    Pair& pair = report.pairs[i];
    const ReportDecision fate = (*fates)[i];
    if (report.kept && (fate == ReportDecision::by_relation || fate == ReportDecision::by_volume))
      report.kept->unreported.push_back(
          {pair.a, pair.b, pair.cls, pair.allowed >= 0, fate == ReportDecision::by_volume});
    if (fate == ReportDecision::by_relation) {
      ++count_of(report.not_reported.by_relation, pair.cls, pair.allowed >= 0);
    } else if (fate == ReportDecision::by_volume) {
      ++count_of(report.not_reported.by_volume, pair.cls, pair.allowed >= 0);
    } else {
      if (fate == ReportDecision::volume_open) pair.flags |= kUncertain;
      kept.push_back(pair);
    }
  }
  report.pairs = std::move(kept);
  return {};
}

std::uint32_t listed_regions(const Pair& pair, const Options& options) {
  return pair.regions_listed(options) + pair.allowed_regions_listed(options);
}

void put_regions_in_order(Report& report) {
  std::vector<Region> ordered;
  ordered.reserve(report.regions.size());
  for (Pair& pair : report.pairs) {
    const std::uint32_t listed = listed_regions(pair, report.options);
    if (listed == 0) continue;
    const auto first = report.regions.begin() + static_cast<std::ptrdiff_t>(pair.first_region);
    pair.first_region = static_cast<std::uint32_t>(ordered.size());
    ordered.insert(ordered.end(), first, first + static_cast<std::ptrdiff_t>(listed));
  }
  report.regions = std::move(ordered);
}

Status leave_out_contacts(const parallel::Context& context, Report& report) {
  return leave_out_contacts(context, report, [](const Pair&) { return false; });
}

Status leave_out_contacts(const parallel::Context& context, Report& report,
                          parallel::FunctionRef<bool(const Pair&)> stays) {
  const auto is_unlisted = [&](const Pair& pair) { return is_left_out(pair) && !stays(pair); };
  const auto unlisted = parallel::reduce(
      context, {.name = "count contacts", .n = report.pairs.size(), .grain = kPairsAtOnce},
      UnlistedContacts{},
      [&](UnlistedContacts& counts, std::size_t i) {
        const Pair& pair = report.pairs[i];
        if (is_unlisted(pair)) ++(pair.allowed < 0 ? counts.contacts : counts.allowed);
      },
      [](UnlistedContacts& into, const UnlistedContacts& counts) {
        into.contacts += counts.contacts;
        into.allowed += counts.allowed;
      });
  if (!unlisted) return unlisted.error();
  auto kept = parallel::collect<Pair>(
      context, {.name = "list without contacts", .n = report.pairs.size(), .grain = kPairsAtOnce},
      [&](std::size_t i, std::vector<Pair>& out) {
        if (!is_unlisted(report.pairs[i])) out.push_back(report.pairs[i]);
      });
  if (!kept) return kept.error();
  if (report.kept)
    if (const Status s = keep_unlisted(context, is_unlisted, report); !s) return s;
  report.unlisted = *unlisted;
  const bool some = kept->size() < report.pairs.size();
  report.pairs = std::move(*kept);
  if (some) put_regions_in_order(report);
  return {};
}

}  // namespace strake::clash
