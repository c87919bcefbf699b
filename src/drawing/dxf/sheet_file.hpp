// SPDX-License-Identifier: Apache-2.0
// A whole DXF file: views at true size in model space, and a sheet with windows that show them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "drawing/dxf/layer_style.hpp"
#include "drawing/dxf/paper_space.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/drawing/write.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/detail/function_ref.hpp"

namespace strake::drawing::dxf {

struct SheetView {
  const NeutralDrawing& drawing;
  const Ink& ink;
};

/// A sheet, which is a layout.
struct SheetLayout {
  std::string name = "Sheet";
  double width_mm = 420, height_mm = 297;
  std::vector<LayerStyle> layers;  ///< those of ViewLayer first
  std::size_t viewport_layer = 0;
  StyleLayers style_layers;
  std::vector<SheetView> views;
};

struct SheetFile {
  bool opens_on_paper = false;  ///< shows the first sheet first, not model space
  /// One at least. Layers of several sheets that have one name are one layer.
  std::vector<SheetLayout> sheets;
};

/// Adds what stands on the sheet of that number beside its views.
using AddMarks = parallel::FunctionRef<void(std::size_t sheet, PaperSpace&)>;

/// Writes the file.
///
/// A view that is the only one lies in model space at its own coordinates. Several lie there as on
/// the sheet, enlarged by the largest of their scales, each at true size about its middle; or,
/// where their windows overlap on the sheet, in a row. Several sheets lie there from left to right.
/// Errors: cancelled, out of memory.
[[nodiscard]] Status write_sheet_file(const SheetFile& file, AddMarks add_marks,
                                      const model::Model& model, Sink sink,
                                      const parallel::Context& context);

}  // namespace strake::drawing::dxf
