// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"
#include "strake/rules/rules.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own name
class App;
}  // namespace CLI

/// Profiles: rules on top of the one test that a command line requests, whose sets and tolerances
/// stay as they are.
namespace strake::cli {

/// Adds --profile; this comes after --rules, which it excludes.
void add_profile_option(CLI::App& command, std::string& profile);

/// Returns the rules of a profile; none for "none" and where --profile is not given.
[[nodiscard]] Result<std::optional<rules::Rules>> profile_rules(const std::string& profile);

/// Gives the only test of a plan the rules of a profile. Which of them do nothing is not told: they
/// are for any model of the kind.
[[nodiscard]] Status apply_profile(const rules::Rules& profile, const model::Scene& scene,
                                   const parallel::Context& context, rules::Plan& plan);

}  // namespace strake::cli
