// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "strake/core/result.hpp"

namespace strake::cli {

/// Has Python's strake.cluster do what a command line requests: it takes the place of the program,
/// with its terminal, Ctrl-C and exit code. `words` are those of the command line behind the
/// program's name. Returns only where Python cannot be started: usage.
[[nodiscard]] Error go_on_cluster(std::span<char* const> words);

}  // namespace strake::cli
