// SPDX-License-Identifier: Apache-2.0
// The layers of a view: their order, and their lines object by object.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "drawing/layout/duplicates.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/deal.hpp"

namespace strake::drawing {

/// A layer of a view: the visible or the hidden lines of one kind.
struct Layer {
  bool hidden;
  hlr::EdgeKind kind;
  std::string_view label;
};

// Later layers are drawn over earlier ones: outlines last, and of these the outlines of cuts.
inline constexpr std::array<Layer, 18> kLayers = {{
    {true, hlr::EdgeKind::polyline, "Hidden polylines"},
    {true, hlr::EdgeKind::boundary, "Hidden boundary"},
    {true, hlr::EdgeKind::non_manifold, "Hidden non-manifold"},
    {true, hlr::EdgeKind::sharp, "Hidden sharp"},
    {true, hlr::EdgeKind::intersection, "Hidden intersections"},
    {true, hlr::EdgeKind::contour, "Hidden outline"},
    {true, hlr::EdgeKind::section, "Hidden section"},
    {true, hlr::EdgeKind::single_line, "Hidden single-line pipes"},
    {false, hlr::EdgeKind::hatch, "Hatch"},
    {false, hlr::EdgeKind::smooth, "Visible smooth"},
    {false, hlr::EdgeKind::polyline, "Visible polylines"},
    {false, hlr::EdgeKind::boundary, "Visible boundary"},
    {false, hlr::EdgeKind::non_manifold, "Visible non-manifold"},
    {false, hlr::EdgeKind::sharp, "Visible sharp"},
    {false, hlr::EdgeKind::intersection, "Visible intersections"},
    {false, hlr::EdgeKind::contour, "Visible outline"},
    {false, hlr::EdgeKind::single_line, "Single-line pipes"},
    {false, hlr::EdgeKind::section, "Visible section"},
}};

[[nodiscard]] inline bool belongs(const Line& line, const Layer& layer) {
  if (line.kind != layer.kind) return false;
  return layer.hidden ? is_hidden(line.state) : line.state == LineState::visible;
}

/// The lines of a view by layer, in the order of kLayers.
using LinesOfLayers = parallel::Dealt<const Line*, kLayers.size()>;

/// Returns the lines of all layers: lines are a hundred bytes each, and there are many layers, so
/// that no layer goes through all of them by itself. The ink must outlive the result. Errors:
/// cancelled, out of memory.
[[nodiscard]] inline Result<LinesOfLayers> lines_of_layers(const Ink& ink,
                                                           const parallel::Context& context) {
  constexpr std::size_t kKinds = static_cast<std::size_t>(hlr::kLastEdgeKind) + 1;
  // By kind: the layer of visible lines, and that of hidden ones; kLayers.size() where there is
  // none.
  std::array<std::array<std::size_t, 2>, kKinds> layer_of{};
  for (auto& of_kind : layer_of) of_kind.fill(kLayers.size());
  for (std::size_t layer = 0; layer < kLayers.size(); ++layer)
    layer_of.at(static_cast<std::size_t>(kLayers.at(layer).kind))
        .at(kLayers.at(layer).hidden ? 1 : 0) = layer;
  return parallel::deal<const Line*, kLayers.size()>(
      context, "lines of layers", ink.lines.size(),
      [&](std::size_t i) {
        const Line& line = ink.lines[i];
        const bool hidden = is_hidden(line.state);
        if (!hidden && line.state != LineState::visible) return kLayers.size();
        return layer_of[static_cast<std::size_t>(line.kind)][hidden ? 1 : 0];
      },
      [&](std::size_t i) { return &ink.lines[i]; });
}

/// Calls `f` with the lines of each object, which stand side by side in the order of the drawing.
template <class F>
void for_each_object(std::span<const Line* const> lines, F&& f) {
  for (std::size_t i = 0; i < lines.size();) {
    std::size_t end = i + 1;
    while (end < lines.size() && lines[end]->object == lines[i]->object) ++end;
    f(lines.subspan(i, end - i));
    i = end;
  }
}

}  // namespace strake::drawing
