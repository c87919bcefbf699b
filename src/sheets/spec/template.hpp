// SPDX-License-Identifier: Apache-2.0
// Templates of sheets: placeholders in texts, references between SVG elements, and the parsed
// template.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/parallel/detail/function_ref.hpp"

namespace strake::sheets {

/// A text and the name of the placeholder that follows it; the last piece names nothing.
struct TextPiece {
  std::string text, name;
};

/// Splits a text such as "scale {{scale}}" into pieces. Errors: usage, where a {{ is not closed or
/// names nothing.
[[nodiscard]] Result<std::vector<TextPiece>> split_placeholders(std::string_view text);

/// Returns the value of a name.
using Lookup = parallel::FunctionRef<std::string(const std::string& name)>;

[[nodiscard]] std::string fill_placeholders(const std::vector<TextPiece>& pieces, Lookup lookup);

/// Returns the names of elements that a value or a style sheet refers to as url(#name).
[[nodiscard]] std::vector<std::string> url_targets(std::string_view text);

/// The references by which elements of a template draw others: `use`, patterns, markers and the
/// like. A few elements that draw each other in a circle, or each twice the one before, would keep
/// a viewer of the sheet busy for ever.
class References {
 public:
  /// Opens an element within the one that is open; `id` is empty where it has none.
  void open(std::string_view name, std::string_view id);
  void close() { open_.pop_back(); }
  /// Adds a reference from the element that is open.
  void refer(std::string target, std::size_t line);
  /// Adds a reference from a style sheet, which may apply to any element.
  void refer_in_style(std::string target, std::size_t line);

  /// Checks the references, once the outermost element is closed. Errors: input, with "line 7" as
  /// their place.
  [[nodiscard]] Status check() const;

 private:
  struct Reference {
    std::string target;
    std::size_t line = 0;
  };
  struct Element {
    std::string id;
    bool is_gradient = false;  ///< gradients draw nothing
    std::vector<std::uint32_t> children;
    std::vector<Reference> references;
  };

  class ReferenceVisitor;

  std::vector<Element> elements_;  ///< the outermost first
  std::vector<std::uint32_t> open_;
  std::vector<Reference> in_style_;
};

/// Frame and title block that a user has drawn: the elements of an SVG, written anew, with fields
/// that texts name as {{field}}.
///
/// Content that is no drawing is an error: scripts, handlers of events, external resources, HTML,
/// animation. Metadata and elements of other namespaces, as editors leave them, are skipped.
struct Template {
  double width_mm = 0, height_mm = 0;
  std::string view_box;           ///< four numbers
  std::vector<TextPiece> pieces;  ///< XML text with fields in between

  /// Returns the fields, each once, in the order of the template.
  [[nodiscard]] std::vector<std::string> fields() const;
};

/// Parses a template. Errors: input, with "line 7" as their place.
[[nodiscard]] Result<Template> parse_template(std::string_view svg);

}  // namespace strake::sheets
