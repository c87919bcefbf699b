// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/draw/draw_again.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "cli/verbs/draw/draw_run.hpp"
#include "cli/verbs/draw/view_settings.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/report/view_drawing.hpp"

namespace strake::cli {

namespace {

/// Returns an option that is given and needs the model; empty where none is.
std::string option_of_model(const DrawOptions& given) {
  if (!given.input.units.empty()) return "--unit";
  if (!given.input.up_axes.empty()) return "--up-axis";
  if (given.input.strict) return "--strict";
  if (given.input.georeference) return "--georeference";
  if (!given.centre_lines.empty()) return "--centre-lines";
  if (!given.styles.empty()) return "--style";
  return first_option_of_lines(given);
}

Status check_alone(const DrawOptions& given) {
  const std::string& file = given.input.files.front();
  if (given.input.files.size() > 1)
    return Error{ErrorCode::usage, "a drawing that is written again is the only file",
                 *std::ranges::find_if(given.input.files, report::is_view_document),
                 "leave out the other files"};
  if (const std::string option = option_of_model(given); !option.empty())
    return Error{ErrorCode::usage,
                 "the lines of '" + file + "' are solved: only their sheet and ink may be others",
                 option, "leave it out, or draw the model"};
  return {};
}

}  // namespace

bool holds_drawing(const InputOptions& input) {
  return std::ranges::any_of(input.files, report::is_view_document);
}

Result<ExitCode> draw_again(Session& session, const DrawOptions& given) {
  if (const Status status = check_alone(given); !status) return status.error();
  const Result<drawing::LayoutOptions> layout = layout_options(given);
  if (!layout) return layout.error();
  const std::string& file = given.input.files.front();
  Result<report::ViewDrawing> read = [&] {
    const auto timer = session.step("read");
    return report::read_view_drawing(file);
  }();
  if (!read) return read.error();
  if (ink_options(given).hidden && !read->drawing.hidden_lines)
    return Error{ErrorCode::usage, "'" + file + "' has no hidden lines: they were left out",
                 "--hidden", "draw the model without --visible-only"};
  Result<drawing::NeutralDrawing> drawing = [&] {
    const auto timer = session.step("layout");
    return drawing::lay_out_again(std::move(read->drawing), *layout, session.context());
  }();
  if (!drawing) {
    Error error = drawing.error();
    if (error.where.empty()) error.where = file;
    return error;
  }
  report_drawing(session, *drawing, read->model);
  if (const Status status = write_drawing(session, given, *drawing, read->model, nullptr); !status)
    return status.error();
  return ExitCode::done;
}

}  // namespace strake::cli
