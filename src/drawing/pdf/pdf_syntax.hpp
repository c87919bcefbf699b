// SPDX-License-Identifier: Apache-2.0
// Numbers, texts and compressed bytes as PDF spells them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "strake/drawing/drawing.hpp"
#include "strake/model/model.hpp"

namespace strake::drawing {

/// Appends a number with up to `decimals` digits (9 at most) behind the point and no exponent,
/// which PDF does not know: "12.5", "-0.003".
void append_pdf_number(std::string& out, double value, int decimals = 6);
/// Appends a point of the sheet in micrometres, "12.5 -3.001 ": a blank follows each number.
void append_pdf_point(std::string& out, const PaperPoint& point);

/// Appends bytes as a string object in brackets.
void append_pdf_literal(std::string& out, std::string_view bytes);
/// Returns a text for people as a string object. Controls, bytes that are no UTF-8, and characters
/// that turn the direction of writing become U+FFFD.
[[nodiscard]] std::string pdf_text(std::string_view text);
/// Returns a colour as the three numbers of an operator, blanks between.
[[nodiscard]] std::string pdf_color(const model::Color& color);

/// Returns "12 0 R".
[[nodiscard]] std::string pdf_reference(std::uint32_t number);

/// Returns the bytes in the form of zlib, as FlateDecode reads them. Throws std::bad_alloc.
[[nodiscard]] std::string deflated(std::string_view bytes);

}  // namespace strake::drawing
