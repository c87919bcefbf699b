// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/clash/clash_profile.hpp"

#include <CLI/CLI.hpp>
#include <utility>
#include <vector>

#include "cli/options/options.hpp"
#include "rules/profiles.hpp"
#include "rules/rule_context.hpp"
#include "strake/core/diagnostics.hpp"

namespace strake::cli {

namespace {

constexpr const char* kNone = "none";

}  // namespace

void add_profile_option(CLI::App& command, std::string& profile) {
  std::vector<std::string> words;
  for (const rules::Profile& known : rules::profiles()) words.emplace_back(known.name);
  words.emplace_back(kNone);
  add_choice(command, "--profile", profile, words,
             "Leave out what is no clash in such a model, as parts of one equipment against each "
             "other, and count it; 'strake rules show plant' prints the rules (default none)")
      ->group("Rules")
      ->excludes(command.get_option("--rules"));
}

Result<std::optional<rules::Rules>> profile_rules(const std::string& profile) {
  const rules::Profile* const known = rules::find_profile(profile);
  if (known == nullptr) return std::optional<rules::Rules>();
  Result<rules::Rules> parsed = rules::Rules::parse(known->text, known->file());
  if (!parsed) return parsed.error();
  return std::optional(std::move(*parsed));
}

Status apply_profile(const rules::Rules& profile, const model::Scene& scene,
                     const parallel::Context& context, rules::Plan& plan) {
  Result<rules::Plan> applied = profile.plan(scene, context);
  if (!applied) return applied.error();
  plan.tests.front().policy = std::move(applied->tests.front().policy);
  for (const Diagnostic& diagnostic : applied->diagnostics.kept())
    if (diagnostic.code != rules::kMatchesNothing && diagnostic.code != rules::kShadowed)
      plan.diagnostics.add(diagnostic);
  return {};
}

}  // namespace strake::cli
