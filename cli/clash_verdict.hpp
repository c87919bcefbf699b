// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/exit_code.hpp"
#include "cli/load.hpp"
#include "strake/clash/clash.hpp"

namespace strake::cli {

/// What the shell is told of a clash run, `fail_on` being --fail-on as written, empty if it is not
/// given. Says on standard error what standard output does not show of the reasons.
///
/// `clashes` where a result is, or may be as far as its brackets tell, of the class of --fail-on or
/// a worse one, where a pair was not compared, where a file ends early and where a test compared
/// nothing, as a set of it is empty. Else `partial` where --strict is given and something was
/// skipped, or a set or a discipline that a matrix checks is empty.
[[nodiscard]] ExitCode verdict(const clash::Findings& findings, const std::string& fail_on,
                               const InputOptions& input, const Loaded& loaded, Console& console);

}  // namespace strake::cli
