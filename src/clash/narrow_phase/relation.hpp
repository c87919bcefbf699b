// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/clash/clash.hpp"
#include "strake/geometry/depth.hpp"

namespace strake::clash {

/// Returns the relation of two parts whose interiors meet; `band` is δ in grid units. Solids have
/// planes.
[[nodiscard]] Relation relation_of(const geometry::DepthOperand& deep_a,
                                   const geometry::DepthOperand& deep_b,
                                   const geometry::MeetingResult& meeting,
                                   const geometry::Depth& depth, double band,
                                   geometry::QueryContext& work);

/// Returns the relation of two parts that are within the band of each other and whose interiors do
/// not meet. `meeting` says what is known of how they touch.
[[nodiscard]] Relation relation_of_contact(const geometry::PartWithBvh& a,
                                           const geometry::PartWithBvh& b,
                                           const geometry::MeetingResult& meeting, double band,
                                           geometry::QueryContext& work);

/// Whether two parts are sheets whose boxes agree within the band, so that they may be the same
/// sheet.
[[nodiscard]] bool may_be_one_sheet(const geometry::PartWithBvh& a, const geometry::PartWithBvh& b,
                                    double band);

}  // namespace strake::clash
