// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/clash/clash_sets.hpp"

#include <CLI/CLI.hpp>
#include <cstddef>
#include <utility>

#include "cli/run/object_selection.hpp"

namespace strake::cli {

namespace {

/// Returns a file as a selection names it: always quoted, so that no letter of the label is a
/// pattern's.
std::string file_selection(const std::string& label) {
  std::string text = "file = '";
  for (const char c : label) {
    if (c == '*' || c == '?' || c == '[' || c == '\\') text += '\\';
    if (c == '\'') text += '\'';
    text += c;
  }
  return text + "'";
}

clash::Sets sets_by_file(const model::Model& model, bool self) {
  const std::size_t n = model.objects.size();
  clash::Sets sets;
  sets.in_a.assign(n, true);
  sets.in_b.assign(n, true);
  if (self || model.files.size() < 2) return sets;
  if (model.files.size() > 2) {
    for (const model::Object& object : model.objects) sets.group.push_back(object.file);
    for (const model::SourceFile& file : model.files)
      sets.group_names.push_back(Hasher().add(std::string_view(file.label)).value());
    sets.name_b = "* of another file";
    return sets;
  }
  for (std::size_t o = 0; o < n; ++o) {
    sets.in_a[o] = model.objects[o].file == 0;
    sets.in_b[o] = !sets.in_a[o];
  }
  sets.name_a = file_selection(model.files[0].label);
  sets.name_b = file_selection(model.files[1].label);
  return sets;
}

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
    return command.add_option(name, texts, help)
        ->type_name("SELECTION")
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->group("Sets");
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

Result<ChosenSets> choose_sets(Session& session, const Loaded& loaded, const SetRequest& request) {
  if (request.a.empty() && request.b.empty())
    return ChosenSets{sets_by_file(*loaded.model, request.self), {}};
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
    Result<Picked> picked = pick_all(session, loaded.scene, side.selections);
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
