// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

/// Names of the steps of a drawing.
namespace strake::hlr {

/// Stages of a drawing in a parallel::RunReport. The preparation makes meshes and contours for the
/// view, intersections and sections. The local step is what each object does to itself: its
/// silhouettes, and what its own faces hide of its edges. The global step is what the others do. An
/// edge goes through both at once; of its time each step has the share that samples show.
inline constexpr std::string_view kPreparationStep = "view preparation";
inline constexpr std::string_view kLocalStep = "local hidden lines";
inline constexpr std::string_view kGlobalStep = "global hidden lines";

}  // namespace strake::hlr
