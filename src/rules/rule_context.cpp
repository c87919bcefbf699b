// SPDX-License-Identifier: Apache-2.0
#include "rules/rule_context.hpp"

#include <algorithm>
#include <utility>

namespace strake::rules {

Result<std::vector<std::vector<bool>>> picked_by(const std::vector<const Chooser*>& choosers,
                                                 const model::Scene& scene,
                                                 const parallel::Context& context) {
  std::vector<model::Selection> selections;
  selections.reserve(choosers.size());
  for (const Chooser* chooser : choosers) selections.push_back(chooser->selection);
  return model::pick(selections, scene, context);
}

RuleContext::RuleContext(const model::Scene& scene, const std::vector<const Chooser*>& choosers,
                         ObjectFacts facts, const parallel::Context& context)
    : scene_(scene),
      context_(context),
      ends_(std::move(facts.ends)),
      obstructions_(facts.obstructions),
      insulation_(facts.insulation) {
  for (std::size_t c = 0; c < choosers.size(); ++c)
    picked_[choosers[c]] = std::move(facts.picked[c]);
}

std::vector<model::ObjectEnd> RuleContext::ends(const std::vector<bool>& among) const {
  if (!ends_) return model::ends_of(scene_, among);
  std::vector<model::ObjectEnd> some;
  for (const model::ObjectEnd& end : *ends_)
    if (among[end.object]) some.push_back(end);
  return some;
}

std::vector<bool> RuleContext::pick(const Chooser& chooser) {
  std::vector<bool> picked = picked_.at(&chooser);
  if (!error_ && std::find(picked.begin(), picked.end(), true) == picked.end())
    warn_no_match(chooser.where, model::picks_nothing(chooser.selection, model()));
  return picked;
}

std::vector<bool> RuleContext::pick(const std::optional<Chooser>& chooser) {
  return chooser ? pick(*chooser) : std::vector<bool>(objects(), true);
}

void RuleContext::warn_no_match(const std::string& where, const std::string& what) {
  diagnostics_.add(Severity::warning, kMatchesNothing, what, where);
}

std::vector<const Chooser*> choosers_of(const RuleFile& rules) {
  std::vector<const Chooser*> all;
  const auto add = [&](const std::optional<Chooser>& chooser) {
    if (chooser) all.push_back(&*chooser);
  };
  for (const NamedSet& set : rules.sets) all.push_back(&set.chooser);
  for (const NamedSet& discipline : rules.disciplines) all.push_back(&discipline.chooser);
  for (const TestRule& test : rules.tests) {
    if (!test.enabled) continue;
    add(test.a);
    add(test.b);
  }
  for (const ExemptingRule& rule : rules.exempting) {
    add(rule.among);
    if (const auto* const units = std::get_if<UnitRule>(&rule.rule))
      for (const UnitRule::UnitGroup& group : units->groups) all.push_back(&group.chooser);
    if (const auto* const exempt = std::get_if<ExemptRule>(&rule.rule)) {
      all.push_back(&exempt->a);
      all.push_back(&exempt->b);
    }
  }
  if (rules.obstruction) {
    add(rules.obstruction->soft);
    add(rules.obstruction->none);
    add(rules.obstruction->hard);
  }
  if (rules.insulation) add(rules.insulation->select);
  for (const AllowedRule& rule : rules.allowed) {
    all.push_back(&rule.a);
    all.push_back(&rule.b);
  }
  return all;
}

}  // namespace strake::rules
