// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/parallel/detail/function_ref.hpp"

namespace strake::sheets {

/// A text, and the name of what follows it; the last piece of a text names nothing.
struct TextPiece {
  std::string text, name;
};

/// "scale {{scale}}" in pieces. Errors: usage, where a {{ is not closed or names nothing.
[[nodiscard]] Result<std::vector<TextPiece>> split_placeholders(std::string_view text);

/// What a name stands for.
using Lookup = parallel::FunctionRef<std::string(const std::string& name)>;

[[nodiscard]] std::string fill_placeholders(const std::vector<TextPiece>& pieces, Lookup lookup);

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

/// Frame and title block as a user draws them: the elements of an SVG, written anew, with the
/// fields that texts name as {{field}}.
///
/// What is not drawing has no place in it and is an error: scripts, handlers of events, what is
/// fetched from elsewhere, HTML, animation. Metadata and elements of other namespaces, as editors
/// leave them, are passed over.
struct Template {
  double width_mm = 0, height_mm = 0;
  std::string view_box;           ///< four numbers
  std::vector<TextPiece> pieces;  ///< XML text, and fields in between

  /// Each once, in the order of the template.
  [[nodiscard]] std::vector<std::string> fields() const;
};

/// Errors: input, with "line 7" as their place.
[[nodiscard]] Result<Template> parse_template(std::string_view svg);

}  // namespace strake::sheets
