// SPDX-License-Identifier: Apache-2.0
#include "sheets/annotation/note_table.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include "drawing/layout/view_plane.hpp"
#include "sheets/labels/tags.hpp"
#include "sheets/spec/natural_order.hpp"
#include "sheets/spec/template.hpp"
#include "sheets/spec/text_metrics.hpp"

namespace strake::sheets {

namespace {

using drawing::rounded_paper;

constexpr double kRowMm = 5, kCellLettersMm = 2.5, kPaddingMm = 1.5, kWidestMm = 90,
                 kNarrowestMm = 10, kMinLettersMm = 1.2;

std::vector<double> widths_of(const NoteTable& table) {
  std::vector<double> widths;
  for (std::size_t c = 0; c < table.headings.size(); ++c) {
    double widest = text_width(table.headings[c]);
    for (const auto& row : table.rows) widest = std::max(widest, text_width(row[c]));
    widths.push_back(rounded_paper(
        std::clamp(widest * kCellLettersMm + 2 * kPaddingMm, kNarrowestMm, kWidestMm)));
  }
  return widths;
}

double lines_of(const NoteTable& table) {
  return static_cast<double>(table.rows.size() + (table.title.empty() ? 1 : 2));
}

void write_cell(const std::string& text, const PaperPoint& at, double width, Marks& marks) {
  if (text.empty()) return;
  const Text full{LineClass::note,
                  {rounded_paper(at.x + kPaddingMm), rounded_paper(at.y - 1.2)},
                  kCellLettersMm,
                  Align::start,
                  text,
                  false};
  Text shrunk = shrunk_to_width(full, width - 2 * kPaddingMm, kMinLettersMm);
  shrunk.height_mm = rounded_paper(shrunk.height_mm);
  // Heights and widths are rounded, which is not to cost a text its end.
  marks.texts.push_back(cut_to_width(std::move(shrunk), width - 2 * kPaddingMm + 0.1));
}

}  // namespace

void NoteTable::fit(double height_mm) {
  while (!rows.empty() && extent_of(*this).bottom > height_mm) {
    rows.pop_back();
    ++left_out;
  }
}

PaperBox extent_of(const NoteTable& table) {
  double width = 0;
  for (const double column : widths_of(table)) width += column;
  return {0, 0, width, kRowMm * lines_of(table)};
}

void draw_table(const NoteTable& table, const PaperPoint& upper_left, Marks& marks) {
  const std::vector<double> widths = widths_of(table);
  const auto point = [&](double x, double y) {
    return PaperPoint{rounded_paper(upper_left.x + x), rounded_paper(upper_left.y + y)};
  };
  const auto line = [&](const PaperPoint& a, const PaperPoint& b) {
    marks.paths.push_back({LineClass::note, {a, b}, false});
  };
  const auto [left, top, right, bottom] = extent_of(table);
  marks.paths.push_back({LineClass::note,
                         {point(left, top), point(right, top), point(right, bottom),
                          point(left, bottom), point(left, top)},
                         false});
  double y = 0;
  if (!table.title.empty()) {
    y += kRowMm;
    write_cell(table.title, point(0, y), right, marks);
    line(point(0, y), point(right, y));
  }
  const double head = y;
  const auto write_row = [&](const std::vector<std::string>& row) {
    y += kRowMm;
    double x = 0;
    for (std::size_t c = 0; c < widths.size(); ++c) {
      write_cell(row[c], point(x, y), widths[c], marks);
      x += widths[c];
    }
    if (y < bottom) line(point(0, y), point(right, y));
  };
  write_row(table.headings);
  for (const auto& row : table.rows) write_row(row);
  double x = 0;
  for (std::size_t c = 0; c + 1 < widths.size(); ++c) {
    x += widths[c];
    line(point(x, head), point(x, bottom));
  }
}

PartsList parts_list(const PartsListSpec& spec, const std::vector<bool>& picked,
                     const model::Model& model) {
  PartsList list{{on_one_line(spec.title), {"POS"}, {}, 0}, {}};
  NoteTable& table = list.table;
  std::vector<std::vector<TextPiece>> columns;
  for (const std::string& column : spec.columns) {
    auto pieces = split_placeholders(column);
    columns.push_back(pieces ? std::move(*pieces) : std::vector<TextPiece>{});
  }
  for (const std::string& heading : spec.headings) table.headings.push_back(on_one_line(heading));
  table.headings.emplace_back("QTY");
  const auto before = [](const std::vector<std::string>& a, const std::vector<std::string>& b) {
    return std::ranges::lexicographical_compare(a, b, natural_less);
  };
  std::map<std::vector<std::string>, std::vector<model::ObjectId>, decltype(before)> rows(before);
  for (std::size_t o = 0; o < picked.size(); ++o) {
    if (!picked[o]) continue;
    const model::ObjectId object{static_cast<std::uint32_t>(o)};
    std::vector<std::string> texts;
    for (const auto& column : columns)
      texts.push_back(on_one_line(fill_placeholders(
          column, [&](const std::string& name) { return value_of_name(model, object, name); })));
    rows[std::move(texts)].push_back(object);
  }
  for (auto& [texts, objects] : rows) {
    std::vector<std::string> row{std::to_string(table.rows.size() + 1)};
    row.insert(row.end(), texts.begin(), texts.end());
    row.push_back(std::to_string(objects.size()));
    table.rows.push_back(std::move(row));
    list.objects.push_back(std::move(objects));
  }
  return list;
}

NoteTable revision_table(const std::vector<RevisionSpec>& revisions) {
  NoteTable table{{}, {"REV", "DATE", "DESCRIPTION", "BY"}, {}, 0};
  for (auto it = revisions.rbegin(); it != revisions.rend(); ++it)
    table.rows.push_back({on_one_line(it->revision), on_one_line(it->date), on_one_line(it->text),
                          on_one_line(it->by)});
  return table;
}

}  // namespace strake::sheets
