// SPDX-License-Identifier: Apache-2.0
// The layers of a view: their order, and their lines object by object.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "drawing/layout/duplicates.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/hlr/hlr.hpp"

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

/// Returns the lines of a layer, in the order of the drawing.
[[nodiscard]] inline std::vector<const Line*> lines_of(const Layer& layer, const Ink& ink) {
  std::vector<const Line*> lines;
  for (const Line& line : ink.lines)
    if (belongs(line, layer)) lines.push_back(&line);
  return lines;
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
