// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/options/options.hpp"
#include "cli/run/load.hpp"
#include "cli/run/project_input.hpp"
#include "cli/verbs/draw/draw_options.hpp"
#include "drawing/conventions.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/model/selection.hpp"
#include "strake/model/single_lines.hpp"

/// What is requested of `draw`: as it was written, and parsed.
namespace strake::cli {

/// --limits that leave far objects out.
constexpr std::string_view kAutoLimits = "auto";

/// The options of `draw` as they were written.
struct DrawOptions {
  InputOptions input;
  SceneInput scene;
  PerspectiveOptions perspective;
  std::vector<std::string> sheets;
  std::string view, direction, up, limits, scale, paper, title;
  std::string stage, solver, global, culling, bucketing, hidden, hidden_layers, centre_lines,
      break_lines, thin, single_line, intersections, own_polylines, smooth, flush_seams,
      sharp_angle, contact_distance;
  std::vector<std::string> select, outputs, sections, uncut, hatches, styles;
  bool visible_only = false;
  ProjectOptions project;
  std::string save, stored;  ///< names of stored views
  bool verify = false, full = false;
};

/// What the options request, after parsing.
struct DrawRequest {
  model::SceneOptions scene;
  hlr::View view;
  hlr::Options options;
  drawing::LayoutOptions layout;
  std::vector<model::Selection> selections, uncut;
  std::vector<HatchRule> hatches;
  bool sag_for_paper = true;
  std::optional<model::SingleLineOptions> single_line;
  bool far_objects = true;  ///< drawn, and warned of; otherwise left out
};

/// Parses the options, and says where directions were rounded. Hidden lines are kept where an
/// output shows them, and they and clipped ones where an output lists all lines, or `keep_lines`,
/// unless --visible-only was given. Errors: usage.
[[nodiscard]] Result<DrawRequest> request_of(const DrawOptions& given, Session& session,
                                             bool keep_lines);

/// Parses --scale, --paper and --title. Errors: usage.
[[nodiscard]] Result<drawing::LayoutOptions> layout_options(const DrawOptions& given);

/// Returns what --hidden requests.
[[nodiscard]] drawing::InkOptions ink_options(const DrawOptions& given);

/// Parses --centre-lines, --break-lines and --thin. Errors: usage.
[[nodiscard]] Result<drawing::Conventions> conventions_of(const DrawOptions& given);

}  // namespace strake::cli
