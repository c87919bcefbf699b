// SPDX-License-Identifier: Apache-2.0
#include "sheets/arrangement/grid_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "drawing/layout/view_plane.hpp"
#include "sheets/spec/text_metrics.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::sheets {

namespace {

using drawing::rounded_paper;

constexpr double kOverhang = 4, kLettersMm = 2.5, kWidestBubble = 7, kApart = 1;

geometry::Vec3l axis_vector(std::uint8_t axis) {
  geometry::Vec3l v;
  v[axis] = 1;
  return v;
}

/// The grid lines across one axis in one view.
class AxisLines {
 public:
  AxisLines(const GridSpec& grid, std::uint8_t axis, const hlr::View& view)
      : grid_(grid), axis_(axis) {
    const auto axes = drawing::paper_axes(view);
    const geometry::Vec3d e = axis_vector(axis).as<double>();
    if (axes) along_ = {dot(axes->right, e), -dot(axes->up, e)};
    for (const GridPlane& plane : grid.planes)
      if (plane.axis == axis) widest_ = std::max(widest_, text_width(plane.label) * kLettersMm);
  }

  /// Returns whether labels stand at the upper ends; otherwise they stand at the left ones.
  [[nodiscard]] bool upright() const { return std::fabs(along_.x) >= std::fabs(along_.y); }
  [[nodiscard]] double radius() const { return std::max(3.5, widest_ / 2 + 0.5); }
  [[nodiscard]] bool bubbles() const { return radius() <= kWidestBubble; }
  /// Returns how far a label reaches beyond the end of its line.
  [[nodiscard]] double reach() const {
    if (bubbles()) return 2 * radius();
    return upright() ? kLettersMm + 1 : widest_ + 1;
  }

  void draw(const drawing::Placement& placement, const PaperBox& box, const PaperBox& dimensioned,
            GridMarks& out) const {
    std::vector<Line> lines;
    std::size_t number = 0;
    for (std::size_t p = 0; p < grid_.planes.size(); ++p) {
      if (grid_.planes[p].axis != axis_) continue;
      if (auto line = line_of(grid_.planes[p], placement, box, dimensioned)) {
        line->number = number;
        out.drawn[p] = true;
        lines.push_back(std::move(*line));
      }
      ++number;
    }
    const std::size_t step = step_of(lines);
    for (const Line& line : lines) {
      out.marks.paths.push_back({LineClass::grid, {line.head, line.tail}, false});
      if (line.number % step != 0)
        ++out.unlabelled;
      else
        label(line, out.marks);
    }
  }

 private:
  struct Line {
    PaperPoint head, tail;
    const std::string* text = nullptr;
    std::size_t number = 0;
  };

  /// Returns the part of the line within the larger box and its overhang; nothing where it misses
  /// the box of the view's lines.
  [[nodiscard]] std::optional<Line> line_of(const GridPlane& plane,
                                            const drawing::Placement& placement,
                                            const PaperBox& box,
                                            const PaperBox& dimensioned) const {
    const auto at = geometry::snap(plane.at_mm);
    if (!at) return std::nullopt;
    const auto steps = static_cast<double>(*at - placement.anchor[axis_]);
    const double away = steps / geometry::kGridPerMm / placement.sheet.scale;
    const PaperPoint on{placement.at.x + along_.x * away, placement.at.y + along_.y * away};
    // The direction from the tail to the head: upwards, or to the left.
    PaperPoint way{along_.y, -along_.x};
    if (upright() ? way.y > 0 : way.x > 0) way = {-way.x, -way.y};
    const double little = 0.01;
    if (!clipped(on, way, box, little)) return std::nullopt;
    const auto ends = clipped(on, way, dimensioned, kOverhang);
    if (!ends) return std::nullopt;
    const auto point = [&](double t) {
      return PaperPoint{rounded_paper(on.x + way.x * t), rounded_paper(on.y + way.y * t)};
    };
    return Line{point(ends->second), point(ends->first), &plane.label, 0};
  }

  /// Returns where a line enters and leaves a box that is widened by a margin.
  static std::optional<std::pair<double, double>> clipped(const PaperPoint& on,
                                                          const PaperPoint& way,
                                                          const PaperBox& box, double wider) {
    double from = -1e9, to = 1e9;
    const auto side = [&](double p, double w, double lo, double hi) {
      if (std::fabs(w) < 1e-12) return lo <= p && p <= hi;
      const double a = (lo - p) / w, b = (hi - p) / w;
      from = std::max(from, std::min(a, b));
      to = std::min(to, std::max(a, b));
      return from <= to;
    };
    if (!side(on.x, way.x, box.left - wider, box.right + wider) ||
        !side(on.y, way.y, box.top - wider, box.bottom + wider))
      return std::nullopt;
    return std::pair(from, to);
  }

  [[nodiscard]] PaperBox label_box(const Line& line) const {
    if (bubbles()) {
      const double r = radius();
      const PaperPoint c = center(line);
      return {c.x - r, c.y - r, c.x + r, c.y + r};
    }
    return box_of(text_of(line));
  }

  [[nodiscard]] PaperPoint center(const Line& line) const {
    const double dx = line.head.x - line.tail.x, dy = line.head.y - line.tail.y;
    const double length = std::sqrt(dx * dx + dy * dy);
    const double r = length > 0 ? radius() / length : 0;
    return {rounded_paper(line.head.x + dx * r), rounded_paper(line.head.y + dy * r)};
  }

  [[nodiscard]] Text text_of(const Line& line) const {
    Text text{LineClass::grid_label, line.head, kLettersMm, Align::middle, *line.text, false};
    if (bubbles()) {
      text.at = center(line);
      text.at.y = rounded_paper(text.at.y + kLettersMm / 2);
    } else if (upright()) {
      text.at.y -= 1;
    } else {
      text.at = {text.at.x - 1, rounded_paper(text.at.y + kLettersMm / 2)};
      text.align = Align::end;
    }
    return text;
  }

  void label(const Line& line, Marks& marks) const {
    if (bubbles()) marks.circles.push_back({LineClass::grid_label, center(line), radius()});
    marks.texts.push_back(text_of(line));
  }

  /// Returns the step n for which every nth label keeps clear of the others.
  [[nodiscard]] std::size_t step_of(const std::vector<Line>& lines) const {
    for (std::size_t decade = 1;; decade *= 10)
      for (const std::size_t digit : {1U, 2U, 5U}) {
        const std::size_t step = decade * digit;
        if (clear(lines, step) || step > lines.size() * 10 + grid_.planes.size()) return step;
      }
  }

  [[nodiscard]] bool clear(const std::vector<Line>& lines, std::size_t step) const {
    const Line* last = nullptr;
    // Sorted along the axis, whatever the order of the file.
    std::vector<const Line*> kept;
    for (const Line& line : lines)
      if (line.number % step == 0) kept.push_back(&line);
    const auto place = [&](const Line* l) { return upright() ? l->head.x : l->head.y; };
    std::sort(kept.begin(), kept.end(), [&](const Line* a, const Line* b) {
      return std::pair(place(a), a->number) < std::pair(place(b), b->number);
    });
    for (const Line* line : kept) {
      if (last != nullptr) {
        PaperBox box = label_box(*last);
        box.right += kApart;
        box.bottom += kApart;
        if (box.overlaps(label_box(*line))) return false;
      }
      last = line;
    }
    return true;
  }

  const GridSpec& grid_;
  std::uint8_t axis_;
  PaperPoint along_{1, 0};  ///< direction of the axis on paper
  double widest_ = 0;
};

}  // namespace

bool shows_grid(const GridSpec& grid, const ViewSpec& view, std::uint8_t axis) {
  const bool named = grid.views.empty() ||
                     std::find(grid.views.begin(), grid.views.end(), view.name) != grid.views.end();
  // In perspective a plane is a line only where the eye lies in it.
  return named && !view.view.perspective && dot(view.view.direction, axis_vector(axis)) == 0 &&
         std::any_of(grid.planes.begin(), grid.planes.end(),
                     [&](const GridPlane& p) { return p.axis == axis; });
}

GridMargin grid_margin(const GridSpec& grid, const ViewSpec& view) {
  GridMargin rim;
  for (std::uint8_t axis = 0; axis < 3; ++axis) {
    if (!shows_grid(grid, view, axis)) continue;
    const AxisLines lines(grid, axis, view.view);
    double& side = lines.upright() ? rim.top_mm : rim.left_mm;
    side = std::max(side, kOverhang + lines.reach());
    rim.other_mm = kOverhang;
  }
  return rim;
}

GridMarks grid_marks(const GridSpec& grid, const ViewSpec& view,
                     const drawing::Placement& placement, const PaperBox& lines,
                     const PaperBox& dimensioned) {
  GridMarks out{{}, std::vector<bool>(grid.planes.size()), 0};
  for (std::uint8_t axis = 0; axis < 3; ++axis)
    if (shows_grid(grid, view, axis))
      AxisLines(grid, axis, view.view).draw(placement, lines, dimensioned, out);
  return out;
}

}  // namespace strake::sheets
