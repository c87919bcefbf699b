// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "strake/core/result.hpp"

namespace strake::sheets {

/// The next item of an XML text.
struct XmlEvent {
  enum class Kind : std::uint8_t { start, end, text, finish };
  Kind kind = Kind::finish;
  std::size_t line = 0;  ///< counted from 1
  std::string name;      ///< name of an element, with its prefix
  std::vector<std::pair<std::string, std::string>> attributes;  ///< values decoded
  std::string text;                                             ///< decoded
};

/// A pull parser for the XML of drawings: elements, attributes, text, CDATA; comments are skipped.
/// It expands only the five entities of XML and numeric character references; a document type, in
/// which others could be declared, is an error. So are text that is no UTF-8, elements that are not
/// closed in turn, an attribute given twice, a second root, processing instructions behind the
/// declaration, and nesting deeper than 200.
///
/// Errors: input, with "line 7" as their place.
class XmlReader {
 public:
  explicit XmlReader(std::string_view text);

  /// Returns the next event. An empty element gives a start and an end.
  [[nodiscard]] Result<XmlEvent> next();

 private:
  [[nodiscard]] Error fault(std::string message,
                            std::string mend = "save it again as plain SVG") const;
  [[nodiscard]] bool at(std::string_view what) const;
  bool skip_past(std::string_view end);
  void skip_blanks();
  void advance(std::size_t bytes);
  Status skip_declaration();
  Status skip_comments();
  Result<std::string> decoded(std::string_view raw) const;
  Result<std::string> name();
  Result<XmlEvent> element();
  Result<XmlEvent> end_tag();
  Result<XmlEvent> characters();

  std::string_view rest_;
  std::size_t line_ = 1;
  bool utf8_ = true, begun_ = false;
  bool close_ = false;  ///< the element begun last is empty: its end comes next
  std::vector<std::string> open_;
};

}  // namespace strake::sheets
