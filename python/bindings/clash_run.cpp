// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <array>
#include <utility>

#include "clash/sets_by_file.hpp"
#include "python/bindings/clash.hpp"
#include "rules/clearances.hpp"
#include "rules/profiles.hpp"
#include "rules/rule_context.hpp"
#include "strake/rules/rules.hpp"

namespace strake::python {

namespace {

/// The rules of a request; a profile has no tests.
struct GivenRules {
  std::optional<rules::Rules> file, profile;
};

Result<GivenRules> given_rules(const ClashRequest& request) {
  GivenRules given;
  if (!request.rules.empty()) {
    Result<rules::Rules> read = rules::Rules::read(request.rules);
    if (!read) return read.error();
    if (!read->files().empty())
      return Error{ErrorCode::usage, "the rules say of files how they are read",
                   read->files().front().where,
                   "give unit and up_axis to load(), and leave [[file]] out of these rules"};
    given.file = std::move(*read);
  }
  if (request.profile.empty()) return given;
  const rules::Profile* const known = rules::find_profile(request.profile);
  if (known == nullptr) {
    std::string names;
    for (const rules::Profile& one : rules::profiles())
      names.append(names.empty() ? "" : ", ").append(one.name);
    return Error{ErrorCode::usage, fmt::format("there is no profile '{}'", request.profile),
                 "profile", "write one of " + names};
  }
  Result<rules::Rules> parsed = rules::Rules::parse(known->text, known->file());
  if (!parsed) return parsed.error();
  given.profile = std::move(*parsed);
  return given;
}

struct Test {
  clash::Options options;
  std::string clearance_attribute;  ///< empty: nothing
};

Result<Test> test_of(const ClashRequest& request) {
  Test test;
  clash::Options& options = test.options;
  if (!request.clearance.empty()) {
    Result<rules::WrittenClearance> written = rules::parse_clearance(request.clearance);
    if (!written) return written.error();
    options.tolerances.clearance_mm = written->mm;
    test.clearance_attribute = std::move(written->attribute);
  }
  clash::Tolerances& tolerances = options.tolerances;
  tolerances.touch_gap_mm = request.touch_gap_mm.value_or(tolerances.touch_gap_mm);
  tolerances.touch_overlap_mm = request.touch_overlap_mm.value_or(tolerances.touch_overlap_mm);
  options.contact_distance_mm = request.contact_distance_mm.value_or(options.contact_distance_mm);
  if (!request.thickness_cap) tolerances.thickness_cap = clash::ThicknessCap::off;
  clash::EngineOptions& engine = options.engine;
  if (request.volumes) engine.volumes = clash::Volumes::on;
  if (request.curves) engine.curves = clash::Curves::on;
  if (request.contacts != "list") engine.contacts = clash::Contacts::count;
  engine.most_regions = request.regions;
  return test;
}

Result<rules::PlannedTest> planned_test(const model::Scene& scene, const ClashRequest& request,
                                        const Test& test, Diagnostics& diagnostics,
                                        const parallel::Context& context) {
  rules::PlannedTest planned{{}, test.options, {}, {}};
  if (request.a.is_everything() && request.b.is_everything()) {
    planned.sets = request.within_files ? clash::one_set(scene) : clash::sets_by_file(*scene.model);
  } else {
    planned.sets = clash::one_set(scene);
    for (const bool is_a : {true, false}) {
      const Pick& wanted = is_a ? request.a : request.b;
      if (wanted.is_everything()) continue;
      Result<Picked> picked = pick(wanted, scene, context);
      if (!picked) return picked.error();
      (is_a ? planned.sets.in_a : planned.sets.in_b) = std::move(picked->objects);
      (is_a ? planned.sets.name_a : planned.sets.name_b) = std::move(picked->name);
      for (const std::string& idle : picked->idle)
        diagnostics.add(Severity::warning, "selection-picks-nothing", idle, is_a ? "--a" : "--b");
    }
  }
  if (!test.clearance_attribute.empty())
    planned.options.tolerances.object_clearances = rules::object_clearances(
        *scene.model, test.clearance_attribute, "--clearance", diagnostics);
  return planned;
}

Result<rules::Plan> plan_of(const model::Scene& scene, const ClashRequest& request,
                            const GivenRules& given, const Test& test,
                            const parallel::Context& context) {
  if (given.file) {
    Result<rules::Plan> plan = given.file->plan(scene, context);
    if (plan)
      for (rules::PlannedTest& one : plan->tests) one.options.engine = test.options.engine;
    return plan;
  }
  rules::Plan plan;
  Result<rules::PlannedTest> planned =
      planned_test(scene, request, test, plan.diagnostics, context);
  if (!planned) return planned.error();
  plan.tests.push_back(std::move(*planned));
  if (!given.profile) return plan;
  Result<rules::Plan> applied = given.profile->plan(scene, context);
  if (!applied) return applied.error();
  plan.tests.front().policy = std::move(applied->tests.front().policy);
  for (const Diagnostic& told : applied->diagnostics.kept())
    if (told.code != rules::kMatchesNothing && told.code != rules::kShadowed)
      plan.diagnostics.add(told);
  return plan;
}

model::SceneOptions scene_options(const GivenRules& given, const Test& test) {
  model::SceneOptions options =
      given.file ? given.file->scene_options() : clash::scene_options(test.options);
  if (given.profile) {
    options.obstruction = given.profile->scene_options().obstruction;
    options.insulation = given.profile->scene_options().insulation;
  }
  return options;
}

Result<clash::Findings> findings_of(const model::Scene& scene, rules::Plan plan,
                                    const parallel::Context& context) {
  clash::Findings findings;
  findings.diagnostics = std::move(plan.diagnostics);
  for (const rules::PlannedTest& test : plan.tests) {
    Result<clash::Report> report =
        clash::detect(scene, test.sets, test.options, test.policy, context);
    if (!report) return report.error();
    report->name = test.name;
    findings.tests.push_back(std::move(*report));
  }
  findings.diagnostics.append(rules::idle_rules(plan, findings.tests));
  return findings;
}

Result<clash::GroupRules> group_rules(const ClashRequest& request) {
  clash::GroupRules rules;
  constexpr std::array kWays{clash::GroupBy::element, clash::GroupBy::proximity,
                             clash::GroupBy::test, clash::GroupBy::files, clash::GroupBy::assembly};
  const auto* const by = std::ranges::find_if(
      kWays, [&](clash::GroupBy way) { return clash::name(way) == request.group_by; });
  if (by == kWays.end())
    return Error{ErrorCode::usage, fmt::format("there is no grouping by '{}'", request.group_by),
                 "group_by", "write element, proximity, test, files or assembly"};
  rules.by = *by;
  rules.distance_mm = request.group_distance_mm.value_or(rules.distance_mm);
  rules.contacts = request.group_contacts;
  rules.apart = request.group_distance_mm.has_value() && rules.by != clash::GroupBy::proximity;
  return rules;
}

}  // namespace

Result<std::shared_ptr<ClashRun>> find_clashes(const ModelPointer& model,
                                               const ClashRequest& request,
                                               const parallel::Context& context) {
  const Result<GivenRules> given = given_rules(request);
  if (!given) return given.error();
  const Result<Test> test = test_of(request);
  if (!test) return test.error();
  const auto scene = model->scene(scene_options(*given, *test), context);
  if (!scene) return scene.error();
  Result<rules::Plan> plan = plan_of(**scene, request, *given, *test, context);
  if (!plan) return plan.error();
  Result<clash::Findings> findings = findings_of(**scene, std::move(*plan), context);
  if (!findings) return findings.error();
  const auto run = std::make_shared<ClashRun>();
  run->model = model;
  run->findings = std::move(*findings);
  run->classes.contact = request.contacts != "off";
  if (!run->classes.all()) report::leave_out_others(run->findings, run->classes);
  if (given->file) run->rules = {given->file->file(), given->file->hash()};
  if (given->profile)
    run->rules = {given->profile->file(), given->profile->hash(), request.profile};
  run->loading = model->model().diagnostics;
  run->loading.append((*scene)->diagnostics);
  if (request.group_by.empty()) return std::shared_ptr<ClashRun>(run);
  const Result<clash::GroupRules> rules = group_rules(request);
  if (!rules) return rules.error();
  Result<clash::Grouping> grouping = clash::group_results(run->findings, model->model(), *rules);
  if (!grouping) return grouping.error();
  run->grouping = std::move(*grouping);
  return std::shared_ptr<ClashRun>(run);
}

}  // namespace strake::python
