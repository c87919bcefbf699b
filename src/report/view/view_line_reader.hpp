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

namespace strake::report {

/// Takes the items of "pieces" of a view document, one by one.
class ViewPieceReader {
 public:
  ViewPieceReader(JsonReader& json, std::vector<ViewPiece>& pieces)
      : json_(json), fields_(json), pieces_(pieces) {}

  /// Appends the piece that must come next. Throws DocumentFault, JsonReader::Fault.
  void take();

 private:
  /// Where faults are.
  [[nodiscard]] std::string here() const;
  void member(std::string_view key, ViewPiece& piece);
  [[nodiscard]] std::uint32_t index(const char* key);
  [[nodiscard]] geometry::Vec3l model_point(const char* key);
  [[nodiscard]] std::array<float, 2> paper_point(const char* key);

  static constexpr std::size_t kMembers = 7;
  JsonReader& json_;
  DocumentFields fields_;
  std::vector<ViewPiece>& pieces_;
  std::array<bool, kMembers> there_{};  ///< members of the piece in hand
};

/// The member "rows" of a binary view document: how its lines stand behind the text.
struct RowLayout {
  std::uint64_t bytes = 0;  ///< of a row
  std::string fields;       ///< as it stands, without blanks
  geometry::Vec3l origin;
  std::vector<hlr::EdgeKind> kinds;
  std::vector<drawing::LineState> states;
  bool has_checksum = false;  ///< behind the rows; drawings of older versions have none
};

/// Takes the member, which must come next. Throws DocumentFault, JsonReader::Fault.
[[nodiscard]] RowLayout read_row_layout(JsonReader& json);

/// The rows that follow in the stream, `count` of them, the checksum where there is one, which must
/// be that of `before` and the rows, and nothing behind. Throws DocumentFault.
[[nodiscard]] std::vector<ViewPiece> read_rows(std::istream& in, const RowLayout& form,
                                               std::uint64_t count, Checksum& before);

}  // namespace strake::report
