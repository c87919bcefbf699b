// SPDX-License-Identifier: Apache-2.0
#include "sheets/output/artwork/artwork.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

#include "drawing/pdf/pdf_syntax.hpp"
#include "sheets/output/artwork/svg_element.hpp"
#include "sheets/output/artwork/svg_geometry.hpp"
#include "sheets/output/artwork/svg_style.hpp"

namespace strake::sheets {

namespace {

/// Elements that draw nothing where they stand.
constexpr std::array<std::string_view, 12> kUnseen{
    "",         "defs", "symbol",  "title",  "desc",           "style",
    "clipPath", "mask", "pattern", "marker", "linearGradient", "radialGradient"};

/// Fits a viewBox into the paper, in its middle, as SVG does where nothing else is said.
Affine fit_view_box(std::string_view view_box, const drawing::PaperSize& paper) {
  const auto box = svg_numbers(view_box);
  if (!box || box->size() != 4 || !((*box)[2] > 0) || !((*box)[3] > 0)) return {};
  const double scale = std::min(paper.width_mm / (*box)[2], paper.height_mm / (*box)[3]);
  return {scale,
          0,
          0,
          scale,
          (paper.width_mm - scale * (*box)[2]) / 2 - scale * (*box)[0],
          (paper.height_mm - scale * (*box)[3]) / 2 - scale * (*box)[1]};
}

/// A piece of a text in one style.
struct TextRun {
  std::string text;
  SvgStyle style;
  std::optional<double> x, y;  ///< where it begins, unless where the last one ends
  double dx = 0, dy = 0;
};

class ArtworkDrawer {
 public:
  ArtworkDrawer(ArtworkCanvas& canvas, const SvgElements& elements)
      : canvas_(canvas), elements_(elements) {}

  void draw(const Affine& to_paper) {
    const auto noted = [this](const std::string& what) { left_out_.insert(what); };
    for (const SvgElement& element : elements_.all)
      if (element.name == "style")
        for (const std::size_t child : element.children)
          styles_.add(elements_.all[child].text, noted);
    draw_children(elements_.all.front(), to_paper, {});
  }

  [[nodiscard]] const std::set<std::string>& left_out() const { return left_out_; }

 private:
  /// Returns the style of an element, and notes what of it is not painted as it is said.
  [[nodiscard]] SvgStyle style_of(const SvgElement& element, const SvgStyle& parent) {
    return styles_.style_of(element, parent,
                            [this](const std::string& what) { left_out_.insert(what); });
  }

  void draw_children(const SvgElement& element, const Affine& to_paper, const SvgStyle& style) {
    for (const std::size_t child : element.children)
      draw_element(elements_.all[child], to_paper, style);
  }

  void draw_element(const SvgElement& element, const Affine& to_paper, const SvgStyle& parent) {
    if (std::ranges::find(kUnseen, element.name) != kUnseen.end()) return;
    const SvgStyle style = style_of(element, parent);
    if (!style.shown) return;
    Affine own = to_paper;
    if (const std::string_view text = element.value("transform"); !text.empty()) {
      const auto transform = svg_transform(text);
      if (!transform)
        return void(left_out_.insert("transform: " + std::string(text.substr(0, 40))));
      own = to_paper.after(*transform);
    }
    if (element.name == "g") return draw_children(element, own, style);
    if (element.name == "use") return draw_used(element, own, style);
    if (element.name == "text") return draw_text(element, own, style);
    PathBuilder path(own);
    if (!build(element, path)) return void(left_out_.insert("<" + element.name + ">"));
    paint(path, style, own.scale());
  }

  void draw_used(const SvgElement& element, const Affine& to_paper, const SvgStyle& style) {
    std::string_view target = element.value("href");
    if (target.empty()) target = element.value("xlink:href");
    if (target.empty()) return;
    const auto found = elements_.by_id.find(target.substr(1));
    if (found == elements_.by_id.end()) return;
    // References do not lead in a circle; they may lead deep.
    constexpr int kDeepest = 100;
    if (uses_ == kDeepest) return void(left_out_.insert("<use> of more than 100 others"));
    ++uses_;
    draw_target(elements_.all[found->second], element, to_paper, style);
    --uses_;
  }

  void draw_target(const SvgElement& used, const SvgElement& element, const Affine& to_paper,
                   const SvgStyle& style) {
    const Affine moved = to_paper.after({1, 0, 0, 1, number(element, "x"), number(element, "y")});
    if (used.name != "symbol") return draw_element(used, moved, style);
    if (!used.value("viewBox").empty()) return void(left_out_.insert("<symbol viewBox>"));
    draw_children(used, moved, style_of(used, style));
  }

  [[nodiscard]] static double number(const SvgElement& element, std::string_view attribute) {
    return svg_length(element.value(attribute)).value_or(0);
  }

  /// Builds the path of a shape; false where the element is none.
  bool build(const SvgElement& element, PathBuilder& path) {
    const auto n = [&](std::string_view attribute) { return number(element, attribute); };
    if (element.name == "path") {
      if (!path.add(element.value("d"))) left_out_.insert("the end of a damaged <path>");
    } else if (element.name == "line") {
      path.move(n("x1"), n("y1"));
      path.line(n("x2"), n("y2"));
    } else if (element.name == "rect") {
      build_rect(element, path);
    } else if (element.name == "circle") {
      if (n("r") > 0) path.ellipse(n("cx"), n("cy"), n("r"), n("r"));
    } else if (element.name == "ellipse") {
      if (n("rx") > 0 && n("ry") > 0) path.ellipse(n("cx"), n("cy"), n("rx"), n("ry"));
    } else if (element.name == "polyline" || element.name == "polygon") {
      const auto points = svg_numbers(element.value("points"));
      for (std::size_t i = 0; points && i + 1 < points->size(); i += 2)
        i == 0 ? path.move((*points)[0], (*points)[1]) : path.line((*points)[i], (*points)[i + 1]);
      if (element.name == "polygon" && !path.operators().empty()) path.close();
    } else {
      return false;
    }
    return true;
  }

  static void build_rect(const SvgElement& element, PathBuilder& path) {
    const double x = number(element, "x"), y = number(element, "y"),
                 width = number(element, "width"), height = number(element, "height");
    if (!(width > 0) || !(height > 0)) return;
    const auto rx_given = svg_length(element.value("rx")),
               ry_given = svg_length(element.value("ry"));
    const double rx = std::clamp(rx_given.value_or(ry_given.value_or(0)), 0.0, width / 2),
                 ry = std::clamp(ry_given.value_or(rx_given.value_or(0)), 0.0, height / 2);
    const PathBuilder::Arc corner{rx, ry, 0, false, true};
    const double right = x + width, bottom = y + height;
    path.move(x + rx, y);
    path.line(right - rx, y);
    path.arc(corner, right, y + ry);
    path.line(right, bottom - ry);
    path.arc(corner, right - rx, bottom);
    path.line(x + rx, bottom);
    path.arc(corner, x, bottom - ry);
    path.line(x, y + ry);
    path.arc(corner, x + rx, y);
    path.close();
  }

  void paint(const PathBuilder& path, const SvgStyle& style, double scale) {
    const bool stroked = style.stroke && style.stroke_width > 0;
    const bool filled = style.fill && path.has_inside();
    if (path.operators().empty() || (!stroked && !filled)) return;
    canvas_.paint(path, style, scale, [this](const std::string& what) { left_out_.insert(what); });
  }

  void draw_text(const SvgElement& element, const Affine& to_paper, const SvgStyle& style) {
    std::vector<TextRun> runs;
    gather(element, style, runs);
    if (runs.empty()) return;
    runs.back().text.erase(runs.back().text.find_last_not_of(' ') + 1);
    double x = 0, y = 0;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const TextRun& run = runs[i];
      if (run.x || run.y || i == 0) {
        x = run.x.value_or(x) - anchored(runs, i);
        y = run.y.value_or(y);
      }
      x += run.dx, y += run.dy;
      const double size = run.style.font_size;
      const double width = canvas_.width_of(run.text);
      if (run.style.fill && size > 0 && !run.text.empty())
        canvas_.write({run.text, run.style, to_paper.after({size, 0, 0, -size, x, y}), width,
                       runs.size() == 1});
      x += width * size;
    }
  }

  /// Returns how far a chunk of runs, from one place to the next, lies before its place.
  [[nodiscard]] double anchored(const std::vector<TextRun>& runs, std::size_t first) {
    if (runs[first].style.anchor == Align::start) return 0;
    double width = 0;
    for (std::size_t i = first; i < runs.size(); ++i) {
      if (i > first && (runs[i].x || runs[i].y)) break;
      width += canvas_.width_of(runs[i].text) * runs[i].style.font_size;
    }
    return runs[first].style.anchor == Align::middle ? width / 2 : width;
  }

  /// Gathers the runs of a text and of the elements within it.
  void gather(const SvgElement& element, const SvgStyle& style, std::vector<TextRun>& runs) {
    const auto first = [&](std::string_view attribute) -> std::optional<double> {
      const std::string_view value = element.value(attribute);
      if (const auto one = svg_length(value)) return one;
      const auto list = svg_numbers(value);
      return list && !list->empty() ? std::optional(list->front()) : std::nullopt;
    };
    TextRun next{
        {}, style, first("x"), first("y"), first("dx").value_or(0), first("dy").value_or(0)};
    for (const std::size_t index : element.children) {
      const SvgElement& child = elements_.all[index];
      if (child.name.empty()) {
        next.text = without_blanks(child.text, runs.empty() || runs.back().text.ends_with(' '));
        if (next.text.empty()) continue;
        runs.push_back(std::exchange(next, {{}, style, {}, {}, 0, 0}));
      } else if (child.name == "tspan") {
        // Where the text begins holds for what is within it, too.
        const std::size_t before = runs.size();
        const SvgStyle own = style_of(child, style);
        if (own.shown) gather(child, own, runs);
        if (runs.size() == before) continue;
        TextRun& begun = runs[before];
        if (!begun.x) begun.x = next.x;
        if (!begun.y) begun.y = next.y;
        next = {{}, style, {}, {}, 0, 0};
      } else if (child.name != "title" && child.name != "desc") {
        left_out_.insert("<" + child.name + ">");
      }
    }
  }

  /// Returns the text with single blanks, and none in front where one stands there already.
  static std::string without_blanks(std::string_view text, bool after_blank) {
    std::string out;
    for (const char c : text) {
      const bool blank = c == ' ' || c == '\n' || c == '\t' || c == '\r';
      if (!blank || !after_blank) out += blank ? ' ' : c;
      after_blank = blank;
    }
    return out;
  }

  ArtworkCanvas& canvas_;
  const SvgElements& elements_;
  StyleSheet styles_;
  std::set<std::string> left_out_;
  int uses_ = 0;  ///< references that are being followed
};

/// The contents of a page.
class PdfCanvas final : public ArtworkCanvas {
 public:
  PdfCanvas(std::string& out, drawing::PdfDocument& document) : out_(out), document_(document) {}

  [[nodiscard]] double width_of(const std::string& text) override {
    return document_.width_of(text);
  }

  void paint(const PathBuilder& path, const SvgStyle& style, double scale,
             ReportUnsupported /*tell*/) override {
    const bool stroked = style.stroke && style.stroke_width > 0;
    const bool filled = style.fill && path.has_inside();
    out_ += "q\n";
    if (filled) out_ += drawing::pdf_color(*style.fill) + "rg\n";
    if (stroked) append_pen(style, scale);
    out_ += path.operators();
    out_ += filled ? (stroked ? "B" : "f") : "S";
    out_ += filled && style.even_odd ? "*\nQ\n" : "\nQ\n";
  }

  void write(const ArtworkText& text) override {
    const Affine& m = text.to_paper;
    out_ += "BT\n" + drawing::pdf_color(*text.style.fill) + "rg\n";
    for (const double value : {m.a, m.b, m.c, m.d}) {
      drawing::append_pdf_number(out_, value);
      out_ += ' ';
    }
    drawing::append_pdf_point(out_, {m.e, m.f});
    out_ += "Tm\n";
    document_.append_text_at_origin(out_, text.text);
    out_ += "ET\n";
  }

 private:
  void append_pen(const SvgStyle& style, double scale) {
    const auto length = [&](double value) {
      drawing::append_pdf_number(out_, value * scale, 4);
      out_ += ' ';
    };
    out_ += drawing::pdf_color(*style.stroke) + "RG\n";
    length(style.stroke_width);
    out_ += "w " + std::to_string(style.cap) + " J " + std::to_string(style.join) + " j ";
    drawing::append_pdf_number(out_, std::max(style.miter_limit, 1.0), 2);
    out_ += " M [";
    for (const double dash : style.dashes) length(dash);
    out_ += "] 0 d\n";
  }

  std::string& out_;
  drawing::PdfDocument& document_;
};

}  // namespace

Status draw_artwork(ArtworkCanvas& canvas, const Sheet::Template& artwork,
                    const drawing::PaperSize& paper, std::string_view format,
                    Diagnostics& diagnostics) {
  const Result<SvgElements> elements = parse_elements(artwork.elements);
  if (!elements) return elements.error();
  ArtworkDrawer drawer(canvas, *elements);
  drawer.draw(fit_view_box(artwork.view_box, paper));
  for (const std::string& what : drawer.left_out())
    diagnostics.add(Severity::warning, "template-part-left-out",
                    "the " + std::string(format) + " has the template without this: " + what,
                    "the template");
  return {};
}

Status append_artwork(std::string& out, drawing::PdfDocument& document,
                      const Sheet::Template& artwork, const drawing::PaperSize& paper,
                      Diagnostics& diagnostics) {
  PdfCanvas canvas(out, document);
  return draw_artwork(canvas, artwork, paper, "PDF", diagnostics);
}

}  // namespace strake::sheets
