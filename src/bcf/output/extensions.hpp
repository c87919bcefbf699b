// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bcf/topics/topic_plan.hpp"
#include "strake/report/clash.hpp"

namespace strake::bcf {

/// Returns the file bcf.version.
[[nodiscard]] std::string version_file(bool version_3);

/// Returns the file extensions.xml of version 3.0: the words and names that topics use.
[[nodiscard]] std::string extensions_file(const report::ClashContents& contents,
                                          const TopicPlan& plan);

}  // namespace strake::bcf
