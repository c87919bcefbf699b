// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "report/document_fields.hpp"
#include "report/json_reader.hpp"
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

}  // namespace strake::report
