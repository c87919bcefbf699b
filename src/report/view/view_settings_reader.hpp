// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "strake/drawing/drawing.hpp"

namespace strake::report {

/// Puts the view and the settings of a document, which are text by name ("view.direction"), into a
/// drawing. Throws DocumentFault for what is missing or makes no sense, JsonReader::Fault.
void read_view_settings(const std::map<std::string, std::string>& settings,
                        drawing::NeutralDrawing& drawing);

}  // namespace strake::report
