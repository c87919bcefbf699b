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
#include "strake/parallel/detail/function_ref.hpp"

/// Reads the lines of a view document, from JSON pieces or from binary rows.
namespace strake::report {

/// All that a document says of a piece.
struct ReadPiece {
  geometry::Vec3l a, b;
  std::array<double, 2> a_paper{}, b_paper{};
  std::uint32_t object = kNone, other = kNone;
  std::uint32_t edge = kNone;  ///< kNone: not stated
  std::uint32_t curve = kNone;
  hlr::EdgeKind kind = hlr::EdgeKind::sharp;
  drawing::LineState state = drawing::LineState::visible;

  static constexpr std::uint32_t kNone = 0xffffffffU;
};

/// Takes pieces in the order of the document.
using PieceSink = parallel::FunctionRef<void(const ReadPiece&)>;

/// Reads the items of "pieces" of a view document, one by one.
class ViewPieceReader {
 public:
  ViewPieceReader(JsonReader& json, PieceSink sink) : json_(json), fields_(json), sink_(sink) {}

  /// Hands on the piece that must come next. Throws DocumentFault, JsonReader::Fault.
  void take();

 private:
  /// Returns the place that faults name.
  [[nodiscard]] std::string here() const;
  void member(std::string_view key, ReadPiece& piece);
  [[nodiscard]] std::uint32_t index(const char* key, const char* what);
  [[nodiscard]] geometry::Vec3l model_point(const char* key);
  [[nodiscard]] std::array<double, 2> paper_point(const char* key);

  static constexpr std::size_t kMembers = 7;
  JsonReader& json_;
  DocumentFields fields_;
  PieceSink sink_;
  std::uint64_t taken_ = 0;
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
void read_rows(std::istream& in, const RowLayout& form, std::uint64_t count, Checksum& before,
               PieceSink sink);

}  // namespace strake::report
