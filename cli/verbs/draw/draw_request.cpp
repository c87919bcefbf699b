// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/draw/draw_request.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <optional>

#include "cli/run/object_selection.hpp"
#include "cli/verbs/draw/styles/style_option.hpp"
#include "core/output_format.hpp"
#include "core/units.hpp"
#include "drawing/drawing_writers.hpp"
#include "drawing/layout/paper_size.hpp"
#include "publish/drawing_formats.hpp"
#include "strake/drawing/view.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::cli {

namespace {

/// The largest sag; it is less where that would show on paper.
constexpr double kSagMm = 0.5;

Result<geometry::Vec3l> direction_of(const std::string& text, const std::string& option,
                                     Console& console) {
  const Result<drawing::Direction> parsed = drawing::parse_direction(text);
  if (!parsed) {
    Error error = parsed.error();
    if (error.where.empty()) error.where = option;
    return error;
  }
  const geometry::Vec3l& v = parsed->vector;
  if (parsed->rounded && parsed->rounding_error > 0)
    console.note(fmt::format("{} {} is taken as {},{},{}, off by {:.1e} rad", option, text, v.x,
                             v.y, v.z, parsed->rounding_error));
  return v;
}

Result<geometry::Box3l> limits_of(const std::string& text) {
  const auto n = coordinates_option(text, 6, "--limits", "xmin,ymin,zmin,xmax,ymax,zmax");
  if (!n) return n.error();
  const auto lo = geometry::snap(geometry::Vec3d{(*n)[0], (*n)[1], (*n)[2]});
  const auto hi = geometry::snap(geometry::Vec3d{(*n)[3], (*n)[4], (*n)[5]});
  if (!lo || !hi)
    return Error{ErrorCode::usage, "'" + text + "' lies outside what can be placed", "--limits",
                 "write millimetres of the model"};
  if (geometry::Box3l{*lo, *hi}.empty())
    return Error{ErrorCode::usage, "'" + text + "' is empty", "--limits",
                 "write the three least coordinates before the three greatest"};
  return geometry::Box3l{*lo, *hi};
}

Result<hlr::Section> section_of(const std::string& text, const hlr::View& view, Console& console) {
  const auto eye = view.perspective ? std::optional(view.perspective->eye) : std::nullopt;
  const Result<drawing::SectionText> parsed = drawing::parse_section(text, view.direction, eye);
  if (!parsed) {
    Error error = parsed.error();
    error.where = "--section";
    return error;
  }
  const geometry::Vec3l& n = parsed->section.normal;
  if (parsed->rounded && parsed->rounding_error > 0)
    console.note(fmt::format("--section {} is taken as normal {},{},{}, off by {:.1e} rad", text,
                             n.x, n.y, n.z, parsed->rounding_error));
  return parsed->section;
}

Result<hlr::View> view_of(const DrawOptions& given, Console& console) {
  hlr::View view;
  const Result<geometry::Vec3l> direction =
      !given.direction.empty()
          ? direction_of(given.direction, "--direction", console)
          : drawing::direction_by_name(given.view.empty() ? "iso" : given.view);
  if (!direction) return direction.error();
  view.direction = *direction;
  if (const Status status = set_perspective(given.perspective, view, console); !status)
    return status.error();
  view.up = drawing::default_up(view.direction);
  if (!given.up.empty()) {
    const Result<geometry::Vec3l> up = direction_of(given.up, "--up", console);
    if (!up) return up.error();
    view.up = *up;
  }
  if (!drawing::can_be_up(view.up, view.direction))
    return Error{ErrorCode::usage, "'" + given.up + "' is parallel to the view direction", "--up",
                 "give a direction that shows on paper"};
  if (!given.limits.empty() && given.limits != kAutoLimits) {
    const Result<geometry::Box3l> limits = limits_of(given.limits);
    if (!limits) return limits.error();
    view.limits = *limits;
  }
  for (const std::string& text : given.sections) {
    const Result<hlr::Section> section = section_of(text, view, console);
    if (!section) return section.error();
    view.sections.push_back(*section);
  }
  return view;
}

Status read_bucketing(const std::string& text, std::int32_t& bucketing) {
  bucketing = hlr::Options::kBucketsByData;
  if (text.empty() || text == "auto") return {};
  bucketing = hlr::Options::kNoBuckets;
  if (text == "off") return {};
  std::uint64_t side = 0;
  if (!whole_number(side, text, "--bucketing") || side == 0 || side > hlr::Options::kMaxBuckets)
    return Error{
        ErrorCode::usage, "'" + text + "' is no number of buckets", "--bucketing",
        fmt::format("write off, auto, or a number from 1 to {}", hlr::Options::kMaxBuckets)};
  bucketing = static_cast<std::int32_t>(side);
  return {};
}

/// Whether any output holds lines that are not shown, too.
bool any_lists_lines(const std::vector<std::string>& outputs) {
  return std::ranges::any_of(outputs, [](const std::string& file) {
    const Result<drawing::DrawingWriter> writer = publish::find_drawing_writer(file);
    return writer && !writer->needs_ink;
  });
}

Result<hlr::Options> engine_options(const DrawOptions& given, bool keep_lines) {
  hlr::Options options;
  if (given.stage == "none") options.stage = hlr::Stage::none;
  if (given.stage == "local") options.stage = hlr::Stage::local;
  if (given.solver == "brute-force") options.solver = hlr::Solver::brute_force;
  if (given.global == "push") options.solver = hlr::Solver::push;
  options.culling = given.culling != "off";
  if (const Status s = read_bucketing(given.bucketing, options.bucketing); !s) return s.error();
  options.clipped = !given.visible_only && (keep_lines || any_lists_lines(given.outputs));
  options.hidden = options.clipped || ink_options(given).hidden;
  if (given.visible_only && !given.hidden.empty() && given.hidden != "off")
    return Error{ErrorCode::usage, "hidden lines cannot be drawn and left out", "--visible-only",
                 "leave out --hidden or --visible-only"};
  using hlr::Intersections, hlr::Smooth;
  for (const Intersections which : {Intersections::off, Intersections::objects,
                                    Intersections::primitives, Intersections::parts})
    if (given.intersections == drawing::intersections_name(which)) options.intersections = which;
  if (given.own_polylines == drawing::own_polylines_name(hlr::OwnPolylines::hidden))
    options.own_polylines = hlr::OwnPolylines::hidden;
  for (const Smooth which : {Smooth::off, Smooth::tangent, Smooth::all})
    if (given.smooth == drawing::smooth_name(which)) options.smooth = which;
  options.flush_seams = given.flush_seams != "off";
  if (!given.sharp_angle.empty()) {
    const Result<double> angle =
        quantity_option(given.sharp_angle, "--sharp-angle", parse_angle_deg);
    if (!angle) return angle.error();
    if (!(*angle >= 0 && *angle <= 180))
      return Error{ErrorCode::usage, "'" + given.sharp_angle + "' is no angle between two faces",
                   "--sharp-angle", "write 0deg to 180deg"};
    options.sharp_angle_deg = *angle;
  }
  if (const Status status =
          length_option(options.contact_distance_mm, given.contact_distance, "--contact-distance");
      !status)
    return status.error();
  return options;
}

}  // namespace

Result<drawing::LayoutOptions> layout_options(const DrawOptions& given) {
  drawing::LayoutOptions options;
  options.view_name = !given.perspective.eye.empty() ? "perspective"
                      : !given.direction.empty()     ? given.direction
                      : given.view.empty()           ? "iso"
                                                     : given.view;
  options.title = given.title;
  if (!given.scale.empty()) {
    const Result<double> scale = quantity_option(given.scale, "--scale", parse_scale);
    if (!scale) return scale.error();
    options.scale = *scale;
  }
  if (!given.paper.empty()) {
    const Result<drawing::PaperSize> paper = drawing::parse_paper(given.paper);
    if (!paper) {
      Error error = paper.error();
      error.where = "--paper";
      return error;
    }
    options.paper = *paper;
  }
  return options;
}

drawing::InkOptions ink_options(const DrawOptions& given) {
  return {.hidden = given.hidden != "off" && !given.hidden.empty(),
          .clean_up = given.hidden != "all",
          .split_hidden = given.hidden_layers == "two"};
}

namespace {

/// Parses the text of an option into `into`, unless it was not given.
template <class Value, class Parse>
Status parse_option(const std::string& text, const char* option, Parse&& parse, Value& into) {
  if (text.empty()) return {};
  auto value = parse(text);
  if (value) {
    into = std::move(*value);
    return {};
  }
  Error error = value.error();
  error.where = option;
  return error;
}

}  // namespace

Result<drawing::Conventions> conventions_of(const DrawOptions& given) {
  drawing::Conventions conventions;
  conventions.break_lines = given.break_lines == "on";
  if (const Status status = parse_option(given.centre_lines, "--centre-lines",
                                         drawing::parse_centre_lines, conventions.centre_lines);
      !status)
    return status.error();
  if (const Status status =
          parse_option(given.thin, "--thin", drawing::parse_thinning, conventions.thin);
      !status)
    return status.error();
  return conventions;
}

Result<DrawRequest> request_of(const DrawOptions& given, Session& session, bool keep_lines) {
  const Result<model::SceneOptions> scene = scene_options(given.scene, kSagMm);
  if (!scene) return scene.error();
  const Result<hlr::View> view = view_of(given, session.console());
  if (!view) return view.error();
  const Result<hlr::Options> options = engine_options(given, keep_lines);
  if (!options) return options.error();
  Result<drawing::LayoutOptions> layout = layout_options(given);
  if (!layout) return layout.error();
  const auto selections = parse_selections(given.select, "--select");
  if (!selections) return selections.error();
  const auto uncut = parse_selections(given.uncut, "--uncut");
  if (!uncut) return uncut.error();
  const auto hatches = parse_hatches(given.hatches);
  if (!hatches) return hatches.error();
  if (const auto conventions = conventions_of(given); !conventions) return conventions.error();
  if (const auto styles = parse_styles(given.styles); !styles) return styles.error();
  std::optional<model::SingleLineOptions> single_line;
  if (const Status status =
          parse_option(given.single_line, "--single-line", model::parse_single_line, single_line);
      !status)
    return status.error();
  if (single_line) layout->single_line_mm = single_line->largest_diameter_mm;
  return DrawRequest{*scene,      *view,
                     *options,    *layout,
                     *selections, *uncut,
                     *hatches,    given.scene.sag.empty(),
                     single_line, given.limits != kAutoLimits};
}

}  // namespace strake::cli
