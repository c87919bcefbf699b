// SPDX-License-Identifier: Apache-2.0
#include "sheets/output/sheet_writers.hpp"

#include <array>

namespace strake::sheets {
namespace {

Status as_svg(const Sheet& sheet, const model::Model& model, drawing::Sink sink) {
  write_svg(sheet, model, sink);
  return {};
}

constexpr std::array kWriters{SheetWriter{{".svg"}, "SVG", as_svg}};

}  // namespace

std::span<const SheetWriter> sheet_writers() { return kWriters; }

}  // namespace strake::sheets
