// SPDX-License-Identifier: Apache-2.0
#include "cli/perspective_option.hpp"

#include <fmt/core.h>

#include "cli/options.hpp"
#include "strake/core/units.hpp"
#include "strake/drawing/view.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::cli {

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
    const Result<double> angle = quantity(given.field_of_view, "--field-of-view", parse_angle_deg);
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
    console.say(
        fmt::format("the paper is square to {},{},{}, off the way to --target by {:.1e} rad", d.x,
                    d.y, d.z, direction->rounding_error));
  }
  return {};
}

}  // namespace strake::cli
