// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace strake {

/// Whether a text has the form of 2026-01-31, whether or not there is such a day.
[[nodiscard]] bool is_day(std::string_view text);

/// Returns a date of XML and STEP (xs:dateTime; without a zone it is UTC) in UTC to the second, as
/// "2026-01-31T23:59:59Z"; nothing for any other text.
[[nodiscard]] std::optional<std::string> utc_of(std::string_view date);

/// Returns a date as C writes it ("Thu Jul 11 09:38:20 2013") in the same form, taken for UTC since
/// it says no zone; nothing for any other text.
[[nodiscard]] std::optional<std::string> utc_of_c_time(std::string_view date);

}  // namespace strake
