// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/clash/clash.hpp"
#include "strake/geometry/depth.hpp"

namespace strake::clash {

/// The relation of two parts whose interiors meet; `band` is δ in grid units.
[[nodiscard]] Relation relation_of(const geometry::TreedPart& a, const geometry::TreedPart& b,
                                   const geometry::MeetingResult& meeting,
                                   const geometry::Depth& depth, double band,
                                   geometry::PairWork& work);

}  // namespace strake::clash
