// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/draw/draw_sheet.hpp"

#include <fmt/core.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <utility>

#include "cli/verbs/draw/draw_summary.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/sheets/write.hpp"

namespace strake::cli {

namespace {

void tell_sheet(Session& session, const sheets::Sheet& sheet, const model::Model& model) {
  Console& console = session.console();
  for (const sheets::PlacedView& view : sheet.views) {
    std::uint64_t lines = 0;
    for (const std::uint64_t count : view.drawing.count) lines += count;
    const auto of = [&](drawing::LineState state) {
      return view.drawing.count[static_cast<std::size_t>(state)];
    };
    console.say(fmt::format("view '{}': {} visible of {} lines at {}", view.name,
                            of(drawing::LineState::visible), lines, view.drawing.sheet.scale_text));
    console.say(
        fmt::format("view '{}': {}", view.name, object_summary_line(view.drawing.account, model)));
    count_objects(session.stats(), view.drawing.account, view.name + ": ");
    for (std::size_t s = 0; s < drawing::kLineStates; ++s)
      session.stats().count(fmt::format("{}: lines {}", view.name,
                                        drawing::state_name(static_cast<drawing::LineState>(s))),
                            view.drawing.count[s]);
  }
  print_diagnostics(
      console, sheet.diagnostics,
      {"view-empty", "selection-matches-nothing", "field-not-filled", "field-not-in-template",
       "field-too-long", "view-off-the-sheet", "view-off-the-frame", "view-on-title-block",
       "views-overlap", "grid-line-nowhere", "grid-label-no-room", "tag-not-seen", "tag-no-room",
       "tag-attribute-missing", "tag-attribute-partly-missing"});
}

}  // namespace

Result<ExitCode> draw_sheet(Session& session, const SheetRequest& request,
                            const InputOptions& input, const model::SceneOptions& scene) {
  if (session.json())
    return Error{ErrorCode::usage, "a sheet is written as SVG only", "--json",
                 "leave --json out, and write -o FILE.svg"};
  if (request.outputs.empty())
    return Error{ErrorCode::usage, "nowhere to draw to", "-o", "write -o FILE.svg"};
  std::vector<std::string> inputs = input.files;
  inputs.push_back(request.file);
  if (const Status status = check_outputs(request.outputs, {".svg"}, inputs); !status)
    return status.error();
  const Result<sheets::SheetFile> file = sheets::SheetFile::read(request.file);
  if (!file) return file.error();
  if (!file->template_name().empty()) {
    const auto beside = std::filesystem::path(request.file).parent_path() / file->template_name();
    if (const Status status = check_outputs(request.outputs, {".svg"}, {beside.string()}); !status)
      return status.error();
  }
  const Result<Loaded> loaded = load(session, input, scene);
  if (!loaded) return loaded.error();
  const Result<sheets::Sheet> sheet = [&] {
    const auto timer = session.step("views");
    return file->compose(loaded->scene, request.options, session.context());
  }();
  if (!sheet) return sheet.error();
  tell_sheet(session, *sheet, *loaded->model);
  for (const std::string& output : request.outputs) {
    const Status written = session.write(output, [&](Session::Sink sink) {
      sheets::write_svg(*sheet, *loaded->model, sink);
      return Status{};
    });
    if (!written) return written.error();
  }
  const Diagnostics& noticed = sheet->diagnostics;
  const bool lacking = noticed.count("view-empty") + noticed.count("selection-matches-nothing") > 0;
  return input.strict && lacking ? ExitCode::partial : strict_exit_code(input, *loaded);
}

}  // namespace strake::cli
