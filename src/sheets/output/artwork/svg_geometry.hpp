// SPDX-License-Identifier: Apache-2.0
// Numbers, transforms and paths of SVG, as paths of PDF in millimetres of the sheet.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "strake/drawing/drawing.hpp"

namespace strake::sheets {

/// Returns all numbers of a text, whatever blanks and commas are between them; nothing where it has
/// anything else.
[[nodiscard]] std::optional<std::vector<double>> svg_numbers(std::string_view text);

/// Returns a length in units of the drawing: a number, or one with px, mm, cm, in or pt; nothing
/// where it is anything else, as a percentage.
[[nodiscard]] std::optional<double> svg_length(std::string_view text);

/// x' = a x + c y + e, y' = b x + d y + f.
struct Affine {
  double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;

  [[nodiscard]] drawing::PaperPoint operator()(double x, double y) const {
    return {a * x + c * y + e, b * x + d * y + f};
  }
  /// Returns what first `inner` and then this does.
  [[nodiscard]] Affine after(const Affine& inner) const;
  /// By how much lengths grow, in the mean of all directions.
  [[nodiscard]] double scale() const;
};

/// Returns the transform that an attribute says; nothing where it is none.
[[nodiscard]] std::optional<Affine> svg_transform(std::string_view text);

/// Builds a path of PDF from the commands of SVG.
class PathBuilder {
 public:
  explicit PathBuilder(const Affine& to_paper) : to_paper_(to_paper) {}

  void move(double x, double y);
  void line(double x, double y);
  void curve(double x1, double y1, double x2, double y2, double x, double y);
  /// An arc of an ellipse with these half axes, turned by an angle in degrees.
  struct Arc {
    double rx = 0, ry = 0, turn_deg = 0;
    bool large = false, sweep = false;
  };
  void arc(const Arc& arc, double x, double y);
  void ellipse(double cx, double cy, double rx, double ry);
  void close();

  /// Appends what a `d` attribute says; false where it is damaged: it is drawn as far as it can be
  /// read, as SVG wants it.
  bool add(std::string_view d);

  [[nodiscard]] const std::string& operators() const { return out_; }
  /// Whether there is more than straight lines from one point to another, which have no inside:
  /// filling one would paint a hair of it.
  [[nodiscard]] bool has_inside() const { return has_inside_; }
  [[nodiscard]] double x() const { return x_; }
  [[nodiscard]] double y() const { return y_; }

 private:
  void go_to(double x, double y) { x_ = x, y_ = y; }

  Affine to_paper_;
  std::string out_;
  bool has_inside_ = false;
  int lines_ = 0;                     ///< of the part of the path
  double x_ = 0, y_ = 0;              ///< where the pen is
  double start_x_ = 0, start_y_ = 0;  ///< where the part of the path began
};

}  // namespace strake::sheets
