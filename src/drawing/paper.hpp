// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::drawing {

/// The plane of a view: unit vectors to the right, up and to the viewer, in the model.
struct PaperAxes {
  geometry::Vec3d right, up, toward;
};

/// Nothing when the direction is zero or up is parallel to it.
[[nodiscard]] std::optional<PaperAxes> paper_axes(const hlr::View& view);

/// A box on the plane of the view, in model millimetres.
struct PlaneBox {
  double left = 0, right = 0, bottom = 0, top = 0;
  [[nodiscard]] double width() const { return right - left; }
  [[nodiscard]] double height() const { return top - bottom; }
};

/// The box of all that a finished run has within the limits, about a point of the model.
[[nodiscard]] PlaneBox plane_extent(const hlr::Drawing& drawing, const PaperAxes& axes,
                                    const geometry::Vec3l& origin);

/// "1:50", "2:1".
[[nodiscard]] std::string scale_text(double scale);

/// The sheet on which a box of this size is drawn: A3 where it fits, otherwise the next A size,
/// otherwise as large as it must be.
[[nodiscard]] Sheet choose_sheet(const PlaneBox& box, const LayoutOptions& options);

/// Height of the strip at the foot of a sheet that holds the title, mm.
inline constexpr double kTitleStrip = 8;

/// The nearest whole micrometre of paper.
[[nodiscard]] double rounded_paper(double mm);

}  // namespace strake::drawing
