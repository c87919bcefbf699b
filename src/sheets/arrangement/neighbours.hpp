// SPDX-License-Identifier: Apache-2.0
// Views that go on where others end: whose limits share a side.
#pragma once

#include <span>

#include "sheets/spec/sheet_spec.hpp"

namespace strake::sheets {

/// Finds, for each view of the sheets that is to have match lines, where its limits end at a plane
/// at which those of another view begin that looks in the same direction: one neighbour for each
/// part of a side, of its own sheet before those of others. Sides that the view does not see
/// edge-on have none.
void find_neighbours(std::span<SheetSpec> sheets);

}  // namespace strake::sheets
