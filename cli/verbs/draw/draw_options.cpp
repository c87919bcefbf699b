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

Error fault(const std::string& message) {
  return {ErrorCode::usage, message, "--hatch",
          "write 30deg,80mm to hatch all sections so, '30deg: PIPE*' for those of some objects, or "
          "off"};
}

/// Parses "30deg,80mm", "30deg", "30" or "80mm": an angle and the distance of the lines, each said
/// once, and each with its unit where both are said.
class HatchPattern {
 public:
  explicit HatchPattern(std::string_view text) : text_(text) {}

  Result<hlr::Hatch> parse() {
    for (std::string_view rest = text_;;) {
      const std::size_t comma = rest.find(',');
      if (const Status status = add(rest.substr(0, comma)); !status) return status.error();
      if (comma == std::string_view::npos) return hatch_;
      rest.remove_prefix(comma + 1);
    }
  }

 private:
  static std::string quoted(std::string_view text) { return "'" + std::string(text) + "'"; }

  Status add(std::string_view part) {
    const auto quantity = parse_quantity(part);
    if (!quantity) return fault(quoted(part) + " is neither an angle nor a length");
    if (unit_mm(quantity->unit)) return add_spacing(part);
    // Which of 30,80 is what is anybody's guess, and 1,5mm has a decimal comma.
    if (quantity->unit.empty() && text_.find(',') != std::string_view::npos)
      return fault(quoted(part) + " in " + quoted(text_) +
                   " has no unit, and a comma parts the angle from the distance");
    return add_angle(part);
  }

  Status add_angle(std::string_view part) {
    const Result<double> angle = parse_angle_deg(part);
    if (!angle) return fault(quoted(part) + " is neither an angle nor a length");
    if (!(*angle >= 0 && *angle <= 180))
      return fault(quoted(part) + " is not between 0deg and 180deg");
    if (has_angle_) return fault(quoted(text_) + " says the angle twice");
    has_angle_ = true;
    hatch_.angle_deg = *angle;
    return {};
  }

  Status add_spacing(std::string_view part) {
    const Result<double> length = parse_distance_mm(part);
    if (!length) return fault(length.error().message);
    if (!(*length > 0)) return fault(quoted(part) + " is no distance between lines");
    if (has_spacing_) return fault(quoted(text_) + " says the distance of lines twice");
    has_spacing_ = true;
    hatch_.spacing_mm = *length;
    return {};
  }

  std::string_view text_;
  hlr::Hatch hatch_;
  bool has_angle_ = false, has_spacing_ = false;
};

Result<hlr::Hatch> parse_pattern(std::string_view text) {
  if (text != "off") return HatchPattern(text).parse();
  hlr::Hatch hatch;
  hatch.spacing_mm = 0;
  return hatch;
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
  return check_in_options(view);
}

}  // namespace strake::cli
