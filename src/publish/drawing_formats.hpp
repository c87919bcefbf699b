// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "drawing/drawing_writers.hpp"
#include "strake/core/result.hpp"

namespace strake::publish {

/// Returns the formats that drawings are written in, in the order of help and errors: those of
/// lines, then what shows the model besides.
[[nodiscard]] std::vector<drawing::DrawingWriter> drawing_writers();
[[nodiscard]] std::vector<OutputFormat> drawing_formats();

/// Returns the writer that a file's name requests. Errors: those of format_number().
[[nodiscard]] Result<drawing::DrawingWriter> find_drawing_writer(const std::string& file);

}  // namespace strake::publish
