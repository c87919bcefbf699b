// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "hlr/shape_view.hpp"
#include "strake/core/result.hpp"

namespace strake::hlr {

/// Gives a part of many polygons buckets or a tree over them, as the sight asks. `edges` are the
/// part's own: what the number of buckets is chosen by. Errors: cancelled.
[[nodiscard]] Status index(std::span<const Polygon> polygons, std::span<const EdgeView> edges,
                           bool convex, const Sight& sight, PartView& part);

}  // namespace strake::hlr
