// SPDX-License-Identifier: Apache-2.0
#include "workbook/sheet/workbook.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>

#include "drawing/buffered_writer.hpp"
#include "report/zip/zip_writer.hpp"
#include "workbook/sheet/sheet_parts.hpp"

namespace strake::workbook {
namespace {

/// Appends the rows of a sheet to the file that is begun. A piece has a fixed number of rows, so
/// that its bytes are the same for any team.
Status add_rows(report::ZipWriter& zip, const Worksheet& sheet, const parallel::Context& context) {
  const std::size_t heads = sheet.has_heads() ? 1 : 0;
  bool packed = true;
  const Status status = drawing::write_in_batches(
      "clash results", sheet.rows,
      [&](std::size_t begin, std::size_t end, std::string& out) {
        std::string text;
        for (std::size_t i = begin; i < end; ++i) {
          SheetRow row(text, i + heads);
          sheet.cells(i, row);
          row.end();
        }
        if (const Result<report::DeflatedPiece> piece = report::deflate_piece(text))
          report::append_piece(out, *piece);
      },
      [&](std::string_view piece) {
        packed = packed && !piece.empty();
        if (packed) zip.add(report::parse_piece(piece));
      },
      context);
  if (!status || packed) return status;
  return Error{ErrorCode::memory, "no memory to pack a workbook with", {}, {}};
}

Status add_sheet(report::ZipWriter& zip, const Worksheet& sheet, std::size_t number,
                 const parallel::Context& context) {
  const Result<report::DeflatedPiece> head = report::deflate_piece(sheet_head(sheet, number == 0));
  if (!head) return head.error();
  zip.begin(sheet_part(number));
  zip.add(*head);
  if (const Status rows = add_rows(zip, sheet, context); !rows) return rows;
  const Result<report::DeflatedPiece> tail = report::deflate_piece(sheet_tail(sheet));
  if (!tail) return tail.error();
  zip.add(*tail);
  return zip.end();
}

}  // namespace

std::optional<PictureSize> size_of_png(std::string_view png) {
  constexpr std::string_view kBegin("\x89PNG\r\n\x1A\n\0\0\0\rIHDR", 16);
  if (png.size() < kBegin.size() + 8 || !png.starts_with(kBegin)) return std::nullopt;
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (const char byte : png.substr(at, 4))
      value = (value << 8U) | static_cast<unsigned char>(byte);
    return value;
  };
  const PictureSize size{number(kBegin.size()), number(kBegin.size() + 4)};
  if (size.width == 0 || size.height == 0) return std::nullopt;
  return size;
}

void append_split(std::vector<Worksheet>& sheets, const Worksheet& whole, std::size_t max_rows) {
  std::size_t first = 0, number = 1;
  do {
    Worksheet sheet = whole;
    sheet.rows = std::min(whole.rows - first, max_rows);
    if (first > 0) {
      sheet.name += " " + std::to_string(++number);
      sheet.cells = [first, cells = whole.cells](std::size_t i, SheetRow& row) {
        cells(first + i, row);
      };
    }
    first += sheet.rows;
    sheets.push_back(std::move(sheet));
  } while (first < whole.rows);
}

Status write_workbook(std::span<const Worksheet> sheets, report::Sink sink,
                      const parallel::Context& context) {
  report::ZipWriter zip(sink, "write .csv, or leave results out with --class");
  for (const PackagePart& part : workbook_parts(sheets))
    if (const Status added = zip.add_file(part.name, part.text); !added) return added;
  for (std::size_t s = 0; s < sheets.size(); ++s)
    if (const Status added = add_sheet(zip, sheets[s], s, context); !added) return added;
  return zip.finish();
}

}  // namespace strake::workbook
