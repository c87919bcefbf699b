// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "core/output_format.hpp"
#include "strake/core/result.hpp"
#include "strake/sheets/write.hpp"

namespace strake::sheets {

/// One format that sheets are written in.
struct SheetWriter {
  OutputFormat format;
  std::string_view name;  ///< what a person calls it: "SVG"
  /// Errors: cancelled, out of memory.
  Status (*write)(const Sheet& sheet, const model::Model& model, drawing::Sink sink);
};

/// All of them, in the order of errors.
[[nodiscard]] std::span<const SheetWriter> sheet_writers();

}  // namespace strake::sheets
