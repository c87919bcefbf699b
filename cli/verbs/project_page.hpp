// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "cli/run/project_input.hpp"
#include "cli/run/session.hpp"
#include "page/page.hpp"
#include "strake/core/result.hpp"

/// The page of a project: what 'strake report' writes and 'strake view' serves.
namespace strake::cli {

/// Takes the contents of a page, which last until it returns.
using PageTaker = std::function<Status(page::PageContents&)>;

/// Puts the page of a project together and gives it to `take`. `geometry` is --page-geometry as it
/// is written. Errors: those of `take` and of reading the project.
[[nodiscard]] Status make_project_page(Session& session, OpenedProject& opened,
                                       const std::string& geometry, const PageTaker& take);

}  // namespace strake::cli
