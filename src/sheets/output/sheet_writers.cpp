// SPDX-License-Identifier: Apache-2.0
#include "sheets/output/sheet_writers.hpp"

#include <array>

namespace strake::sheets {
namespace {

Result<Diagnostics> as_svg(std::span<const Sheet> sheets, const model::Model& model,
                           drawing::Sink sink, const parallel::Context& /*context*/) {
  write_svg(sheets.front(), model, sink);
  return Diagnostics();
}

Result<Diagnostics> as_dxf(std::span<const Sheet> sheets, const model::Model& model,
                           drawing::Sink sink, const parallel::Context& context) {
  return write_dxf(sheets.front(), model, sink, context);
}

constexpr std::array kWriters{
    SheetWriter{{".svg"}, "SVG", false, as_svg},
    SheetWriter{{".pdf"}, "PDF", true, write_pdf},
    SheetWriter{{".dxf"}, "DXF", false, as_dxf},
};

}  // namespace

std::span<const SheetWriter> sheet_writers() { return kWriters; }

}  // namespace strake::sheets
