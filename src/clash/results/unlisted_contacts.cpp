// SPDX-License-Identifier: Apache-2.0
#include "clash/results/unlisted_contacts.hpp"

#include <utility>
#include <vector>

#include "strake/parallel/collect.hpp"
#include "strake/parallel/reduce.hpp"

namespace strake::clash {
namespace {

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
  report.unlisted = *unlisted;
  report.pairs = std::move(*kept);
  return {};
}

}  // namespace strake::clash
