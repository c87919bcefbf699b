// SPDX-License-Identifier: Apache-2.0
// The lowest level of DXF: pairs of a group code and a value, a line each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace strake::drawing::dxf {

/// A number that names an object of the file; no two objects have the same.
using Handle = std::uint64_t;

/// Appends pairs of a group code and a value. It is a view of the text that it appends to.
class Groups {
 public:
  explicit Groups(std::string& out) : out_(&out) {}

  /// Appends text that is known to be safe; names from files go through value_text() before.
  Groups& text(int code, std::string_view value);
  Groups& whole(int code, std::int64_t value);
  Groups& handle(int code, Handle value);
  /// Appends the shortest text that reads back as the same number.
  Groups& number(int code, double value);
  /// Appends x and y under `code` and `code` + 10.
  Groups& point(int code, double x, double y);
  /// Appends x, y and 0.
  Groups& point_in_space(int code, double x, double y);

 private:
  void append_code(int code);
  std::string* out_;
};

/// The most bytes of a text in extended data.
inline constexpr std::size_t kMaxOfData = 255;
/// The most bytes of any other text, so that no program finds a line too long.
inline constexpr std::size_t kMaxOfText = 2000;

/// Returns a text that reads back as itself from one line of a file: what is no printable
/// character is U+FFFD, '^' and the backslash of "\U+" and "\M+" are written as readers unescape
/// them. What is longer than `limit` bytes is cut and ends in an ellipsis.
[[nodiscard]] std::string value_text(std::string_view text, std::size_t limit);

/// Returns value_text() of what TEXT shows as this text: the percent signs of "%%" are no commands.
[[nodiscard]] std::string shown_text(std::string_view text);

}  // namespace strake::drawing::dxf
