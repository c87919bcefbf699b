// SPDX-License-Identifier: Apache-2.0
// PDF of a drawing: one page with the layers of its view.
#include <array>
#include <string>

#include "drawing/ink/dash_fit.hpp"
#include "drawing/ink/hidden_ink.hpp"
#include "drawing/pdf/pdf_document.hpp"
#include "drawing/pdf/pdf_path.hpp"
#include "drawing/pdf/pdf_view.hpp"
#include "strake/drawing/write.hpp"

namespace strake::drawing {

namespace {

/// Adds a layer with lines of the thin pen and operators after them.
void add_framing(PdfDocument& document, std::string_view label, const Pens& pens,
                 const Chain& chain, const std::string& texts) {
  const PdfLayerId layer = document.add_layer(label);
  std::string out = document.open(layer) + "q\n" + pdf_pen({pens.thin, {}, {0, 0, 0, 255}});
  append_pdf_chain(out, chain);
  document.add(out + "S\n" + texts + "Q\n" + document.close(layer));
}

void add_title(PdfDocument& document, const NeutralDrawing& drawing, const Pens& pens) {
  constexpr double kLetters = 3.5;
  const Sheet& sheet = drawing.sheet;
  const double right = sheet.width_mm - 10, line = sheet.height_mm - 11, base = line + 5;
  std::string texts;
  document.append_text(texts, drawing.title, {{10, base}, kLetters, 0, {0, 0, 0, 255}});
  // A view in perspective has no scale to measure by.
  if (!drawing.view.perspective)
    document.append_text(texts, "scale " + sheet.scale_text,
                         {{right, base}, kLetters, 1, {0, 0, 0, 255}});
  add_framing(document, "Title", pens, {{10, line}, {right, line}}, texts);
}

std::string title_of(const NeutralDrawing& drawing) {
  if (drawing.view.perspective) return drawing.title;
  return drawing.title + " \xC2\xB7 " + drawing.sheet.scale_text;
}

}  // namespace

Result<Diagnostics> write_pdf(const NeutralDrawing& drawing, const Ink& ink,
                              const model::Model& model, Sink sink,
                              const parallel::Context& context) {
  PdfDocument document(sink, title_of(drawing), pdf_facts(drawing, ink, model));
  document.begin_page({drawing.sheet.width_mm, drawing.sheet.height_mm}, title_of(drawing));
  const std::array<const Ink*, 1> views{&ink};
  const PdfStyleLayers styles = add_style_layers(document, views);
  const auto pen_of_layer = [&](const Layer& layer, LineState /*state*/) {
    return usual_pen(layer, ink.pens);
  };
  const Status status =
      add_pdf_view(document, std::nullopt, drawing.curves, ink, model,
                   {pen_of_layer,
                    {ink.pens.thin, pen_dashes(kCentreDashes, ink.pens.thin), {0, 0, 0, 255}},
                    {ink.pens.thin, {}, {0, 0, 0, 255}},
                    styles},
                   context);
  if (!status) return status.error();
  if (drawing.frame) {
    const auto& [left, top, right, bottom] = *drawing.frame;
    add_framing(document, "Frame", ink.pens,
                {{left, top}, {right, top}, {right, bottom}, {left, bottom}, {left, top}}, "");
  }
  add_title(document, drawing, ink.pens);
  return document.finish();
}

}  // namespace strake::drawing
