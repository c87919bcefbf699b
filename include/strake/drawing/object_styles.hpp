// SPDX-License-Identifier: Apache-2.0
// Colours, pens and types of lines by discipline or system.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/model/model.hpp"

namespace strake::drawing {

/// How dashes and gaps follow each other.
struct LineType {
  std::vector<double> dashes;  ///< lengths of ink and gap by turns; empty: continuous
  bool in_widths = false;      ///< the lengths are widths of the pen, not millimetres
};

/// How the lines of some objects are drawn where that is not as those of all.
struct ObjectStyle {
  std::string name;                   ///< of its layer in files that have layers; empty: none
  std::optional<model::Color> color;  ///< of all its lines
  /// The width of its visible edges, mm of paper; its other lines are wider and narrower than these
  /// as they are of all objects.
  std::optional<double> pen_mm;
  std::optional<LineType> line;  ///< of visible lines; hidden ones stay dashed as all are
};

/// Which objects have which style.
class ObjectStyles {
 public:
  /// The number of lines that are drawn as those of all objects are; that of style s is s + 1.
  static constexpr std::size_t kPlain = 0;

  explicit ObjectStyles(std::size_t objects) : of_object_(objects) {}

  /// Gives the objects that are picked a style, but for those that have one: the first that picks
  /// an object holds for it. `picked` selects objects; empty: all.
  void add(ObjectStyle style, const std::vector<bool>& picked);

  [[nodiscard]] const std::vector<ObjectStyle>& all() const { return all_; }
  /// The style of a line is that of the object that the drawing gives it to. An intersection of an
  /// object without a style has that of the other object.
  [[nodiscard]] std::size_t number_of(const Line& line) const;
  [[nodiscard]] std::size_t number_of(model::ObjectId object) const {
    return of_object_[model::index(object)];
  }
  /// Returns how much wider or narrower the lines of a style are than those of all objects, where
  /// visible edges have this width.
  [[nodiscard]] double widening(std::size_t number, double edge_mm) const;

 private:
  std::vector<ObjectStyle> all_;
  std::vector<std::uint16_t> of_object_;
};

/// The most styles that one drawing has.
inline constexpr std::size_t kMaxObjectStyles = 1000;

/// The former name of kMaxObjectStyles.
[[deprecated("it is called kMaxObjectStyles")]] inline constexpr std::size_t kMostObjectStyles =
    kMaxObjectStyles;

/// Reads "#rrggbb". Errors: usage.
[[nodiscard]] Result<model::Color> parse_color(std::string_view text);

/// Reads "continuous", "dashed", "dash-dot", "dash-dot-dot" or "dotted", whose dashes are those of
/// ISO 128-2 in widths of the pen, or lengths of ink and gap by turns, "3mm 1mm". Errors: usage.
[[nodiscard]] Result<LineType> parse_line_type(std::string_view text);

/// Reads the width of a pen, "0.35mm". Errors: usage.
[[nodiscard]] Result<double> parse_pen_mm(std::string_view text);

/// A style, and the selection of those whose lines it is for, as it was written.
struct StyleText {
  ObjectStyle style;
  std::string selection;
};

/// Reads "name=PIPING,color=#c00000,pen=0.35mm,line=dashed: @discipline = PIPING", of which each
/// part before the colon may be left out. Errors: usage.
[[nodiscard]] Result<StyleText> parse_style(std::string_view text);

}  // namespace strake::drawing
