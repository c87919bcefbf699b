// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "clash/parts.hpp"

namespace strake::clash {

/// Notes of every part how far it may lie from what its source states: what the snap moved its
/// place and the vertices of a mesh (those of a primitive count in its sag), and the step of its
/// numbers where that is coarse. Few different values, so that equal pairs stay equal. Errors:
/// cancelled.
[[nodiscard]] Status note_source_errors(const model::Scene& scene, const Options& options,
                                        PartList& list, const parallel::Context& context);

}  // namespace strake::clash
