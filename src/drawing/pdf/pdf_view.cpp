// SPDX-License-Identifier: Apache-2.0
#include "drawing/pdf/pdf_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/number.hpp"
#include "core/text_encoding.hpp"
#include "drawing/buffered_writer.hpp"
#include "drawing/pdf/pdf_path.hpp"
#include "drawing/pdf/pdf_syntax.hpp"
#include "drawing/strokes/dash_runs.hpp"
#include "drawing/strokes/dashed_paths.hpp"
#include "drawing/strokes/strokes.hpp"
#include "strake/parallel/find.hpp"

namespace strake::drawing {

namespace {

/// Lines of whole objects that make one stream: enough to compress well, few enough to share out.
constexpr std::size_t kLinesOfStream = 4096;

/// The contents of a layer: lines, and what stands before and after them in each stream.
struct LayerContents {
  std::string begin, end;
  std::vector<const Line*> lines;  ///< those of `state`, and others that are dashed with them
  LineState state = LineState::visible;
  std::vector<double> dash_mm;  ///< to be fitted to each line; empty: the pen of `begin` says all
};

struct Stream {
  const LayerContents* layer = nullptr;
  std::span<const Line* const> lines;
};

/// Returns a name as what an object is marked with: older programs take strings of 32,767 bytes in
/// contents, so that longer names end in an ellipsis.
std::string mark_text(std::string_view name) {
  constexpr std::size_t kMaxBytes = 10000;
  if (name.size() <= kMaxBytes) return pdf_text(name);
  std::string_view rest = name.substr(0, kMaxBytes);
  std::string cut;
  while (!rest.empty()) {
    const DecodedCharacter c = decode_character(rest);
    if (c.length > 0 || !rest.empty()) cut += c.bytes;  // not half a character
  }
  return pdf_text(cut + "\xE2\x80\xA6");
}

/// Appends the operator that chooses dashes, as they go on from that length; none: continuous.
void append_dashes(std::string& out, std::span<const double> dash_mm, double from_mm = 0) {
  out += '[';
  for (const double dash : dash_mm) {
    append_pdf_number(out, dash, 4);
    out += ' ';
  }
  out += ']';
  append_pdf_number(out, from_mm, 4);
  out += " d\n";
}

void append_paths(std::string& out, const DashedPaths& paths) {
  paths.for_each([&](std::span<const double> pattern, const std::string& commands) {
    append_dashes(out, pattern);
    out += commands + "S\n";
  });
}

/// A part of a stroke, and how far from the stroke's beginning it begins, mm.
struct StrokePart {
  JoinedLines chain;
  double from_mm = 0;
};

/// Returns the parts of a stroke whose lines are of one state.
std::vector<StrokePart> parts_of(const JoinedLines& stroke, LineState state,
                                 const PaperCurves& curves) {
  std::vector<StrokePart> parts;
  double along = 0;
  bool goes_on = false;
  for (std::size_t i = 0; i < stroke.lines.size(); ++i) {
    const Line* line = stroke.lines[i];
    if (line->state == state) {
      if (!goes_on) parts.push_back({{{stroke.points[i]}, {}}, along});
      parts.back().chain.points.push_back(stroke.points[i + 1]);
      parts.back().chain.lines.push_back(line);
    }
    goes_on = line->state == state;
    along += length_along(curves.of(*line), stroke.points[i], stroke.points[i + 1]);
  }
  return parts;
}

/// Appends dashed lines of one state. Where a stroke comes from a line of another state, its dashes
/// go on.
void append_dashed(std::string& out, const std::vector<JoinedLines>& chains, LineState state,
                   const PaperCurves& curves, std::span<const double> dash_mm) {
  DashedPaths paths(dash_mm);
  std::string amid;
  for (const JoinedLines& chain : chains)
    for (const DashRun& run : dash_runs(chain, curves, dash_mm))
      for (const StrokePart& part : parts_of(run.chain, state, curves)) {
        const bool begins = part.from_mm == 0 || run.stretch == 0;
        if (!begins) append_dashes(amid, paths.pattern(run.stretch), part.from_mm);
        append_pdf_stroke(begins ? paths.of(run.stretch) : amid, stroke_of(part.chain, curves));
        if (!begins) amid += "S\n";
      }
  append_paths(out, paths);
  out += amid;
}

void append_object(std::string& out, std::span<const Line* const> lines, const PaperCurves& curves,
                   const model::Model& model, const LayerContents& layer) {
  const std::vector<JoinedLines> chains = join_lines(lines);
  if (chains.empty()) return;
  const model::Object& object = model.object(lines.front()->object);
  out += "/Strake<</Id" + mark_text(object.id) + "/Name" + mark_text(object.name) + "/File" +
         mark_text(model.files[object.file].label) + ">>BDC\n";
  if (layer.dash_mm.empty()) {
    for (const JoinedLines& chain : chains) append_pdf_stroke(out, stroke_of(chain, curves));
    out += "S\n";
  } else {
    append_dashed(out, chains, layer.state, curves, layer.dash_mm);
  }
  out += "EMC\n";
}

std::vector<Stream> streams_of(const std::vector<LayerContents>& layers) {
  std::vector<Stream> streams;
  for (const LayerContents& layer : layers) {
    const std::span<const Line* const> lines(layer.lines);
    std::size_t begin = 0, end = 0;
    for_each_object(lines, [&](std::span<const Line* const> object) {
      end += object.size();
      if (end - begin < kLinesOfStream) return;
      streams.push_back({&layer, lines.subspan(begin, end - begin)});
      begin = end;
    });
    if (begin < end) streams.push_back({&layer, lines.subspan(begin, end - begin)});
  }
  return streams;
}

/// The layer of hidden lines for each way in which a line is hidden: by others, or by its object.
struct Occlusion {
  LineState state;
  std::string_view label;
};
constexpr std::array<Occlusion, 2> kOcclusions = {{
    {LineState::hidden_by_other, "Hidden by other objects"},
    {LineState::hidden_by_self, "Hidden by the object itself"},
}};

/// Adds the layers of a view that have lines, and finds the lines of each.
class LayerMaker {
 public:
  LayerMaker(PdfDocument& document, std::optional<PdfLayerId> parent, const Ink& ink)
      : document_(document), parent_(parent), ink_(ink) {}

  Result<std::vector<LayerContents>> make(const PdfPens& pens, const parallel::Context& context) {
    const Result<LinesOfLayers> lines_of = lines_of_layers(ink_, context);
    if (!lines_of) return lines_of.error();
    for (std::size_t c = 0; c < kOcclusions.size(); ++c) {
      const auto found = parallel::find_first(
          context, {.name = "causes of hiding", .n = ink_.lines.size(), .grain = 16384},
          [&](std::size_t i) { return ink_.lines[i].state == kOcclusions.at(c).state; });
      if (!found) return found.error();
      if (*found) causes_.at(c) = document_.add_layer(kOcclusions.at(c).label, parent_);
    }
    for (std::size_t l = 0; l < kLayers.size(); ++l) {
      const Layer& layer = kLayers.at(l);
      const std::span<const Line* const> lines = (*lines_of)[l];
      if (lines.empty()) continue;
      const PdfLayerId id = document_.add_layer(layer.label, parent_);
      for (const LinesOfStyle& part : by_style(lines, ink_))
        if (layer.hidden)
          for (std::size_t c = 0; c < kOcclusions.size(); ++c)
            add_hidden({layer, id, part}, pens, c);
        else
          add_visible({layer, id, part}, pens);
    }
    return std::move(layers_);
  }

 private:
  /// Lines of one style in a layer.
  struct StyledPart {
    const Layer& layer;
    PdfLayerId id;
    const LinesOfStyle& of;
  };

  [[nodiscard]] LinePen pen_of(const StyledPart& part, const PdfPens& pens, LineState state) const {
    LinePen pen = pens.of(part.layer, state);
    if (part.of.style == ObjectStyles::kPlain) return pen;
    return styled_pen(std::move(pen), part.layer, *ink_.styles, part.of.style, ink_.pens.edge);
  }

  void add(const StyledPart& part, const PdfPens& pens, std::optional<PdfLayerId> cause,
           LayerContents contents, const LinePen& pen) {
    const std::optional<PdfLayerId> style = part.of.style == ObjectStyles::kPlain
                                                ? std::nullopt
                                                : pens.style_layers.at(part.of.style - 1);
    contents.begin = document_.open(part.id);
    contents.end = "Q\n";
    for (const std::optional<PdfLayerId>& other : {cause, style}) {
      if (!other) continue;
      contents.begin += PdfDocument::open_alone(*other);
      contents.end += "EMC\n";
    }
    contents.begin += "q\n" + pdf_pen(pen);
    contents.end += document_.close(part.id);
    layers_.push_back(std::move(contents));
  }

  void add_visible(const StyledPart& part, const PdfPens& pens) {
    const LinePen pen = pen_of(part, pens, LineState::visible);
    // Dashes that a style requests fit each line.
    const bool fits = part.of.style != ObjectStyles::kPlain;
    add(part, pens, std::nullopt,
        {{}, {}, part.of.lines, LineState::visible, fits ? pen.dash_mm : std::vector<double>{}},
        pen);
  }

  /// Adds the lines of a layer that are hidden by one cause: they lie in its layer too.
  void add_hidden(const StyledPart& part, const PdfPens& pens, std::size_t cause) {
    const LineState state = kOcclusions.at(cause).state;
    const LinePen pen = pen_of(part, pens, state);
    const bool dashed_as_one = !ink_.split_hidden && !pen.dash_mm.empty();
    const auto of_state = [&](const Line* line) { return line->state == state; };
    std::vector<const Line*> chosen;
    for_each_object(std::span<const Line* const>(part.of.lines),
                    [&](std::span<const Line* const> object) {
                      if (dashed_as_one && std::ranges::any_of(object, of_state))
                        chosen.insert(chosen.end(), object.begin(), object.end());
                      else
                        std::ranges::copy_if(object, std::back_inserter(chosen), of_state);
                    });
    if (chosen.empty()) return;
    add(part, pens, causes_.at(cause), {{}, {}, std::move(chosen), state, pen.dash_mm}, pen);
  }

  PdfDocument& document_;
  std::optional<PdfLayerId> parent_;
  const Ink& ink_;
  std::array<std::optional<PdfLayerId>, kOcclusions.size()> causes_;
  std::vector<LayerContents> layers_;
};

void add_centre_lines(PdfDocument& document, std::optional<PdfLayerId> parent, const Ink& ink,
                      const LinePen& pen) {
  if (ink.centre_lines.empty()) return;
  const PdfLayerId layer = document.add_layer("Centre lines", parent);
  DashedPaths paths(pen.dash_mm);
  for (const CentreLine& line : ink.centre_lines)
    append_pdf_chain(paths.of(stretch_of(line, pen.dash_mm)), line.points);
  std::string out = document.open(layer) + "q\n" + pdf_pen(pen);
  append_paths(out, paths);
  document.add(out + "Q\n" + document.close(layer));
}

void add_break_lines(PdfDocument& document, std::optional<PdfLayerId> parent, const Ink& ink,
                     const PdfPens& pens) {
  if (ink.break_lines.empty()) return;
  const PdfLayerId layer = document.add_layer("Break lines", parent);
  std::string out = document.open(layer);
  for (const BreakLinesOfStyle& part : break_lines_by_style(ink)) {
    const bool plain = part.style == ObjectStyles::kPlain;
    const std::optional<PdfLayerId> style =
        plain ? std::nullopt : pens.style_layers.at(part.style - 1);
    if (style) out += PdfDocument::open_alone(*style);
    out += "q\n" + pdf_pen(plain ? pens.break_lines
                                 : styled_break_pen(pens.break_lines, *ink.styles, part.style,
                                                    ink.pens.edge));
    for (const BreakLine* const line : part.lines) append_pdf_chain(out, line->points);
    out += style ? "S\nQ\nEMC\n" : "S\nQ\n";
  }
  document.add(out + document.close(layer));
}

std::string with_commas(const geometry::Vec3l& v) { return fmt::format("{},{},{}", v.x, v.y, v.z); }

}  // namespace

PdfStyleLayers add_style_layers(PdfDocument& document, std::span<const Ink* const> views) {
  PdfStyleLayers layers;
  std::map<std::string, PdfLayerId> of_name;
  for (const Ink* const ink : views) {
    if (ink->styles == nullptr) continue;
    const std::vector<ObjectStyle>& styles = ink->styles->all();
    std::vector<bool> used(styles.size() + 1);
    for (const Line& line : ink->lines) used[ink->styles->number_of(line)] = true;
    for (const BreakLine& line : ink->break_lines) used[ink->styles->number_of(line.object)] = true;
    layers.resize(std::max(layers.size(), styles.size()));
    for (std::size_t s = 0; s < styles.size(); ++s) {
      if (!used[s + 1] || styles[s].name.empty() || layers[s]) continue;
      auto known = of_name.find(styles[s].name);
      if (known == of_name.end())
        known = of_name.emplace(styles[s].name, document.add_layer(styles[s].name)).first;
      layers[s] = known->second;
    }
  }
  return layers;
}

std::string pdf_pen(const LinePen& pen) {
  std::string out = pdf_color(pen.color) + "RG\n";
  append_pdf_number(out, pen.width_mm, 4);
  out += " w\n";
  if (pen.dash_mm.empty()) return out;
  out += "0 J ";
  append_dashes(out, pen.dash_mm);
  return out;
}

Status add_pdf_view(PdfDocument& document, std::optional<PdfLayerId> parent,
                    const PaperCurves& curves, const Ink& ink, const model::Model& model,
                    const PdfPens& pens, const parallel::Context& context) {
  const Result<std::vector<LayerContents>> layers =
      LayerMaker(document, parent, ink).make(pens, context);
  if (!layers) return layers.error();
  const std::vector<Stream> streams = streams_of(*layers);
  std::size_t lines = 0;
  for (const Stream& stream : streams) lines += stream.lines.size();
  const parallel::ProgressPhase phase(context.progress, "PDF", lines);
  const Status status = make_in_order(
      "PDF", streams.size(),
      [&](std::size_t i) {
        std::string out = streams[i].layer->begin;
        for_each_object(streams[i].lines, [&](std::span<const Line* const> object) {
          append_object(out, object, curves, model, *streams[i].layer);
        });
        return deflated(out + streams[i].layer->end);
      },
      [&](const std::string& bytes, std::size_t i) {
        document.add_deflated(bytes);
        phase.add(streams[i].lines.size());
      },
      context);
  if (!status) return status;
  add_break_lines(document, parent, ink, pens);
  add_centre_lines(document, parent, ink, pens.centre_lines);
  return status;
}

std::string pdf_facts(const NeutralDrawing& drawing, const Ink& ink, const model::Model& model) {
  std::string out = "<rdf:li rdf:parseType=\"Resource\">\n";
  const auto fact = [&](std::string_view name, std::string_view value) {
    out += fmt::format("<strake:{0}>{1}</strake:{0}>\n", name, xml_escaped(value));
  };
  fact("name", drawing.view_name);
  fact("direction", with_commas(drawing.view.direction));
  fact("up", with_commas(drawing.view.up));
  // A view in perspective has no scale to measure by.
  if (drawing.view.perspective)
    fact("projection", "perspective");
  else
    fact("scale", drawing.sheet.scale_text);
  fact("stage", stage_name(drawing.stage));
  fact("contactDistanceMm", shortest(drawing.contact_distance_mm));
  fact("hash", drawing.hash.text());
  fact("objects", std::to_string(drawing.account.objects()));
  fact("objectsDrawn", std::to_string(drawing.account.of(hlr::Fate::drawn)));
  if (ink.thinned) fact("linesThinned", std::to_string(ink.thinned->lines));
  fact("hiddenLeftOut", std::to_string(ink.left_out));
  for (const model::ObjectId id : drawing.far_left_out) fact("farObject", model.object(id).id);
  return out + "</rdf:li>\n";
}

}  // namespace strake::drawing
