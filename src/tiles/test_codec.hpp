// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/rules/rules.hpp"

namespace strake::tiles {

/// Encodes a test over the objects of a tile. Errors: memory.
[[nodiscard]] Result<std::vector<std::byte>> encode_test(const rules::PlannedTest& test);

/// Decodes it; clash::detect() checks what it says of objects. Errors: input, by the name `what`.
[[nodiscard]] Result<rules::PlannedTest> decode_test(std::span<const std::byte> bytes,
                                                     std::size_t objects, const std::string& what);

}  // namespace strake::tiles
