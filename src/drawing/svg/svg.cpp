// SPDX-License-Identifier: Apache-2.0
// SVG of a drawing: the layers of a view, and the sheet round them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/number.hpp"
#include "drawing/buffered_writer.hpp"
#include "drawing/ink/hidden_ink.hpp"
#include "drawing/strokes/layers.hpp"
#include "drawing/strokes/strokes.hpp"
#include "drawing/svg/svg_layers.hpp"
#include "drawing/svg/svg_path.hpp"
#include "strake/drawing/write.hpp"

namespace strake::drawing {

namespace {

void write_object(BufferedWriter& out, const PaperCurves& curves, const model::Model& model,
                  std::span<const Line* const> lines) {
  const std::vector<JoinedLines> chains = join_lines(lines);
  if (chains.empty()) return;
  const model::Object& object = model.object(lines.front()->object);
  out << "<g data-id=\"" << xml_escaped(object.id) << "\" data-name=\"" << xml_escaped(object.name)
      << "\" data-file=\"" << xml_escaped(model.files[object.file].label) << "\"><path d=\"";
  for (const JoinedLines& chain : chains) {
    append_svg_path(out.text(), stroke_of(chain, curves));
    out.done();
  }
  out << "\"/></g>\n";
}

void write_layer(BufferedWriter& out, const PaperCurves& curves, const Ink& ink,
                 const model::Model& model, const Layer& layer, std::string_view prefix) {
  const std::vector<const Line*> lines = lines_of(layer, ink);
  if (lines.empty()) return;
  const std::string_view state = layer.hidden ? "hidden" : "visible";
  const std::string_view kind = kind_name(layer.kind);
  out << fmt::format(
      "<g inkscape:groupmode=\"layer\" inkscape:label=\"{}\" id=\"{}{}-{}\" class=\"{} {}\">\n",
      layer.label, prefix, state, kind, state, kind);
  for_each_object(lines, [&](std::span<const Line* const> of_object) {
    write_object(out, curves, model, of_object);
  });
  out << "</g>\n";
}

}  // namespace

void write_far_objects(BufferedWriter& out, const NeutralDrawing& drawing,
                       const model::Model& model) {
  for (const model::ObjectId id : drawing.far_left_out) {
    const model::Object& object = model.object(id);
    out << "<far-object id=\"" << xml_escaped(object.id) << "\" name=\"" << xml_escaped(object.name)
        << "\" file=\"" << xml_escaped(model.files[object.file].label) << "\"/>\n";
  }
}

void write_layers(BufferedWriter& out, const PaperCurves& curves, const Ink& ink,
                  const model::Model& model, std::string_view prefix) {
  for (const Layer& layer : kLayers) write_layer(out, curves, ink, model, layer, prefix);
}

namespace {

void write_style(BufferedWriter& out, const Ink& ink, bool sections) {
  const Pens& pens = ink.pens;
  // A dash of 12 line widths and a gap of 3; long dash, gap, dot for centre lines (ISO 128-20).
  out << fmt::format(
      "<style>\n"
      "path {{ fill: none; stroke: #000; stroke-linecap: round; stroke-linejoin: round; }}\n"
      ".visible.contour path {{ stroke-width: {0}; }}\n"
      ".visible.sharp path, .visible.boundary path, .visible.non_manifold path, "
      ".visible.intersection path {{ stroke-width: {1}; }}\n"
      ".visible.polyline path {{ stroke-width: {2}; stroke: #246; }}\n"
      ".hidden path {{ stroke-width: {2}; stroke: #444; stroke-linecap: butt; "
      "stroke-dasharray: {3} {4}; }}\n"
      ".hidden.polyline path {{ stroke: #68a; }}\n"
      ".sheet {{ fill: #fff; stroke: none; }}\n"
      "text {{ font-family: sans-serif; font-size: 3.5px; }}\n"
      ".frame path {{ stroke-width: {2}; }}\n",
      pens.outline, pens.edge, pens.thin, shortest(std::round(pens.thin * kDash * 100) / 100),
      shortest(std::round(pens.thin * kDashGap * 100) / 100));
  if (sections)
    out << fmt::format(
        ".visible.section path {{ stroke-width: {}; }}\n"
        ".visible.hatch path {{ stroke-width: {}; }}\n",
        pens.section, pens.thin);
  const bool smooth = std::ranges::any_of(
      ink.lines, [](const Line& line) { return line.kind == hlr::EdgeKind::smooth; });
  if (smooth) out << fmt::format(".visible.smooth path {{ stroke-width: {}; }}\n", pens.thin);
  out << "</style>\n";
}

std::string vector_text(const geometry::Vec3l& v) { return fmt::format("{},{},{}", v.x, v.y, v.z); }

void write_head(BufferedWriter& out, const NeutralDrawing& drawing, const Ink& ink,
                const model::Model& model) {
  const Sheet& sheet = drawing.sheet;
  const std::string width = shortest(sheet.width_mm), height = shortest(sheet.height_mm);
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      << "<svg xmlns=\"http://www.w3.org/2000/svg\" "
         "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" "
      << fmt::format("width=\"{0}mm\" height=\"{1}mm\" viewBox=\"0 0 {0} {1}\">\n", width, height)
      << "<title>" << xml_escaped(drawing.title);
  // A view in perspective has no scale to measure by.
  if (!drawing.view.perspective) out << " \xC2\xB7 " << sheet.scale_text;
  out << "</title>\n<metadata>\n"
      << "<drawing xmlns=\"urn:strake:drawing:1\" view=\"" << xml_escaped(drawing.view_name)
      << "\" direction=\"" << vector_text(drawing.view.direction) << "\" up=\""
      << vector_text(drawing.view.up) << "\" stage=\"" << stage_name(drawing.stage) << "\" scale=\""
      << sheet.scale_text << "\" contact-distance-mm=\"" << shortest(drawing.contact_distance_mm)
      << "\" hash=\"" << drawing.hash.text() << "\">\n"
      << fmt::format("<counts objects=\"{}\" objects-drawn=\"{}\" feature-edges=\"{}\"",
                     drawing.account.objects(), drawing.account.of(hlr::Fate::drawn),
                     drawing.counters.feature_edges);
  for (std::size_t s = 0; s < kLineStates; ++s) {
    std::string name(state_name(static_cast<LineState>(s)));
    std::replace(name.begin(), name.end(), '_', '-');
    out << fmt::format(" {}=\"{}\"", name, drawing.count[s]);
  }
  if (drawing.uncut) out << fmt::format(" objects-uncut=\"{}\"", drawing.counters.uncut_objects);
  if (!drawing.flush_seams) out << fmt::format(" edges-with-seams=\"{}\"", drawing.counters.seams);
  out << fmt::format(" hidden-left-out=\"{}\"", ink.left_out) << "/>\n";
  write_far_objects(out, drawing, model);
  out << "</drawing>\n</metadata>\n";
}

/// Writes the frame of a view in perspective, where it has one.
void write_frame(BufferedWriter& out, const NeutralDrawing& drawing) {
  if (!drawing.frame) return;
  const auto& [left, top, right, bottom] = *drawing.frame;
  out << "<g inkscape:groupmode=\"layer\" inkscape:label=\"Frame\" id=\"view-frame\" "
         "class=\"frame\">\n<path d=\"";
  append_svg_chain(out.text(),
                   {{left, top}, {right, top}, {right, bottom}, {left, bottom}, {left, top}});
  out << "\"/>\n</g>\n";
}

void write_title(BufferedWriter& out, const NeutralDrawing& drawing) {
  const Sheet& sheet = drawing.sheet;
  const double x = sheet.width_mm - 10, y = sheet.height_mm - 6;
  out << "<g inkscape:groupmode=\"layer\" inkscape:label=\"Title\" id=\"title\" class=\"frame\">\n"
      << fmt::format("<path d=\"M10 {0}L{1} {0}\"/>\n", shortest(sheet.height_mm - 11), shortest(x))
      << fmt::format("<text x=\"10\" y=\"{}\">", shortest(y)) << xml_escaped(drawing.title)
      << "</text>\n";
  // A view in perspective has no scale to measure by.
  if (!drawing.view.perspective)
    out << fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\">", shortest(x), shortest(y))
        << "scale " << sheet.scale_text << "</text>\n";
  out << "</g>\n";
}

}  // namespace

void write_svg(const NeutralDrawing& drawing, const Ink& ink, const model::Model& model,
               Sink sink) {
  BufferedWriter out(sink);
  write_head(out, drawing, ink, model);
  write_style(out, ink, !drawing.view.sections.empty());
  out << fmt::format("<rect class=\"sheet\" width=\"{}\" height=\"{}\"/>\n",
                     shortest(drawing.sheet.width_mm), shortest(drawing.sheet.height_mm));
  out << "<g class=\"view\" id=\"view\" data-view=\"" << xml_escaped(drawing.view_name)
      << "\" data-scale=\"" << drawing.sheet.scale_text << "\">\n";
  write_layers(out, drawing.curves, ink, model, "");
  write_frame(out, drawing);
  out << "</g>\n";
  write_title(out, drawing);
  out << "</svg>\n";
}

}  // namespace strake::drawing
