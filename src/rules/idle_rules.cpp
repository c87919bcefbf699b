// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rules/rule_context.hpp"
#include "strake/rules/rules.hpp"

namespace strake::rules {
namespace {

constexpr std::string_view kExempted = "exempted", kAllowed = "allowed";

/// The effect of a rule in all tests that follow it.
struct RuleEffect {
  bool busy = false;
  std::string_view doing;    ///< what it does, in words
  std::string_view done_by;  ///< the rule that did it before, if any

  void add(bool did, std::int32_t shadowed_by, const auto& rule, std::string_view what) {
    busy = busy || did;
    doing = what;
    if (shadowed_by >= 0 && done_by.empty())
      done_by = rule[static_cast<std::size_t>(shadowed_by)].rule;
  }
};

std::map<std::string_view, RuleEffect> effects_of(std::span<const clash::Report> tests) {
  std::map<std::string_view, RuleEffect> effects;
  for (const clash::Report& test : tests) {
    for (const clash::Exempted& e : test.exempted)
      effects[e.rule].add(e.pairs > 0, e.shadowed_by, test.exempted, kExempted);
    // A rule that was applied to a pair and did not allow the result has done its work.
    for (const clash::AllowedCount& a : test.allowed)
      effects[a.rule].add(a.pairs + a.regions > 0 || (a.candidates > 0 && a.shadowed_by < 0),
                          a.shadowed_by, test.allowed, kAllowed);
  }
  return effects;
}

}  // namespace

Diagnostics idle_rules(const Plan& plan, std::span<const clash::Report> tests) {
  Diagnostics diagnostics;
  const std::map<std::string_view, RuleEffect> effects = effects_of(tests);
  for (const WatchedRule& rule : plan.watched) {
    const auto at = effects.find(rule.name);
    if (at == effects.end() || at->second.busy) continue;
    const RuleEffect& effect = at->second;
    if (effect.done_by.empty())
      diagnostics.add(Severity::warning, kMatchesNothing,
                      "it concerns no two objects that are within reach of each other" +
                          std::string(effect.doing == kAllowed ? " and not exempted" : ""),
                      rule.where);
    else
      diagnostics.add(Severity::warning, kShadowed,
                      "it does nothing: what it concerns is " + std::string(effect.doing) +
                          " by earlier rules, as '" + std::string(effect.done_by) + "'",
                      rule.where);
  }
  return diagnostics;
}

}  // namespace strake::rules
