// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "drawing/lettering/lettering.hpp"
#include "drawing/pdf/pdf_file.hpp"

namespace strake::drawing {

/// Writes the font of the texts that a letterer has set, as the object of that number: glyphs by
/// their own numbers, two bytes each, of them only those that are used, and which characters they
/// stand for.
void write_pdf_font(PdfFile& file, std::uint32_t number, const Letterer& letterer);

}  // namespace strake::drawing
