// SPDX-License-Identifier: Apache-2.0
#include "drawing/layout/paper_size.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "core/text_encoding.hpp"
#include "core/units.hpp"
#include "drawing/layout/view_plane.hpp"

namespace strake::drawing {

namespace {

Error fault(std::string message) {
  return {ErrorCode::usage, std::move(message), "",
          "write A4, A3, A2, A1 or A0, with ,portrait for upright paper, or width x height, as "
          "900mmx420mm"};
}

std::string quoted(std::string_view text) { return "'" + std::string(text) + "'"; }

Result<PaperSize> named_paper(std::string_view text, std::string_view name, std::string_view way) {
  const auto* const found = std::ranges::find_if(
      kNamedPapers, [&](const NamedPaper& paper) { return paper.name == name; });
  if (found == kNamedPapers.end()) return fault("no paper is called " + quoted(name));
  if (way.empty() || way == "landscape") return found->size;
  if (way == "portrait") return PaperSize{found->size.height_mm, found->size.width_mm};
  return fault(quoted(way) + " of " + quoted(text) + " is neither landscape nor portrait");
}

/// Parses a side of the paper: millimetres where it has no unit, in whole micrometres.
Result<double> side_mm(std::string_view text, std::string_view side) {
  const Result<double> mm = parse_coordinate_mm(side);
  if (!mm) return fault(quoted(side) + " of " + quoted(text) + " is no length of paper");
  const double side_of_paper = rounded_paper(*mm);  // 12 inches are 304.8 mm, whatever doubles say
  if (!(side_of_paper >= kMinPaperMm && side_of_paper <= kLargestPaperMm))
    return fault(quoted(side) + " of " + quoted(text) + " is not between 100mm and 20m");
  return side_of_paper;
}

}  // namespace

Result<PaperSize> parse_paper(std::string_view text) {
  const std::string_view whole = trimmed(text);
  if (const std::size_t by = whole.find('x'); by != std::string_view::npos) {
    const Result<double> width = side_mm(whole, trimmed(whole.substr(0, by)));
    if (!width) return width.error();
    const Result<double> height = side_mm(whole, trimmed(whole.substr(by + 1)));
    if (!height) return height.error();
    return PaperSize{*width, *height};
  }
  const std::size_t end = std::min(whole.find_first_of(", "), whole.size());
  std::string_view way = trimmed(whole.substr(end));
  if (way.starts_with(',')) way = trimmed(way.substr(1));
  return named_paper(whole, whole.substr(0, end), way);
}

}  // namespace strake::drawing
