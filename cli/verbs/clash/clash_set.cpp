// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cli/run/object_selection.hpp"
#include "cli/run/person.hpp"
#include "cli/run/project_input.hpp"
#include "cli/run/utc_time.hpp"
#include "cli/verbs/clash/clash_output.hpp"
#include "cli/verbs/clash/clash_result.hpp"
#include "cli/verbs/verb.hpp"
#include "core/number.hpp"
#include "core/text_encoding.hpp"
#include "project/results/clash_queries.hpp"
#include "project/results/stored_tests.hpp"

namespace strake::cli {

namespace {

struct ClashSetOptions {
  ProjectOptions project;
  std::vector<std::string> keys, select;
  std::string group, classes, status, by;
  std::optional<std::string> comment, assignee;
  ClashResultInput grouping;
};

/// Returns what groups are by, with the default.
ClashResultInput grouping_of(const ClashSetOptions& given) {
  ClashResultInput grouping = given.grouping;
  if (!given.group.empty() && grouping.group_by.empty())
    grouping.group_by = name(clash::GroupBy::element);
  return grouping;
}

Status check(const ClashSetOptions& given) {
  if (given.project.file.empty())
    return Error{ErrorCode::usage, "no project is given", "-p", "write -p FILE"};
  if (given.status.empty() && !given.comment && !given.assignee)
    return Error{
        ErrorCode::usage, "there is nothing to set", {}, "add --status, --comment or --assignee"};
  const int ways =
      (given.keys.empty() ? 0 : 1) + (given.select.empty() ? 0 : 1) + (given.group.empty() ? 0 : 1);
  if (ways != 1)
    return Error{ErrorCode::usage,
                 "it is not clear which clashes are meant",
                 {},
                 "give keys, or --select, or --group"};
  const ClashResultInput& grouping = given.grouping;
  for (const auto& [option, is_given] :
       {std::pair("--group-by", !grouping.group_by.empty()),
        std::pair("--group-distance", !grouping.group_distance.empty()),
        std::pair("--group-contacts", grouping.group_contacts),
        std::pair("--class", !given.classes.empty()), std::pair("--sort", !grouping.sort.empty())})
    if (is_given && given.group.empty())
      return Error{ErrorCode::usage, "no group is meant", option, "add --group"};
  return check(grouping_of(given));
}

std::optional<report::DecisionStatus> status_of(const std::string& word) {
  for (const report::DecisionStatus status : report::kDecisionStatuses)
    if (name(status) == word) return status;
  return std::nullopt;
}

/// Returns the keys of the clashes of which a selection picks one of the two objects, as far as
/// they are there.
Result<std::vector<std::string>> keys_by_selection(Session& session, OpenedProject& opened,
                                                   const std::vector<std::string>& texts) {
  const Result<std::vector<model::Selection>> selections = parse_selections(texts, "--select");
  if (!selections) return selections.error();
  const Result<Loaded> loaded = load_project(session, opened, {});
  if (!loaded) return loaded.error();
  const Result<std::vector<bool>> picked =
      pick_any(session, loaded->scene, *selections, "--select");
  if (!picked) return picked.error();
  std::set<std::pair<std::string, std::string>> objects;
  for (std::size_t o = 0; o < picked->size(); ++o) {
    const model::Object& object = loaded->model->objects[o];
    if ((*picked)[o])
      objects.emplace(valid_utf8(loaded->model->files[object.file].label), valid_utf8(object.id));
  }
  const Result<std::vector<project::ListedClash>> clashes =
      project::list_clashes(opened.project.database(), {});
  if (!clashes) return clashes.error();
  std::vector<std::string> keys;
  for (const project::ListedClash& clash : *clashes)
    if (!clash.row.gone_run && (objects.contains({clash.row.a.file, clash.row.a.id}) ||
                                objects.contains({clash.row.b.file, clash.row.b.id})))
      keys.push_back(clash.row.key);
  return keys;
}

/// The results of the last run of these classes, without what is approved: as the run groups them.
struct OpenResults {
  clash::Findings findings;
  std::vector<std::vector<std::string>> keys;  ///< of each test and result; empty: none
};

Result<OpenResults> open_results(Session& session, OpenedProject& opened,
                                 const report::WrittenClasses& classes) {
  project::Database& database = opened.project.database();
  const Result<std::vector<project::ListedClash>> clashes = project::list_clashes(database, {});
  if (!clashes) return clashes.error();
  const Result<std::vector<std::string>> tests = project::last_tests(database);
  if (!tests) return tests.error();
  std::map<std::int64_t, const project::ListedClash*> by_row;
  for (const project::ListedClash& clash : *clashes) by_row.emplace(clash.row.id, &clash);
  OpenResults open;
  for (const std::string& name : *tests) {
    Result<std::optional<project::StoredTest>> test =
        project::read_test(database, name, session.context());
    if (!test) return test.error();
    if (!*test) continue;
    clash::Report report = std::move((**test).results.report);
    std::vector<clash::Pair> pairs = std::move(report.pairs);
    report.pairs.clear();
    std::vector<std::string>& keys = open.keys.emplace_back();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto row = by_row.find((**test).results.rows[i]);
      const project::ListedClash* const clash = row == by_row.end() ? nullptr : row->second;
      if (clash != nullptr && clash->status == report::DecisionStatus::approved) continue;
      if (!classes.has(pairs[i].cls) && !classes.has(pairs[i].severest)) continue;
      report.pairs.push_back(pairs[i]);
      keys.push_back(clash == nullptr ? std::string() : clash->row.key);
    }
    open.findings.tests.push_back(std::move(report));
  }
  return open;
}

/// Finds a group by its number in the order of the run, from 1 on, or by its id.
const clash::Group* find_group(const clash::Grouping& grouping, const std::string& wanted) {
  const auto by_id = std::ranges::find(grouping.groups, wanted, &clash::Group::id);
  if (by_id != grouping.groups.end()) return &*by_id;
  const std::optional<double> number = parse_number(wanted);
  for (std::size_t g = 0; g < grouping.groups.size(); ++g)
    if (number && *number == static_cast<double>(g + 1)) return &grouping.groups[g];
  return nullptr;
}

Result<std::vector<std::string>> keys_of_group(Session& session, OpenedProject& opened,
                                               const ClashSetOptions& given) {
  ClashOutputInput shown;
  shown.classes = given.classes;
  const Result<ClashOutput> output = clash_output(shown, {});
  if (!output) return output.error();
  const Result<OpenResults> open = open_results(session, opened, output->classes);
  if (!open) return open.error();
  const Result<model::Model> model = project_model(session, opened.project);
  if (!model) return model.error();
  for (const clash::Report& report : open->findings.tests)
    if (report.in_a.size() != model->objects.size())
      return Error{ErrorCode::usage, "the model changed since its clashes were grouped", "--group",
                   "run 'strake clash -p " + opened.file + "' first"};
  const Result<std::optional<clash::Grouping>> grouping =
      group(session, grouping_of(given), open->findings, *model, nullptr);
  if (!grouping) return grouping.error();
  const clash::Group* const wanted = find_group(**grouping, given.group);
  if (wanted == nullptr)
    return Error{ErrorCode::usage,
                 fmt::format("there is no group {}; there are {}", in_quotes(given.group),
                             (**grouping).groups.size()),
                 "--group",
                 "write the number or the id of a group, and the --group-by, --group-distance, "
                 "--group-contacts, --class and --sort of the run that showed it"};
  std::vector<std::string> keys;
  for (const clash::ResultRef& result : wanted->results)
    if (const std::string& key = open->keys[result.test][result.pair]; !key.empty())
      keys.push_back(key);
  return keys;
}

Result<std::vector<std::string>> keys_of(Session& session, OpenedProject& opened,
                                         const ClashSetOptions& given) {
  if (!given.select.empty()) return keys_by_selection(session, opened, given.select);
  if (!given.group.empty()) return keys_of_group(session, opened, given);
  return given.keys;
}

Result<ExitCode> run_set(Session& session, const ClashSetOptions& given) {
  if (const Status status = check(given); !status) return status.error();
  Result<OpenedProject> opened = open_project(session, given.project, project::Access::write);
  if (!opened) return opened.error();
  project::Database& database = opened->project.database();
  Result<project::Transaction> transaction = project::Transaction::begin(database);
  if (!transaction) return transaction.error();
  const Result<std::vector<std::string>> keys = keys_of(session, *opened, given);
  if (!keys) return keys.error();
  project::ClashDecision decision;
  decision.status = status_of(given.status);
  decision.comment = given.comment;
  decision.assignee = given.assignee;
  decision.by = given.by.empty() ? person() : given.by;
  decision.at = utc_time();
  const Result<std::uint64_t> changed = project::decide(database, *keys, decision);
  if (!changed) return changed.error();
  if (const Status status = transaction->commit(); !status) return status.error();
  session.console().note(
      fmt::format("{}: {} of {} clashes changed", opened->file, *changed, keys->size()));
  return ExitCode::done;
}

}  // namespace

Verb add_clash_set(CLI::App& clash, CommonOptions& common) {
  const auto options = std::make_shared<ClashSetOptions>();
  CLI::App* const command = clash.add_subcommand(
      "set", "Decide about clashes of a project: their status, a comment, who sees to them");
  command->add_option("keys", options->keys, "Keys of clashes, as results have them")
      ->type_name("KEY");
  add_project_options(*command, options->project);
  command
      ->add_option("--select", options->select,
                   "The clashes of the objects that this selection picks (docs/selection.md)")
      ->type_name("SELECTION");
  command
      ->add_option("--group", options->group,
                   "The clashes of this group of the last run: its number, or its id")
      ->type_name("N");
  add_choice(*command, "--group-by", options->grouping.group_by,
             {"element", "proximity", "test", "files", "assembly"},
             "What the groups are by (default element)");
  command
      ->add_option("--group-distance", options->grouping.group_distance,
                   "As of the run that showed the groups")
      ->type_name("LENGTH");
  command->add_flag("--group-contacts", options->grouping.group_contacts,
                    "As of the run that showed the groups");
  command->add_option("--class", options->classes, "As of the run that showed the groups")
      ->type_name("CLASS,...");
  add_choice(*command, "--sort", options->grouping.sort, {"depth", "volume", "size"},
             "As of the run that showed the groups (default depth)");
  add_choice(*command, "--status", options->status,
             {"new", "active", "reviewed", "approved", "resolved"},
             "What is decided (docs/statuses.md)");
  // An empty text is given, too: it takes back what was there.
  command
      ->add_option_function<std::string>(
          "--comment", [options](const std::string& text) { options->comment = text; },
          "Why; '' takes it back")
      ->type_name("TEXT|''");
  command
      ->add_option_function<std::string>(
          "--assignee", [options](const std::string& name) { options->assignee = name; },
          "Who sees to it; '' for nobody")
      ->type_name("NAME|''");
  command->add_option("--by", options->by, "Who decides (default: the user)")->type_name("NAME");
  add_common_options(*command, common);
  command->footer(R"(
A new run keeps what was decided. An approved clash comes back where it got deeper, of a severer class or has
more places (--deeper of 'strake clash'); what is gone becomes resolved, and what is found again new.

The number of a group is that of a run with the same --group-by, --group-distance, --group-contacts, --class
and --sort, as long as nothing more is approved: an approved clash is in no group. Ids of groups stay.

Examples:
  strake clash set -p ship.strake 0c8x2kq9w3e4r5t6y7v8b9n0mz --status approved --comment 'as agreed'
  strake clash set -p ship.strake --select 'path = "/HVAC/*"' --assignee Ann
  strake clash set -p ship.strake --group 3 --status reviewed --by Bob
  strake clash set -p ship.strake --group 3 --group-by assembly --class hit --status approved
  strake clash set -p ship.strake 0c8x2kq9w3e4r5t6y7v8b9n0mz --assignee '' --comment '')");
  return {command, [options](Session& session) { return run_set(session, *options); }};
}

}  // namespace strake::cli
