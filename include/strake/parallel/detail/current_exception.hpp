// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

#include "strake/core/result.hpp"

namespace strake::parallel::detail {

/// The exception that is being handled, as the error of an item of a region.
[[nodiscard]] Error error_of_current_exception(std::string_view region, std::size_t item) noexcept;
/// What a triggered stop token makes of a region.
[[nodiscard]] Error cancelled_error();

}  // namespace strake::parallel::detail
