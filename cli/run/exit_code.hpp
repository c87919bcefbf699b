// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/core/result.hpp"

namespace strake::cli {

/// What the program returns to the shell; scripts rely on the numbers.
enum class ExitCode : int {
  done = 0,
  check_failed = 1,  ///< clashes as severe as --fail-on says, or a verification that found a fault
  usage = 2,         ///< the command line makes no sense
  input = 3,         ///< a file cannot be read or written
  partial = 4,       ///< under --strict: done, but something was skipped
  internal = 5,      ///< a fault of the program itself
  memory = 6,        ///< out of memory
  cancelled = 130,
};

[[nodiscard]] constexpr ExitCode exit_code_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::usage:
      return ExitCode::usage;
    case ErrorCode::input:
    case ErrorCode::output:
      return ExitCode::input;
    case ErrorCode::cancelled:
      return ExitCode::cancelled;
    case ErrorCode::memory:
      return ExitCode::memory;
    case ErrorCode::internal:
      break;
  }
  return ExitCode::internal;
}

}  // namespace strake::cli
