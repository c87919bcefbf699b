// SPDX-License-Identifier: Apache-2.0
// PDF of sheets: a page for each, with the layers of its views and its marks.
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "drawing/pdf/pdf_document.hpp"
#include "drawing/pdf/pdf_path.hpp"
#include "drawing/pdf/pdf_syntax.hpp"
#include "drawing/pdf/pdf_view.hpp"
#include "sheets/output/artwork/artwork.hpp"
#include "sheets/output/line_styles.hpp"
#include "sheets/spec/text_metrics.hpp"
#include "strake/sheets/write.hpp"

namespace strake::sheets {

namespace {

using drawing::LinePen;
using drawing::PdfDocument;
using drawing::PdfLayerId;

LinePen pen_of(const LineStyle& style) { return {style.width_mm, style.dash_mm, style.color}; }

/// The part of its width by which a text lies before its place.
double anchor_of(Align align) {
  return align == Align::start ? 0 : align == Align::middle ? 0.5 : 1;
}

/// Writes the pages of one document.
class PageWriter {
 public:
  PageWriter(PdfDocument& document, const model::Model& model, const parallel::Context& context)
      : document_(document), model_(model), context_(context) {}

  Status write(const Sheet& sheet) {
    sheet_ = &sheet;
    document_.begin_page({sheet.width_mm, sheet.height_mm},
                         sheet.name.empty() ? sheet.title : sheet.name);
    if (const Status status = write_artwork(); !status) return status;
    write_layer(sheet.frame, "Frame", std::nullopt);
    write_layer(sheet.notes, "Notes", std::nullopt);
    std::vector<const drawing::Ink*> inks;
    for (const PlacedView& view : sheet.views) inks.push_back(&view.ink);
    styles_ = drawing::add_style_layers(document_, inks);
    for (const PlacedView& view : sheet.views)
      if (const Status status = write_view(view); !status) return status;
    return {};
  }

  /// Of templates, what is not drawn.
  [[nodiscard]] const Diagnostics& diagnostics() const { return diagnostics_; }

 private:
  Status write_artwork() {
    if (!sheet_->artwork) return {};
    const PdfLayerId layer = document_.add_layer("Frame");
    std::string out = document_.open(layer);
    const Status status = append_artwork(out, document_, *sheet_->artwork,
                                         {sheet_->width_mm, sheet_->height_mm}, diagnostics_);
    if (status) document_.add(out + document_.close(layer));
    return status;
  }

  Status write_view(const PlacedView& view) {
    const PdfLayerId layer = document_.add_layer(view.name);
    document_.add_bookmark(view.title.empty() ? view.name : view.title,
                           {view.box.left, view.box.top, view.box.right, view.box.bottom});
    const auto pen = [&](const drawing::Layer& of, drawing::LineState state) {
      return pen_of_layer(sheet_->styles, view.ink, of, state);
    };
    const LinePen break_lines = pen_of(style_of(sheet_->styles, LineClass::break_line));
    const Status status = drawing::add_pdf_view(
        document_, layer, view.drawing.curves, view.ink, model_,
        {pen, pen_of(style_of(sheet_->styles, LineClass::centre)), break_lines, styles_}, context_);
    if (!status) return status;
    write_layer(view.frame, "Frame", layer);
    write_layer(view.grid, "Grid", layer);
    write_layer(view.notes, "Notes", layer);
    write_layer(view.match_lines, "Match lines", layer);
    write_layer(view.tags, "Tags", layer);
    write_layer(view.caption, "Title", layer);
    return {};
  }

  /// Writes a layer of marks, where there are any.
  void write_layer(const Marks& marks, std::string_view label, std::optional<PdfLayerId> parent) {
    if (marks.paths.empty() && marks.circles.empty() && marks.texts.empty()) return;
    const PdfLayerId layer = document_.add_layer(label, parent);
    std::string out = document_.open(layer);
    append_marks(out, marks);
    document_.add(out + document_.close(layer));
  }

  void append_marks(std::string& out, const Marks& marks) {
    for (const Text& text : marks.texts)
      if (text.clears) append_cleared(out, corners_of(text));
    for (const Path& path : marks.paths) {
      const LineStyle& style = style_of(sheet_->styles, path.line);
      out += path.filled ? "q\n" + drawing::pdf_color(style.color) + "rg\n"
                         : "q\n" + drawing::pdf_pen(pen_of(style));
      drawing::append_pdf_chain(out, path.points);
      out += path.filled ? "f\nQ\n" : "S\nQ\n";
    }
    for (const Circle& circle : marks.circles) {
      out += "q\n" + drawing::pdf_pen(pen_of(style_of(sheet_->styles, circle.line)));
      drawing::append_pdf_circle(out, circle.center, circle.radius_mm);
      out += "S\nQ\n";
    }
    for (const Text& text : marks.texts)
      document_.append_text(out, text.text,
                            {text.at, text.height_mm * kFontSize, anchor_of(text.align),
                             style_of(sheet_->styles, text.line).color, text.turn_deg});
  }

  static void append_cleared(std::string& out, const std::array<PaperPoint, 4>& corners) {
    const auto& [lower_left, lower_right, upper_right, upper_left] = corners;
    out += "1 g\n";
    drawing::append_pdf_chain(out, {upper_left, upper_right, lower_right, lower_left, upper_left});
    out += "f\n0 g\n";
  }

  PdfDocument& document_;
  const model::Model& model_;
  const parallel::Context& context_;
  const Sheet* sheet_ = nullptr;
  drawing::PdfStyleLayers styles_;
  Diagnostics diagnostics_;
};

}  // namespace

Result<Diagnostics> write_pdf(std::span<const Sheet> sheets, const model::Model& model,
                              drawing::Sink sink, const parallel::Context& context) {
  if (sheets.empty()) return Error{ErrorCode::usage, "there is no sheet to write", {}, {}};
  std::string facts;
  for (const Sheet& sheet : sheets)
    for (const PlacedView& view : sheet.views)
      facts += drawing::pdf_facts(view.drawing, view.ink, model);
  PdfDocument document(sink, sheets.front().title, std::move(facts));
  PageWriter pages(document, model, context);
  for (const Sheet& sheet : sheets)
    if (const Status status = pages.write(sheet); !status) return status.error();
  Diagnostics noticed = pages.diagnostics();
  noticed.append(document.finish());
  return noticed;
}

}  // namespace strake::sheets
