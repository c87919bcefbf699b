// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "cli/run/load.hpp"
#include "cli/run/project_input.hpp"
#include "cli/verbs/draw/draw_again.hpp"
#include "cli/verbs/draw/draw_options.hpp"
#include "cli/verbs/draw/draw_request.hpp"
#include "cli/verbs/draw/draw_run.hpp"
#include "cli/verbs/draw/draw_sheet.hpp"
#include "cli/verbs/draw/draw_stored.hpp"
#include "cli/verbs/verb.hpp"
#include "core/output_format.hpp"
#include "core/text_encoding.hpp"
#include "drawing/drawing_writers.hpp"
#include "publish/drawing_formats.hpp"

namespace strake::cli {

namespace {

/// Those that show what got ink, or those that hold the whole drawing, whatever of it is shown:
/// ".json and .view".
std::string suffixes_by_ink(bool needs_ink) {
  std::vector<OutputFormat> formats;
  const std::vector<drawing::DrawingWriter> writers = publish::drawing_writers();
  for (const drawing::DrawingWriter& writer : writers)
    if (writer.needs_ink == needs_ink) formats.push_back(writer.format);
  return list_suffixes(formats, "and");
}

/// Checks the name that --save gives a view: people read it in lists and write it again.
Status check_view_name(const DrawOptions& given) {
  constexpr std::size_t kLongestName = 200;
  if (given.save.empty()) return {};
  if (given.save.size() > kLongestName)
    return Error{ErrorCode::usage, fmt::format("a name of {} bytes is too long", given.save.size()),
                 "--save", fmt::format("give one of at most {}", kLongestName)};
  for (std::string_view rest = given.save; !rest.empty();)
    if (!is_printable(decode_character(rest)))
      return Error{ErrorCode::usage,
                   in_quotes(printable(given.save)) + " holds characters that cannot be shown",
                   "--save", "give a name of letters, digits and signs, in UTF-8"};
  return {};
}

Status check_drawing_outputs(Session& session, const DrawOptions& given) {
  const bool remembers = !given.save.empty() || !given.stored.empty();
  if (given.outputs.empty() && !session.json() && !remembers)
    return Error{
        ErrorCode::usage, "nowhere to draw to", "-o",
        fmt::format("write -o FILE{}, or --json", publish::drawing_formats().front().suffix)};
  return session.files().add_outputs(given.outputs, publish::drawing_formats());
}

/// Draws the model files, or a project as if its model came from them.
Result<ExitCode> draw_model(Session& session, const DrawOptions& given,
                            const DrawRequest& request) {
  Result<LoadedModel> loaded = [&]() -> Result<LoadedModel> {
    if (given.project.file.empty()) return load(session, given.input, request.scene);
    Result<OpenedProject> opened = open_project(session, given.project, project::Access::read);
    if (!opened) return opened.error();
    return load_project(session, *opened, request.scene);
  }();
  if (!loaded) return loaded.error();
  if (const Status status = draw_pipes_as_lines(session, request, loaded->scene); !status)
    return status.error();
  const Result<PreparedView> prepared = prepare_view(session, request, loaded->scene);
  if (!prepared) return prepared.error();
  const Result<hlr::Drawing> lines = solve(session, request, *prepared, loaded->scene);
  if (!lines) return lines.error();
  const auto drawing = put_on_paper(session, *lines, *loaded->model, prepared->layout);
  if (!drawing) return drawing.error();
  report_drawing(session, *drawing, *loaded->model);
  if (const Status status = write_drawing(session, given, *drawing, *loaded->model, &loaded->scene);
      !status)
    return status.error();
  return strict_exit_code(given.input, *loaded);
}

Result<ExitCode> run_draw(Session& session, const DrawOptions& given) {
  if (const Status status = check_project_options(given.project, given.input); !status)
    return status.error();
  if (const Status status = check_view_name(given); !status) return status.error();
  if ((given.full || given.verify) && given.save.empty() && given.stored.empty())
    return Error{ErrorCode::usage, "only stored views are solved otherwise than in full",
                 given.full ? "--full" : "--verify",
                 "leave it out, or name the view: --stored NAME"};
  if (given.input.files.empty() && given.project.file.empty())
    return Error{ErrorCode::usage, "no model file is given", {}, "'strake draw --help' tells more"};
  if (const Status status = session.files().add_inputs(given.input.files); !status)
    return status.error();
  if (given.sheets.empty())
    if (const Status status = check_drawing_outputs(session, given); !status) return status.error();
  if (!given.save.empty() || !given.stored.empty()) return draw_stored(session, given);
  if (holds_drawing(given.input)) return draw_again(session, given);
  const Result<DrawRequest> request = request_of(given, session, session.json());
  if (!request) return request.error();
  if (!given.sheets.empty())
    return draw_sheet(
        session,
        {given.sheets,
         given.outputs,
         {.solver = request->options.solver, .sag_for_paper = request->sag_for_paper}},
        given.input, request->scene);
  return draw_model(session, given, *request);
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
      may_repeat(
          command.add_option(
              "--section", options.sections,
              "Cut away what lies beyond a plane: 'z>4500mm' above, 'z<4500mm' below, z=4500mm "
              "what is nearer to the viewer; for z also x, y or a normal, '1,2,0>4500mm'. "
              "Solids are closed by a hatched face where it cuts them; may be repeated"))
          ->type_name("PLANE")
          ->group("View");
  may_repeat(command.add_option(
                 "--uncut", options.uncut,
                 "Leave the objects that this picks whole where a section cuts them, neither cut "
                 "nor hatched, as bolts, shafts and ribs along it (ISO 128-3): 'name = BOLT*'; "
                 "what lies wholly beyond a plane is cut away all the same; may be repeated"))
      ->type_name("SELECTION")
      ->needs(section)
      ->group("View");
  may_repeat(command.add_option(
                 "--hatch", options.hatches,
                 "How sections are hatched: angle, distance of lines in the model, or both with "
                 "their units, or off, and of which objects: '30deg,80mm: PIPE*'; may be "
                 "repeated, the first that "
                 "picks an object counts (default: neighbours differ in angle, colours in "
                 "distance)"))
      ->type_name("PATTERN")
      ->group("View");
  may_repeat(command.add_option(
                 "--select", options.select,
                 "Draw only objects that this picks, as 'PIPE*' or 'type = box and @DN > 80mm'; "
                 "may be repeated"))
      ->type_name("SELECTION")
      ->group("View");
}

/// Adds which lines besides visible edges come on paper.
void add_drawn_lines(CLI::App& command, DrawOptions& options) {
  add_choice(command, "--hidden", options.hidden, {"off", "dashed", "all"},
             fmt::format("Hidden lines in {}: none, dashed where no line runs beside them, or all "
                         "(default off)",
                         suffixes_by_ink(true)))
      ->group("Lines");
  add_choice(
      command, "--hidden-layers", options.hidden_layers, {"one", "two"},
      "Hidden lines as one layer, or what an object hides itself and what others hide as two "
      "(default one)")
      ->group("Lines");
  command
      .add_option(
          "--centre-lines", options.centre_lines,
          fmt::format("Centre lines of round parts in {}: on, off, or the diameter on paper "
                      "from which parts have them (default off; on is 2mm)",
                      suffixes_by_ink(true)))
      ->type_name("on|off|LENGTH")
      ->group("Lines");
  add_choice(command, "--break-lines", options.break_lines, {"on", "off"},
             "Lines with zigzags where --limits cut objects (default off)")
      ->group("Lines");
  command
      .add_option("--single-line", options.single_line,
                  "Draw pipes up to this outer diameter as single lines, their axes (ISO 6412): "
                  "a length, or a nominal size as DN50; off (default off)")
      ->type_name("off|DN|LENGTH")
      ->group("Lines");
}

/// Adds how lines are drawn.
void add_line_styles(CLI::App& command, DrawOptions& options) {
  command
      .add_option(
          "--thin", options.thin,
          "Leave out inner lines of an object that are nearer than this to others on paper: "
          "on (two pens), off, or a distance, as 0.5mm; +dxf behind it leaves them out of "
          "model space of .dxf, too (default off)")
      ->type_name("on|off|LENGTH[+dxf]")
      ->group("Lines");
  may_repeat(
      command.add_option(
          "--style", options.styles,
          fmt::format("How the lines of some objects are drawn in {}: name of their layer, colour, "
                      "width of visible edges and type of line, each as you like: "
                      "'name=PIPING,color=#c00000,pen=0.35mm,line=dashed: @discipline = PIPING'; "
                      "may be repeated, the first that picks an object counts",
                      suffixes_by_ink(true))))
      ->type_name("STYLE")
      ->group("Lines");
}

/// Adds what hides lines, and which.
void add_visibility(CLI::App& command, DrawOptions& options) {
  command
      .add_flag(
          "--visible-only", options.visible_only,
          fmt::format("Leave hidden and clipped lines out of everything, of {} too: less time "
                      "and memory",
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
}

/// Adds which edges of a surface are lines.
void add_edge_kinds(CLI::App& command, DrawOptions& options) {
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

/// Adds how lines are solved; the drawing is the same.
void add_running(CLI::App& command, DrawOptions& options) {
  add_choice(command, "--solver", options.solver, {"gather", "brute-force"},
             "How lines are hidden; the result is the same. brute-force is an oracle for small "
             "scenes, which tries every edge with every triangle: seconds for 10,000 triangles, "
             "days for a million (default gather)")
      ->group("Running");
  add_choice(
      command, "--global", options.global, {"gather", "push"},
      "How objects hide each other: each edge gathers what hides it, or each object "
      "publishes what it hides, the baseline that benchmarks compare with; the result is the "
      "same (default gather)")
      ->excludes("--solver")
      ->group("Running");
  add_choice(command, "--culling", options.culling, {"on", "off"},
             "Leave out the work that cannot change the result (default on)")
      ->group("Running");
  command
      .add_option(
          "--bucketing", options.bucketing,
          "How the faces of complex objects are found: in a grid of at most N by N buckets, "
          "in as many as suit the faces (auto), or by testing each face (off); the result is "
          "the same (default auto)")
      ->type_name("off|N|auto")
      ->group("Running");
}

/// Adds the scale, the sheet and its title.
void add_paper(CLI::App& command, DrawOptions& options) {
  command
      .add_option("--scale", options.scale,
                  "Paper to model, as 1:50 or 10:1 (default: the largest usual one that fits the "
                  "paper)")
      ->type_name("1:N")
      ->group("Output");
  command
      .add_option("--paper", options.paper,
                  "A4, A3, A2, A1 or A0, with ,portrait for upright paper, or width x height as "
                  "900mmx420mm; what does not fit it at a given --scale is an error (default: A3, "
                  "and larger where --scale asks for it)")
      ->type_name("SIZE")
      ->group("Output");
  command.add_option("--title", options.title, "Title of the sheet")->group("Output");
}

/// Adds -p and what a project remembers of drawings.
void add_stored(CLI::App& command, DrawOptions& options) {
  add_project_options(command, options.project, kWorkOnProject);
  CLI::Option* const project = command.get_option("--project");
  CLI::Option* const save =
      command
          .add_option("--save", options.save,
                      "Remember these options in the project as a view of this name, and its lines")
          ->type_name("NAME")
          ->needs(project)
          ->group("Stored views");
  command
      .add_option("--stored", options.stored,
                  "Draw a view that the project remembers: only what changed since is solved. "
                  "--hidden, --scale, --paper and --title may be other ones")
      ->type_name("NAME")
      ->needs(project)
      ->excludes(save)
      ->group("Stored views");
  command
      .add_flag("--full", options.full,
                "Solve all lines of the stored view, whatever is remembered")
      ->needs(project)
      ->group("Stored views");
  command
      .add_flag("--verify", options.verify,
                "Solve the stored view both ways, by what changed and in full: exit code 1 where "
                "they differ")
      ->needs(project)
      ->group("Stored views");
}

/// Adds --sheet; it excludes the options that a sheet states itself.
void add_sheet(CLI::App& command, DrawOptions& options) {
  CLI::Option* const sheet =
      may_repeat(
          command.add_option(
              "--sheet", options.sheets,
              "Several views with frame and title block, as a sheet file (TOML) says; may "
              "be repeated; several sheets are pages of a .pdf, layouts of a .dxf, or a file "
              "each, -o 'NAME-{sheet}.svg'"))
          ->type_name("FILE")
          ->group("Output");
  for (const char* const other : {"--view",
                                  "--direction",
                                  "--eye",
                                  "--up",
                                  "--limits",
                                  "--section",
                                  "--uncut",
                                  "--hatch",
                                  "--select",
                                  "--hidden",
                                  "--hidden-layers",
                                  "--centre-lines",
                                  "--break-lines",
                                  "--thin",
                                  "--single-line",
                                  "--visible-only",
                                  "--stage",
                                  "--intersections",
                                  "--own-polylines",
                                  "--smooth",
                                  "--flush-seams",
                                  "--sharp-angle",
                                  "--contact-distance",
                                  "--scale",
                                  "--paper",
                                  "--title",
                                  "--project",
                                  "--save",
                                  "--stored",
                                  "--style"})
    sheet->excludes(other);
}

}  // namespace

Verb add_draw(CLI::App& program, CommonOptions& common) {
  const auto options = std::make_shared<DrawOptions>();
  CLI::App* const command =
      program.add_subcommand("draw", "Line drawings of models, hidden lines removed exactly");
  add_input_options(*command, options->input);
  add_georeference_option(*command, options->input);
  command->get_option("files")->required(false);  // 'strake draw diff' has files of its own
  add_scene_options(*command, options->scene, "0.05mm on paper, 0.5mm at most");
  add_view(*command, *options);
  add_drawn_lines(*command, *options);
  add_line_styles(*command, *options);
  add_visibility(*command, *options);
  add_edge_kinds(*command, *options);
  add_running(*command, *options);
  add_paper(*command, *options);
  add_output_option(*command, options->outputs, "Drawing", publish::drawing_formats());
  add_stored(*command, *options);
  add_sheet(*command, *options);
  add_distribution_option(*command, common);
  add_scheduler_options(*command, common);
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
  strake draw ship.glb --sheet deck.toml -o deck.svg
  strake draw ship.glb --sheet deck.toml --sheet frames.toml -o ship.pdf
  strake draw -p ship.strake --save deck4 --view top --limits 0,0,9m,80m,20m,12m -o deck4.svg
  strake draw -p ship.strake --stored deck4 --hidden dashed -o deck4.svg -o deck4.json
  strake draw deck4.json --scale 1:50 --paper A1 -o deck4_A1.svg)");
  return {command, [options](Session& session) { return run_draw(session, *options); }};
}

}  // namespace strake::cli
