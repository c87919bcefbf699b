// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/draw/draw_options.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <string_view>
#include <utility>

#include "cli/options/options.hpp"
#include "cli/run/object_selection.hpp"
#include "core/text_encoding.hpp"
#include "core/units.hpp"
#include "hlr/view/view_frustum.hpp"
#include "strake/drawing/hatching.hpp"
#include "strake/drawing/view.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::cli {

namespace {

Error in_option(Error error) {
  error.where = "--hatch";
  return error;
}

}  // namespace

Result<std::vector<HatchRule>> parse_hatches(const std::vector<std::string>& texts) {
  std::vector<HatchRule> rules;
  for (const std::string& text : texts) {
    const std::size_t colon = text.find(':');
    const auto hatch = drawing::parse_hatch(std::string_view(text).substr(0, colon));
    if (!hatch) return in_option(hatch.error());
    rules.push_back({*hatch, std::nullopt});
    if (colon == std::string::npos) continue;
    auto selections = parse_selections({std::string(trimmed(text.substr(colon + 1)))}, "--hatch");
    if (!selections) return selections.error();
    rules.back().selection = std::move(selections->front());
  }
  return rules;
}

Result<std::vector<hlr::Hatch>> hatches_of(Session& session, const model::Scene& scene,
                                           const std::vector<HatchRule>& rules) {
  if (rules.empty()) return std::vector<hlr::Hatch>{};
  drawing::Hatching hatching(scene.model->objects.size());
  for (const HatchRule& rule : rules) {
    std::vector<bool> picked;
    if (rule.selection) {
      auto some = pick_any(session, scene, {*rule.selection}, "--hatch");
      if (!some) return some.error();
      picked = std::move(*some);
    }
    hatching.add(rule.hatch, picked);
  }
  return std::move(hatching).by_object();
}

namespace {

Result<geometry::Vec3l> point_of(const std::string& text, const std::string& option) {
  const auto n = coordinates_option(text, 3, option, "x,y,z");
  if (!n) return n.error();
  const auto point = geometry::snap(geometry::Vec3d{(*n)[0], (*n)[1], (*n)[2]});
  if (!point)
    return Error{ErrorCode::usage, "'" + text + "' lies outside what can be placed", option,
                 "write millimetres of the model"};
  return *point;
}

}  // namespace

void add_perspective_options(CLI::App& command, PerspectiveOptions& options, CLI::Option* view,
                             CLI::Option* direction) {
  CLI::Option* const eye =
      command
          .add_option("--eye", options.eye,
                      "A view in perspective from this point of the model, in mm or with units, as "
                      "9m,-20m,1.7m; needs --target")
          ->type_name("X,Y,Z")
          ->excludes(view)
          ->excludes(direction)
          ->group("View");
  CLI::Option* const target =
      command
          .add_option("--target", options.target,
                      "What the eye looks at, a point likewise; the scale holds in the plane "
                      "through it")
          ->type_name("X,Y,Z")
          ->needs(eye)
          ->group("View");
  eye->needs(target);
  command
      .add_option("--near", options.near,
                  "Draw nothing nearer to the eye than this, along the view (default 100mm)")
      ->type_name("LENGTH")
      ->needs(eye)
      ->group("View");
  command
      .add_option("--field-of-view", options.field_of_view,
                  "From side to side of the square that the eye sees (default 90deg)")
      ->type_name("ANGLE")
      ->needs(eye)
      ->group("View");
}

namespace {

/// Checks the perspective before a model is read; an error names the option that is at fault: the
/// one that would be right with its default, or else the eye.
Status check_in_options(const hlr::View& view) {
  const Status status = hlr::check_perspective(view);
  if (status) return {};
  hlr::View with_field = view, with_near = view;
  with_field.perspective->field_of_view_deg = hlr::Perspective{}.field_of_view_deg;
  with_near.perspective->near_mm = hlr::Perspective{}.near_mm;
  Error error = status.error();
  error.where = hlr::check_perspective(with_field)  ? "--field-of-view"
                : hlr::check_perspective(with_near) ? "--near"
                                                    : "--eye";
  return error;
}

}  // namespace

Status set_perspective(const PerspectiveOptions& given, hlr::View& view, Console& console) {
  if (given.eye.empty()) return {};
  hlr::Perspective perspective;
  const Result<geometry::Vec3l> eye = point_of(given.eye, "--eye");
  if (!eye) return eye.error();
  const Result<geometry::Vec3l> target = point_of(given.target, "--target");
  if (!target) return target.error();
  perspective.eye = *eye;
  perspective.target = *target;
  if (const Status status = length_option(perspective.near_mm, given.near, "--near"); !status)
    return status;
  if (!given.field_of_view.empty()) {
    const Result<double> angle =
        quantity_option(given.field_of_view, "--field-of-view", parse_angle_deg);
    if (!angle) return angle.error();
    perspective.field_of_view_deg = *angle;
  }
  const Result<drawing::Direction> direction = drawing::set_perspective(perspective, view);
  if (!direction) {
    Error error = direction.error();
    error.where = "--target";
    return error;
  }
  if (direction->rounding_error > 0) {
    const geometry::Vec3l& d = direction->vector;
    console.note(
        fmt::format("the paper is square to {},{},{}, off the way to --target by {:.1e} rad", d.x,
                    d.y, d.z, direction->rounding_error));
  }
  return check_in_options(view);
}

}  // namespace strake::cli
