// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <istream>
#include <string>
#include <vector>

#include "report/json_reader.hpp"
#include "strake/core/checksum.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/report/view_document.hpp"

namespace strake::report {

/// The member "rows" of a binary view document: how its lines stand behind the text.
struct RowForm {
  std::uint64_t bytes = 0;  ///< of a row
  std::string fields;       ///< as it stands, without blanks
  geometry::Vec3l origin;
  std::vector<hlr::EdgeKind> kinds;
  std::vector<drawing::LineState> states;
  bool has_checksum = false;  ///< behind the rows; drawings of older versions have none
};

/// Takes the member, which must come next. Throws DocumentFault, JsonReader::Fault.
[[nodiscard]] RowForm take_row_form(JsonReader& json);

/// The rows that follow in the stream, `count` of them, the checksum where there is one, which must
/// be that of `before` and the rows, and nothing behind. Throws DocumentFault.
[[nodiscard]] std::vector<ViewPiece> read_rows(std::istream& in, const RowForm& form,
                                               std::uint64_t count, Checksum& before);

}  // namespace strake::report
