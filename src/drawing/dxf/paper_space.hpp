// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drawing/dxf/entities.hpp"
#include "drawing/dxf/groups.hpp"
#include "drawing/dxf/layer_style.hpp"
#include "strake/drawing/drawing.hpp"

namespace strake::drawing::dxf {

/// The entities of a sheet: viewports, and what is drawn beside them. Points are given as they lie
/// on a drawing's sheet, with y downwards; layers by their numbers.
class PaperSpace {
 public:
  /// `block` is that of its layout; handles of entities count from `first`, the paper itself.
  PaperSpace(const PaperSize& size, std::span<const LayerStyle> layers, std::size_t viewport_layer,
             Handle block, Handle first);

  /// Gives what is added from now on a pen of its own; none: that of its layer.
  void use_pen(std::optional<EntityPen> pen) { pen_ = pen; }

  void add_viewport(const PaperFrame& window, const PaperPoint& target, double scale);
  /// Points joined by straight lines; closed when the last is the first.
  void add_lines(std::size_t layer, std::span<const PaperPoint> points);
  void add_filled(std::size_t layer, std::span<const PaperPoint> points);
  void add_circle(std::size_t layer, const PaperPoint& centre, double radius_mm);
  void add_text(std::size_t layer, const TextPlace& place, std::string_view text);
  /// Covers what was added before.
  void add_cover(std::size_t layer, const CoverCorners& corners);

  [[nodiscard]] const std::string& text() const { return text_; }
  /// The first handle that is free.
  [[nodiscard]] Handle next() const { return next_; }

 private:
  [[nodiscard]] EntityHead head(std::size_t layer);
  [[nodiscard]] PaperPoint up(const PaperPoint& p) const;
  [[nodiscard]] std::vector<PaperPoint> all_up(std::span<const PaperPoint> points) const;

  double height_mm_;
  Handle block_;
  std::span<const LayerStyle> layers_;
  std::size_t viewport_layer_;
  std::string text_;
  Handle next_;
  int viewports_ = 1;
  std::optional<EntityPen> pen_;
};

}  // namespace strake::drawing::dxf
