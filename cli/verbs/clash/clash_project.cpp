// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/clash/clash_project.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <span>
#include <string_view>
#include <utility>

#include "cli/run/authorship.hpp"
#include "core/text/counted.hpp"
#include "core/text_encoding.hpp"
#include "project/model/file_rows.hpp"
#include "project/stored_report/report_codec.hpp"
#include "strake/clash/incremental.hpp"
#include "strake/core/hash.hpp"

namespace strake::cli {

namespace {

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Whether no object changed, came, went or has another number.
bool is_same(const std::vector<std::uint32_t>& now_of, std::size_t objects) {
  if (now_of.size() != objects) return false;
  for (std::size_t o = 0; o < objects; ++o)
    if (now_of[o] != o) return false;
  return true;
}

std::string called(std::string_view test) {
  return test.empty() ? std::string() : "test " + in_quotes(test) + ": ";
}

/// Returns what was tested again, in one line.
std::string work_text(std::string_view test, const project::TestWork& work) {
  switch (work.how) {
    case project::Retested::nothing:
      return fmt::format("{}nothing changed, {} kept", called(test),
                         counted(work.kept_results, "result"));
    case project::Retested::changes:
      return fmt::format("{}{} of {} changed, {} tested again, {} kept", called(test),
                         work.changed_objects, counted(work.objects, "object"),
                         counted(work.tested_pairs, "pair"), counted(work.kept_results, "result"));
    case project::Retested::full:
      break;
  }
  return fmt::format("{}all of {} tested", called(test), counted(work.objects, "object"));
}

/// Whether a run finds what the one before found, and has it under the same names: where files have
/// other labels, what is written of the same results is other, too.
Result<bool> is_same_run(Session& session, const LoadedModel& loaded,
                         const project::StoredTest& before,
                         const std::vector<std::uint32_t>& now_of) {
  if (!is_same(now_of, loaded.model->objects.size())) return false;
  return clash::have_same_names(before.results.report, *loaded.model, session.context());
}

/// Returns a hash of a model, of which the project has this seal, and of how it is on the grid.
Hash128 hash_of_scene(const Hash128& seal, const LoadedModel& loaded,
                      const model::SceneOptions& options) {
  WordHash hash;
  hash.add(seal).add(hash_bytes(std::as_bytes(std::span(loaded.shape_hashes))));
  hash.add(options.sag_mm).add(options.weld_mm);
  for (const bool is_placed : {options.physical, options.obstruction, options.insulation})
    hash.add(is_placed);
  return hash.value();
}

/// Whether all objects have the identities that they had.
bool have_same_identities(const project::Snapshot& then, const project::Snapshot& now) {
  return project::is_same_known(then.names, now.names) || then.identities == now.identities;
}

/// Counts the results of the earlier run whose objects are as they were.
std::uint64_t count_kept(const clash::Report& report, const std::vector<std::uint32_t>& now_of) {
  return static_cast<std::uint64_t>(
      std::ranges::count_if(report.pairs, [&](const clash::Pair& pair) {
        return now_of[index(pair.a)] != model::kNoObject &&
               now_of[index(pair.b)] != model::kNoObject;
      }));
}

}  // namespace

void add_clash_project_options(CLI::App& command, ClashProjectInput& options) {
  add_project_options(command, options.project, kWorkOnProject);
  CLI::Option* const project = command.get_option("--project");
  command
      .add_flag("--full", options.full,
                "Test every pair again, although the project knows what changed; the result is the "
                "same")
      ->group("Running")
      ->needs(project);
  command
      .add_flag("--verify", options.verify,
                "Test what changed and then everything, and compare: exit code 1 where they differ")
      ->group("Running")
      ->needs(project);
  command.add_option("--by", options.by, "Who runs the test, for its history (default: the user)")
      ->type_name("NAME")
      ->group("Decisions")
      ->needs(project);
}

ProjectClashes::ProjectClashes(OpenedProject opened, const ClashProjectInput& input)
    : opened_(std::move(opened)), input_(input), started_(utc_time()), started_s_(now_s()) {}

Result<ProjectClashes> ProjectClashes::open(Session& session, const ClashProjectInput& input) {
  Result<OpenedProject> opened = open_project(session, input.project, project::Access::write);
  if (!opened) return opened.error();
  return ProjectClashes(std::move(*opened), input);
}

Result<LoadedModel> ProjectClashes::load(Session& session, const model::SceneOptions& options,
                                         std::span<const rules::FileSettings> file_settings) {
  const Result<project::ReadScope> moment = project::ReadScope::begin(opened_.project.database());
  if (!moment) return moment.error();
  const Result<Hash128> seal = project::model_seal(opened_.project.database());
  if (!seal) return seal.error();
  model_seal_ = *seal;
  Result<LoadedModel> loaded = load_project(session, opened_, options, file_settings);
  if (loaded) scene_ = hash_of_scene(*seal, *loaded, options);
  return loaded;
}

Result<clash::Findings> ProjectClashes::find(Session& session, const LoadedModel& loaded,
                                             rules::Plan plan, bool list_exempted) {
  clash::Findings findings;
  findings.diagnostics = plan.diagnostics;
  for (rules::PlannedTest& planned : plan.tests) {
    planned.policy.list_exempted = list_exempted;
    planned.options.engine.keep_for_changes = true;
    Tested& tested = tests_.emplace_back();
    Result<clash::Report> report = test(session, loaded, planned, tested);
    if (!report) return report.error();
    report->name = planned.name;
    session.console().note(work_text(planned.name, tested.work));
    if (input_.verify && tested.work.how != project::Retested::full)
      if (const Status status = verify(session, loaded, planned, *report); !status)
        return status.error();
    findings.tests.push_back(std::move(*report));
  }
  findings.diagnostics.append(rules::idle_rules(plan, findings.tests));
  for (std::size_t t = 0; t < tests_.size(); ++t) {
    tests_[t].sets = std::move(plan.tests[t].sets);
    tests_[t].policy = std::move(plan.tests[t].policy);
  }
  return findings;
}

Result<clash::Report> ProjectClashes::test(Session& session, const LoadedModel& loaded,
                                           const rules::PlannedTest& planned, Tested& tested) {
  {
    const auto timer = session.step("read earlier result");
    Result<std::optional<project::StoredTest>> before =
        project::read_test(opened_.project.database(), planned.name, session.context());
    if (!before) return before.error();
    tested.before = std::move(*before);
  }
  if (const Status status = sign(session, loaded, planned, tested); !status) return status.error();
  const std::string step = planned.name.empty() ? "clash" : "clash " + planned.name;
  const auto timer = session.step(step);
  tested.work.objects = tested.work.changed_objects = loaded.model->objects.size();
  // A log of pairs is about the work of a full run.
  const bool follows = tested.before && !input_.full && !planned.options.engine.log_pairs &&
                       tested.before->snapshot.whole == tested.snapshot().whole &&
                       tested.before->results.report.kept;
  if (follows) return follow(session, loaded, planned, tested);
  Result<clash::Report> report =
      clash::detect(loaded.scene, planned.sets, planned.options, planned.policy, session.context());
  if (report) tested.work.tested_pairs = report->counters.candidate_pairs;
  return report;
}

Status ProjectClashes::sign(Session& session, const LoadedModel& loaded,
                            const rules::PlannedTest& planned, Tested& tested) {
  const auto timer = session.step("signatures");
  const Hash128 source =
      WordHash()
          .add(scene_)
          .add(clash::hash_of_inputs(loaded.scene, planned.sets, planned.options, planned.policy))
          .value();
  const project::Snapshot* const before = tested.before ? &tested.before->snapshot : nullptr;
  if (before != nullptr && project::is_same_known(before->source, source)) return {};
  clash::EarlierSignatures earlier;
  if (before != nullptr) earlier = {before->signatures, before->ranges};
  Result<clash::Signatures> signatures =
      clash::signatures(loaded.scene, planned.sets, planned.options, planned.policy,
                        session.context(), loaded.known(), earlier);
  if (!signatures) return signatures.error();
  const bool same_names = before != nullptr && project::is_same_known(before->names, loaded.names);
  if (!same_names && identities_.empty()) {
    Result<std::vector<std::uint64_t>> all = project::identities(*loaded.model, session.context());
    if (!all) return all.error();
    identities_ = std::move(*all);
  }
  tested.made = project::Snapshot{signatures->rules,
                                  same_names ? before->identities : identities_,
                                  std::move(signatures->objects),
                                  loaded.names,
                                  source,
                                  std::move(signatures->ranges)};
  return {};
}

Result<clash::Report> ProjectClashes::follow(Session& session, const LoadedModel& loaded,
                                             const rules::PlannedTest& planned, Tested& tested) {
  project::StoredTest& before = *tested.before;
  if (!tested.made) return keep(planned, tested);
  const Result<std::vector<std::uint32_t>> now_of =
      project::unchanged(before.snapshot, *tested.made, session.context());
  if (!now_of) return now_of.error();
  const Result<bool> nothing_changed = is_same_run(session, loaded, before, *now_of);
  if (!nothing_changed) return nothing_changed.error();
  if (*nothing_changed) return keep(planned, tested);
  project::TestWork& work = tested.work;
  work.how = project::Retested::changes;
  work.changed_objects = work.objects - static_cast<std::uint64_t>(now_of->size()) +
                         static_cast<std::uint64_t>(std::ranges::count(*now_of, model::kNoObject));
  const std::size_t had = before.results.report.pairs.size();
  Result<clash::FollowedRun> run =
      clash::follow_changes(loaded.scene, planned.sets, planned.options, planned.policy,
                            {std::move(before.results.report), *now_of,
                             have_same_identities(before.snapshot, *tested.made),
                             before.results.partners ? &*before.results.partners : nullptr},
                            session.context());
  if (!run) return run.error();
  before.results.report = std::move(run->earlier);
  tested.changes = std::move(run->changes);
  work.kept_results = tested.changes ? had - tested.changes->gone.size()
                                     : count_kept(before.results.report, *now_of);
  work.tested_pairs = run->report.counters.candidate_pairs;
  return std::move(run->report);
}

clash::Report ProjectClashes::keep(const rules::PlannedTest& planned, Tested& tested) {
  clash::Report report = std::move(tested.before->results.report);
  tested.work.how = project::Retested::nothing;
  tested.work.kept_results = report.pairs.size();
  tested.work.changed_objects = 0;
  report.counters = {};
  report.options = planned.options;
  return report;
}

Status ProjectClashes::verify(Session& session, const LoadedModel& loaded,
                              const rules::PlannedTest& planned, clash::Report& report) {
  const auto timer = session.step("verify");
  Result<clash::Report> full =
      clash::detect(loaded.scene, planned.sets, planned.options, planned.policy, session.context());
  if (!full) return full.error();
  full->name = planned.name;
  const Result<bool> is_same = project::is_same_result(report, *full);
  if (!is_same) return is_same.error();
  if (*is_same) {
    session.console().note(called(planned.name) + "the same as by a full test");
    return {};
  }
  differs_ = true;
  session.console().warn(called(planned.name) +
                         "--verify: the result is another than that of a full test, which counts "
                         "(a fault of the program: please report it)");
  report = std::move(*full);
  return {};
}

Status ProjectClashes::remember(Session& session, const LoadedModel& loaded,
                                const clash::Findings& findings, RunRequest request) {
  const auto timer = session.step("remember");
  Result<project::Transaction> transaction =
      project::Transaction::begin(opened_.project.database());
  if (!transaction) return transaction.error();
  transaction_.emplace(std::move(*transaction));
  const Result<Hash128> seal = project::model_seal(opened_.project.database());
  if (!seal) return seal.error();
  if (*seal != model_seal_)
    return Error{ErrorCode::output, "the model of the project changed meanwhile", opened_.file,
                 "nothing is remembered: run again"};
  std::vector<project::TestedTest> tests;
  for (std::size_t t = 0; t < tests_.size(); ++t) {
    Tested& tested = tests_[t];
    // What --verify put in place of the result is written as such.
    if (differs_) {
      tested.work.how = project::Retested::full;
      if (!tested.made) tested.made = std::move(tested.before->snapshot);
      tested.before.reset();
    }
    tests.push_back({&findings.tests[t], &tested.snapshot(), &tested.sets, &tested.policy,
                     tested.before ? &*tested.before : nullptr, tested.work,
                     tested.before && tested.changes ? &*tested.changes : nullptr});
  }
  const project::RunFacts facts{started_,
                                input_.by.empty() ? person() : input_.by,
                                now_s() - started_s_,
                                request.deeper_mm,
                                std::move(request.rules),
                                std::move(request.grouping),
                                request.comments};
  Result<project::RememberedRun> run =
      project::remember(opened_.project.database(), *loaded.model, facts, tests, session.context());
  if (!run) return run.error();
  run_.emplace(std::move(*run));
  for (std::size_t t = 0; t < tests_.size(); ++t) {
    const project::TestTrend& trend = run_->trends[t];
    session.console().note(fmt::format("{}run {}: {} appeared, {} resolved, {} cannot be told",
                                       called(findings.tests[t].name), run_->number, trend.appeared,
                                       trend.gone, trend.cannot_tell));
  }
  return {};
}

Status ProjectClashes::commit(Session& session) {
  const auto timer = session.step("remember");
  const Status status = transaction_->commit();
  transaction_.reset();
  return status;
}

}  // namespace strake::cli
