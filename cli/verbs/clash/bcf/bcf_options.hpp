// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "strake/core/result.hpp"
#include "strake/report/clash.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own name
class App;
}  // namespace CLI

namespace strake::cli {

/// What is said of BCF on the command line, as written.
struct BcfInput {
  std::string version, most, date, author;
  bool contacts = false;
};

void add_bcf_options(CLI::App& command, BcfInput& options);

/// Returns the form of BCF. Errors: usage for what is misspelt, and for an option where no BCF is
/// written.
[[nodiscard]] Result<report::BcfForm> bcf_form(const BcfInput& input, bool is_written);

}  // namespace strake::cli
