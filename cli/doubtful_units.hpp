// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/model/scene.hpp"

namespace strake::cli {

/// Warns of two files that may be of different units: that of one at least is only assumed, and the
/// extents of the one are those of the other times what one unit of length is in another.
void note_doubtful_units(model::Scene& scene);

}  // namespace strake::cli
