// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace strake {

// These functions convert numbers to text and back, independently of the locale.

/// Returns the shortest text that reads back as the same number: "0.1", "1e+30", "-2.5", "0" for
/// both zeros; "nan", "inf", "-inf".
[[nodiscard]] std::string shortest(double value);
void append_shortest(std::string& out, double value);

/// Returns text with exactly `decimals` digits after the point (0 to 17), correctly rounded; never
/// "-0.00".
[[nodiscard]] std::string fixed(double value, int decimals);
void append_fixed(std::string& out, double value, int decimals);

/// Parses the whole text as a finite number, a leading '+' allowed; returns nothing when it is
/// anything else.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// Parses the whole text as a whole number that fits; returns nothing when it is anything else.
[[nodiscard]] std::optional<long long> parse_integer(std::string_view text);

}  // namespace strake
