// SPDX-License-Identifier: Apache-2.0
// SVG of a drawing: the layers of a view, and the sheet round them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/number.hpp"
#include "drawing/buffered_writer.hpp"
#include "drawing/ink/dash_fit.hpp"
#include "drawing/ink/hidden_ink.hpp"
#include "drawing/strokes/dash_runs.hpp"
#include "drawing/strokes/dashed_paths.hpp"
#include "drawing/strokes/layers.hpp"
#include "drawing/strokes/strokes.hpp"
#include "drawing/svg/svg_layers.hpp"
#include "drawing/svg/svg_path.hpp"
#include "drawing/svg/svg_styles.hpp"
#include "strake/drawing/write.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/reduce.hpp"

namespace strake::drawing {

namespace {

void write_paths(BufferedWriter& out, const DashedPaths& paths) {
  paths.for_each([&](std::span<const double> pattern, const std::string& commands) {
    out << "<path style=\"stroke-dasharray:";
    if (pattern.empty()) out << "none";
    for (std::size_t k = 0; k < pattern.size(); ++k)
      out << (k == 0 ? "" : " ") << shortest(pattern[k]);
    out << "\" d=\"" << commands << "\"/>";
  });
}

void write_object(BufferedWriter& out, const PaperCurves& curves, const model::Model& model,
                  std::span<const Line* const> lines, std::span<const double> dash_mm) {
  const std::vector<JoinedLines> chains = join_lines(lines);
  if (chains.empty()) return;
  const model::Object& object = model.object(lines.front()->object);
  out << "<g data-id=\"" << xml_escaped(object.id) << "\" data-name=\"" << xml_escaped(object.name)
      << "\" data-file=\"" << xml_escaped(model.files[object.file].label) << "\">";
  if (dash_mm.empty()) {
    out << "<path d=\"";
    for (const JoinedLines& chain : chains) {
      append_svg_path(out.text(), stroke_of(chain, curves));
      out.done();
    }
    out << "\"/>";
  } else {
    DashedPaths paths(dash_mm);
    for (const JoinedLines& chain : chains)
      for (const DashRun& run : dash_runs(chain, curves, dash_mm))
        append_svg_path(paths.of(run.stretch), stroke_of(run.chain, curves));
    write_paths(out, paths);
  }
  out << "</g>\n";
}

/// Lines that a worker takes at once where little is done for each.
constexpr std::size_t kLinesOfSvgRun = 16384;

Status write_objects(BufferedWriter& out, const PaperCurves& curves, const model::Model& model,
                     std::span<const Line* const> lines, std::span<const double> dash_mm,
                     const parallel::Context& context) {
  const auto starts = parallel::collect<std::size_t>(
      context, {.name = "objects of a layer", .n = lines.size(), .grain = kLinesOfSvgRun},
      [&](std::size_t i, std::vector<std::size_t>& found) {
        if (i == 0 || lines[i]->object != lines[i - 1]->object) found.push_back(i);
      });
  if (!starts) return starts.error();
  const std::vector<std::size_t>& start = *starts;
  // Only shares the work out, and bounds what is made before it is written.
  constexpr std::size_t kObjectsPerPiece = 64;
  return make_in_order(
      "objects as SVG", (start.size() + kObjectsPerPiece - 1) / kObjectsPerPiece,
      [&](std::size_t piece) {
        std::string text;
        const auto gather = [&](std::string_view more) { text += more; };
        BufferedWriter own(gather);
        const std::size_t end = std::min(start.size(), (piece + 1) * kObjectsPerPiece);
        for (std::size_t o = piece * kObjectsPerPiece; o < end; ++o) {
          const std::size_t next = o + 1 < start.size() ? start[o + 1] : lines.size();
          write_object(own, curves, model, lines.subspan(start[o], next - start[o]), dash_mm);
        }
        own.flush();
        return text;
      },
      [&](const std::string& text, std::size_t /*piece*/) { out << text; }, context);
}

/// `style` names that of the objects in the layer, where there is one.
void begin_layer(BufferedWriter& out, std::string_view label, std::string_view id,
                 std::string_view classes, std::string_view style = {}) {
  out << "<g inkscape:groupmode=\"layer\" inkscape:label=\"" << label << "\" id=\"" << id
      << "\" class=\"" << classes << "\"";
  if (!style.empty()) out << " data-style=\"" << style << "\"";
  out << ">\n";
}

/// Begins the layer of a style within another.
void begin_style(BufferedWriter& out, const ObjectStyles& styles, std::size_t number,
                 std::string_view outer_label, std::string_view outer_id) {
  const std::string label = xml_escaped(style_label(styles, number));
  begin_layer(out, fmt::format("{}, {}", outer_label, label),
              fmt::format("{}-style-{}", outer_id, number), fmt::format("style-{}", number), label);
}

/// Writes the layers of a view.
class LayerWriter {
 public:
  LayerWriter(BufferedWriter& out, const PaperCurves& curves, const Ink& ink,
              const model::Model& model, PenOfLayer pen_of, const parallel::Context& context)
      : out_(out), curves_(curves), ink_(ink), model_(model), pen_of_(pen_of), context_(context) {}

  Status write(const Layer& layer, std::span<const Line* const> lines, std::string_view prefix) {
    if (lines.empty()) return {};
    const std::string_view state = layer.hidden ? "hidden" : "visible";
    const std::string_view kind = kind_name(layer.kind);
    const std::string id = fmt::format("{}{}-{}", prefix, state, kind);
    begin_layer(out_, layer.label, id, fmt::format("{} {}", state, kind));
    if (layer.hidden && ink_.split_hidden) {
      for (const auto& [by, names] :
           {std::pair(LineState::hidden_by_other, Names{"by-other", "by others", id}),
            std::pair(LineState::hidden_by_self, Names{"by-self", "by the object itself", id})})
        if (Status status = write_state(layer, lines, by, names); !status) return status;
    } else if (Status status = write_styles(
                   layer, lines, layer.hidden ? LineState::hidden_by_self : LineState::visible,
                   {{}, std::string(layer.label), id});
               !status) {
      return status;
    }
    out_ << "</g>\n";
    return {};
  }

 private:
  struct Names {
    std::string_view name;
    std::string label, id;
  };

  Status write_state(const Layer& layer, std::span<const Line* const> lines, LineState by,
                     const Names& names) {
    std::vector<const Line*> some;
    std::ranges::copy_if(lines, std::back_inserter(some),
                         [&](const Line* line) { return line->state == by; });
    if (some.empty()) return {};
    const std::string label = fmt::format("{}, {}", layer.label, names.label);
    const std::string id = fmt::format("{}-{}", names.id, names.name);
    begin_layer(out_, label, id, names.name);
    if (Status status = write_styles(layer, some, by, {{}, label, id}); !status) return status;
    out_ << "</g>\n";
    return {};
  }

  Status write_styles(const Layer& layer, std::span<const Line* const> lines, LineState state,
                      const Names& names) {
    for (const LinesOfStyle& part : by_style(lines, ink_)) {
      const LinePen pen = pen_of_(layer, state);
      if (part.style == ObjectStyles::kPlain) {
        Status status = write_objects(
            out_, curves_, model_, part.lines,
            layer.hidden ? std::span<const double>(pen.dash_mm) : std::span<const double>(),
            context_);
        if (!status) return status;
        continue;
      }
      const LinePen styled = styled_pen(pen, layer, *ink_.styles, part.style, ink_.pens.edge);
      begin_style(out_, *ink_.styles, part.style, names.label, names.id);
      if (Status status =
              write_objects(out_, curves_, model_, part.lines, styled.dash_mm, context_);
          !status)
        return status;
      out_ << "</g>\n";
    }
    return {};
  }

  BufferedWriter& out_;
  const PaperCurves& curves_;
  const Ink& ink_;
  const model::Model& model_;
  PenOfLayer pen_of_;
  const parallel::Context& context_;
};

/// For writers that have no other way to say so: without a team and a token nothing else fails.
void throw_unless(const Status& status) {
  if (!status) throw std::bad_alloc();
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

Status write_layers(BufferedWriter& out, const PaperCurves& curves, const Ink& ink,
                    const model::Model& model, std::string_view prefix, PenOfLayer pen_of,
                    const parallel::Context& context) {
  const Result<LinesOfLayers> lines = lines_of_layers(ink, context);
  if (!lines) return lines.error();
  LayerWriter writer(out, curves, ink, model, pen_of, context);
  for (std::size_t layer = 0; layer < kLayers.size(); ++layer)
    if (Status status = writer.write(kLayers.at(layer), (*lines)[layer], prefix); !status)
      return status;
  return {};
}

void write_layers(BufferedWriter& out, const PaperCurves& curves, const Ink& ink,
                  const model::Model& model, std::string_view prefix, PenOfLayer pen_of) {
  throw_unless(write_layers(out, curves, ink, model, prefix, pen_of, {}));
}

void write_break_lines(BufferedWriter& out, const Ink& ink, std::string_view prefix) {
  if (ink.break_lines.empty()) return;
  const std::string id = fmt::format("{}break-lines", prefix);
  begin_layer(out, "Break lines", id, "break");
  for (const BreakLinesOfStyle& part : break_lines_by_style(ink)) {
    const bool plain = part.style == ObjectStyles::kPlain;
    if (!plain) begin_style(out, *ink.styles, part.style, "Break lines", id);
    out << "<path d=\"";
    for (const BreakLine* const line : part.lines) append_svg_chain(out.text(), line->points);
    out << (plain ? "\"/>\n" : "\"/>\n</g>\n");
  }
  out << "</g>\n";
}

void write_centre_lines(BufferedWriter& out, const Ink& ink, std::string_view prefix,
                        std::span<const double> dash_mm) {
  if (ink.centre_lines.empty()) return;
  begin_layer(out, "Centre lines", fmt::format("{}centre-lines", prefix), "centre");
  DashedPaths paths(dash_mm);
  for (const CentreLine& line : ink.centre_lines)
    append_svg_chain(paths.of(stretch_of(line, dash_mm)), line.points);
  write_paths(out, paths);
  out << "\n</g>\n";
}

namespace {

/// The kinds of lines that there are, a bit for each.
using Kinds = std::uint32_t;

constexpr Kinds bit_of(hlr::EdgeKind kind) { return Kinds{1} << static_cast<unsigned>(kind); }

Result<Kinds> kinds_of(std::span<const Line> lines, const parallel::Context& context) {
  return parallel::reduce(
      context, {.name = "kinds of lines", .n = lines.size(), .grain = kLinesOfSvgRun}, Kinds{0},
      [&](Kinds& kinds, std::size_t i) { kinds |= bit_of(lines[i].kind); },
      [](Kinds& into, Kinds kinds) { into |= kinds; });
}

void write_style(BufferedWriter& out, const Ink& ink, Kinds kinds, bool sections,
                 PenOfLayer pen_of) {
  const Pens& pens = ink.pens;
  const std::vector<double> dashes = pen_dashes(kHiddenDashes, pens.thin);
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
      pens.outline, pens.edge, pens.thin, shortest(dashes[0]), shortest(dashes[1]));
  if (sections)
    out << fmt::format(
        ".visible.section path {{ stroke-width: {}; }}\n"
        ".visible.hatch path {{ stroke-width: {}; }}\n",
        pens.section, pens.thin);
  if (!ink.centre_lines.empty())
    out << fmt::format(".centre path {{ stroke-width: {}; stroke-linecap: butt; }}\n", pens.thin);
  if (!ink.break_lines.empty())
    out << fmt::format(".break path {{ stroke-width: {}; }}\n", pens.thin);
  const auto has = [&](hlr::EdgeKind kind) { return (kinds & bit_of(kind)) != 0; };
  if (has(hlr::EdgeKind::single_line))
    out << fmt::format(".visible.single_line path {{ stroke-width: {}; }}\n", pens.outline);
  if (has(hlr::EdgeKind::smooth))
    out << fmt::format(".visible.smooth path {{ stroke-width: {}; }}\n", pens.thin);
  const std::array<const Ink*, 1> views{&ink};
  out << svg_style_rules(views, "", pen_of, {pens.thin, {}, {0, 0, 0, 255}}) << "</style>\n";
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
  if (ink.thinned) out << fmt::format(" lines-thinned=\"{}\"", ink.thinned->lines);
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

Status write_svg(const NeutralDrawing& drawing, const Ink& ink, const model::Model& model,
                 Sink sink, const parallel::Context& context) {
  BufferedWriter out(sink);
  write_head(out, drawing, ink, model);
  const auto pen_of = [&](const Layer& layer, LineState /*state*/) {
    return usual_pen(layer, ink.pens);
  };
  const Result<Kinds> kinds = kinds_of(ink.lines, context);
  if (!kinds) return kinds.error();
  write_style(out, ink, *kinds, !drawing.view.sections.empty(), pen_of);
  out << fmt::format("<rect class=\"sheet\" width=\"{}\" height=\"{}\"/>\n",
                     shortest(drawing.sheet.width_mm), shortest(drawing.sheet.height_mm));
  out << "<g class=\"view\" id=\"view\" data-view=\"" << xml_escaped(drawing.view_name)
      << "\" data-scale=\"" << drawing.sheet.scale_text << "\">\n";
  if (Status status = write_layers(out, drawing.curves, ink, model, "", pen_of, context); !status)
    return status;
  write_break_lines(out, ink, "");
  write_centre_lines(out, ink, "", pen_dashes(kCentreDashes, ink.pens.thin));
  write_frame(out, drawing);
  out << "</g>\n";
  write_title(out, drawing);
  out << "</svg>\n";
  return {};
}

void write_svg(const NeutralDrawing& drawing, const Ink& ink, const model::Model& model,
               Sink sink) {
  throw_unless(write_svg(drawing, ink, model, sink, {}));
}

}  // namespace strake::drawing
