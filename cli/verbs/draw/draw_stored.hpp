// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/run/exit_code.hpp"
#include "cli/run/project_input.hpp"
#include "cli/run/session.hpp"
#include "cli/verbs/draw/draw_request.hpp"
#include "strake/core/result.hpp"
#include "strake/report/view_document.hpp"

namespace strake::cli {

/// Runs 'strake draw -p FILE --save NAME' and '--stored NAME'. What is drawn is what a run without
/// a memory draws with hidden lines kept: of what is remembered, only lines are used whose objects,
/// view and options have the signatures of now.
[[nodiscard]] Result<ExitCode> draw_stored(Session& session, const DrawOptions& given);

/// A drawing that a project has stored, on its sheet.
struct FormerSheet {
  drawing::NeutralDrawing drawing;
  model::Model model;  ///< its objects and files, by name
  drawing::InkOptions ink;
};

/// Returns the drawing of a view that a project has stored, as it was when it was solved. Errors:
/// those of project::former_drawing().
[[nodiscard]] Result<FormerSheet> former_sheet(Session& session, OpenedProject& opened,
                                               const std::string& view);

/// Returns the same as a document.
[[nodiscard]] Result<report::ViewDocument> stored_document(Session& session, OpenedProject& opened,
                                                           const std::string& view);

/// Returns a stored view drawn of the model that the project has now, solving what changed since,
/// and stores nothing. Errors: those of draw_stored().
[[nodiscard]] Result<report::ViewDocument> document_of_now(Session& session, OpenedProject& opened,
                                                           const std::string& view);

}  // namespace strake::cli
