// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cli/evaluate/record.hpp"
#include "strake/parallel/context.hpp"

namespace strake::cli {

/// Returns what can be known of the machine and the program; what cannot stays empty.
[[nodiscard]] Machine this_machine();

/// Gives freed memory back and forgets the peak of the process so far; false where the system does
/// not allow it.
bool reset_peak_memory();
/// Returns the most memory that the process held since; 0: unknown.
[[nodiscard]] std::uint64_t peak_memory_since_reset();

/// Does a fixed amount of work on one core, for ratios that another machine understands: sorts
/// pseudo-random numbers. Returns the seconds that it took.
[[nodiscard]] double reference_seconds();

/// Does a fixed amount of work that any team shares perfectly: many pieces of equal length, each in
/// a cache of its own, and nothing between them. Returns the wall seconds that it took; with
/// another program on the same cores, or cores that are two threads of one, more than its part.
[[nodiscard]] double kernel_seconds(const parallel::Context& context);

}  // namespace strake::cli
