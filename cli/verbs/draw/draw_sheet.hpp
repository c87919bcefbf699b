// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cli/run/exit_code.hpp"
#include "cli/run/load.hpp"
#include "cli/run/session.hpp"
#include "strake/core/result.hpp"
#include "strake/sheets/sheet_file.hpp"

namespace strake::cli {

/// The options of `draw --sheet`, as written.
struct SheetRequest {
  std::vector<std::string> files;
  std::vector<std::string> outputs;
  sheets::ComposeOptions options;
};

/// Draws the sheets that files describe and writes them. With --strict a view that shows nothing,
/// or a selection that picks nothing, makes it `partial`.
[[nodiscard]] Result<ExitCode> draw_sheet(Session& session, const SheetRequest& request,
                                          const InputOptions& input,
                                          const model::SceneOptions& scene);

}  // namespace strake::cli
