// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "core/output_format.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"
#include "strake/sheets/write.hpp"

namespace strake::sheets {

/// What sheets are written from.
struct SheetContents {
  std::span<const Sheet> sheets;  ///< one at least
  const model::Model& model;
  const model::Scene* scene = nullptr;  ///< what was drawn, where it is known: for what shows it
};

/// One format that sheets are written in.
struct SheetWriter {
  OutputFormat format;
  std::string_view name;       ///< what a person calls it: "SVG"
  bool takes_several = false;  ///< one file holds any number of sheets
  /// Writes sheets, and one only unless it takes several. Returns what of them could not be written
  /// as it is. Errors: cancelled, out of memory.
  Result<Diagnostics> (*write)(const SheetContents& contents, drawing::Sink sink,
                               const parallel::Context& context);
};

/// Returns the writers of all formats, in the order of errors.
[[nodiscard]] std::span<const SheetWriter> sheet_writers();

}  // namespace strake::sheets
