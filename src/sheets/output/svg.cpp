// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "core/number.hpp"
#include "drawing/buffered_writer.hpp"
#include "drawing/layout/view_plane.hpp"
#include "drawing/strokes/layers.hpp"
#include "drawing/svg/svg_layers.hpp"
#include "drawing/svg/svg_path.hpp"
#include "drawing/svg/svg_styles.hpp"
#include "model/attributes.hpp"
#include "sheets/output/line_styles.hpp"
#include "sheets/spec/text_metrics.hpp"
#include "strake/drawing/write.hpp"
#include "strake/sheets/write.hpp"

namespace strake::sheets {

namespace {

using drawing::BufferedWriter;
using drawing::xml_escaped;

std::string vector_text(const geometry::Vec3l& v) { return fmt::format("{},{},{}", v.x, v.y, v.z); }

/// Returns the name of the class of a letter height: "h2_5" for 2.5.
std::string height_class(double height_mm) {
  std::string name = "h" + shortest(height_mm);
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

std::string dashes(const LineStyle& style) {
  std::string text;
  for (const double dash : style.dash_mm) text += (text.empty() ? "" : " ") + shortest(dash);
  return text.empty() ? "none" : text;
}

/// Returns the selector of a class of lines in the style sheet: layers of views by their contents,
/// marks by their class.
std::string selector(LineClass line, bool single_lines) {
  std::string list;
  for (const drawing::Layer& layer : drawing::kLayers)
    if (class_of(layer.kind, layer.hidden) == line &&
        (layer.kind != hlr::EdgeKind::single_line || single_lines))
      list += fmt::format(".strake .{}.{} path, ", layer.hidden ? "hidden" : "visible",
                          drawing::kind_name(layer.kind));
  if (line == LineClass::hidden_self) list = ".strake .hidden .by-self path, ";
  if (line == LineClass::centre) list = ".strake .centre path, ";
  if (line == LineClass::break_line) list = ".strake .break path, ";
  if (line == LineClass::hidden_other) list = ".strake .hidden .by-other path, ";
  return list + ".strake ." + std::string(class_name(line));
}

/// Returns all marks of a sheet.
std::vector<const Marks*> marks_of(const Sheet& sheet) {
  std::vector<const Marks*> all{&sheet.frame, &sheet.notes};
  for (const PlacedView& view : sheet.views)
    for (const Marks* marks :
         {&view.caption, &view.grid, &view.tags, &view.frame, &view.notes, &view.match_lines})
      all.push_back(marks);
  return all;
}

bool has_single_lines(const Sheet& sheet) {
  return std::ranges::any_of(sheet.views, [](const PlacedView& view) {
    return std::ranges::any_of(view.ink.lines, [](const drawing::Line& line) {
      return line.kind == hlr::EdgeKind::single_line;
    });
  });
}

/// Returns whether a class has a rule: those that came later have none where nothing is of them, so
/// that sheets without stay as they were.
bool is_used(const Sheet& sheet, LineClass line) {
  const auto any = [&](const auto& of_view) { return std::ranges::any_of(sheet.views, of_view); };
  if (line < LineClass::hidden_self) return true;
  if (line == LineClass::hidden_self || line == LineClass::hidden_other)
    return any([](const PlacedView& view) { return view.ink.split_hidden; });
  if (line == LineClass::centre)
    return any([](const PlacedView& view) { return !view.ink.centre_lines.empty(); });
  if (line == LineClass::single_line) return has_single_lines(sheet);
  if (line == LineClass::break_line)
    return any([](const PlacedView& view) { return !view.ink.break_lines.empty(); });
  return std::ranges::any_of(marks_of(sheet), [&](const Marks* marks) {
    const auto has = [&](const auto& mark) { return mark.line == line; };
    return std::ranges::any_of(marks->paths, has) || std::ranges::any_of(marks->circles, has) ||
           std::ranges::any_of(marks->texts, has);
  });
}

void write_style(BufferedWriter& out, const Sheet& sheet, const std::set<double>& heights) {
  out << "<style>\n"
         ".strake path, .strake circle { fill: none; stroke-linecap: round; stroke-linejoin: "
         "round; }\n";
  const bool single_lines = has_single_lines(sheet);
  for (std::size_t c = 0; c < kLineClasses; ++c) {
    if (!is_used(sheet, static_cast<LineClass>(c))) continue;
    const LineStyle& style = sheet.styles.at(c);
    out << selector(static_cast<LineClass>(c), single_lines)
        << fmt::format(" {{ stroke: {}; stroke-width: {}; stroke-dasharray: {};{} }}\n",
                       model::color_text(style.color), shortest(style.width_mm), dashes(style),
                       style.dash_mm.empty() ? "" : " stroke-linecap: butt;");
  }
  out << ".strake text { font-family: sans-serif; stroke: none; }\n";
  for (std::size_t c = 0; c < kLineClasses; ++c) {
    if (!is_used(sheet, static_cast<LineClass>(c))) continue;
    const std::string color = model::color_text(sheet.styles.at(c).color);
    const std::string_view name = class_name(static_cast<LineClass>(c));
    out << fmt::format(".strake text.{0}, .strake path.{0}.filled {{ fill: {1}; stroke: none; }}\n",
                       name, color);
  }
  for (const double height : heights)
    out << fmt::format(".strake text.{} {{ font-size: {}px; }}\n", height_class(height),
                       shortest(std::round(height * kFontSize * 1000) / 1000));
  std::vector<const drawing::Ink*> inks;
  for (const PlacedView& view : sheet.views) inks.push_back(&view.ink);
  const auto pen = [&](const drawing::Layer& layer, drawing::LineState state) {
    return pen_of_layer(sheet.styles, *inks.front(), layer, state);
  };
  const LineStyle& break_line = style_of(sheet.styles, LineClass::break_line);
  out << drawing::svg_style_rules(inks, ".strake ", pen,
                                  {break_line.width_mm, break_line.dash_mm, break_line.color});
  out << ".strake .paper { fill: #fff; stroke: none; }\n</style>\n";
}

void write_metadata(BufferedWriter& out, const Sheet& sheet, const model::Model& model) {
  out << "<metadata>\n<sheet xmlns=\"urn:strake:sheet:1\">\n";
  for (const PlacedView& view : sheet.views) {
    const drawing::NeutralDrawing& drawing = view.drawing;
    out << "<view name=\"" << xml_escaped(view.name) << "\" direction=\""
        << vector_text(drawing.view.direction) << "\" up=\"" << vector_text(drawing.view.up) << "\""
        << (drawing.view.perspective ? " projection=\"perspective\"" : "") << " stage=\""
        << drawing::stage_name(drawing.stage) << "\" scale=\"" << drawing.sheet.scale_text
        << "\" contact-distance-mm=\"" << shortest(drawing.contact_distance_mm) << "\" hash=\""
        << drawing.hash.text() << "\""
        << fmt::format(" objects=\"{}\" objects-drawn=\"{}\" feature-edges=\"{}\"",
                       drawing.account.objects(), drawing.account.of(hlr::Fate::drawn),
                       drawing.counters.feature_edges);
    for (std::size_t s = 0; s < drawing::kLineStates; ++s) {
      const auto state = static_cast<drawing::LineState>(s);
      const bool hidden = state == drawing::LineState::hidden_by_self ||
                          state == drawing::LineState::hidden_by_other;
      if (hidden && !drawing.hidden_lines) continue;
      std::string name(drawing::state_name(state));
      std::replace(name.begin(), name.end(), '_', '-');
      out << fmt::format(" {}=\"{}\"", name, drawing.count[s]);
    }
    if (drawing.uncut) out << fmt::format(" objects-uncut=\"{}\"", drawing.counters.uncut_objects);
    if (!drawing.flush_seams)
      out << fmt::format(" edges-with-seams=\"{}\"", drawing.counters.seams);
    if (!drawing.hidden_lines) out << " hidden-lines=\"not asked for\"";
    if (view.ink.thinned) out << fmt::format(" lines-thinned=\"{}\"", view.ink.thinned->lines);
    out << fmt::format(" hidden-left-out=\"{}\"", view.ink.left_out);
    if (drawing.far_left_out.empty()) {
      out << "/>\n";
      continue;
    }
    out << ">\n";
    drawing::write_far_objects(out, drawing, model);
    out << "</view>\n";
  }
  out << "</sheet>\n</metadata>\n";
}

/// Returns the attribute that turns a text; SVG counts with the clock.
std::string turn_of(const Text& text) {
  if (text.turn_deg == 0) return {};
  return fmt::format(" transform=\"rotate({} {} {})\"", shortest(-text.turn_deg),
                     shortest(text.at.x), shortest(text.at.y));
}

void write_marks(BufferedWriter& out, const Marks& marks) {
  for (const Text& text : marks.texts) {
    if (!text.clears) continue;
    const PaperBox box = level_box_of(text);
    out << fmt::format("<rect class=\"paper\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"{}/>\n",
                       shortest(drawing::rounded_paper(box.left)),
                       shortest(drawing::rounded_paper(box.top)),
                       shortest(drawing::rounded_paper(box.width())),
                       shortest(drawing::rounded_paper(box.height())), turn_of(text));
  }
  for (const Path& path : marks.paths) {
    out << "<path class=\"" << class_name(path.line) << (path.filled ? " filled" : "") << "\" d=\"";
    drawing::append_svg_chain(out.text(), path.points);
    out << "\"/>\n";
  }
  for (const Circle& circle : marks.circles)
    out << fmt::format("<circle class=\"{}\" cx=\"{}\" cy=\"{}\" r=\"{}\"/>\n",
                       class_name(circle.line), shortest(circle.center.x),
                       shortest(circle.center.y), shortest(circle.radius_mm));
  constexpr std::array<std::string_view, 3> kAnchors{"", " text-anchor=\"middle\"",
                                                     " text-anchor=\"end\""};
  for (const Text& text : marks.texts)
    out << fmt::format("<text class=\"{} {}\" x=\"{}\" y=\"{}\"{}{}>", class_name(text.line),
                       height_class(text.height_mm), shortest(text.at.x), shortest(text.at.y),
                       kAnchors.at(static_cast<std::size_t>(text.align)), turn_of(text))
        << xml_escaped(text.text) << "</text>\n";
}

/// Writes a layer of marks, where there are any.
void write_layer(BufferedWriter& out, const Marks& marks, const std::string& id,
                 std::string_view label) {
  if (marks.paths.empty() && marks.circles.empty() && marks.texts.empty()) return;
  out << fmt::format("<g inkscape:groupmode=\"layer\" inkscape:label=\"{}\" id=\"{}\">\n", label,
                     id);
  write_marks(out, marks);
  out << "</g>\n";
}

void write_view(BufferedWriter& out, const PlacedView& view, const LineStyles& styles,
                const model::Model& model, std::size_t number) {
  const std::string id = fmt::format("view-{}", number);
  out << "<g class=\"view\" id=\"" << id << "\" inkscape:groupmode=\"layer\" inkscape:label=\""
      << xml_escaped(view.name) << "\" data-view=\"" << xml_escaped(view.name) << "\" data-scale=\""
      << view.drawing.sheet.scale_text << "\">\n";
  drawing::write_layers(out, view.drawing.curves, view.ink, model, id + "-",
                        [&](const drawing::Layer& layer, drawing::LineState state) {
                          return pen_of_layer(styles, view.ink, layer, state);
                        });
  drawing::write_break_lines(out, view.ink, id + "-");
  drawing::write_centre_lines(out, view.ink, id + "-", style_of(styles, LineClass::centre).dash_mm);
  write_layer(out, view.frame, id + "-frame", "Frame");
  write_layer(out, view.grid, id + "-grid", "Grid");
  write_layer(out, view.notes, id + "-notes", "Notes");
  write_layer(out, view.match_lines, id + "-match-lines", "Match lines");
  write_layer(out, view.tags, id + "-tags", "Tags");
  write_layer(out, view.caption, id + "-title", "Title");
  out << "</g>\n";
}

std::set<double> heights_of(const Sheet& sheet) {
  std::set<double> heights;
  for (const Marks* marks : marks_of(sheet))
    for (const Text& text : marks->texts) heights.insert(text.height_mm);
  return heights;
}

}  // namespace

void write_svg(const Sheet& sheet, const model::Model& model, drawing::Sink sink) {
  BufferedWriter out(sink);
  const std::string width = shortest(sheet.width_mm), height = shortest(sheet.height_mm);
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<svg xmlns=\"http://www.w3.org/2000/svg\" "
         "xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
         "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" "
      << fmt::format("width=\"{0}mm\" height=\"{1}mm\" viewBox=\"0 0 {0} {1}\">\n", width, height)
      << "<title>" << xml_escaped(sheet.title) << "</title>\n";
  write_metadata(out, sheet, model);
  write_style(out, sheet, heights_of(sheet));
  out << "<g class=\"strake\">\n"
      << fmt::format("<rect class=\"paper\" width=\"{}\" height=\"{}\"/>\n</g>\n", width, height);
  if (sheet.artwork)
    out << fmt::format("<svg id=\"sheet-frame\" width=\"{}\" height=\"{}\" viewBox=\"{}\">\n",
                       width, height, sheet.artwork->view_box)
        << sheet.artwork->elements << "\n</svg>\n";
  out << "<g class=\"strake\" id=\"sheet-drawing\">\n";
  write_layer(out, sheet.frame, "sheet-frame", "Frame");
  write_layer(out, sheet.notes, "sheet-notes", "Notes");
  for (std::size_t v = 0; v < sheet.views.size(); ++v)
    write_view(out, sheet.views[v], sheet.styles, model, v + 1);
  out << "</g>\n</svg>\n";
}

}  // namespace strake::sheets
