// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "drawing/dxf/document.hpp"

namespace strake::drawing::dxf {

/// Appends the tables of a file: what viewports, types of lines, layers, styles and blocks there
/// are. Layers with the same dashes share a type of line.
void append_tables(std::string& out, const DxfDocument& document);

}  // namespace strake::drawing::dxf
