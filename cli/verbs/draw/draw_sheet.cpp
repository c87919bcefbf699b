// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/draw/draw_sheet.hpp"

#include <fmt/core.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "cli/verbs/draw/draw_summary.hpp"
#include "core/output_format.hpp"
#include "sheets/output/sheet_writers.hpp"
#include "strake/drawing/drawing.hpp"

namespace strake::cli {

namespace {

void print_sheet_summary(Session& session, const sheets::Sheet& sheet, const model::Model& model) {
  Console& console = session.console();
  for (const sheets::PlacedView& view : sheet.views) {
    std::uint64_t lines = 0;
    for (const std::uint64_t count : view.drawing.count) lines += count;
    const auto of = [&](drawing::LineState state) {
      return view.drawing.count[static_cast<std::size_t>(state)];
    };
    console.note(fmt::format("view '{}': {} visible of {} lines at {}", view.name,
                             of(drawing::LineState::visible), lines, scale_words(view.drawing)));
    console.note(
        fmt::format("view '{}': {}", view.name, object_summary_line(view.drawing.account, model)));
    for (const std::string& line : left_alone_lines(view.drawing))
      console.note(fmt::format("view '{}': {}", view.name, line));
    count_objects(session.stats(), view.drawing.account, view.name + ": ");
    for (std::size_t s = 0; s < drawing::kLineStates; ++s)
      session.stats().count(fmt::format("{}: lines {}", view.name,
                                        drawing::state_name(static_cast<drawing::LineState>(s))),
                            view.drawing.count[s]);
  }
  print_diagnostics(console, sheet.diagnostics,
                    {"view-empty",
                     "selection-matches-nothing",
                     "uncut-without-sections",
                     "field-not-filled",
                     "field-not-in-template",
                     "field-too-long",
                     "view-off-the-sheet",
                     "view-off-the-frame",
                     "view-on-title-block",
                     "views-overlap",
                     "far-object",
                     "far-object-left-out",
                     "grid-line-nowhere",
                     "grid-label-no-room",
                     "tag-not-seen",
                     "tag-no-room",
                     "tag-attribute-missing",
                     "tag-attribute-partly-missing",
                     "level-nowhere",
                     "section-mark-nowhere",
                     "extent-not-shown",
                     "parts-list-no-room",
                     "scale-bar-without-scale",
                     "north-not-shown", "dimension-not-drawn"});
}

/// "SVG": the formats of sheets in a sentence.
std::string format_names() {
  std::string names;
  for (const sheets::SheetWriter& writer : sheets::sheet_writers())
    names.append(names.empty() ? "" : " or ").append(writer.name);
  return names;
}

}  // namespace

Result<ExitCode> draw_sheet(Session& session, const SheetRequest& request,
                            const InputOptions& input, const model::SceneOptions& scene) {
  const std::vector<OutputFormat> formats = formats_of(sheets::sheet_writers());
  const std::string mend = fmt::format("write -o FILE{}", formats.front().suffix);
  if (session.json())
    return Error{ErrorCode::usage, fmt::format("a sheet is written as {} only", format_names()),
                 "--json", "leave --json out, and " + mend};
  if (request.outputs.empty()) return Error{ErrorCode::usage, "nowhere to draw to", "-o", mend};
  if (const Status status = session.files().add_input(request.file); !status) return status.error();
  if (const Status status = session.files().add_outputs(request.outputs, formats); !status)
    return status.error();
  const Result<sheets::SheetFile> file = sheets::SheetFile::read(request.file);
  if (!file) return file.error();
  if (!file->template_name().empty()) {
    const auto beside = std::filesystem::path(request.file).parent_path() / file->template_name();
    if (const Status status = session.files().add_input(beside); !status) return status.error();
  }
  const Result<Loaded> loaded = load(session, input, scene);
  if (!loaded) return loaded.error();
  if (request.options.solver == hlr::Solver::brute_force)
    session.console().note(
        "--solver brute-force: every view tries every edge with every triangle; it is an oracle "
        "for small scenes (without it the lines are the same, in much less time)");
  const Result<sheets::Sheet> sheet = [&] {
    const auto timer = session.step("views");
    return file->compose(loaded->scene, request.options, session.context());
  }();
  if (!sheet) return sheet.error();
  print_sheet_summary(session, *sheet, *loaded->model);
  for (const std::string& output : request.outputs) {
    const Result<sheets::SheetWriter> writer = find_writer(sheets::sheet_writers(), output);
    if (!writer) return writer.error();
    const Status written = session.write(
        output, [&](Session::Sink sink) { return writer->write(*sheet, *loaded->model, sink); });
    if (!written) return written.error();
  }
  const Diagnostics& noticed = sheet->diagnostics;
  const bool lacking = noticed.count("view-empty") + noticed.count("selection-matches-nothing") > 0;
  return input.strict && lacking ? ExitCode::partial : strict_exit_code(input, *loaded);
}

}  // namespace strake::cli
