// SPDX-License-Identifier: Apache-2.0
#include "python/bindings/draw_request.hpp"

#include <fmt/core.h>

#include <string_view>
#include <utility>

#include "core/units.hpp"
#include "drawing/layout/paper_size.hpp"
#include "strake/drawing/view.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::python {

namespace {

Error usage(std::string message, std::string where, std::string mend) {
  return {ErrorCode::usage, std::move(message), std::move(where), std::move(mend)};
}

Result<geometry::Vec3l> grid_point(const geometry::Vec3d& mm, const char* argument) {
  const auto point = geometry::snap(mm);
  if (!point)
    return usage("it is not finite, or lies outside what can be placed", argument,
                 "write millimetres of the model");
  return *point;
}

Result<geometry::Vec3l> grid_point(const std::array<double, 3>& mm, const char* argument) {
  return grid_point(geometry::Vec3d{mm[0], mm[1], mm[2]}, argument);
}

/// Parses one of some words; `name_of` spells each.
template <class Word, class Name, std::size_t Size>
Status read_word(const std::string& text, const std::array<Word, Size>& words, Name name_of,
                 const char* argument, Word& into) {
  std::string all;
  for (const Word word : words) {
    if (name_of(word) == text) {
      into = word;
      return {};
    }
    all.append(all.empty() ? "" : ", ").append(name_of(word));
  }
  return usage(fmt::format("'{}' is none of the words that it may be", text), argument,
               "write one of " + all);
}

Status set_perspective(const DrawRequest& request, hlr::View& view) {
  if (!request.eye || !request.target)
    return request.eye || request.target
               ? usage("a view in perspective has an eye and a target", "eye", "give both")
               : Status{};
  hlr::Perspective perspective;
  const Result<geometry::Vec3l> eye = grid_point(*request.eye, "eye");
  if (!eye) return eye.error();
  const Result<geometry::Vec3l> target = grid_point(*request.target, "target");
  if (!target) return target.error();
  perspective.eye = *eye;
  perspective.target = *target;
  perspective.near_mm = request.near_mm.value_or(perspective.near_mm);
  perspective.field_of_view_deg = request.field_of_view_deg.value_or(perspective.field_of_view_deg);
  const Result<drawing::Direction> direction = drawing::set_perspective(perspective, view);
  return direction ? Status{} : Status(in_argument(direction.error(), "target"));
}

Result<geometry::Vec3l> direction_of(const std::string& text, const char* argument) {
  const Result<drawing::Direction> parsed = drawing::parse_direction(text);
  if (!parsed) return in_argument(parsed.error(), argument);
  return parsed->vector;
}

Result<geometry::Box3l> limits_of(const std::array<double, 6>& mm) {
  const auto lo = grid_point(geometry::Vec3d{mm[0], mm[1], mm[2]}, "limits");
  if (!lo) return lo.error();
  const auto hi = grid_point(geometry::Vec3d{mm[3], mm[4], mm[5]}, "limits");
  if (!hi) return hi.error();
  if (geometry::Box3l{*lo, *hi}.empty())
    return usage("the box is empty", "limits", "give the least corner before the greatest");
  return geometry::Box3l{*lo, *hi};
}

}  // namespace

Error in_argument(Error error, const char* argument) {
  error.where = argument;
  return error;
}

Result<hlr::View> view_of(const DrawRequest& request) {
  hlr::View view;
  const Result<geometry::Vec3l> direction = request.direction.empty()
                                                ? drawing::direction_by_name(request.view)
                                                : direction_of(request.direction, "direction");
  if (!direction)
    return request.direction.empty() ? in_argument(direction.error(), "view") : direction.error();
  view.direction = *direction;
  if (const Status status = set_perspective(request, view); !status) return status.error();
  view.up = drawing::default_up(view.direction);
  if (!request.up.empty()) {
    const Result<geometry::Vec3l> up = direction_of(request.up, "up");
    if (!up) return up.error();
    view.up = *up;
  }
  if (!drawing::can_be_up(view.up, view.direction))
    return usage("it is parallel to the view direction", "up", "give one that shows on paper");
  if (request.limits) {
    const Result<geometry::Box3l> limits = limits_of(*request.limits);
    if (!limits) return limits.error();
    view.limits = *limits;
  }
  const auto eye = view.perspective ? std::optional(view.perspective->eye) : std::nullopt;
  for (const std::string& text : request.sections) {
    const auto section = drawing::parse_section(text, view.direction, eye);
    if (!section) return in_argument(section.error(), "section");
    view.sections.push_back(section->section);
  }
  return view;
}

Result<hlr::Options> line_options(const DrawRequest& request) {
  hlr::Options options;
  using hlr::Intersections, hlr::OwnPolylines, hlr::Smooth, hlr::Stage;
  for (const Status& status :
       {read_word(request.stage, std::array{Stage::none, Stage::local, Stage::global},
                  drawing::stage_name, "stage", options.stage),
        read_word(request.intersections,
                  std::array{Intersections::off, Intersections::objects, Intersections::primitives,
                             Intersections::parts},
                  drawing::intersections_name, "intersections", options.intersections),
        read_word(request.own_polylines, std::array{OwnPolylines::visible, OwnPolylines::hidden},
                  drawing::own_polylines_name, "own_polylines", options.own_polylines),
        read_word(request.smooth, std::array{Smooth::off, Smooth::tangent, Smooth::all},
                  drawing::smooth_name, "smooth", options.smooth)})
    if (!status) return status.error();
  if (request.hidden != "off" && request.hidden != "dashed" && request.hidden != "all")
    return usage(fmt::format("'{}' is none of the words that it may be", request.hidden), "hidden",
                 "write one of off, dashed, all");
  if (request.visible_only && (request.hidden != "off" || request.keep_hidden))
    return usage("hidden lines cannot be drawn and left out", "visible_only",
                 "leave out hidden or visible_only");
  options.hidden = request.keep_hidden || request.hidden != "off";
  options.clipped = request.keep_hidden;
  options.flush_seams = request.flush_seams;
  options.contact_distance_mm = request.contact_distance_mm.value_or(options.contact_distance_mm);
  options.sharp_angle_deg = request.sharp_angle_deg.value_or(options.sharp_angle_deg);
  if (!(options.sharp_angle_deg >= 0 && options.sharp_angle_deg <= 180))
    return usage("it is no angle between two faces", "sharp_angle", "write 0 to 180 degrees");
  return options;
}

Result<drawing::LayoutOptions> layout_options(const DrawRequest& request) {
  drawing::LayoutOptions options;
  options.view_name = request.eye                 ? "perspective"
                      : request.direction.empty() ? request.view
                                                  : request.direction;
  options.title = request.title;
  options.uncut_selections = request.uncut;
  if (!request.scale.empty()) {
    const Result<double> scale = parse_scale(request.scale);
    if (!scale) return in_argument(scale.error(), "scale");
    options.scale = *scale;
  }
  if (!request.paper.empty()) {
    const Result<drawing::PaperSize> paper = drawing::parse_paper(request.paper);
    if (!paper) return in_argument(paper.error(), "paper");
    options.paper = *paper;
  }
  return options;
}

model::SceneOptions scene_options(const DrawRequest& request) {
  model::SceneOptions options;
  options.obstruction = request.obstructions;
  options.insulation = request.insulation;
  options.sag_mm = request.sag_mm.value_or(options.sag_mm);
  options.weld_mm = request.weld_mm.value_or(options.weld_mm);
  return options;
}

}  // namespace strake::python
