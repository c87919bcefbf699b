// SPDX-License-Identifier: Apache-2.0
// How elements of a template are painted: attributes, style attributes, style sheets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sheets/output/artwork/svg_element.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/detail/function_ref.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// What an element is painted with; lengths are in units of the drawing.
struct SvgStyle {
  std::optional<model::Color> fill = model::Color{0, 0, 0, 255}, stroke;
  double stroke_width = 1, miter_limit = 4, font_size = 16;
  std::vector<double> dashes;
  int cap = 0, join = 0;  ///< as PDF numbers them: butt, round, square; miter, round, bevel
  bool even_odd = false, shown = true;
  Align anchor = Align::start;
};

/// Takes what cannot be painted as it is said: "stroke: url(#blue)".
using ReportUnsupported = parallel::FunctionRef<void(const std::string& what)>;

/// The style sheets of a template. Selectors of one element are understood: a name, a class, an id,
/// a name with a class, `*`, and lists of these.
class StyleSheet {
 public:
  void add(std::string_view css, ReportUnsupported report);

  /// Returns the style of an element within another one: the attributes first, over them the style
  /// sheets, over them its own `style`.
  [[nodiscard]] SvgStyle style_of(const SvgElement& element, const SvgStyle& parent,
                                  ReportUnsupported report) const;

 private:
  struct Rule {
    std::string name, class_name, id;
    std::string declarations;
    std::uint32_t weight = 0;  ///< the rule with the largest holds, and of equals the last
    std::size_t order = 0;     ///< in which it was added
    [[nodiscard]] bool picks(const SvgElement& element) const;
  };
  void add_rule(std::string_view selector, std::string_view declarations, ReportUnsupported report);

  std::vector<Rule> rules_;  ///< by weight
};

}  // namespace strake::sheets
