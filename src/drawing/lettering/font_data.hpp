// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace strake::drawing {

/// Returns the bytes of the font that drawings carry with them: DejaVu Sans, a TrueType file, as it
/// was put into the library (cmake/drawing_font.cmake).
[[nodiscard]] std::string_view font_data();

}  // namespace strake::drawing
