// SPDX-License-Identifier: Apache-2.0
// The axes of round primitives on paper, as far as lines run beside them.
#pragma once

// Decision 0081 says why lines beside an axis decide, and not its own visibility.

#include <span>
#include <vector>

#include "drawing/layout/view_plane.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/model/model.hpp"

namespace strake::drawing {

/// A straight part of an axis on paper. It may be drawn longer by `before` at a and by `after` at
/// b.
struct AxisPart {
  PaperPoint a, b;
  double before_mm = 0, after_mm = 0;
  model::ObjectId object{};
  bool cross = false;  ///< an arm of a cross
  double half_mm = 0;  ///< the radius of what it is the axis of; 0 of an arm
};

/// The middle of a bend on paper: points of its arc.
struct BendPart {
  std::vector<PaperPoint> points;
  model::ObjectId object{};
};

struct Axes2d {
  std::vector<AxisPart> parts;
  std::vector<BendPart> bends;
};

/// How far a centre line goes on beyond an outline of that diameter on paper, mm.
[[nodiscard]] double overhang_mm(double diameter_mm);

/// Where points of the model lie on paper, in a view without perspective.
class OrthographicPaper {
 public:
  /// `line` is any line of the drawing, whose two places tell where the paper lies.
  OrthographicPaper(const PaperAxes& axes, double scale, const Line& line)
      : axes_(axes), scale_(scale), from_mm_(line.a_mm), at_(line.a_paper) {}

  [[nodiscard]] PaperPoint point(const geometry::Vec3d& mm) const {
    const PaperPoint v = vector(mm - from_mm_);
    return {at_.x + v.x, at_.y + v.y};
  }
  [[nodiscard]] PaperPoint vector(const geometry::Vec3d& mm) const {
    return {dot(axes_.right, mm) / scale_, -dot(axes_.up, mm) / scale_};
  }
  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] const geometry::Vec3d& toward() const { return axes_.toward; }

 private:
  const PaperAxes& axes_;
  double scale_;
  geometry::Vec3d from_mm_;
  PaperPoint at_;
};

/// Appends the axes of an object that has these lines with ink.
void find_axes(const model::Model& model, std::span<const Line> lines,
               const OrthographicPaper& paper, double min_diameter_mm, Axes2d& out);

}  // namespace strake::drawing
