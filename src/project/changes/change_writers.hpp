// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "core/output_format.hpp"
#include "strake/project/update.hpp"

namespace strake::project {

/// One format that changes of a model are written in.
struct ChangeWriter {
  OutputFormat format;
  void (*write)(const Changes& changes, report::Sink sink);
};

/// All of them, in the order of help and errors.
[[nodiscard]] std::span<const ChangeWriter> change_writers();

}  // namespace strake::project
