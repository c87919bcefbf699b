// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "strake/report/clash_document.hpp"

namespace strake::report {

// The members of a clash document that are small enough to be read as a whole. All throw
// DocumentFault.

/// The member `elements`: hashes in ascending order.
[[nodiscard]] std::vector<std::uint64_t> read_elements(std::string_view base64);

/// The member `sheets`: a byte for each of so many elements.
[[nodiscard]] std::vector<std::uint8_t> read_sheets(std::string_view base64, std::size_t elements);

/// The member `positional_ids`: a bit for each of so many elements.
[[nodiscard]] std::vector<std::uint8_t> read_positional_ids(std::string_view base64,
                                                            std::size_t elements);

/// The member `tests`, of a model with so many elements.
[[nodiscard]] std::vector<DocumentTest> read_tests(std::string_view json, std::size_t elements);

}  // namespace strake::report
