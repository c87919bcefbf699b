// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "strake/core/result.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own name
class App;
class ParseError;
}  // namespace CLI

namespace strake::cli {

/// Returns what is wrong with the command line that the program could not parse, and what to do, in
/// the words of this program rather than its parser's.
[[nodiscard]] Error usage_error(const CLI::App& program, const CLI::ParseError& error);

/// A command of the program with the words that lead to it: "strake clash diff".
struct FoundCommand {
  const CLI::App* command = nullptr;
  std::string path;
};

/// Returns the command that verbs lead to, the program itself where there are none. Errors: usage,
/// with the verb that is most like one that there is not.
[[nodiscard]] Result<FoundCommand> find_command(const CLI::App& program,
                                                const std::vector<std::string>& verbs);

}  // namespace strake::cli
