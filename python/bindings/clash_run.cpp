// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <array>
#include <utility>

#include "publish/form_words.hpp"
#include "python/bindings/clash.hpp"
#include "python/bindings/clash_plan.hpp"
#include "strake/rules/rules.hpp"

namespace strake::python {

namespace {

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

clash::SortBy sort_of(const ClashRequest& request) {
  if (request.sort == "volume") return clash::SortBy::volume;
  return request.sort == "size" ? clash::SortBy::size : clash::SortBy::depth;
}

Result<report::WrittenClasses> classes_of(const ClashRequest& request) {
  report::WrittenClasses classes;
  if (!request.classes.empty()) classes = {false, false, false};
  for (const std::string& word : request.classes)
    if (const Status added = publish::add_class(word, classes); !added) {
      Error error = added.error();
      error.where = "classes";
      return error;
    }
  if (request.contacts == "off") classes.contact = false;
  return classes;
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
  rules.sort = sort_of(request);
  rules.apart = request.group_distance_mm.has_value() && rules.by != clash::GroupBy::proximity;
  return rules;
}

}  // namespace

Result<std::shared_ptr<ClashRun>> run_of(const ModelPointer& model, const ClashRequest& request,
                                         const ClashPlanner& planner, clash::Findings findings,
                                         Diagnostics loading) {
  const auto run = std::make_shared<ClashRun>();
  run->model = model;
  run->findings = std::move(findings);
  const Result<report::WrittenClasses> classes = classes_of(request);
  if (!classes) return classes.error();
  run->classes = *classes;
  run->sort = sort_of(request);
  run->logs_pairs = request.log_pairs;
  if (!run->classes.all()) report::leave_out_others(run->findings, run->classes);
  run->rules = planner.rules_source();
  run->loading = std::move(loading);
  if (request.group_by.empty()) return run;
  const Result<clash::GroupRules> rules = group_rules(request);
  if (!rules) return rules.error();
  Result<clash::Grouping> grouping = clash::group_results(run->findings, model->model(), *rules);
  if (!grouping) return grouping.error();
  run->grouping = std::move(*grouping);
  return run;
}

Result<std::shared_ptr<ClashRun>> find_clashes(const ModelPointer& model,
                                               const ClashRequest& request,
                                               const parallel::Context& context) {
  const Result<ClashPlanner> planner = ClashPlanner::of(request);
  if (!planner) return planner.error();
  const auto scene = model->scene(planner->scene_options(), context);
  if (!scene) return scene.error();
  Result<RequestFacts> facts = planner->facts(**scene, context);
  if (!facts) return facts.error();
  Result<rules::Plan> plan = planner->plan(**scene, std::move(*facts), context);
  if (!plan) return plan.error();
  Result<clash::Findings> findings = findings_of(**scene, std::move(*plan), context);
  if (!findings) return findings.error();
  Diagnostics loading = model->model().diagnostics;
  loading.append((*scene)->diagnostics);
  auto run = run_of(model, request, *planner, std::move(*findings), std::move(loading));
  if (run) (*run)->scene = *scene;
  return run;
}

}  // namespace strake::python
