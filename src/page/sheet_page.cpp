// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "page/page.hpp"
#include "strake/sheets/write.hpp"

namespace strake::page {
namespace {

/// Marks the objects that have ink in a view.
void mark_drawn(const drawing::Ink& ink, std::vector<bool>& drawn) {
  for (const drawing::Line& line : ink.lines)
    drawn[model::index(line.object)] = drawn[model::index(line.other)] = true;
}

PageDrawing page_sheet(const sheets::Sheet& sheet, const model::Model& model) {
  PageDrawing page;
  page.title = sheet.name.empty() ? sheet.title : sheet.name;
  std::vector<bool> drawn(model.objects.size());
  for (const sheets::PlacedView& view : sheet.views) mark_drawn(view.ink, drawn);
  page.objects = static_cast<std::uint64_t>(std::ranges::count(drawn, true));
  sheets::write_svg(sheet, model, [&](std::string_view text) { page.svg += text; });
  return page;
}

/// "DECK 1", "DECK 1 and 2 more".
std::string title_of(std::span<const sheets::Sheet> sheets) {
  std::string title = sheets.front().title;
  if (sheets.size() > 1) title += " and " + std::to_string(sheets.size() - 1) + " more";
  return title;
}

}  // namespace

Status write_sheet_page(const sheets::SheetContents& contents, drawing::Sink sink,
                        const parallel::Context& context) {
  PageContents page{.title = title_of(contents.sheets),
                    .model = contents.model,
                    .scene = contents.scene,
                    .drawn = std::vector<bool>(contents.model.objects.size())};
  for (const sheets::Sheet& sheet : contents.sheets) {
    for (const sheets::PlacedView& view : sheet.views) mark_drawn(view.ink, page.drawn);
    page.drawings.push_back(page_sheet(sheet, contents.model));
  }
  return write_page(page, sink, context);
}

}  // namespace strake::page
