// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "drawing/buffered_writer.hpp"
#include "strake/clash/clash.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/report/clash.hpp"

namespace strake::report {

using drawing::BufferedWriter;

/// Appends a JSON string with its quotes.
void append_json(std::string& out, std::string_view text);

/// Appends millimetres to a nanometre, without trailing zeros.
void append_mm(std::string& out, double mm);

/// Append millimetres rounded down or up, so that a bracket stays certain.
void append_mm_floor(std::string& out, double mm);
void append_mm_ceil(std::string& out, double mm);

/// Return the millionths that append_mm(), append_mm_floor() and append_mm_ceil() write: divided by
/// 10^6 they are the numbers that their texts read as. What does not fit becomes the outermost that
/// does, what is no number 0.
[[nodiscard]] std::int64_t millionths(double value);
[[nodiscard]] std::int64_t millionths_floor(double value);
[[nodiscard]] std::int64_t millionths_ceil(double value);

/// Append fields of a result with something between: the bounds of d, the coordinates of a point,
/// the names of the flags, each between quotes.
void append_range(std::string& out, double lower_mm, double upper_mm, std::string_view between);
void append_point(std::string& out, const geometry::Vec3d& mm, std::string_view between);
void append_flags(std::string& out, std::uint16_t flags, std::string_view between,
                  std::string_view quote);

/// Returns the name of a class for a column of a table.
[[nodiscard]] std::string_view short_class_name(clash::Class cls);

/// Returns the text in so many columns of a terminal, filled up with blanks; where it is wider, its
/// middle is left out. Control characters, those that change the direction of writing, and
/// bytes that are not UTF-8 become '?'.
[[nodiscard]] std::string fit_to_columns(std::string_view text, std::size_t columns);

}  // namespace strake::report
