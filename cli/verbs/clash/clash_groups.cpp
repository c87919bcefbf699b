// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/clash/clash_groups.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "clash/results/clash_key.hpp"
#include "cli/verbs/clash/clash_output.hpp"
#include "project/results/clash_queries.hpp"
#include "project/results/stored_tests.hpp"
#include "project/snapshot/snapshot.hpp"
#include "strake/core/hash.hpp"

namespace strake::cli {

namespace {

/// The results of the last run of these classes, without what was approved then: as the run groups
/// them.
struct OpenResults {
  clash::Findings findings;
  std::vector<std::vector<std::string>> keys;  ///< of each test and result; empty: none
  std::vector<std::uint64_t> identities;       ///< of the objects of the model then
};

/// The clashes of a project, with the statuses that they had when the last run ended.
class ClashesOfRun {
 public:
  static Result<ClashesOfRun> read(project::Database& database,
                                   const std::optional<project::RunRecord>& run) {
    ClashesOfRun clashes;
    Result<std::vector<project::ListedClash>> listed = project::list_clashes(database, {});
    if (!listed) return listed.error();
    for (const project::ListedClash& clash : *listed)
      clashes.by_row_.emplace(clash.row.id, Clash{clash.row.key, clash.status});
    // Of a run of an earlier version it is not known when it ended.
    if (!run) return clashes;
    const Result<std::map<std::int64_t, report::DecisionStatus>> then =
        project::statuses_at(database, run->last_event);
    if (!then) return then.error();
    for (const auto& [row, status] : *then)
      if (const auto at = clashes.by_row_.find(row); at != clashes.by_row_.end())
        at->second.status = status;
    return clashes;
  }

  struct Clash {
    std::string key;
    report::DecisionStatus status{};
  };
  /// Returns null where a result has no clash.
  [[nodiscard]] const Clash* find(std::int64_t row) const {
    const auto at = by_row_.find(row);
    return at == by_row_.end() ? nullptr : &at->second;
  }

 private:
  std::map<std::int64_t, Clash> by_row_;
};

/// Adds the results of a test that the run put into groups.
void add_open(project::StoredTest test, const ClashesOfRun& clashes,
              const report::WrittenClasses& classes, OpenResults& open) {
  clash::Report report = std::move(test.results.report);
  const std::vector<clash::Pair> pairs = std::exchange(report.pairs, {});
  std::vector<std::string>& keys = open.keys.emplace_back();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const ClashesOfRun::Clash* const clash = clashes.find(test.results.rows[i]);
    if (clash != nullptr && clash->status == report::DecisionStatus::approved) continue;
    if (!classes.has(pairs[i].cls) && !classes.has(pairs[i].severest)) continue;
    report.pairs.push_back(pairs[i]);
    keys.push_back(clash == nullptr ? std::string() : clash->key);
  }
  open.findings.tests.push_back(std::move(report));
  open.identities = std::move(test.snapshot.identities);
}

Result<OpenResults> open_results(Session& session, project::Database& database,
                                 const std::optional<project::RunRecord>& run,
                                 const report::WrittenClasses& classes) {
  const Result<ClashesOfRun> clashes = ClashesOfRun::read(database, run);
  if (!clashes) return clashes.error();
  const Result<std::vector<std::string>> tests = project::last_tests(database);
  if (!tests) return tests.error();
  OpenResults open;
  for (const std::string& name : *tests) {
    Result<std::optional<project::StoredTest>> test =
        project::read_test(database, name, session.context());
    if (!test) return test.error();
    if (*test) add_open(std::move(**test), *clashes, classes, open);
  }
  return open;
}

/// Returns the record of the last run; nothing where there is none.
Result<std::optional<project::RunRecord>> record_of_last_run(project::Database& database) {
  const Result<std::optional<std::int64_t>> run = project::last_run(database);
  if (!run) return run.error();
  if (!*run) return std::optional<project::RunRecord>();
  return project::read_run_record(database, **run);
}

/// Returns what is requested; where nothing is, how the run grouped.
ClashGroupingInput grouping_or_that_of_run(const ClashGroupingInput& input,
                                           const std::optional<project::RunRecord>& run) {
  ClashGroupingInput requested = input;
  if (input.first_given() == nullptr && run && !run->grouping.by.empty()) {
    requested.result.group_by = run->grouping.by;
    requested.result.group_distance = run->grouping.distance;
    requested.result.group_contacts = run->grouping.contacts;
    requested.result.sort = run->grouping.sort;
    requested.classes = run->grouping.classes;
  }
  if (requested.result.group_by.empty()) requested.result.group_by = name(clash::GroupBy::element);
  return requested;
}

std::string key_of_group(std::vector<std::string> clashes) {
  std::ranges::sort(clashes);
  Hasher hasher;
  hasher.add(std::string_view("group"));
  for (const std::string& key : clashes) hasher.add(std::string_view(key));
  return clash::key_text(hasher.value());
}

}  // namespace

const char* ClashGroupingInput::first_given() const {
  if (!result.group_by.empty()) return "--group-by";
  if (!result.group_distance.empty()) return "--group-distance";
  if (result.group_contacts) return "--group-contacts";
  if (!classes.empty()) return "--class";
  return result.sort.empty() ? nullptr : "--sort";
}

void add_grouping_options(CLI::App& command, ClashGroupingInput& options) {
  constexpr const char* kGroup = "Groups";
  add_choice(command, "--group-by", options.result.group_by,
             {"element", "proximity", "test", "files", "assembly"},
             "What the groups are by (default: as the last run grouped, or element)")
      ->group(kGroup);
  command.add_option("--group-distance", options.result.group_distance, "As 'strake clash' has it")
      ->type_name("LENGTH")
      ->group(kGroup);
  command.add_flag("--group-contacts", options.result.group_contacts, "As 'strake clash' has it")
      ->group(kGroup);
  command.add_option("--class", options.classes, "As 'strake clash' has it")
      ->type_name("CLASS,...")
      ->group(kGroup);
  add_choice(command, "--sort", options.result.sort, {"depth", "volume", "size"},
             "As 'strake clash' has it (default depth)")
      ->group(kGroup);
}

Status check(const ClashGroupingInput& input) {
  return check(grouping_or_that_of_run(input, std::nullopt).result);
}

project::RunGrouping grouping_of(const ClashResultInput& result, const std::string& classes) {
  return {result.group_by, result.group_distance, classes, result.sort, result.group_contacts};
}

Result<std::vector<ProjectGroup>> groups_of_last_run(Session& session, OpenedProject& opened,
                                                     const ClashGroupingInput& input) {
  project::Database& database = opened.project.database();
  const Result<std::optional<project::RunRecord>> run = record_of_last_run(database);
  if (!run) return run.error();
  const ClashGroupingInput requested = grouping_or_that_of_run(input, *run);
  ClashOutputInput shown;
  shown.classes = requested.classes;
  const Result<ClashOutput> output = clash_output(shown, {});
  if (!output) return output.error();
  const Result<OpenResults> open = open_results(session, database, *run, output->classes);
  if (!open) return open.error();
  const Result<model::Model> model = project_model(session, opened.project);
  if (!model) return model.error();
  const Result<std::vector<std::uint64_t>> identities =
      project::identities(*model, session.context());
  if (!identities) return identities.error();
  if (!open->findings.tests.empty() && open->identities != *identities)
    return Error{ErrorCode::usage, "the model changed since its clashes were grouped", opened.file,
                 "run 'strake clash -p " + opened.file + "' first"};
  const Result<std::optional<clash::Grouping>> grouping =
      group(session, requested.result, open->findings, *model, nullptr);
  if (!grouping) return grouping.error();
  std::vector<ProjectGroup> groups;
  for (const clash::Group& group : (**grouping).groups) {
    ProjectGroup& project_group = groups.emplace_back(ProjectGroup{{}, group.id, group.name, {}});
    for (const clash::ResultRef& result : group.results)
      if (const std::string& key = open->keys[result.test][result.pair]; !key.empty())
        project_group.clashes.push_back(key);
    project_group.key = key_of_group(project_group.clashes);
  }
  return groups;
}

}  // namespace strake::cli
