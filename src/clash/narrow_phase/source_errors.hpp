// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0043 says why the bracket counts what the grid and the source leave open.

#include "clash/broad_phase/broad_phase.hpp"

namespace strake::clash {

/// Sets for every part how far it may lie from what its source states: what the snap moved its
/// place and the vertices of a mesh (those of a primitive count in its sag), and the step of its
/// numbers where that is coarse. The values are few, so that equal pairs stay equal. Errors:
/// cancelled.
[[nodiscard]] Status set_source_errors(const model::Scene& scene, const Options& options,
                                       ScenePartList& list, const parallel::Context& context);

}  // namespace strake::clash
