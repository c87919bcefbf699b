// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/clash/clash_result.hpp"

#include <fmt/core.h>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "cli/options/options.hpp"
#include "cli/output/console.hpp"
#include "core/text/counted.hpp"
#include "core/text_encoding.hpp"
#include "rules/clearances.hpp"
#include "strake/core/diagnostics.hpp"

namespace strake::cli {

namespace {

Result<clash::GroupRules> rules_of(const ClashResultInput& input) {
  clash::GroupRules rules;
  for (const clash::GroupBy by :
       {clash::GroupBy::element, clash::GroupBy::proximity, clash::GroupBy::test,
        clash::GroupBy::files, clash::GroupBy::assembly})
    if (name(by) == input.group_by) rules.by = by;
  rules.sort = sort_by(input.sort);
  rules.contacts = input.group_contacts;
  rules.apart = !input.group_distance.empty() && rules.by != clash::GroupBy::proximity;
  if (const Status status =
          length_option(rules.distance_mm, input.group_distance, "--group-distance");
      !status)
    return status.error();
  if (!(rules.distance_mm >= clash::kMinGroupDistanceMm))
    return Error{ErrorCode::usage, "'" + input.group_distance + "' is less than a millimetre",
                 "--group-distance", "give a length such as 3m"};
  return rules;
}

}  // namespace

void add_result_options(CLI::App& command, ClashResultInput& options) {
  constexpr const char* kGroup = "Result";
  add_choice(
      command, "--group-by", options.group_by,
      {"element", "proximity", "test", "files", "assembly"},
      "Group results: by the object that most of them share, by proximity, by test, by the files "
      "of the two or by what they are parts of: the nearest named equipment, branch or structure")
      ->group(kGroup);
  command
      .add_option("--group-distance", options.group_distance,
                  "Results no farther apart are one group (with --group-by proximity; default 3m); "
                  "groups by anything else are split by it")
      ->type_name("LENGTH")
      ->group(kGroup);
  command.add_flag("--group-contacts", options.group_contacts, "Put contacts into groups too")
      ->group(kGroup);
  add_choice(command, "--sort", options.sort, {"depth", "volume", "size"},
             "What comes first: the deepest (default), the largest common volume, or with "
             "--group-by the largest group")
      ->group(kGroup);
  command
      .add_option("--log-pairs", options.log_pairs,
                  "Write every pair that went to the detailed stage to this .csv: class (NO_HIT "
                  "too), whether a rule may allow it, and what it cost")
      ->type_name("FILE")
      ->group(kGroup);
  command.add_flag("--volumes", options.volumes, "Measure the volume that hits have in common")
      ->group(kGroup);
  command
      .add_option("--regions", options.regions,
                  fmt::format("Contact regions that are listed of a pair with several, the worst "
                              "first; all are counted (default {}; 0: none are searched for)",
                              clash::EngineOptions{}.max_regions))
      ->type_name("N")
      ->group(kGroup);
}

Status check(const ClashResultInput& input) {
  if (input.sort == "size" && input.group_by.empty())
    return Error{ErrorCode::usage, "only groups have a size", "--sort", "add --group-by"};
  if (input.group_contacts && input.group_by.empty())
    return Error{ErrorCode::usage, "there are no groups", "--group-contacts", "add --group-by"};
  if (!input.group_distance.empty() && input.group_by.empty())
    return Error{ErrorCode::usage, "there are no groups", "--group-distance",
                 "add --group-by proximity, or by what is to be split"};
  if (const Result<clash::GroupRules> rules = rules_of(input); !rules) return rules.error();
  return {};
}

std::size_t terminal_width() {
  constexpr std::size_t kDefault = 100, kMin = 40;
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kDefault;
  return std::max<std::size_t>(size.ws_col, kMin);
}

namespace {

/// Returns which of several tests, and of several files, a pair is from: names may repeat in each.
std::string where(const clash::Findings& findings, const clash::Report& test,
                  const clash::LoggedPair& pair, const model::Model& model) {
  std::string out;
  if (model.files.size() > 1) {
    const auto a = model.object(pair.a).file, b = model.object(pair.b).file;
    out = ", of " + model.files[a].label + (a == b ? "" : " and " + model.files[b].label);
  }
  return findings.tests.size() > 1 ? out + ", test '" + test.name + "'" : out;
}

}  // namespace

void count_work(Stats& stats, const std::vector<clash::Report>& tests) {
  clash::Counters sum;
  std::uint64_t allowed_other_regions = 0;
  for (const clash::Report& test : tests) {
    sum.candidate_pairs += test.counters.candidate_pairs;
    sum.allowed_pairs += test.counters.allowed_pairs;
    sum.part_pairs += test.counters.part_pairs;
    sum.triangle_pairs += test.counters.triangle_pairs;
    sum.exact_fallbacks += test.counters.exact_fallbacks;
    sum.depth_cells += test.counters.depth_cells;
    sum.volume_triangle_pairs += test.counters.volume_triangle_pairs;
    sum.volumes_given_up += test.counters.volumes_given_up;
    sum.regions_given_up += test.counters.regions_given_up;
    allowed_other_regions += test.count_allowed_regions;
  }
  const clash::NotComparedCounts lacks = clash::counts_of(tests);
  stats.count("candidate pairs", sum.candidate_pairs);
  stats.count("pairs that may be allowed", sum.allowed_pairs);
  stats.count("part pairs", sum.part_pairs);
  stats.count("triangle pairs", sum.triangle_pairs);
  stats.count("exact fall-backs", sum.exact_fallbacks);
  stats.count("depth cells", sum.depth_cells);
  stats.count("volume triangle pairs", sum.volume_triangle_pairs);
  stats.count("volumes given up", sum.volumes_given_up);
  stats.count("regions given up", sum.regions_given_up);
  stats.count("allowed places of others", allowed_other_regions);
  stats.count("pairs not compared", lacks.pairs);
  stats.count("objects not compared whole", lacks.objects);
}

void count_costs(Stats& stats, const clash::Findings& findings, const model::Model& model) {
  constexpr std::size_t kShown = 5;
  struct Costly {
    const clash::Report* test = nullptr;
    const clash::LoggedPair* pair = nullptr;
  };
  std::vector<Costly> costly;
  for (const clash::Report& test : findings.tests)
    for (const clash::LoggedPair& pair : test.log) costly.push_back({&test, &pair});
  const auto shown = static_cast<std::ptrdiff_t>(std::min(kShown, costly.size()));
  std::partial_sort(costly.begin(), costly.begin() + shown, costly.end(),
                    [](const Costly& l, const Costly& r) {
                      const auto *x = l.pair, *y = r.pair;
                      return std::tuple(y->cost(), x->a, x->b, l.test) <
                             std::tuple(x->cost(), y->a, y->b, r.test);
                    });
  costly.resize(static_cast<std::size_t>(shown));
  for (const auto& [test, pair] : costly)
    stats.costly(model.object(pair->a).id, model.object(pair->b).id,
                 where(findings, *test, *pair, model), pair->cost());
}

clash::SortBy sort_by(const std::string& word) {
  if (word == "volume") return clash::SortBy::volume;
  return word == "size" ? clash::SortBy::size : clash::SortBy::depth;
}

Result<std::optional<clash::Grouping>> group(Session& session, const ClashResultInput& input,
                                             const clash::Findings& findings,
                                             const model::Model& model,
                                             const report::DecidedResults* decided) {
  if (input.group_by.empty()) return std::optional<clash::Grouping>();
  const Result<clash::GroupRules> rules = rules_of(input);
  if (!rules) return rules.error();
  const auto timer = session.step("group");
  Result<clash::Grouping> grouping =
      group_results(findings, model, *rules, [&](const clash::ResultRef& r) {
        return decided != nullptr &&
               decided->is_settled(r.test, findings.tests[r.test].pairs[r.pair]);
      });
  if (!grouping) return grouping.error();
  return std::optional(std::move(*grouping));
}

namespace {

/// Returns the least severe class that --fail-on names; NO_HIT if it is not given.
clash::Class failing_class(const std::string& fail_on) {
  if (fail_on == "hit") return clash::Class::hit;
  if (fail_on == "contact") return clash::Class::contact;
  return fail_on.empty() ? clash::Class::no_hit : clash::Class::clearance_violation;
}

/// Whether a result or a pair stops --fail-on; says how many only may be as bad. An object that
/// could not be read whole is in many models every night: it is reported, and --strict stops at it.
bool has_failing_pair(const clash::Findings& findings, const FailingPairs& failing,
                      const std::string& fail_on, Console& console) {
  const auto& [surely, perhaps] = failing;
  const clash::NotComparedCounts lacks = clash::counts_of(findings.tests);
  if (perhaps > 0)
    console.note(
        fmt::format("--fail-on {}: {} that may be as bad as far as is known (UNCERTAIN), "
                    "besides {} that are",
                    fail_on, perhaps, surely));
  if (lacks.pairs > 0)
    console.note(fmt::format("--fail-on {}: pairs that could not be compared and may be as bad: {}",
                             fail_on, lacks.pairs));
  if (lacks.objects > 0)
    console.note(
        fmt::format("--fail-on {}: {} could not be fully compared; --fail-on ignores {} (add "
                    "--strict to fail)",
                    fail_on, counted(lacks.objects, "object"), lacks.objects == 1 ? "it" : "them"));
  return surely + perhaps + lacks.pairs > 0;
}

/// Returns in words what of the run compared nothing at all.
std::vector<std::string> empty_tests(const clash::Findings& findings) {
  std::vector<std::string> empty;
  for (const clash::Report& test : findings.tests) {
    const std::string of = test.name.empty() ? "" : fmt::format(" of test '{}'", test.name);
    if (test.objects_a == 0)
      empty.push_back(fmt::format("set A{} is empty ({})", of, test.set_a));
    else if (test.objects_b == 0)
      empty.push_back(fmt::format("set B{} is empty ({})", of, test.set_b));
  }
  return empty;
}

/// Returns in words the disciplines without objects that a matrix checks against something.
std::vector<std::string> empty_disciplines(const clash::Findings& findings) {
  std::vector<std::string> empty;
  for (const clash::Report& test : findings.tests) {
    std::vector<bool> checked(test.disciplines.size());
    for (const clash::CellReport& cell : test.cells)
      if (cell.checked) checked[cell.a] = checked[cell.b] = true;
    for (std::size_t d = 0; d < checked.size(); ++d)
      if (checked[d] && test.disciplines[d].objects == 0)
        empty.push_back(
            fmt::format("discipline '{}' of the matrix is empty", test.disciplines[d].name));
  }
  return empty;
}

/// Returns in words why clearances from an attribute are less than they request.
std::vector<std::string> lowered_clearances(const clash::Findings& findings) {
  std::vector<std::string> lowered;
  const Diagnostics diagnostics = findings.all_diagnostics();
  for (const Diagnostic& diagnostic : diagnostics.kept())
    if (diagnostic.code == rules::kNotALength || diagnostic.code == rules::kNoSuchAttribute)
      lowered.push_back(diagnostic.message);
  return lowered;
}

/// Returns the only name, or of several the first and how many there are.
std::string first_of(const std::vector<std::string>& names) {
  return names.size() == 1 ? names.front()
                           : fmt::format("{}, first of {}", names.front(), names.size());
}

/// Whether --strict stops at what was compared; prints why where standard output does not show it.
bool stops_strict(const clash::Findings& findings, const std::vector<std::string>& empty_tests,
                  Console& console) {
  bool stops = findings.all_diagnostics().skipped() > 0;
  const auto stop_at = [&](const char* what, const std::vector<std::string>& reasons) {
    if (reasons.empty()) return;
    stops = true;
    console.warn(fmt::format("--strict: {}: {}", what, first_of(reasons)));
  };
  stop_at("nothing was compared", empty_tests);
  stop_at("not everything was compared", empty_disciplines(findings));
  stop_at("not every clearance is as large as it was asked for", lowered_clearances(findings));
  return stops;
}

}  // namespace

FailingPairs failing_pairs(const clash::Findings& findings, const std::string& fail_on,
                           const report::DecidedResults* decided) {
  FailingPairs failing;
  if (fail_on.empty()) return failing;
  const clash::Class worst = failing_class(fail_on);
  for (std::size_t t = 0; t < findings.tests.size(); ++t) {
    const clash::Report& test = findings.tests[t];
    if (worst <= clash::Class::contact) failing.surely += test.unlisted.contacts;
    for (const clash::Pair& pair : test.pairs) {
      if (decided != nullptr && decided->is_settled(t, pair)) continue;
      if (pair.allowed < 0 && pair.cls >= worst)
        ++failing.surely;
      else if (pair.severest >= worst)
        ++failing.perhaps;
    }
  }
  return failing;
}

ExitCode clash_exit_code(const clash::Findings& findings, const FailingPairs& failing,
                         const std::string& fail_on, const InputOptions& input,
                         const LoadedModel& loaded, Console& console) {
  const std::vector<std::string> tests = empty_tests(findings);
  if (!fail_on.empty()) {
    const bool fails = has_failing_pair(findings, failing, fail_on, console);
    const std::string rest = unread_rest(*loaded.model);
    if (!rest.empty())
      console.warn(fmt::format("--fail-on {}: not everything was compared: {}", fail_on, rest));
    if (!tests.empty())
      console.warn(fmt::format("--fail-on {}: nothing was compared: {}", fail_on, first_of(tests)));
    if (fails || !tests.empty() || !rest.empty()) return ExitCode::check_failed;
  }
  if (input.strict && stops_strict(findings, tests, console)) return ExitCode::partial;
  return strict_exit_code(input, loaded);
}

}  // namespace strake::cli
