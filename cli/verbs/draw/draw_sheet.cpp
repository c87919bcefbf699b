// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/draw/draw_sheet.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cli/verbs/draw/draw_summary.hpp"
#include "core/output_format.hpp"
#include "publish/sheet_formats.hpp"
#include "strake/drawing/drawing.hpp"

namespace strake::cli {

namespace {

/// Prints what became of a sheet; `of` is what its lines begin with where there are several.
void print_sheet_summary(Session& session, const sheets::Sheet& sheet, const model::Model& model,
                         const std::string& of) {
  Console& console = session.console();
  for (const sheets::PlacedView& view : sheet.views) {
    std::uint64_t lines = 0;
    for (const std::uint64_t count : view.drawing.count) lines += count;
    const auto count_of = [&](drawing::LineState state) {
      return view.drawing.count[static_cast<std::size_t>(state)];
    };
    const std::string name = fmt::format("{}view '{}': ", of, view.name);
    console.note(fmt::format("{}{} visible of {} lines at {}", name,
                             count_of(drawing::LineState::visible), lines,
                             scale_words(view.drawing)));
    console.note(name + object_summary_line(view.drawing.account, model));
    for (const std::string& line : left_alone_lines(view.drawing)) console.note(name + line);
    count_objects(session.stats(), view.drawing.account, of + view.name + ": ");
    for (std::size_t s = 0; s < drawing::kLineStates; ++s)
      session.stats().count(fmt::format("{}{}: lines {}", of, view.name,
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
                     "north-not-shown",
                     "dimension-not-drawn"});
}

/// "SVG": the formats of sheets in a sentence.
std::string format_names() {
  std::string names;
  const std::vector<sheets::SheetWriter> writers = publish::sheet_writers();
  for (const sheets::SheetWriter& writer : writers)
    names.append(names.empty() ? "" : " or ").append(writer.name);
  return names;
}

std::vector<OutputFormat> sheet_formats() {
  const std::vector<sheets::SheetWriter> writers = publish::sheet_writers();
  return formats_of(std::span(writers));
}

/// A file that is written, and the sheets in it.
struct SheetOutput {
  std::string file;
  std::size_t first = 0, count = 0;
  sheets::SheetWriter writer;
};

/// What stands for the name of each sheet in the name of an output.
constexpr std::string_view kSheetInName = "{sheet}";

/// Returns the names of the sheets: as their file has them, or what the file of the only one is
/// called.
std::vector<std::string> sheet_names(const SheetRequest& request,
                                     std::span<const sheets::SheetFile> files) {
  std::vector<std::string> names;
  for (std::size_t f = 0; f < files.size(); ++f)
    for (const std::string& name : files[f].names())
      names.push_back(name.empty() ? std::filesystem::path(request.files[f]).stem().string()
                                   : name);
  return names;
}

/// Returns the files that an output stands for: one with all sheets, or one for each of them.
Result<std::vector<SheetOutput>> files_of_output(const std::string& output,
                                                 std::span<const std::string> names) {
  const std::vector<sheets::SheetWriter> writers = publish::sheet_writers();
  const Result<sheets::SheetWriter> writer = find_writer(std::span(writers), output);
  if (!writer) {
    Error error = writer.error();
    error.where = "-o";
    return error;
  }
  const std::size_t place = output.find(kSheetInName);
  if (place == std::string::npos) {
    if (names.size() > 1 && !writer->takes_several)
      return Error{ErrorCode::usage,
                   fmt::format("'{}' holds one sheet, and {} are given", output, names.size()),
                   "-o",
                   fmt::format("write all to a .pdf, .dxf or .html, or each to a file of its own: "
                               "'NAME-{}{}'",
                               kSheetInName, writer->format.suffix)};
    return std::vector{SheetOutput{output, 0, names.size(), *writer}};
  }
  std::vector<SheetOutput> files;
  for (std::size_t s = 0; s < names.size(); ++s) {
    std::string file = output;
    file.replace(place, kSheetInName.size(), names[s]);
    files.push_back({std::move(file), s, 1, *writer});
  }
  return files;
}

/// Finds the files that are written, and tells the run of them. Errors: usage for one that cannot
/// hold all sheets, or that would be written twice.
Result<std::vector<SheetOutput>> outputs_of(Session& session, const SheetRequest& request,
                                            std::span<const sheets::SheetFile> sheet_files) {
  const std::vector<std::string> names = sheet_names(request, sheet_files);
  std::vector<SheetOutput> outputs;
  std::vector<std::string> paths;
  for (const std::string& output : request.outputs) {
    Result<std::vector<SheetOutput>> files = files_of_output(output, names);
    if (!files) return files.error();
    for (SheetOutput& file : *files) {
      paths.push_back(file.file);
      outputs.push_back(std::move(file));
    }
  }
  if (const Status status = session.files().add_outputs(paths, sheet_formats()); !status)
    return status.error();
  return outputs;
}

/// Reads the files, and tells the run of them and of their templates.
Result<std::vector<sheets::SheetFile>> read_sheet_files(Session& session,
                                                        const SheetRequest& request) {
  std::vector<sheets::SheetFile> files;
  for (const std::string& path : request.files) {
    const Result<sheets::SheetFile> file = sheets::SheetFile::read(path);
    if (!file) return file.error();
    for (const std::string& name : file->template_names()) {
      const auto beside = std::filesystem::path(path).parent_path() / name;
      if (const Status status = session.files().add_input(beside); !status) return status.error();
    }
    files.push_back(*file);
  }
  std::size_t of = 0, before = 0;
  for (const sheets::SheetFile& file : files) of += file.names().size();
  for (sheets::SheetFile& file : files) {
    const std::size_t own = file.names().size();
    file = file.in_set(before, of);
    before += own;
  }
  return files;
}

/// Writes the sheets to all outputs.
Status write_sheets(Session& session, std::span<const SheetOutput> outputs,
                    const sheets::SheetContents& contents) {
  for (const SheetOutput& output : outputs) {
    const sheets::SheetContents some{contents.sheets.subspan(output.first, output.count),
                                     contents.model, contents.scene};
    Diagnostics noticed;
    const Status status = session.write(output.file, [&](Session::Sink sink) -> Status {
      Result<Diagnostics> written = output.writer.write(some, sink, session.context());
      if (!written) return written.error();
      noticed = std::move(*written);
      return {};
    });
    if (!status) return status;
    print_diagnostics(session.console(), noticed,
                      {"text-character-missing", "template-part-left-out"});
  }
  return {};
}

bool is_lacking(const sheets::Sheet& sheet) {
  const Diagnostics& noticed = sheet.diagnostics;
  return noticed.count("view-empty") + noticed.count("selection-matches-nothing") > 0;
}

}  // namespace

Result<ExitCode> draw_sheet(Session& session, const SheetRequest& request,
                            const InputOptions& input, const model::SceneOptions& scene) {
  const std::vector<OutputFormat> formats = sheet_formats();
  const std::string mend = fmt::format("write -o FILE{}", formats.front().suffix);
  if (session.json())
    return Error{ErrorCode::usage, fmt::format("a sheet is written as {} only", format_names()),
                 "--json", "leave --json out, and " + mend};
  if (request.outputs.empty()) return Error{ErrorCode::usage, "nowhere to draw to", "-o", mend};
  if (const Status status = session.files().add_inputs(request.files); !status)
    return status.error();
  const Result<std::vector<sheets::SheetFile>> files = read_sheet_files(session, request);
  if (!files) return files.error();
  const auto outputs = outputs_of(session, request, *files);
  if (!outputs) return outputs.error();
  const Result<LoadedModel> loaded = load(session, input, scene);
  if (!loaded) return loaded.error();
  if (request.options.solver == hlr::Solver::brute_force)
    session.console().note(
        "--solver brute-force: every view tries every edge with every triangle; it is an oracle "
        "for small scenes (without it the lines are the same, in much less time)");
  std::vector<sheets::Sheet> sheets;
  for (std::size_t i = 0; i < files->size(); ++i) {
    Result<std::vector<sheets::Sheet>> of_file = [&] {
      const auto timer = session.step("views");
      return (*files)[i].compose_all(loaded->scene, request.options, session.context());
    }();
    if (!of_file) return of_file.error();
    const std::string file = std::filesystem::path(request.files[i]).filename().string();
    for (sheets::Sheet& sheet : *of_file) {
      const std::string of = (files->size() > 1 ? file + ", " : "") +
                             (sheet.name.empty() ? "" : "sheet '" + sheet.name + "', ");
      print_sheet_summary(session, sheet, *loaded->model, of);
      sheets.push_back(std::move(sheet));
    }
  }
  if (const Status status =
          write_sheets(session, *outputs, {sheets, *loaded->model, &loaded->scene});
      !status)
    return status.error();
  const bool lacking = std::ranges::any_of(sheets, is_lacking);
  return input.strict && lacking ? ExitCode::partial : strict_exit_code(input, *loaded);
}

}  // namespace strake::cli
