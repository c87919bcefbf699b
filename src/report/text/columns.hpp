// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace strake::report {

/// Returns how many columns of a terminal a character takes: two for those of East Asian scripts
/// and their full-width forms (wide and full-width by UAX #11, block by block), none for marks that
/// stand over or join others, else one.
[[nodiscard]] std::size_t columns_of(std::uint32_t code);

/// Returns how many columns a printable text takes.
[[nodiscard]] std::size_t columns_in(std::string_view text);

/// Return the text filled up with blanks behind or before it; a wider one stays as it is.
[[nodiscard]] std::string left_aligned(std::string text, std::size_t columns);
[[nodiscard]] std::string right_aligned(std::string text, std::size_t columns);

/// Returns the line without blanks at its end, with a line break.
[[nodiscard]] std::string ended(std::string line);

}  // namespace strake::report
