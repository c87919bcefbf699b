// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/run/load.hpp"
#include "cli/run/object_selection.hpp"
#include "cli/verbs/draw/brute_force_cost.hpp"
#include "cli/verbs/draw/draw_options.hpp"
#include "cli/verbs/draw/draw_sheet.hpp"
#include "cli/verbs/draw/draw_summary.hpp"
#include "cli/verbs/draw/far_objects.hpp"
#include "cli/verbs/verb.hpp"
#include "core/output_format.hpp"
#include "core/units.hpp"
#include "drawing/drawing_writers.hpp"
#include "drawing/layout/paper_size.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/view.hpp"
#include "strake/drawing/write.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::cli {

namespace {

/// --limits that leave far objects out.
constexpr std::string_view kAutoLimits = "auto";

/// The largest sag; it is less where that would show on paper.
constexpr double kSagMm = 0.5;

struct DrawOptions {
  InputOptions input;
  SceneInput scene;
  PerspectiveOptions perspective;
  std::string sheet;
  std::string view, direction, up, limits, scale, paper, title;
  std::string stage, solver, global, culling, bucketing, hidden, intersections, own_polylines,
      smooth, flush_seams, sharp_angle, contact_distance;
  std::vector<std::string> select, outputs, sections, uncut, hatches;
  bool visible_only = false;
};

/// Those that show what got ink, or those that hold the whole drawing, whatever of it is shown:
/// ".json and .view".
std::string suffixes_by_ink(bool needs_ink) {
  std::vector<OutputFormat> formats;
  for (const drawing::DrawingWriter& writer : drawing::drawing_writers())
    if (writer.needs_ink == needs_ink) formats.push_back(writer.format);
  return list_suffixes(formats, "and");
}

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
  if (!whole_number(side, text, "--bucketing") || side == 0 || side > hlr::Options::kMostBuckets)
    return Error{
        ErrorCode::usage, "'" + text + "' is no number of buckets", "--bucketing",
        fmt::format("write off, auto, or a number from 1 to {}", hlr::Options::kMostBuckets)};
  bucketing = static_cast<std::int32_t>(side);
  return {};
}

/// Whether any output shows hidden lines, or holds them whatever is shown of them.
bool keeps_hidden_lines(const DrawOptions& given, bool json) {
  if (given.visible_only) return false;
  if (json || (!given.hidden.empty() && given.hidden != "off")) return true;
  return std::ranges::any_of(given.outputs, [](const std::string& file) {
    const Result<drawing::DrawingWriter> writer = find_writer(drawing::drawing_writers(), file);
    return writer && !writer->needs_ink;
  });
}

Result<hlr::Options> engine_options(const DrawOptions& given, bool json) {
  hlr::Options options;
  if (given.stage == "none") options.stage = hlr::Stage::none;
  if (given.stage == "local") options.stage = hlr::Stage::local;
  if (given.solver == "brute-force") options.solver = hlr::Solver::brute_force;
  if (given.global == "push") options.solver = hlr::Solver::push;
  options.culling = given.culling != "off";
  if (const Status s = read_bucketing(given.bucketing, options.bucketing); !s) return s.error();
  options.hidden = keeps_hidden_lines(given, json);
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

void count_work(Stats& stats, const drawing::NeutralDrawing& drawing) {
  const hlr::Counters& work = drawing.counters;
  count_objects(stats, drawing.account, "");
  stats.count("feature edges", work.feature_edges);
  stats.count("covered edges", work.covered_edges);
  stats.count("face tests", work.face_tests);
  stats.count("exact fall-backs", work.exact_fallbacks);
  stats.count("intersection pairs", work.crossing_pairs);
  stats.count("intersection tests", work.crossing_tests);
  stats.count("specks", work.specks);
  stats.count("edges with hidden pieces left out", work.left_out);
  if (drawing.uncut) stats.count("objects uncut", work.uncut_objects);
  if (!drawing.flush_seams) stats.count("edges with flush seams left out", work.seams);
  for (std::size_t s = 0; s < drawing::kLineStates; ++s)
    stats.count(fmt::format("lines {}", drawing::state_name(static_cast<drawing::LineState>(s))),
                drawing.count[s]);
}

void print_drawing_summary(Console& console, const drawing::NeutralDrawing& drawing,
                           const model::Model& model) {
  const auto of = [&](drawing::LineState state) {
    return drawing.count[static_cast<std::size_t>(state)];
  };
  const std::uint64_t visible = of(drawing::LineState::visible);
  console.note(object_summary_line(drawing.account, model));
  console.note(fmt::format("{} visible of {} lines at {} on {} x {} mm", visible,
                           drawing.lines.size(), scale_words(drawing), drawing.sheet.width_mm,
                           drawing.sheet.height_mm));
  for (const std::string& line : left_alone_lines(drawing)) console.note(line);
  if (visible > 0) return;
  console.note(of(drawing::LineState::clipped) > 0
                   ? "warning empty-sheet: nothing is left to draw inside the limits, the field of "
                     "view and the sections"
                   : "warning empty-sheet: the model has nothing to draw");
}

Status write_drawing(Session& session, const DrawOptions& given,
                     const drawing::NeutralDrawing& drawing, const model::Model& model) {
  const drawing::InkOptions options{.hidden = given.hidden != "off" && !given.hidden.empty(),
                                    .clean_up = given.hidden != "all"};
  std::vector<drawing::DrawingWriter> writers;
  for (const std::string& file : given.outputs) {
    const Result<drawing::DrawingWriter> writer = find_writer(drawing::drawing_writers(), file);
    if (!writer) return writer.error();
    writers.push_back(*writer);
  }
  drawing::Ink ink;
  if (std::any_of(writers.begin(), writers.end(),
                  std::mem_fn(&drawing::DrawingWriter::needs_ink))) {
    const auto timer = session.step("ink");
    Result<drawing::Ink> chosen = drawing::choose_ink(drawing, options, session.context());
    if (!chosen) return chosen.error();
    ink = std::move(*chosen);
  }
  for (std::size_t i = 0; i < writers.size(); ++i) {
    const Status status = session.write(given.outputs[i], [&](Session::Sink sink) {
      return writers[i].write({drawing, ink, model}, sink, session.context());
    });
    if (!status) return status;
  }
  if (!session.json()) return {};
  return session.write_stdout([&](Session::Sink sink) {
    return drawing::write_view_json(drawing, model, sink, session.context());
  });
}

/// What the options ask for, after parsing.
struct DrawRequest {
  model::SceneOptions scene;
  hlr::View view;
  hlr::Options options;
  drawing::LayoutOptions layout;
  std::vector<model::Selection> selections, uncut;
  std::vector<HatchRule> hatches;
  bool sag_for_paper = true;
  bool far_objects = true;  ///< drawn, and warned of; otherwise left out
};

Result<DrawRequest> request_of(const DrawOptions& given, Session& session) {
  const Result<model::SceneOptions> scene = scene_options(given.scene, kSagMm);
  if (!scene) return scene.error();
  const Result<hlr::View> view = view_of(given, session.console());
  if (!view) return view.error();
  const Result<hlr::Options> options = engine_options(given, session.json());
  if (!options) return options.error();
  const Result<drawing::LayoutOptions> layout = layout_options(given);
  if (!layout) return layout.error();
  const auto selections = parse_selections(given.select, "--select");
  if (!selections) return selections.error();
  const auto uncut = parse_selections(given.uncut, "--uncut");
  if (!uncut) return uncut.error();
  const auto hatches = parse_hatches(given.hatches);
  if (!hatches) return hatches.error();
  return DrawRequest{*scene,
                     *view,
                     *options,
                     *layout,
                     *selections,
                     *uncut,
                     *hatches,
                     given.scene.sag.empty(),
                     given.limits != kAutoLimits};
}

Result<drawing::NeutralDrawing> compute(Session& session, const DrawRequest& request,
                                        const model::Scene& scene) {
  Result<std::vector<bool>> drawn = pick_any(session, scene, request.selections, "--select");
  if (!drawn) return drawn.error();
  drawing::LayoutOptions layout = request.layout;
  if (const Status status =
          mind_far_objects(session, scene, request.view, !request.far_objects, *drawn, layout);
      !status)
    return status.error();
  auto hatches = hatches_of(session, scene, request.hatches);
  if (!hatches) return hatches.error();
  hlr::Options options = request.options;
  options.hatches = std::move(*hatches);
  auto uncut = pick_any(session, scene, request.uncut, "--uncut");
  if (!uncut) return uncut.error();
  options.uncut = std::move(*uncut);
  for (const model::Selection& selection : request.uncut)
    layout.uncut_selections.push_back(selection.text());
  if (request.sag_for_paper) {
    const Result<double> sag =
        drawing::sag_for_paper(scene, *drawn, request.view, layout, session.context());
    if (!sag) return sag.error();
    options.sag_mm = *sag;
  }
  if (options.solver == hlr::Solver::brute_force)
    if (const Status told = tell_brute_force_cost(session, scene, *drawn, request.view, options);
        !told)
      return told.error();
  const Result<hlr::Drawing> lines = [&] {
    const auto timer = session.step("hidden lines");
    return hlr::draw(scene, *drawn, request.view, options, session.context());
  }();
  if (!lines) return lines.error();
  print_diagnostics(session.console(), lines->diagnostics);
  const auto timer = session.step("layout");
  return drawing::lay_out(*lines, *scene.model, layout, session.context());
}

Result<ExitCode> run_draw(Session& session, const DrawOptions& given) {
  if (given.input.files.empty())
    return Error{ErrorCode::usage, "no model file is given", {}, "'strake draw --help' tells more"};
  const Result<DrawRequest> request = request_of(given, session);
  if (!request) return request.error();
  if (!given.sheet.empty())
    return draw_sheet(
        session,
        {given.sheet,
         given.outputs,
         {.solver = request->options.solver, .sag_for_paper = request->sag_for_paper}},
        given.input, request->scene);
  if (given.outputs.empty() && !session.json())
    return Error{ErrorCode::usage, "nowhere to draw to", "-o",
                 fmt::format("write -o FILE{}, or --json",
                             formats_of(drawing::drawing_writers()).front().suffix)};
  if (const Status status =
          check_outputs(given.outputs, formats_of(drawing::drawing_writers()), given.input.files);
      !status)
    return status.error();
  const Result<Loaded> loaded = load(session, given.input, request->scene);
  if (!loaded) return loaded.error();
  const Result<drawing::NeutralDrawing> drawing = compute(session, *request, loaded->scene);
  if (!drawing) return drawing.error();
  count_work(session.stats(), *drawing);
  print_drawing_summary(session.console(), *drawing, *loaded->model);
  if (const Status status = write_drawing(session, given, *drawing, *loaded->model); !status)
    return status.error();
  return strict_exit_code(given.input, *loaded);
}

void add_view(CLI::App& command, DrawOptions& options) {
  CLI::Option* const view = add_choice(command, "--view", options.view,
                                       {"top", "bottom", "front", "back", "left", "right", "iso"},
                                       "A view by name (default iso)")
                                ->group("View");
  CLI::Option* const direction =
      command
          .add_option("--direction", options.direction,
                      "A view by the direction that points to the viewer, in whole numbers")
          ->type_name("X,Y,Z")
          ->excludes(view)
          ->group("View");
  add_perspective_options(command, options.perspective, view, direction);
  command.add_option("--up", options.up, "The direction that is up on paper (default z, plans y)")
      ->type_name("X,Y,Z")
      ->group("View");
  command
      .add_option("--limits", options.limits,
                  "Draw this box of the model only: xmin,ymin,zmin,xmax,ymax,zmax in mm or with "
                  "units, as 4.5m. What it cuts stays open; --section closes it. auto leaves out "
                  "the few objects that lie so far from all others that they decide the scale")
      ->type_name("BOX|auto")
      ->group("View");
  CLI::Option* const section =
      command
          .add_option(
              "--section", options.sections,
              "Cut away what lies beyond a plane: 'z>4500mm' above, 'z<4500mm' below, z=4500mm "
              "what is nearer to the viewer; for z also x, y or a normal, '1,2,0>4500mm'. "
              "Solids are closed by a hatched face where it cuts them; may be repeated")
          ->type_name("PLANE")
          ->expected(1)
          ->allow_extra_args(false)
          ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
          ->group("View");
  command
      .add_option("--uncut", options.uncut,
                  "Leave the objects that this picks whole where a section cuts them, neither cut "
                  "nor hatched, as bolts, shafts and ribs along it (ISO 128-3): 'name = BOLT*'; "
                  "what lies wholly beyond a plane is cut away all the same; may be repeated")
      ->type_name("SELECTION")
      ->needs(section)
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group("View");
  command
      .add_option("--hatch", options.hatches,
                  "How sections are hatched: angle, distance of lines in the model, or both with "
                  "their units, or off, and of which objects: '30deg,80mm: PIPE*'; may be "
                  "repeated, the first that "
                  "picks an object counts (default: neighbours differ in angle, colours in "
                  "distance)")
      ->type_name("PATTERN")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group("View");
  command
      .add_option("--select", options.select,
                  "Draw only objects that this picks, as 'PIPE*' or 'type = box and @DN > 80mm'; "
                  "may be repeated")
      ->type_name("SELECTION")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group("View");
}

void add_lines(CLI::App& command, DrawOptions& options) {
  add_choice(command, "--hidden", options.hidden, {"off", "dashed", "all"},
             fmt::format("Hidden lines in {}: none, dashed where no line runs beside them, or all "
                         "(default off)",
                         suffixes_by_ink(true)))
      ->group("Lines");
  command
      .add_flag("--visible-only", options.visible_only,
                fmt::format("Leave hidden lines out of everything, of {} too: less time and memory",
                            suffixes_by_ink(false)))
      ->group("Lines");
  add_choice(command, "--stage", options.stage, {"none", "local", "global"},
             "Hide nothing, within each object, or among all (default global)")
      ->group("Lines");
  add_choice(command, "--intersections", options.intersections,
             {"off", "objects", "primitives", "parts"},
             "Lines where bodies pass through each other: none, those of different objects, those "
             "and of primitives within an object, or of all parts (default primitives)")
      ->group("Lines");
  add_choice(command, "--own-polylines", options.own_polylines, {"visible", "hidden"},
             "Polylines behind or inside faces of their own object, as centre lines in pipes: seen "
             "through them, or hidden by them (default visible)")
      ->group("Lines");
  add_choice(command, "--smooth", options.smooth, {"off", "tangent", "on"},
             "Edges where faces turn by less than the sharp angle, as thin lines: none, where a "
             "curved surface begins or ends, or all (default off)")
      ->group("Lines");
  add_choice(command, "--flush-seams", options.flush_seams, {"on", "off"},
             "Edges where parts of one colour touch flush, their faces in one plane on both sides, "
             "as of plates welded end to end: drawn, or left out (default on)")
      ->group("Lines");
  command
      .add_option("--sharp-angle", options.sharp_angle,
                  "An edge is drawn where its faces turn by more than this (default 20deg)")
      ->type_name("ANGLE")
      ->group("Lines");
  command
      .add_option("--contact-distance", options.contact_distance,
                  "What is nearer by no more than this hides nothing (default: from the precision "
                  "of the files)")
      ->type_name("LENGTH")
      ->group("Lines");
}

/// Adds --sheet; it excludes the options that a sheet states itself.
void add_sheet(CLI::App& command, DrawOptions& options) {
  CLI::Option* const sheet =
      command
          .add_option("--sheet", options.sheet,
                      "Several views with frame and title block, as a sheet file (TOML) says")
          ->type_name("FILE")
          ->group("Output");
  for (const char* const other :
       {"--view",          "--direction",        "--eye",          "--up",
        "--limits",        "--section",          "--uncut",        "--hatch",
        "--select",        "--hidden",           "--visible-only", "--stage",
        "--intersections", "--own-polylines",    "--smooth",       "--flush-seams",
        "--sharp-angle",   "--contact-distance", "--scale",        "--paper",
        "--title"})
    sheet->excludes(other);
}

}  // namespace

Verb add_draw(CLI::App& program, CommonOptions& common) {
  const auto options = std::make_shared<DrawOptions>();
  CLI::App* const command =
      program.add_subcommand("draw", "Line drawings of models, hidden lines removed exactly");
  add_input_options(*command, options->input);
  command->get_option("files")->required(false);  // 'strake draw diff' has files of its own
  add_scene_options(*command, options->scene, "0.05mm on paper, 0.5mm at most");
  add_view(*command, *options);
  add_lines(*command, *options);
  add_choice(*command, "--solver", options->solver, {"gather", "brute-force"},
             "How lines are hidden; the result is the same. brute-force is an oracle for small "
             "scenes, which tries every edge with every triangle: seconds for 10,000 triangles, "
             "days for a million (default gather)")
      ->group("Running");
  add_choice(
      *command, "--global", options->global, {"gather", "push"},
      "How objects hide each other: each edge gathers what hides it, or each object "
      "publishes what it hides, the baseline that benchmarks compare with; the result is the "
      "same (default gather)")
      ->excludes("--solver")
      ->group("Running");
  add_choice(*command, "--culling", options->culling, {"on", "off"},
             "Leave out the work that cannot change the result (default on)")
      ->group("Running");
  command
      ->add_option(
          "--bucketing", options->bucketing,
          "How the faces of complex objects are found: in a grid of at most N by N buckets, "
          "in as many as suit the faces (auto), or by testing each face (off); the result is "
          "the same (default auto)")
      ->type_name("off|N|auto")
      ->group("Running");
  command
      ->add_option("--scale", options->scale,
                   "Paper to model, as 1:50 or 10:1 (default: the largest usual one that fits the "
                   "paper)")
      ->type_name("1:N")
      ->group("Output");
  command
      ->add_option("--paper", options->paper,
                   "A4, A3, A2, A1 or A0, with ,portrait for upright paper, or width x height as "
                   "900mmx420mm; what does not fit it at a given --scale is an error (default: A3, "
                   "and larger where --scale asks for it)")
      ->type_name("SIZE")
      ->group("Output");
  command->add_option("--title", options->title, "Title of the sheet")->group("Output");
  add_output_option(*command, options->outputs, "Drawing", formats_of(drawing::drawing_writers()));
  add_sheet(*command, *options);
  add_distribution_option(*command, common);
  add_common_options(*command, common);
  command->footer(R"(
Examples:
  strake draw platform.rvm --view iso --hidden dashed -o platform.svg
  strake draw ship.glb --direction 1,-2,1 --up 0,0,1 --scale 1:100 -o cut.svg \
      --limits 0,-5000,0,20000,5000,8000
  strake draw ship.glb --select 'PIP-*' --view top -o pipes.svg -o pipes.json
  strake draw ship.glb --view top --section z=4500mm -o section.svg
  strake draw ship.glb --view top --paper A1 -o plan.svg
  strake draw ship.glb --eye 2000,-9000,6000 --target 9000,0,3000 -o seen.svg
  strake draw ship.glb --sheet deck.toml -o deck.svg)");
  return {command, [options](Session& session) { return run_draw(session, *options); }};
}

}  // namespace strake::cli
