// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "cli/console.hpp"
#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::cli {

/// --eye, --target, --near and --field-of-view as they were written.
struct PerspectiveOptions {
  std::string eye, target, near, field_of_view;
};

/// Adds them; they take the place of `view` and `direction`.
void add_perspective_options(CLI::App& command, PerspectiveOptions& options, CLI::Option* view,
                             CLI::Option* direction);

/// Makes a view one in perspective: its direction too. Says where that was rounded. Nothing is done
/// where no eye was given.
[[nodiscard]] Status set_perspective(const PerspectiveOptions& given, hlr::View& view,
                                     Console& console);

}  // namespace strake::cli
