// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cli/run/authorship.hpp"
#include "cli/run/object_selection.hpp"
#include "cli/run/project_input.hpp"
#include "cli/verbs/clash/bcf/bcf_review.hpp"
#include "cli/verbs/clash/clash_groups.hpp"
#include "cli/verbs/verb.hpp"
#include "core/number.hpp"
#include "core/text/counted.hpp"
#include "core/text_encoding.hpp"
#include "project/results/clash_queries.hpp"

namespace strake::cli {

namespace {

struct ClashSetOptions {
  ProjectOptions project;
  std::vector<std::string> keys, select;
  std::string group, status, by, bcf, prefer;
  std::optional<std::string> comment, assignee;
  ClashGroupingInput grouping;
};

/// A file that says what is decided about which clashes leaves nothing else to say.
Status check_bcf(const ClashSetOptions& given) {
  if (given.bcf.empty() && !given.prefer.empty())
    return Error{ErrorCode::usage, "no .bcf is read", "--prefer", "add --bcf FILE"};
  if (given.bcf.empty()) return {};
  const bool selects = !given.keys.empty() || !given.select.empty() || !given.group.empty() ||
                       !given.status.empty() || given.comment || given.assignee ||
                       given.grouping.first_given() != nullptr;
  if (selects)
    return Error{ErrorCode::usage, "a BCF file says what is decided about which clashes", "--bcf",
                 "leave out keys, --select, --group, --status, --comment and --assignee"};
  return {};
}

Status check(const ClashSetOptions& given) {
  if (given.project.file.empty())
    return Error{ErrorCode::usage, "no project is given", "-p", "write -p FILE"};
  if (const Status status = check_bcf(given); !status) return status;
  if (!given.bcf.empty()) return {};
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
  if (const char* const option = given.grouping.first_given(); option && given.group.empty())
    return Error{ErrorCode::usage, "no group is meant", option, "add --group"};
  return check(given.grouping);
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
  const Result<LoadedModel> loaded = load_project(session, opened, {});
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

/// Finds a group by its key, by its id or by its number in the order of the run, from 1 on.
const ProjectGroup* find_group(const std::vector<ProjectGroup>& groups, const std::string& wanted) {
  for (const auto text : {&ProjectGroup::key, &ProjectGroup::id})
    if (const auto at = std::ranges::find(groups, wanted, text); at != groups.end()) return &*at;
  const std::optional<double> number = parse_number(wanted);
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (number && *number == static_cast<double>(g + 1)) return &groups[g];
  return nullptr;
}

Result<std::vector<std::string>> keys_of_group(Session& session, OpenedProject& opened,
                                               const ClashSetOptions& given) {
  const Result<std::vector<ProjectGroup>> groups =
      groups_of_last_run(session, opened, given.grouping);
  if (!groups) return groups.error();
  const ProjectGroup* const wanted = find_group(*groups, given.group);
  if (wanted == nullptr)
    return Error{ErrorCode::usage,
                 fmt::format("there is no group {} in the last run; there are {}",
                             in_quotes(given.group), groups->size()),
                 "--group",
                 "'strake clash list --groups' shows them; where others were meant, write the "
                 "--group-by, --group-distance, --group-contacts, --class and --sort that showed "
                 "them"};
  session.console().note(fmt::format("group {}: {}, key {}", wanted - groups->data() + 1,
                                     in_quotes(wanted->name), wanted->key));
  return wanted->clashes;
}

Result<std::vector<std::string>> keys_of(Session& session, OpenedProject& opened,
                                         const ClashSetOptions& given) {
  if (!given.select.empty()) return keys_by_selection(session, opened, given.select);
  if (!given.group.empty()) return keys_of_group(session, opened, given);
  return given.keys;
}

Result<ExitCode> run_set(Session& session, const ClashSetOptions& given) {
  if (const Status status = check(given); !status) return status.error();
  if (!given.bcf.empty())
    if (const Status status = session.files().add_input(given.bcf); !status) return status.error();
  Result<OpenedProject> opened = open_project(session, given.project, project::Access::write);
  if (!opened) return opened.error();
  if (!given.bcf.empty()) {
    const Status status = take_bcf(session, *opened, {given.bcf, given.by, given.prefer == "bcf"});
    if (!status) return status.error();
    return ExitCode::done;
  }
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
  session.console().note(fmt::format("{}: {} of {} changed", opened->file, *changed,
                                     counted(keys->size(), "clash", "clashes")));
  return ExitCode::done;
}

}  // namespace

Verb add_clash_set(CLI::App& clash, CommonOptions& common) {
  const auto options = std::make_shared<ClashSetOptions>();
  CLI::App* const command = clash.add_subcommand(
      "set", "Decide about clashes of a project: their status, a comment, who sees to them");
  command->add_option("keys", options->keys, "Keys of clashes, as results have them")
      ->type_name("KEY");
  add_project_options(*command, options->project,
                      "The project whose clashes are decided about (docs/project.md)");
  command
      ->add_option("--select", options->select,
                   "The clashes of the objects that this selection picks (docs/selection.md)")
      ->type_name("SELECTION");
  command
      ->add_option("--group", options->group,
                   "The clashes of this group of the last run: its key ('strake clash list "
                   "--groups'), its id, or its number in the report of that run")
      ->type_name("GROUP");
  add_grouping_options(*command, options->grouping);
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
  command
      ->add_option("--bcf", options->bcf,
                   "Statuses, assignees and comments of this BCF 2.1 or 3.0, which came back from "
                   "another program (docs/bcf.md)")
      ->type_name("FILE");
  add_choice(*command, "--prefer", options->prefer, {"project", "bcf"},
             "What counts where the two decided otherwise (default project)");
  command->add_option("--by", options->by, "Who decides (default: the user)")->type_name("NAME");
  add_common_options(*command, common);
  command->footer(R"(
A new run keeps what was decided. An approved clash comes back where it got deeper, of a severer class or has
more places (--deeper of 'strake clash'); what is gone becomes resolved, and what is found again new.

Groups are those that the last run reported, whatever was decided since, and numbers are those of its report. The
key of a group is made of its clashes: it never means others, in a later run neither.

Examples:
  strake clash set -p ship.strake 0c8x2kq9w3e4r5t6y7v8b9n0mz --status approved --comment 'as agreed'
  strake clash set -p ship.strake --select 'path = "/HVAC/*"' --assignee Ann
  strake clash set -p ship.strake --group 3 --status reviewed --by Bob
  strake clash set -p ship.strake --group 3 --group-by assembly --class hit --status approved
  strake clash set -p ship.strake --bcf back.bcf
  strake clash set -p ship.strake --group 4dy8m2x6p0b3hq7t1v9wz5kcne --status approved
  strake clash set -p ship.strake 0c8x2kq9w3e4r5t6y7v8b9n0mz --assignee '' --comment '')");
  return {command, [options](Session& session) { return run_set(session, *options); }};
}

}  // namespace strake::cli
