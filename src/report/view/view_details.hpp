// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <istream>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "report/json/json_reader.hpp"
#include "report/view/view_line_reader.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/report/view_document.hpp"

/// What a comparison does not need of a view document, but what is written again does.
namespace strake::report {

/// An object of which something could not be drawn.
struct ViewDefect {
  ViewObject object;
  std::string fate;
  std::vector<std::string> why;
};

struct ViewDetails {
  std::vector<drawing::Line> lines;  ///< objects are indices into ViewDocument::objects
  drawing::PaperCurves curves;
  std::vector<ViewDefect> defects;
  std::vector<std::string> cut_files;           ///< labels of files that end early
  std::map<std::string, std::uint64_t> counts;  ///< as stated
  std::string scale_text, title;
  std::optional<drawing::PaperFrame> frame;

  /// Appends a line, and its curve where it has one. Throws DocumentFault for one that is not in
  /// order or has no number of an edge; `list_item` is what a fault calls
  /// a line before its number.
  void add(const ReadPiece& piece, std::string_view list_item);
};

/// Reads the members of a document, each of which must come next. They throw DocumentFault and
/// JsonReader::Fault.
void read_curves(JsonReader& json, ViewDetails& details);
void read_defects(JsonReader& json, ViewDetails& details);
void read_cut_files(JsonReader& json, ViewDetails& details);
[[nodiscard]] drawing::PaperFrame read_frame(JsonReader& json);

/// Reads a document with all that it holds: its lines are in `details` instead of
/// ViewDocument::pieces. Errors: those of parse_view_document().
[[nodiscard]] Result<ViewDocument> parse_view_document(std::istream& in, const std::string& name,
                                                       ViewDetails& details);

}  // namespace strake::report
