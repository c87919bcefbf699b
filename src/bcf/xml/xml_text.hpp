// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "strake/geometry/vec.hpp"

namespace strake::bcf {

/// Returns what people wrote, for people: printable() line by line, with blanks for tabs.
[[nodiscard]] std::string printable_lines(std::string_view text);

/// Returns what somebody wrote as it is compared with what came back: printable, with one blank for
/// each run of blanks and line ends, since some programs lay texts out anew.
[[nodiscard]] std::string compared_text(std::string_view text);

/// Returns a printable name of at most so many characters; the middle of a longer one is left out.
[[nodiscard]] std::string short_name(std::string_view name, std::size_t limit);

/// Writes XML with an element a line. Names of elements and attributes must last as long.
class XmlWriter {
 public:
  /// Begins the document with its root.
  explicit XmlWriter(std::string_view root);

  XmlWriter& begin(std::string_view name);
  /// Adds an attribute to the element that was begun last.
  XmlWriter& attribute(std::string_view name, std::string_view value);
  XmlWriter& end();
  /// Adds an element that has nothing but a text.
  XmlWriter& leaf(std::string_view name, std::string_view text);
  /// Writes a leaf, but nothing where the text is empty or blank: the schemas have it so.
  XmlWriter& leaf_if(std::string_view name, std::string_view text);
  /// Adds an element with X, Y and Z, the coordinates over `divisor`.
  XmlWriter& vector(std::string_view name, const geometry::Vec3d& v, double divisor);

  /// Ends what is open and returns the document.
  [[nodiscard]] std::string finish();

 private:
  void close_tag();
  void new_line();
  std::string out_;
  std::vector<std::string_view> open_;
  bool in_tag_ = false;
};

}  // namespace strake::bcf
