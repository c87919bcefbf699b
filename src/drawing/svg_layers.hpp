// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "drawing/buffered.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/model/model.hpp"

namespace strake::drawing {

/// The lines of a view: a group per layer, of class "visible sharp" and the like, in it one per
/// object with one path. `prefix` stands before the ids of the layers.
void write_layers(Buffered& out, const PaperCurves& curves, const Ink& ink,
                  const model::Model& model, std::string_view prefix);

}  // namespace strake::drawing
