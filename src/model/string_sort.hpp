// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

namespace strake::model {

/// Sorts indices by their texts, byte by byte as unsigned, equal texts by index. Returns true when
/// no two of the texts are equal. Errors: cancelled, out of memory.
///
/// Object ids share long beginnings (paths), and each comparison of two costs two cache misses. So
/// it sorts by eight bytes at a time, kept beside the indices, behind what all texts of a range
/// share; ranges that agree in their eight bytes are sorted by the next ones. All workers sort a
/// long range together, and short ones each by itself.
[[nodiscard]] Result<bool> sort_strings(std::span<const std::string_view> texts,
                                        std::span<std::uint32_t> order,
                                        const parallel::Context& context = {});

}  // namespace strake::model
