// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0010 says what the first touch of memory costs.

#include <cstddef>

#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

namespace strake::parallel::detail {

/// Has the system provide memory that nobody has touched yet, by all workers at once: clearing
/// gigabytes takes one of them seconds. Does nothing where the memory is small. Errors: cancelled.
[[nodiscard]] Status provide_pages(const Context& context, void* memory, std::size_t bytes);

}  // namespace strake::parallel::detail
