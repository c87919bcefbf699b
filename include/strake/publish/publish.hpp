// SPDX-License-Identifier: Apache-2.0
// Results as files: the end of a file's name picks the format.
#pragma once

#include <filesystem>

#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/model/model.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"
#include "strake/report/clash.hpp"

/// All that results are put out as, for programs that write what the program `strake` writes:
///
///     const Status status = publish::write_clashes(contents, "clashes.xlsx", context);
namespace strake::publish {

/// Writes clash results in the format that the name of the file requests: .json, .csv, .xlsx, .xml,
/// .bcf, .svg, .glb, .html and others (docs/reading-results.md). What shows the model needs
/// ClashContents::scene. The file is written whole or not at all. Errors: usage for a name that no
/// format has; output; cancelled; out of memory.
[[nodiscard]] Status write_clashes(const report::ClashContents& contents,
                                   const std::filesystem::path& file,
                                   const parallel::Context& context = {});

/// Writes a drawing in the format that the name of the file requests: .svg, .pdf, .dxf, .json,
/// .view or .html; the last shows the model where `scene` is given. Returns what of the drawing
/// could not be written as it is. The file is written whole or not at all. Errors: as of
/// write_clashes().
[[nodiscard]] Result<Diagnostics> write_drawing(const drawing::NeutralDrawing& drawing,
                                                const drawing::Ink& ink, const model::Model& model,
                                                const model::Scene* scene,
                                                const std::filesystem::path& file,
                                                const parallel::Context& context = {});

}  // namespace strake::publish
