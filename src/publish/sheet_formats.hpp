// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "sheets/output/sheet_writers.hpp"

namespace strake::publish {

/// Returns the formats that sheets are written in, in the order of errors: those of lines, then
/// what shows the model besides.
[[nodiscard]] std::vector<sheets::SheetWriter> sheet_writers();

}  // namespace strake::publish
