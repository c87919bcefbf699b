// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/clash/clash_sets.hpp"

#include <CLI/CLI.hpp>
#include <utility>

#include "clash/sets_by_file.hpp"
#include "cli/run/object_selection.hpp"

namespace strake::cli {

namespace {

/// Joins selections into one: each in brackets where there are several.
std::string joined(const std::vector<model::Selection>& selections) {
  if (selections.size() == 1) return selections.front().text();
  std::string text;
  for (const model::Selection& selection : selections)
    text += (text.empty() ? "(" : " or (") + selection.text() + ")";
  return text;
}

}  // namespace

void add_set_options(CLI::App& command, SetInput& options) {
  const auto set = [&](const char* name, std::vector<std::string>& texts, const char* help) {
    return may_repeat(command.add_option(name, texts, help))->type_name("SELECTION")->group("Sets");
  };
  CLI::Option* const a = set("--a", options.a,
                             "Set A: objects that this picks, as 'path = \"*/PIPING/*\"' or "
                             "'file = steel.rvm'; may be repeated (default: everything)");
  CLI::Option* const b =
      set("--b", options.b, "Set B, likewise; each pair of one of A and one of B is looked at");
  command.add_flag("--self", options.self, "Several files: pairs within one file too")
      ->group("Sets")
      ->excludes(a)
      ->excludes(b);
}

Result<SetRequest> set_request(const SetInput& input) {
  Result<std::vector<model::Selection>> a = parse_selections(input.a, "--a");
  if (!a) return a.error();
  Result<std::vector<model::Selection>> b = parse_selections(input.b, "--b");
  if (!b) return b.error();
  return SetRequest{std::move(*a), std::move(*b), input.self};
}

Result<ChosenSets> choose_sets(Session& session, const LoadedModel& loaded,
                               const SetRequest& request) {
  if (request.a.empty() && request.b.empty())
    return ChosenSets{
        request.self ? clash::one_set(loaded.scene) : clash::sets_by_file(*loaded.model), {}};
  ChosenSets chosen{clash::one_set(loaded.scene), {}};
  struct Side {
    const std::vector<model::Selection>& selections;
    std::vector<bool>& members;
    std::string& name;
    const char* option;
  };
  for (const Side& side : {Side{request.a, chosen.sets.in_a, chosen.sets.name_a, "--a"},
                           Side{request.b, chosen.sets.in_b, chosen.sets.name_b, "--b"}}) {
    if (side.selections.empty()) continue;
    Result<SelectedObjects> picked = pick_all(session, loaded.scene, side.selections);
    if (!picked) return picked.error();
    side.members = std::move(picked->any);
    side.name = joined(side.selections);
    for (const IdleSelection& idle : picked->idle)
      chosen.diagnostics.add(Severity::warning, "selection-picks-nothing",
                             idle.message + " (" + idle.mend + ")", side.option);
  }
  return chosen;
}

}  // namespace strake::cli
