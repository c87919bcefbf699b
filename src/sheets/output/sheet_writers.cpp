// SPDX-License-Identifier: Apache-2.0
#include "sheets/output/sheet_writers.hpp"

#include <array>

namespace strake::sheets {
namespace {

Result<Diagnostics> as_svg(const SheetContents& contents, drawing::Sink sink,
                           const parallel::Context& /*context*/) {
  write_svg(contents.sheets.front(), contents.model, sink);
  return Diagnostics();
}

Result<Diagnostics> as_pdf(const SheetContents& contents, drawing::Sink sink,
                           const parallel::Context& context) {
  return write_pdf(contents.sheets, contents.model, sink, context);
}

Result<Diagnostics> as_dxf(const SheetContents& contents, drawing::Sink sink,
                           const parallel::Context& context) {
  return write_dxf(contents.sheets, contents.model, sink, context);
}

constexpr std::array kWriters{
    SheetWriter{{".svg"}, "SVG", false, as_svg},
    SheetWriter{{".pdf"}, "PDF", true, as_pdf},
    SheetWriter{{".dxf"}, "DXF", true, as_dxf},
};

}  // namespace

std::span<const SheetWriter> sheet_writers() { return kWriters; }

}  // namespace strake::sheets
