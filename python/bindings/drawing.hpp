// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "python/bindings/model.hpp"
#include "python/bindings/selection.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/parallel/context.hpp"

namespace strake::python {

/// What is requested of a drawing. Texts are those of the program's options of the same names.
struct DrawRequest {
  std::string view, direction, up;
  std::optional<std::array<double, 3>> eye, target;  ///< mm
  std::optional<double> near_mm, field_of_view_deg;
  std::optional<std::array<double, 6>> limits;  ///< mm: the least corner, then the greatest
  bool leave_out_far_objects = false;
  std::vector<std::string> sections;
  Pick select;
  std::vector<std::string> uncut;
  std::vector<std::string> hatches, styles;
  std::string hidden = "off";      ///< "off", "dashed" or "all"
  std::string centre_lines, thin;  ///< "on", "off" or a length on paper; empty: off
  std::string single_line;         ///< "off", a length or a nominal size; empty: off
  bool split_hidden = false, break_lines = false;
  std::string stage = "global", intersections = "primitives", own_polylines = "visible",
              smooth = "off";
  /// Hidden lines are kept where they are shown, or where they are to be kept all the same.
  bool keep_hidden = false;
  bool visible_only = false, flush_seams = true, obstructions = false, insulation = false;
  std::optional<double> sharp_angle_deg, contact_distance_mm, sag_mm, weld_mm;
  std::string scale, paper, title;
  std::optional<std::array<double, 4>> pens;  ///< outline, edge, thin, section, mm on paper
};

/// A drawing on paper, with the lines that get ink.
struct DrawRun {
  ModelPointer model;
  std::shared_ptr<const model::Scene> scene;
  drawing::NeutralDrawing drawing;
  drawing::Ink ink;
  Diagnostics diagnostics;
};

/// Draws what the program's verb `draw` draws. Errors: usage, input, cancelled, memory.
[[nodiscard]] Result<std::shared_ptr<DrawRun>> draw(const ModelPointer& model,
                                                    const DrawRequest& request,
                                                    const parallel::Context& context);

}  // namespace strake::python
