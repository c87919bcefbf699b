// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bcf/topics/topic_plan.hpp"
#include "pictures/viewpoint.hpp"
#include "strake/report/clash.hpp"

namespace strake::bcf {

/// The most objects that a viewpoint selects and colours: programs stall on more.
inline constexpr std::size_t kMaxComponents = 1000;

/// Returns the viewpoint of a topic: a camera in perspective, the objects of the two sides selected
/// and coloured, and what must be cut away for them to be seen. Lengths are in metres.
[[nodiscard]] std::string viewpoint_file(const report::ClashContents& contents,
                                         const PlannedTopic& topic, const std::string& guid,
                                         const pictures::ClashViewpoint& viewpoint);

}  // namespace strake::bcf
