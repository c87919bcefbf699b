// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <istream>
#include <string>

#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/model/model.hpp"

/// Reads a drawing back from its neutral form, to be written again without the model it is of.
namespace strake::report {

/// A drawing, and as much of its model as writers request: objects with id, name and file.
struct ViewDrawing {
  drawing::NeutralDrawing drawing;
  model::Model model;
};

/// Whether a file begins as the neutral form of a drawing does: the program takes it where it takes
/// model files. Anything but a plain file does not.
[[nodiscard]] bool is_view_document(const std::filesystem::path& file);

/// Reads a drawing with all that drawing::write_svg(), write_view_json() and write_view_rows()
/// need: each writes the bytes that it wrote when the drawing was made, but for the version of the
/// program. Errors: those of read_view_document(), and input where it says less of itself than
/// that.
[[nodiscard]] Result<ViewDrawing> read_view_drawing(const std::filesystem::path& file);

/// The same from a stream; `name` is what errors call it.
[[nodiscard]] Result<ViewDrawing> parse_view_drawing(std::istream& in, const std::string& name);

}  // namespace strake::report
