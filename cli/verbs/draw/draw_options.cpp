// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/draw/draw_options.hpp"

#include <fmt/core.h>

#include <string_view>
#include <utility>

#include "cli/options/options.hpp"
#include "cli/run/object_selection.hpp"
#include "core/units.hpp"
#include "strake/drawing/hatching.hpp"
#include "strake/drawing/view.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::cli {

namespace {

Error fault(const std::string& message) {
  return {ErrorCode::usage, message, "--hatch",
          "write 30deg,80mm to hatch all sections so, '30deg: PIPE*' for those of some objects, or "
          "off"};
}

/// Parses an angle or a length.
Status add_number(std::string_view text, hlr::Hatch& hatch) {
  const auto quantity = parse_quantity(text);
  const std::string quoted = "'" + std::string(text) + "'";
  if (!quantity) return fault(quoted + " is neither an angle nor a length");
  if (!unit_mm(quantity->unit)) {
    const Result<double> angle = parse_angle_deg(text);
    if (!angle) return fault(quoted + " is neither an angle nor a length");
    if (!(*angle >= 0 && *angle <= 180)) return fault(quoted + " is not between 0deg and 180deg");
    hatch.angle_deg = *angle;
    return {};
  }
  const Result<double> length = parse_length_mm(text);
  if (!length) return fault(length.error().message);
  if (!(*length > 0)) return fault(quoted + " is no distance between lines");
  hatch.spacing_mm = *length;
  return {};
}

Result<hlr::Hatch> parse_pattern(std::string_view text) {
  hlr::Hatch hatch;
  if (text == "off") {
    hatch.spacing_mm = 0;
    return hatch;
  }
  for (;;) {
    const std::size_t comma = text.find(',');
    if (const Status status = add_number(text.substr(0, comma), hatch); !status)
      return status.error();
    if (comma == std::string_view::npos) return hatch;
    text.remove_prefix(comma + 1);
  }
}

}  // namespace

Result<std::vector<HatchRule>> parse_hatches(const std::vector<std::string>& texts) {
  std::vector<HatchRule> rules;
  for (const std::string& text : texts) {
    const std::size_t colon = text.find(':');
    const Result<hlr::Hatch> hatch = parse_pattern(std::string_view(text).substr(0, colon));
    if (!hatch) return hatch.error();
    rules.push_back({*hatch, std::nullopt});
    if (colon == std::string::npos) continue;
    auto selections = parse_selections({text.substr(colon + 1)}, "--hatch");
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
  const auto n = number_list(text, 3, option, "x,y,z in millimetres of the model");
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
                      "A view in perspective from this point of the model, in mm; needs --target")
          ->type_name("X,Y,Z")
          ->excludes(view)
          ->excludes(direction)
          ->group("View");
  CLI::Option* const target =
      command
          .add_option("--target", options.target,
                      "What the eye looks at; the scale holds in the plane through it")
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
  const Result<drawing::Direction> direction = drawing::see_from(perspective, view);
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
  return {};
}

}  // namespace strake::cli
