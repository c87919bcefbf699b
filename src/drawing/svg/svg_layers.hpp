// SPDX-License-Identifier: Apache-2.0
// The layers of a view in SVG: their order, their lines, and how they are written.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drawing/buffered_writer.hpp"
#include "drawing/layout/duplicates.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/model/model.hpp"

namespace strake::drawing {

/// A layer of a view: the visible or the hidden lines of one kind.
struct Layer {
  bool hidden;
  hlr::EdgeKind kind;
  std::string_view label;
};

// Later layers are drawn over earlier ones: outlines last, and of these the outlines of cuts.
inline constexpr std::array<Layer, 16> kLayers = {{
    {true, hlr::EdgeKind::polyline, "Hidden polylines"},
    {true, hlr::EdgeKind::boundary, "Hidden boundary"},
    {true, hlr::EdgeKind::non_manifold, "Hidden non-manifold"},
    {true, hlr::EdgeKind::sharp, "Hidden sharp"},
    {true, hlr::EdgeKind::intersection, "Hidden intersections"},
    {true, hlr::EdgeKind::contour, "Hidden outline"},
    {true, hlr::EdgeKind::section, "Hidden section"},
    {false, hlr::EdgeKind::hatch, "Hatch"},
    {false, hlr::EdgeKind::smooth, "Visible smooth"},
    {false, hlr::EdgeKind::polyline, "Visible polylines"},
    {false, hlr::EdgeKind::boundary, "Visible boundary"},
    {false, hlr::EdgeKind::non_manifold, "Visible non-manifold"},
    {false, hlr::EdgeKind::sharp, "Visible sharp"},
    {false, hlr::EdgeKind::intersection, "Visible intersections"},
    {false, hlr::EdgeKind::contour, "Visible outline"},
    {false, hlr::EdgeKind::section, "Visible section"},
}};

[[nodiscard]] inline bool belongs(const Line& line, const Layer& layer) {
  if (line.kind != layer.kind) return false;
  return layer.hidden ? is_hidden(line.state) : line.state == LineState::visible;
}

/// The lengths of ink and gap by turns of hidden lines, mm; empty: continuous. Lines that others
/// hide have their own where the ink keeps the two apart.
struct HiddenDashes {
  std::vector<double> by_self, by_other;
};

/// Writes the lines of a view: a group per layer, of class "visible sharp" and the like, and in it
/// a group per object with one path, or for dashed lines one for each pattern that fits them
/// (dash_runs). Where hidden lines are kept apart, the layer has a layer for each state within it.
/// `prefix` stands before the ids of the layers.
void write_layers(BufferedWriter& out, const PaperCurves& curves, const Ink& ink,
                  const model::Model& model, std::string_view prefix, const HiddenDashes& dashes);

/// Writes the layer of centre lines, of class "centre", where there are any. Their dashes fit each
/// of them.
void write_centre_lines(BufferedWriter& out, const Ink& ink, std::string_view prefix,
                        std::span<const double> dash_mm);

/// Returns a length of a dash as style sheets have it, rounded to hundredths of a millimetre.
[[nodiscard]] double rounded_dash(double mm);

/// Writes an element of metadata for each object that was left out because it lies far from all
/// others.
void write_far_objects(BufferedWriter& out, const NeutralDrawing& drawing,
                       const model::Model& model);

}  // namespace strake::drawing
