// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include "core/checksum.hpp"
#include "report/document/document_reader.hpp"
#include "report/json/json_reader.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/report/view_document.hpp"

/// Reads the lines of a view document, from JSON pieces or from binary rows.
namespace strake::report {

/// Reads the items of "pieces" of a view document, one by one.
class ViewPieceReader {
 public:
  ViewPieceReader(JsonReader& json, std::vector<ViewPiece>& pieces)
      : json_(json), fields_(json), pieces_(pieces) {}

  /// Appends the piece that must come next. Throws DocumentFault, JsonReader::Fault.
  void take();

 private:
  /// Returns the place that faults name.
  [[nodiscard]] std::string here() const;
  void member(std::string_view key, ViewPiece& piece);
  [[nodiscard]] std::uint32_t index(const char* key);
  [[nodiscard]] geometry::Vec3l model_point(const char* key);
  [[nodiscard]] std::array<float, 2> paper_point(const char* key);

  static constexpr std::size_t kMembers = 7;
  JsonReader& json_;
  DocumentFields fields_;
  std::vector<ViewPiece>& pieces_;
  std::array<bool, kMembers> there_{};  ///< members found of the current piece
};

/// The member "rows" of a binary view document: how its lines are stored behind the text.
struct RowLayout {
  std::uint64_t bytes = 0;  ///< the size of a row
  std::string fields;       ///< as written, without blanks
  geometry::Vec3l origin;
  std::vector<hlr::EdgeKind> kinds;
  std::vector<drawing::LineState> states;
  bool has_checksum = false;  ///< one follows the rows; drawings of older versions have none
};

/// Reads the member, which must come next. Throws DocumentFault, JsonReader::Fault.
[[nodiscard]] RowLayout read_row_layout(JsonReader& json);

/// Reads the `count` rows that follow in the stream and the checksum where there is one, which must
/// be that of `before` and the rows, with nothing behind it. Throws DocumentFault.
[[nodiscard]] std::vector<ViewPiece> read_rows(std::istream& in, const RowLayout& form,
                                               std::uint64_t count, Checksum& before);

}  // namespace strake::report
