// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "strake/core/result.hpp"

namespace strake::sheets {

/// An element of a template, or a text within one (without a name).
struct SvgElement {
  std::string name, text;
  std::map<std::string, std::string, std::less<>> attributes;
  std::vector<std::size_t> children;  ///< indices of SvgElements::all

  /// Returns the value of an attribute; empty where there is none.
  [[nodiscard]] std::string_view value(std::string_view attribute) const;
};

/// The elements of a template as a tree.
struct SvgElements {
  std::vector<SvgElement> all;  ///< the root first
  std::map<std::string, std::size_t, std::less<>> by_id;
};

/// Parses elements as Sheet::Template has them. Errors: those of XmlReader.
[[nodiscard]] Result<SvgElements> parse_elements(std::string_view elements);

}  // namespace strake::sheets
