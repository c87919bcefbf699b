// SPDX-License-Identifier: Apache-2.0
#include "clash/rules/shadowed_rules.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "clash/rules/rule_matcher.hpp"
#include "strake/parallel/reduce.hpp"

namespace strake::clash {
namespace {

/// Pairs per block where idle rules are looked for. Between 4096 and 65'536 no difference can be
/// seen (decision 0073).
constexpr std::size_t kShadowGrain = 16384;

/// Finds for each idle rule the first of the rules that did its work before it; kNoLabel if none
/// did. `by(pair)` is the rule that took a pair, kNoLabel if none did; `concerns(rule, pair)` says
/// whether an idle rule would have.
template <class By, class Concerns>
Result<std::vector<std::uint32_t>> first_before(const std::vector<std::uint32_t>& idle,
                                                std::size_t pairs, const parallel::Context& context,
                                                const By& by, const Concerns& concerns) {
  using Firsts = std::vector<std::uint32_t>;
  return parallel::reduce(
      context, {.name = "shadowed rules", .n = idle.empty() ? 0 : pairs, .grain = kShadowGrain},
      Firsts(idle.size(), kNoLabel),
      [&](Firsts& partial, std::size_t i) {
        const std::uint32_t rule = by(i);
        if (rule == kNoLabel) return;
        for (std::size_t k = 0; k < idle.size(); ++k)
          if (rule < partial[k] && concerns(idle[k], i)) partial[k] = rule;
      },
      [](Firsts& into, const Firsts& partial) {
        for (std::size_t k = 0; k < into.size(); ++k) into[k] = std::min(into[k], partial[k]);
      });
}

bool is_between(const std::vector<bool>& of_a, const std::vector<bool>& of_b, std::uint32_t a,
                std::uint32_t b) {
  return (of_a[a] && of_b[b]) || (of_a[b] && of_b[a]);
}

bool takes(const Exemption& exemption, std::uint32_t a, std::uint32_t b) {
  if (const auto* const between = std::get_if<Between>(&exemption.test))
    return is_between(between->a, between->b, a, b);
  if (const auto* const same = std::get_if<SameLabel>(&exemption.test)) return exempts(*same, a, b);
  return exempts(*std::get_if<Linked>(&exemption.test), a, b);
}

}  // namespace

Status record_shadowed_exemptions(const Policy& policy, std::span<const ExemptedPair> exempted,
                                  const parallel::Context& context, Report& report) {
  const std::size_t base = policy.matrix ? 1 : 0;
  std::vector<std::uint32_t> idle;
  for (std::uint32_t e = 0; e < policy.exemptions.size(); ++e)
    if (report.exempted[base + e].pairs == 0) idle.push_back(e);
  const auto first = first_before(
      idle, exempted.size(), context, [&](std::size_t i) { return exempted[i].rule; },
      [&](std::uint32_t rule, std::size_t i) {
        return takes(policy.exemptions[rule], index(exempted[i].a), index(exempted[i].b));
      });
  if (!first) return first.error();
  for (std::size_t k = 0; k < idle.size(); ++k)
    if ((*first)[k] != kNoLabel)
      report.exempted[base + idle[k]].shadowed_by = static_cast<std::int32_t>((*first)[k]);
  return {};
}

Status record_shadowed_allowances(const Policy& policy, std::span<const Pair> pairs,
                                  const parallel::Context& context, Report& report) {
  std::vector<std::uint32_t> idle;
  for (std::uint32_t r = 0; r < report.allowed.size(); ++r)
    if (report.allowed[r].pairs == 0 && report.allowed[r].regions == 0) idle.push_back(r);
  const auto first = first_before(
      idle, pairs.size(), context,
      [&](std::size_t i) {
        return pairs[i].allowed < 0 ? kNoLabel : static_cast<std::uint32_t>(pairs[i].allowed);
      },
      [&](std::uint32_t r, std::size_t i) {
        const Allowed& rule = policy.allowed[r];
        return is_between(rule.a, rule.b, index(pairs[i].a), index(pairs[i].b)) &&
               allows(rule, pairs[i], 0);
      });
  if (!first) return first.error();
  for (std::size_t k = 0; k < idle.size(); ++k) {
    std::int32_t& by = report.allowed[idle[k]].shadowed_by;
    if ((*first)[k] != kNoLabel && (by < 0 || (*first)[k] < static_cast<std::uint32_t>(by)))
      by = static_cast<std::int32_t>((*first)[k]);
  }
  return {};
}

}  // namespace strake::clash
