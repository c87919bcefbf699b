// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "page/page.hpp"
#include "strake/drawing/write.hpp"

namespace strake::page {
namespace {

/// Returns which objects have a line in a drawing that is not clipped.
std::vector<bool> drawn_objects(const drawing::NeutralDrawing& drawing, const model::Model& model) {
  std::vector<bool> drawn(model.objects.size(), false);
  for (const drawing::Line& line : drawing.lines) {
    if (line.state == drawing::LineState::clipped) continue;
    drawn[model::index(line.object)] = drawn[model::index(line.other)] = true;
  }
  return drawn;
}

}  // namespace

PageDrawing page_drawing(const drawing::NeutralDrawing& drawing, const drawing::Ink& ink,
                         const model::Model& model) {
  PageDrawing page;
  page.title = drawing.title.empty() ? drawing.view_name : drawing.title;
  page.objects =
      static_cast<std::uint64_t>(std::ranges::count(drawn_objects(drawing, model), true));
  drawing::write_svg(drawing, ink, model, [&](std::string_view text) { page.svg += text; });
  return page;
}

Status write_drawing_page(const drawing::DrawingContents& contents, drawing::Sink sink,
                          const parallel::Context& context) {
  PageDrawing drawing = page_drawing(contents.drawing, contents.ink, contents.model);
  PageContents page{.title = drawing.title,
                    .model = contents.model,
                    .scene = contents.scene,
                    .without_model = {"This drawing was written from its lines alone.",
                                      "To have the model, draw it again from the model's files."},
                    .drawn = drawn_objects(contents.drawing, contents.model)};
  page.drawings.push_back(std::move(drawing));
  return write_page(page, sink, context);
}

}  // namespace strake::page
