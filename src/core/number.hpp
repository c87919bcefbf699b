// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace strake {

// Number text that does not depend on the locale, in either direction.

/// The shortest text that reads back as the same number: "0.1", "1e+30", "-2.5", "0" for both
/// zeros; "nan", "inf", "-inf".
[[nodiscard]] std::string shortest(double value);
void append_shortest(std::string& out, double value);

/// With exactly `decimals` digits after the point (0 to 17), correctly rounded; never "-0.00".
[[nodiscard]] std::string fixed(double value, int decimals);
void append_fixed(std::string& out, double value, int decimals);

/// The whole text as a finite number, a leading '+' allowed; nothing when it is anything else.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// The whole text as a whole number that fits; nothing when it is anything else.
[[nodiscard]] std::optional<long long> parse_integer(std::string_view text);

}  // namespace strake
