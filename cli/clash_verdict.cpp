// SPDX-License-Identifier: Apache-2.0
#include "cli/clash_verdict.hpp"

#include <fmt/core.h>

#include <cstdint>
#include <string>
#include <vector>

#include "cli/console.hpp"
#include "strake/core/diagnostics.hpp"

namespace strake::cli {

namespace {

/// The least severe class that --fail-on names; NO_HIT: it is not given.
clash::Class failing_class(const std::string& fail_on) {
  if (fail_on == "hit") return clash::Class::hit;
  if (fail_on == "contact") return clash::Class::contact;
  return fail_on.empty() ? clash::Class::no_hit : clash::Class::clearance_violation;
}

/// Whether a result or a pair stops --fail-on; says how many only may be as bad. An object that
/// could not be read whole is in many models every night: it is told, and --strict stops at it.
bool has_failing_pair(const clash::Findings& findings, const std::string& fail_on,
                      Console& console) {
  const clash::Class worst = failing_class(fail_on);
  std::uint64_t surely = 0, perhaps = 0;
  const clash::NotComparedCounts lacks = clash::counts_of(findings.tests);
  for (const clash::Report& test : findings.tests)
    for (const clash::Pair& pair : test.pairs) {
      if (pair.allowed < 0 && pair.cls >= worst)
        ++surely;
      else if (pair.severest >= worst)
        ++perhaps;
    }
  if (perhaps > 0)
    console.say(
        fmt::format("--fail-on {}: {} that may be as bad as far as is known (UNCERTAIN), "
                    "besides {} that are",
                    fail_on, perhaps, surely));
  if (lacks.pairs > 0)
    console.say(fmt::format("--fail-on {}: pairs that could not be compared and may be as bad: {}",
                            fail_on, lacks.pairs));
  if (lacks.objects > 0)
    console.say(
        fmt::format("--fail-on {}: does not go by objects that could not be compared whole "
                    "(--strict does): {}",
                    fail_on, lacks.objects));
  return surely + perhaps + lacks.pairs > 0;
}

/// What of the run compared nothing at all, in words.
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

/// The disciplines without objects that a matrix checks against something, in words.
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

/// The only one, or of several the first and how many there are.
std::string first_of(const std::vector<std::string>& names) {
  return names.size() == 1 ? names.front()
                           : fmt::format("{}, first of {}", names.front(), names.size());
}

}  // namespace

ExitCode verdict(const clash::Findings& findings, const std::string& fail_on,
                 const InputOptions& input, const Loaded& loaded, Console& console) {
  const std::vector<std::string> tests = empty_tests(findings);
  if (!fail_on.empty()) {
    const bool fails = has_failing_pair(findings, fail_on, console);
    const std::string rest = unread_rest(*loaded.model);
    if (!rest.empty())
      console.warn(fmt::format("--fail-on {}: not everything was compared: {}", fail_on, rest));
    if (!tests.empty())
      console.warn(fmt::format("--fail-on {}: nothing was compared: {}", fail_on, first_of(tests)));
    if (fails || !tests.empty() || !rest.empty()) return ExitCode::clashes;
  }
  if (input.strict) {
    if (!tests.empty())
      console.warn(fmt::format("--strict: nothing was compared: {}", first_of(tests)));
    const std::vector<std::string> disciplines = empty_disciplines(findings);
    if (!disciplines.empty())
      console.warn(fmt::format("--strict: not everything was compared: {}", first_of(disciplines)));
    if (!tests.empty() || !disciplines.empty() || findings.all_diagnostics().skipped() > 0)
      return ExitCode::partial;
  }
  return outcome(input, loaded);
}

}  // namespace strake::cli
