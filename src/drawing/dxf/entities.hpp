// SPDX-License-Identifier: Apache-2.0
// Entities of a DXF file: what is seen of a drawing, and the viewports that show it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "drawing/dxf/groups.hpp"
#include "strake/drawing/drawing.hpp"

namespace strake::drawing::dxf {

/// The space that an entity lies in. Here y points up.
enum class Space : std::uint8_t { model, paper };

/// A colour and a width that are not those of the layer.
struct EntityPen {
  model::Color color;
  double width_mm = 0;  ///< 0: that of the layer
};

/// What every entity says first.
struct EntityHead {
  Space space = Space::model;
  Handle handle = 0;
  std::string_view layer;
  double dash_stretch = 1;  ///< factor of the layer's dashes; 0: continuous
  Handle paper = 0;         ///< the block of the layout that it lies on; 0: the first
  std::optional<EntityPen> pen = std::nullopt;  ///< none: as its layer
};

void append_line(std::string& out, const EntityHead& head, const PaperPoint& a,
                 const PaperPoint& b);

/// Appends straight lines through points; closed where the last is the first. `dashed` lets the
/// dashes go on round corners.
void append_polyline(std::string& out, const EntityHead& head, std::span<const PaperPoint> points,
                     bool dashed);

void append_circle(std::string& out, const EntityHead& head, const PaperPoint& centre,
                   double radius);

/// Appends an arc against the clock, degrees from the x axis.
void append_arc(std::string& out, const EntityHead& head, const PaperPoint& centre, double radius,
                double from_deg, double to_deg);

/// Appends an elliptical arc against the clock. The parameters count from the major axis; 0 to 2π
/// is a whole ellipse.
void append_ellipse(std::string& out, const EntityHead& head, const PaperPoint& centre,
                    const PaperPoint& major, double ratio, double from_rad, double to_rad);

enum class TextAlign : std::uint8_t { start, middle, end };

/// How a text stands: a point of its base line, the height of a capital square to it, and by how
/// much it is turned about the point, degrees against the clock.
struct TextPlace {
  PaperPoint at;
  double height = 2.5;
  TextAlign align = TextAlign::start;
  double turn_deg = 0;
  double stretch = 1;   ///< how much wider it is than the font
  double lean_deg = 0;  ///< by how much its uprights lean to where it runs
  /// It runs to the other side, and all of it is as in a mirror beside the point, before it turns.
  bool mirrored = false;
};
void append_text(std::string& out, const EntityHead& head, const TextPlace& place,
                 std::string_view text);

/// Appends an area of one colour; the last point is not the first.
void append_filled(std::string& out, const EntityHead& head, std::span<const PaperPoint> points);

/// Appends an area in which nothing is seen of what was drawn before: a box with these corners.
struct CoverCorners {
  PaperPoint lower_left, lower_right, upper_left;
};
void append_cover(std::string& out, const EntityHead& head, const CoverCorners& corners);

/// A window of the paper into model space.
struct Viewport {
  PaperPoint centre;             ///< on paper
  double width = 0, height = 0;  ///< on paper, mm
  PaperPoint target;             ///< the point of model space in its middle
  double height_in_model = 0;
};

/// Appends a viewport. Number 1 is the paper itself; those that show views begin with 2.
void append_viewport(std::string& out, const EntityHead& head, const Viewport& viewport,
                     int number);

}  // namespace strake::drawing::dxf
