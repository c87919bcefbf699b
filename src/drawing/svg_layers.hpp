// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "drawing/chains.hpp"
#include "drawing/chunked.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/model/model.hpp"

namespace strake::drawing {

/// Appends the commands of a path: "M0 0L1 0 1 1Z".
void append_svg_chain(std::string& out, const Chain& chain);

/// The lines of a view: a group per layer, of class "visible sharp" and the like, in it one per
/// object with one path. `prefix` stands before the ids of the layers.
void write_layers(Chunked& out, const Ink& ink, const model::Model& model, std::string_view prefix);

}  // namespace strake::drawing
