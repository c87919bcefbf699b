// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <istream>
#include <string>
#include <vector>

#include "report/json_reader.hpp"
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
};

/// Takes the member, which must come next. Throws DocumentFault, JsonReader::Fault.
[[nodiscard]] RowForm take_row_form(JsonReader& json);

/// The rows that follow in the stream, `count` of them and nothing behind. Throws DocumentFault.
[[nodiscard]] std::vector<ViewPiece> read_rows(std::istream& in, const RowForm& form,
                                               std::uint64_t count);

}  // namespace strake::report
