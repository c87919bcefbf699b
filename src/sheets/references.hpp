// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "strake/core/result.hpp"

namespace strake::sheets {

/// The names of elements that a value or a style sheet refers to as url(#name).
[[nodiscard]] std::vector<std::string> url_targets(std::string_view text);

/// Which elements of a template draw which others, by `use`, patterns, markers and the like: a few
/// lines that draw each other in a circle, or each twice the one before, would keep whoever opens
/// the sheet busy for ever.
class References {
 public:
  /// An element within the one that is open; `id` is empty where it has none.
  void open(std::string_view name, std::string_view id);
  void close() { open_.pop_back(); }
  /// From the element that is open.
  void refer(std::string target, std::size_t line);
  /// From a style sheet, which may speak for any element.
  void refer_in_style(std::string target, std::size_t line);

  /// Once the outermost element is closed. Errors: input, with "line 7" as their place.
  [[nodiscard]] Status check() const;

 private:
  struct Reference {
    std::string target;
    std::size_t line = 0;
  };
  struct Element {
    std::string id;
    bool is_gradient = false;  ///< which draws nothing
    std::vector<std::uint32_t> children;
    std::vector<Reference> references;
  };

  class Walk;

  std::vector<Element> elements_;  ///< the outermost first
  std::vector<std::uint32_t> open_;
  std::vector<Reference> in_style_;
};

}  // namespace strake::sheets
