// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "project/model/blocks.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"

namespace strake::project {

[[nodiscard]] Result<Blob> pack_diagnostics(const Diagnostics& diagnostics);
[[nodiscard]] Result<Diagnostics> unpack_diagnostics(std::span<const std::byte> blob,
                                                     std::string what);

/// What is said of a file that is alone in its model, and what it is called there and now.
struct FileDiagnostics {
  Diagnostics diagnostics;
  std::string name, label;
  std::string given;  ///< the path by which it was read
};

/// Returns what io::read_models() says of several files: what their readers noticed, in the order
/// of their names, then `of_all`, what it told of all of them, then what finish() did, in the order
/// of their labels. `files` are in the latter.
[[nodiscard]] Diagnostics joined_diagnostics(std::span<const FileDiagnostics> files,
                                             const Diagnostics& of_all = {});

}  // namespace strake::project
