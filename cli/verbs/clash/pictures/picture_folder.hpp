// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/run/session.hpp"
#include "strake/core/result.hpp"
#include "strake/report/clash.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own name
class App;
}  // namespace CLI

/// The options for a folder of pictures of clashes, and the folder.
namespace strake::cli {

/// As written.
struct PictureInput {
  std::string folder, max_pictures, format;
};

void add_picture_options(CLI::App& command, PictureInput& options);

/// Checks the options before the run begins. Errors: usage for what makes no sense, output for a
/// folder that holds something else.
[[nodiscard]] Status check_pictures(const PictureInput& given);

/// Writes the folder where one is requested, and tells how many pictures there are and how many are
/// left out.
[[nodiscard]] Status write_pictures(Session& session, const PictureInput& given,
                                    const report::ClashContents& contents);

}  // namespace strake::cli
