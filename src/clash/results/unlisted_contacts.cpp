// SPDX-License-Identifier: Apache-2.0
#include "clash/results/unlisted_contacts.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "clash/results/reported.hpp"
#include "clash/results/result_hash.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/reduce.hpp"

namespace strake::clash {
namespace {

// Only shares the work out: between 1024 and 16'384 no difference can be seen (decision 0073).
constexpr std::size_t kGrain = 4096;

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
      context, {.name = "contacts kept", .n = report.pairs.size(), .grain = kGrain},
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

Status leave_out_contacts(const parallel::Context& context, Report& report) {
  return leave_out_contacts(context, report, [](const Pair&) { return false; });
}

Status leave_out_contacts(const parallel::Context& context, Report& report,
                          parallel::FunctionRef<bool(const Pair&)> stays) {
  const auto is_unlisted = [&](const Pair& pair) { return is_left_out(pair) && !stays(pair); };
  const auto unlisted = parallel::reduce(
      context, {.name = "count contacts", .n = report.pairs.size(), .grain = kGrain},
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
      context, {.name = "list without contacts", .n = report.pairs.size(), .grain = kGrain},
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
