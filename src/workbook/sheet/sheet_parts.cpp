// SPDX-License-Identifier: Apache-2.0
#include "workbook/sheet/sheet_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "strake/drawing/write.hpp"

namespace strake::workbook {
namespace {

constexpr std::string_view kXml = "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?>\n";
constexpr std::string_view kMain = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
constexpr std::string_view kRelations =
    "http://schemas.openxmlformats.org/package/2006/relationships";
constexpr std::string_view kOffice =
    "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
constexpr std::string_view kDrawing = "http://schemas.openxmlformats.org/drawingml/2006/main";
constexpr std::string_view kOnSheet =
    "http://schemas.openxmlformats.org/drawingml/2006/spreadsheetDrawing";

/// A word with the colours of its cell: of the letters and of the ground, distinguished in grey
/// too.
struct WordColours {
  std::string_view word, letters, ground;
};
constexpr std::array kClassColours{
    WordColours{"HIT", "FF9C0006", "FFFFC7CE"},
    WordColours{"CONTACT", "FF1F4E79", "FFDDEBF7"},
    WordColours{"CLEARANCE_VIOLATION", "FF7F6000", "FFFFF2CC"},
    WordColours{"EXEMPTED", "FF595959", "FFEDEDED"},
};
constexpr std::array kStatusColours{
    WordColours{"active", "FF833C0B", "FFFCE4D6"},
    WordColours{"reviewed", "FF1F4E79", "FFDDEBF7"},
    WordColours{"approved", "FF375623", "FFE2EFDA"},
    WordColours{"resolved", "FF595959", "FFEDEDED"},
};

/// Returns the part that says how cells look; cell formats are in the order of CellStyle.
std::string styles() {
  std::string out(kXml);
  out += fmt::format("<styleSheet xmlns=\"{}\">", kMain);
  out +=
      "<numFmts count=\"1\"><numFmt numFmtId=\"164\" formatCode=\"0.000\"/></numFmts>"
      "<fonts count=\"3\"><font><sz val=\"11\"/><name val=\"Calibri\"/><family val=\"2\"/></font>"
      "<font><b/><sz val=\"11\"/><name val=\"Calibri\"/><family val=\"2\"/></font>"
      "<font><b/><sz val=\"16\"/><name val=\"Calibri\"/><family val=\"2\"/></font></fonts>"
      "<fills count=\"3\"><fill><patternFill patternType=\"none\"/></fill>"
      "<fill><patternFill patternType=\"gray125\"/></fill><fill><patternFill patternType=\"solid\">"
      "<fgColor rgb=\"FFD9E1F2\"/><bgColor indexed=\"64\"/></patternFill></fill></fills>"
      "<borders count=\"1\"><border><left/><right/><top/><bottom/><diagonal/></border></borders>"
      "<cellStyleXfs count=\"1\"><xf numFmtId=\"0\" fontId=\"0\" fillId=\"0\" borderId=\"0\"/>"
      "</cellStyleXfs><cellXfs count=\"7\">"
      "<xf numFmtId=\"0\" fontId=\"0\" fillId=\"0\" borderId=\"0\" xfId=\"0\"/>"
      "<xf numFmtId=\"0\" fontId=\"1\" fillId=\"2\" borderId=\"0\" xfId=\"0\" applyFont=\"1\" "
      "applyFill=\"1\"/>"
      "<xf numFmtId=\"0\" fontId=\"2\" fillId=\"0\" borderId=\"0\" xfId=\"0\" applyFont=\"1\"/>"
      "<xf numFmtId=\"49\" fontId=\"0\" fillId=\"0\" borderId=\"0\" xfId=\"0\" quotePrefix=\"1\" "
      "applyNumberFormat=\"1\"/>"
      "<xf numFmtId=\"164\" fontId=\"0\" fillId=\"0\" borderId=\"0\" xfId=\"0\" "
      "applyNumberFormat=\"1\"/>"
      "<xf numFmtId=\"1\" fontId=\"0\" fillId=\"0\" borderId=\"0\" xfId=\"0\" "
      "applyNumberFormat=\"1\"/>"
      "<xf numFmtId=\"0\" fontId=\"1\" fillId=\"0\" borderId=\"0\" xfId=\"0\" applyFont=\"1\"/>"
      "</cellXfs><cellStyles count=\"1\"><cellStyle name=\"Normal\" xfId=\"0\" builtinId=\"0\"/>"
      "</cellStyles>";
  out += fmt::format("<dxfs count=\"{}\">", kClassColours.size() + kStatusColours.size());
  for (const auto& colours : {kClassColours, kStatusColours})
    for (const WordColours& c : colours)
      out += fmt::format(
          "<dxf><font><color rgb=\"{}\"/></font><fill><patternFill><bgColor rgb=\"{}\"/>"
          "</patternFill></fill></dxf>",
          c.letters, c.ground);
  return out + "</dxfs></styleSheet>";
}

std::string content_types(std::span<const Worksheet> sheets) {
  std::string out(kXml);
  out +=
      "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">"
      "<Default Extension=\"rels\" "
      "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>"
      "<Default Extension=\"xml\" ContentType=\"application/xml\"/>"
      "<Default Extension=\"png\" ContentType=\"image/png\"/>";
  constexpr std::string_view kType =
      "<Override PartName=\"/{}\" "
      "ContentType=\"application/vnd.openxmlformats-officedocument.{}+xml\"/>";
  const auto add = [&](std::string_view part, std::string_view type) {
    out += fmt::format(kType, part, type);
  };
  add("xl/workbook.xml", "spreadsheetml.sheet.main");
  add("xl/styles.xml", "spreadsheetml.styles");
  for (std::size_t s = 0; s < sheets.size(); ++s) {
    add(sheet_part(s), "spreadsheetml.worksheet");
    if (!sheets[s].pictures.empty())
      add(fmt::format("xl/drawings/drawing{}.xml", s + 1), "drawing");
  }
  return out + "</Types>";
}

/// A relation of a part to another: the kind of it, and where the other is.
using Relation = std::pair<std::string_view, std::string>;

std::string relations(std::span<const Relation> all) {
  std::string out(kXml);
  out += fmt::format("<Relationships xmlns=\"{}\">", kRelations);
  for (std::size_t i = 0; i < all.size(); ++i)
    out += fmt::format("<Relationship Id=\"rId{}\" Type=\"{}/{}\" Target=\"{}\"/>", i + 1, kOffice,
                       all[i].first, all[i].second);
  return out + "</Relationships>";
}

/// Returns the cells of a sheet that have heads, as filters name them: "A1:F20".
std::string table_range(const Worksheet& sheet, std::string_view dollar) {
  return fmt::format("{0}A{0}1:{0}{1}{0}{2}", dollar, column_name(sheet.columns.size() - 1),
                     sheet.rows + 1);
}

bool has_filter(const Worksheet& sheet) { return sheet.has_heads() && sheet.rows > 0; }

std::string workbook_part(std::span<const Worksheet> sheets) {
  std::string out(kXml);
  out += fmt::format("<workbook xmlns=\"{}\" xmlns:r=\"{}\"><sheets>", kMain, kOffice);
  std::string filters;
  for (std::size_t s = 0; s < sheets.size(); ++s) {
    const std::string name = drawing::xml_escaped(sheets[s].name);
    out += fmt::format("<sheet name=\"{}\" sheetId=\"{}\" r:id=\"rId{}\"/>", name, s + 1, s + 1);
    if (has_filter(sheets[s]))
      filters += fmt::format(
          "<definedName name=\"_xlnm._FilterDatabase\" localSheetId=\"{}\" "
          "hidden=\"1\">'{}'!{}</definedName>",
          s, name, table_range(sheets[s], "$"));
  }
  out += "</sheets>";
  if (!filters.empty()) out += "<definedNames>" + filters + "</definedNames>";
  return out + "</workbook>";
}

/// Returns the part that says where the pictures of a sheet stand, each in the width of 320 px.
std::string pictures_part(const Worksheet& sheet) {
  constexpr std::uint64_t kUnitsOfPixel = 9525, kWidth = 320;
  std::string out(kXml);
  out += fmt::format("<xdr:wsDr xmlns:xdr=\"{}\" xmlns:a=\"{}\" xmlns:r=\"{}\">", kOnSheet,
                     kDrawing, kOffice);
  for (std::size_t i = 0; i < sheet.pictures.size(); ++i) {
    const SheetPicture& picture = sheet.pictures[i];
    const PictureSize size = size_of_png(picture.png).value_or(PictureSize{1, 1});
    const std::uint64_t height = std::max<std::uint64_t>(1, kWidth * size.height / size.width);
    const std::string extent =
        fmt::format("cx=\"{}\" cy=\"{}\"", kWidth * kUnitsOfPixel, height * kUnitsOfPixel);
    out += fmt::format(
        "<xdr:oneCellAnchor><xdr:from><xdr:col>{}</xdr:col><xdr:colOff>0</xdr:colOff>"
        "<xdr:row>{}</xdr:row><xdr:rowOff>0</xdr:rowOff></xdr:from><xdr:ext {}/><xdr:pic>"
        "<xdr:nvPicPr><xdr:cNvPr id=\"{}\" name=\"Picture {}\"/><xdr:cNvPicPr/></xdr:nvPicPr>"
        "<xdr:blipFill><a:blip r:embed=\"rId{}\"/><a:stretch><a:fillRect/></a:stretch>"
        "</xdr:blipFill><xdr:spPr><a:xfrm><a:off x=\"0\" y=\"0\"/><a:ext {}/></a:xfrm>"
        "<a:prstGeom prst=\"rect\"><a:avLst/></a:prstGeom></xdr:spPr></xdr:pic><xdr:clientData/>"
        "</xdr:oneCellAnchor>",
        picture.column, picture.row, extent, i + 2, i + 1, i + 1, extent);
  }
  return out + "</xdr:wsDr>";
}

/// Adds the parts of the pictures of sheet number `s`; `images` counts those of all sheets.
void add_pictures(std::vector<PackagePart>& parts, const Worksheet& sheet, std::size_t s,
                  std::size_t& images) {
  const std::string drawing = fmt::format("drawing{}.xml", s + 1);
  const std::array to_drawing{Relation{"drawing", "../drawings/" + drawing}};
  parts.push_back(
      {fmt::format("xl/worksheets/_rels/sheet{}.xml.rels", s + 1), relations(to_drawing)});
  parts.push_back({"xl/drawings/" + drawing, pictures_part(sheet)});
  std::vector<Relation> to_images;
  for (const SheetPicture& picture : sheet.pictures) {
    const std::string image = fmt::format("image{}.png", ++images);
    to_images.emplace_back("image", "../media/" + image);
    parts.push_back({"xl/media/" + image, picture.png});
  }
  parts.push_back({"xl/drawings/_rels/" + drawing + ".rels", relations(to_images)});
}

/// Returns the rules that colour the words of a column; `first` is the number of its first format.
std::string colour_rules(const Worksheet& sheet, std::size_t column,
                         std::span<const WordColours> words, std::size_t first) {
  std::string out = fmt::format("<conditionalFormatting sqref=\"{0}2:{0}{1}\">",
                                column_name(column), sheet.rows + 1);
  for (std::size_t i = 0; i < words.size(); ++i)
    out += fmt::format(
        "<cfRule type=\"cellIs\" dxfId=\"{}\" priority=\"{}\" operator=\"equal\"><formula>\"{}\""
        "</formula></cfRule>",
        first + i, first + i + 1, words[i].word);
  return out + "</conditionalFormatting>";
}

}  // namespace

std::string sheet_part(std::size_t sheet) {
  return fmt::format("xl/worksheets/sheet{}.xml", sheet + 1);
}

std::vector<PackagePart> workbook_parts(std::span<const Worksheet> sheets) {
  const std::array to_workbook{Relation{"officeDocument", "xl/workbook.xml"}};
  std::vector<Relation> of_workbook;
  for (std::size_t s = 0; s < sheets.size(); ++s)
    of_workbook.emplace_back("worksheet", fmt::format("worksheets/sheet{}.xml", s + 1));
  of_workbook.emplace_back("styles", "styles.xml");
  std::vector<PackagePart> parts{{"[Content_Types].xml", content_types(sheets)},
                                 {"_rels/.rels", relations(to_workbook)},
                                 {"xl/workbook.xml", workbook_part(sheets)},
                                 {"xl/_rels/workbook.xml.rels", relations(of_workbook)},
                                 {"xl/styles.xml", styles()}};
  std::size_t images = 0;
  for (std::size_t s = 0; s < sheets.size(); ++s)
    if (!sheets[s].pictures.empty()) add_pictures(parts, sheets[s], s, images);
  return parts;
}

std::string sheet_head(const Worksheet& sheet, bool is_first) {
  std::string out(kXml);
  out += fmt::format(
      "<worksheet xmlns=\"{}\" xmlns:r=\"{}\"><sheetViews><sheetView{} "
      "workbookViewId=\"0\">",
      kMain, kOffice, is_first ? " tabSelected=\"1\"" : "");
  if (sheet.has_heads())
    out +=
        "<pane ySplit=\"1\" topLeftCell=\"A2\" activePane=\"bottomLeft\" state=\"frozen\"/>"
        "<selection pane=\"bottomLeft\"/>";
  out += "</sheetView></sheetViews>";
  out += sheet.row_height > 0
             ? fmt::format("<sheetFormatPr defaultRowHeight=\"{}\" customHeight=\"1\"/>",
                           sheet.row_height)
             : "<sheetFormatPr defaultRowHeight=\"15\"/>";
  if (!sheet.columns.empty()) out += "<cols>";
  for (std::size_t c = 0; c < sheet.columns.size(); ++c)
    out += fmt::format("<col min=\"{0}\" max=\"{0}\" width=\"{1}\" customWidth=\"1\"/>", c + 1,
                       sheet.columns[c].width);
  if (!sheet.columns.empty()) out += "</cols>";
  out += "<sheetData>";
  if (!sheet.has_heads()) return out;
  // Rows may be as high as pictures are, which heads are not to be.
  constexpr int kHeadHeight = 15;
  SheetRow row(out, 0, kHeadHeight);
  for (const SheetColumn& column : sheet.columns) row.word(column.name, CellStyle::head);
  row.end();
  return out;
}

std::string sheet_tail(const Worksheet& sheet) {
  std::string out = "</sheetData>";
  if (has_filter(sheet)) out += fmt::format("<autoFilter ref=\"{}\"/>", table_range(sheet, ""));
  if (sheet.class_column && sheet.rows > 0)
    out += colour_rules(sheet, *sheet.class_column, kClassColours, 0);
  if (sheet.status_column && sheet.rows > 0) {
    out += colour_rules(sheet, *sheet.status_column, kStatusColours, kClassColours.size());
    out += fmt::format(
        "<dataValidations count=\"1\"><dataValidation type=\"list\" allowBlank=\"1\" "
        "showErrorMessage=\"1\" sqref=\"{0}2:{0}{1}\"><formula1>"
        "\"new,active,reviewed,approved,resolved\"</formula1></dataValidation></dataValidations>",
        column_name(*sheet.status_column), sheet.rows + 1);
  }
  out +=
      "<pageMargins left=\"0.5\" right=\"0.5\" top=\"0.5\" bottom=\"0.5\" header=\"0.3\" "
      "footer=\"0.3\"/><pageSetup paperSize=\"9\" orientation=\"landscape\"/>";
  if (!sheet.pictures.empty()) out += "<drawing r:id=\"rId1\"/>";
  return out + "</worksheet>";
}

}  // namespace strake::workbook
