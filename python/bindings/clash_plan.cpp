// SPDX-License-Identifier: Apache-2.0
#include "python/bindings/clash_plan.hpp"

#include <fmt/core.h>

#include <cstddef>
#include <utility>

#include "clash/sets_by_file.hpp"
#include "python/bindings/selection.hpp"
#include "rules/clearances.hpp"
#include "rules/profiles.hpp"
#include "rules/rule_context.hpp"

namespace strake::python {

void RequestFacts::append(const RequestFacts& more) {
  append_picked(more.a, a);
  append_picked(more.b, b);
  file.append(more.file);
  profile.append(more.profile);
}

Result<ClashPlanner> ClashPlanner::of(const ClashRequest& request) {
  ClashPlanner planner(request);
  if (const Status s = planner.read_rules(); !s) return s.error();
  if (const Status s = planner.read_test(); !s) return s.error();
  return planner;
}

Status ClashPlanner::read_rules() {
  if (!request_->rules.empty()) {
    Result<rules::Rules> read = rules::Rules::read(request_->rules);
    if (!read) return read.error();
    if (!read->files().empty())
      return Error{ErrorCode::usage, "the rules say of files how they are read",
                   read->files().front().where,
                   "give unit and up_axis to load(), and leave [[file]] out of these rules"};
    file_ = std::move(*read);
  }
  if (request_->profile.empty()) return {};
  const rules::Profile* const known = rules::find_profile(request_->profile);
  if (known == nullptr) {
    std::string names;
    for (const rules::Profile& one : rules::profiles())
      names.append(names.empty() ? "" : ", ").append(one.name);
    return Error{ErrorCode::usage, fmt::format("there is no profile '{}'", request_->profile),
                 "profile", "write one of " + names};
  }
  Result<rules::Rules> parsed = rules::Rules::parse(known->text, known->file());
  if (!parsed) return parsed.error();
  profile_ = std::move(*parsed);
  return {};
}

Status ClashPlanner::read_test() {
  const ClashRequest& request = *request_;
  clash::Tolerances& tolerances = options_.tolerances;
  if (!request.clearance.empty()) {
    Result<rules::WrittenClearance> written = rules::parse_clearance(request.clearance);
    if (!written) {
      Error error = written.error();
      error.where = "clearance";
      return error;
    }
    tolerances.clearance_mm = written->mm;
    clearance_attribute_ = std::move(written->attribute);
  }
  tolerances.touch_gap_mm = request.touch_gap_mm.value_or(tolerances.touch_gap_mm);
  tolerances.touch_overlap_mm = request.touch_overlap_mm.value_or(tolerances.touch_overlap_mm);
  options_.contact_distance_mm = request.contact_distance_mm.value_or(options_.contact_distance_mm);
  if (!request.thickness_cap) tolerances.thickness_cap = clash::ThicknessCap::off;
  clash::EngineOptions& engine = options_.engine;
  if (request.volumes) engine.volumes = clash::Volumes::on;
  if (request.curves) engine.curves = clash::Curves::on;
  if (request.contacts != "list") engine.contacts = clash::Contacts::count;
  engine.max_regions = request.regions;
  engine.log_pairs = request.log_pairs;
  if (request.list_exempted && !file_ && !profile_)
    return Error{ErrorCode::usage, "there are no rules that exempt", "list_exempted",
                 "give rules or profile"};
  return {};
}

model::SceneOptions ClashPlanner::scene_options() const {
  model::SceneOptions options = file_ ? file_->scene_options() : clash::scene_options(options_);
  if (profile_) {
    options.obstruction = profile_->scene_options().obstruction;
    options.insulation = profile_->scene_options().insulation;
  }
  options.obstruction = options.obstruction || request_->obstructions;
  options.insulation = options.insulation || request_->insulation;
  options.sag_mm = request_->sag_mm.value_or(options.sag_mm);
  options.weld_mm = request_->weld_mm.value_or(options.weld_mm);
  return options;
}

std::optional<report::RulesSource> ClashPlanner::rules_source() const {
  if (profile_) return report::RulesSource{profile_->file(), profile_->hash(), request_->profile};
  if (file_) return report::RulesSource{file_->file(), file_->hash()};
  return std::nullopt;
}

bool ClashPlanner::selects(const RequestFacts& facts) const {
  return !facts.a.empty() || !facts.b.empty() || !facts.file.picked.empty() ||
         !facts.profile.picked.empty();
}

Result<RequestFacts> ClashPlanner::facts(const model::Scene& scene,
                                         const parallel::Context& context) const {
  RequestFacts facts;
  for (const bool is_a : {true, false}) {
    auto each = picked_by_each(is_a ? request_->a : request_->b, scene, context);
    if (!each) return each.error();
    (is_a ? facts.a : facts.b) = std::move(*each);
  }
  for (const bool is_file : {true, false}) {
    const std::optional<rules::Rules>& some = is_file ? file_ : profile_;
    if (!some) continue;
    Result<rules::ObjectFacts> of_rules = some->facts(scene, context);
    if (!of_rules) return of_rules.error();
    (is_file ? facts.file : facts.profile) = std::move(*of_rules);
  }
  return facts;
}

Result<rules::PlannedTest> ClashPlanner::planned_test(const model::Scene& scene,
                                                      const RequestFacts& facts,
                                                      Diagnostics& diagnostics) const {
  rules::PlannedTest planned{{}, options_, {}, {}};
  if (request_->a.is_everything() && request_->b.is_everything()) {
    planned.sets =
        request_->within_files ? clash::one_set(scene) : clash::sets_by_file(*scene.model);
  } else {
    planned.sets = clash::one_set(scene);
    for (const bool is_a : {true, false}) {
      const Pick& wanted = is_a ? request_->a : request_->b;
      if (wanted.is_everything()) continue;
      Result<Picked> picked = pick(wanted, is_a ? facts.a : facts.b, *scene.model);
      if (!picked) return picked.error();
      (is_a ? planned.sets.in_a : planned.sets.in_b) = std::move(picked->objects);
      (is_a ? planned.sets.name_a : planned.sets.name_b) = std::move(picked->name);
      for (const std::string& idle : picked->idle)
        diagnostics.add(Severity::warning, "selection-picks-nothing", idle, is_a ? "--a" : "--b");
    }
  }
  if (!clearance_attribute_.empty())
    planned.options.tolerances.object_clearances =
        rules::object_clearances(*scene.model, clearance_attribute_, "--clearance", diagnostics);
  return planned;
}

Result<rules::Plan> ClashPlanner::plan(const model::Scene& scene, RequestFacts facts,
                                       const parallel::Context& context) const {
  Result<rules::Plan> plan = plan_by_rules(scene, std::move(facts), context);
  if (plan)
    for (rules::PlannedTest& one : plan->tests) one.policy.list_exempted = request_->list_exempted;
  return plan;
}

Result<rules::Plan> ClashPlanner::plan_by_rules(const model::Scene& scene, RequestFacts facts,
                                                const parallel::Context& context) const {
  if (file_) {
    Result<rules::Plan> plan = file_->plan(scene, std::move(facts.file), context);
    if (plan)
      for (rules::PlannedTest& one : plan->tests) one.options.engine = options_.engine;
    return plan;
  }
  rules::Plan plan;
  Result<rules::PlannedTest> planned = planned_test(scene, facts, plan.diagnostics);
  if (!planned) return planned.error();
  plan.tests.push_back(std::move(*planned));
  if (!profile_) return plan;
  Result<rules::Plan> applied = profile_->plan(scene, std::move(facts.profile), context);
  if (!applied) return applied.error();
  plan.tests.front().policy = std::move(applied->tests.front().policy);
  for (const Diagnostic& diagnostic : applied->diagnostics.kept())
    if (diagnostic.code != rules::kMatchesNothing && diagnostic.code != rules::kShadowed)
      plan.diagnostics.add(diagnostic);
  return plan;
}

}  // namespace strake::python
