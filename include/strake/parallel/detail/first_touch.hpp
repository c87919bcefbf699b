// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decisions 0010 and 0113 say what the first touch of memory costs.

#include <cstddef>

#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/detail/function_ref.hpp"

namespace strake::parallel::detail {

/// Whether so many values are worth being made by a team, and there is one.
[[nodiscard]] bool is_worth_a_team(const Context& context, std::size_t n, std::size_t size);

/// Calls make(begin, end), which must not throw, for runs of n values of a size that take about as
/// much memory each, by all workers. It is not cancelled, so that all is made or nothing. Errors:
/// out of memory, before anything is made.
[[nodiscard]] Status for_each_run_of_memory(const Context& context, std::size_t n, std::size_t size,
                                            FunctionRef<void(std::size_t, std::size_t)> make);

}  // namespace strake::parallel::detail
