// SPDX-License-Identifier: Apache-2.0
// The plane of a view: its axes, points and boxes on it, and the scale and sheet that suit a box.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/context.hpp"

namespace strake::drawing {

/// The eye of a view in perspective.
struct Eye {
  geometry::Vec3l at;      ///< grid units
  geometry::Vec3l target;  ///< grid units
  double distance_mm = 0;  ///< from the eye to the view's plane, which goes through the target
  double near_mm = 0;      ///< nearer points are taken to be as far away as this
};

/// The axes of a view's plane: unit vectors to the right, up and to the viewer, in the model.
struct PaperAxes {
  geometry::Vec3d right, up, toward;
  std::optional<Eye> eye = std::nullopt;  ///< in perspective

  /// Returns by what factor lengths at a point of the model, mm, grow in the view's plane: 1
  /// without an eye.
  [[nodiscard]] double magnification(const geometry::Vec3d& mm) const;
  /// Returns the parameter on a segment in the model of the point at parameter t of its projection.
  [[nodiscard]] double share_in_model(const geometry::Vec3d& a_mm, const geometry::Vec3d& b_mm,
                                      double t) const;
};

/// A point in the plane of a view, in millimetres of the model.
struct PlanePoint {
  double x = 0, y = 0;
  double toward = 0;  ///< larger is nearer to the viewer
  double magnification = 1;
};

/// The plane of a view about a point of the model. Points are made relative to it, or to the eye,
/// before they become doubles, so that a model in map coordinates loses no precision.
class ViewPlane {
 public:
  ViewPlane(const PaperAxes& axes, const geometry::Vec3l& origin);

  [[nodiscard]] PlanePoint operator()(const geometry::Vec3l& grid) const;

 private:
  [[nodiscard]] PlanePoint project(const geometry::Vec3l& grid) const;

  PaperAxes axes_;
  geometry::Vec3l from_;  ///< the eye, or the origin
  double x_ = 0, y_ = 0;  ///< coordinates of the origin
};

/// Returns how near to the viewer a segment is, larger is nearer: the same number for the same
/// depth, whatever else is drawn. It is the sum over both ends, exact but for one last rounding, in
/// grid units times the direction's length.
[[nodiscard]] double nearness(const geometry::Vec3l& direction, const geometry::Vec3l& a,
                              const geometry::Vec3l& b);

/// Returns the axes of a view; nothing when the direction is zero or up is parallel to it.
[[nodiscard]] std::optional<PaperAxes> paper_axes(const hlr::View& view);

/// A box on the plane of the view, in model millimetres.
struct PlaneBox {
  double left = 0, right = 0, bottom = 0, top = 0;
  [[nodiscard]] double width() const { return right - left; }
  [[nodiscard]] double height() const { return top - bottom; }
  void include(const PlaneBox& other) {
    left = std::min(left, other.left);
    right = std::max(right, other.right);
    bottom = std::min(bottom, other.bottom);
    top = std::max(top, other.top);
  }
};

/// The box that holds nothing, and that any other makes its own when it is included.
inline constexpr PlaneBox kNoPlaneBox{
    std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest(),
    std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};

/// Returns the square that a view in perspective shows of its plane, round the target, about a
/// point of the model; nothing for other views and for those without axes.
[[nodiscard]] std::optional<PlaneBox> field_of_view(const hlr::View& view,
                                                    const geometry::Vec3l& origin);

/// Returns the box of all that a finished run has within the limits, about a point of the model.
/// Errors: cancelled.
[[nodiscard]] Result<PlaneBox> plane_extent(const hlr::Drawing& drawing, const PaperAxes& axes,
                                            const geometry::Vec3l& origin,
                                            const parallel::Context& context);

/// Returns the usual scales of ISO 5455, 50:1 to 1:1000000000, the largest first.
[[nodiscard]] std::span<const double> usual_scales();

/// Returns the intermediate scale between a usual one and the next larger, where the two differ by
/// 2.5 and both reduce: 1:2.5 for 1:5, 1:25 for 1:50 … It is for what would leave half the room
/// empty both ways at the usual one (ISO 5455 has intermediate scales for exceptions).
[[nodiscard]] std::optional<double> intermediate_scale(double usual);

/// Returns a scale as text: "1:50", "2:1".
[[nodiscard]] std::string scale_text(double scale);

/// Returns the sheet on which a box of this size is drawn: the given paper; or else A3 where it
/// fits, otherwise the next A size, otherwise as large as it must be.
[[nodiscard]] Sheet choose_sheet(const PlaneBox& box, const LayoutOptions& options);

/// Returns nothing where a box fits its sheet; otherwise, as an error, by how much it does not, and
/// the largest scale that fits.
[[nodiscard]] Status check_fit(const PlaneBox& box, const Sheet& sheet,
                               const LayoutOptions& options);

/// Height of the strip at the foot of a sheet that holds the title, mm.
inline constexpr double kTitleStrip = 8;

/// How far beside the lines of a view in perspective its frame lies at most, mm.
inline constexpr double kFrameGapMm = 3;

/// Rounds to the nearest whole micrometre of paper.
[[nodiscard]] double rounded_paper(double mm);

}  // namespace strake::drawing
