// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "strake/core/result.hpp"

namespace strake::serve {

/// Returns 160 bits of the system's random generator as 40 digits of base 16. Errors: internal
/// where it gives none.
[[nodiscard]] Result<std::string> make_secret();

/// Whether two texts are equal, in a time that does not show where they differ.
[[nodiscard]] bool is_secret(std::string_view given, std::string_view secret);

}  // namespace strake::serve
