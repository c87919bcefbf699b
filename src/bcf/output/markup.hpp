// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bcf/topics/topic_facts.hpp"

namespace strake::bcf {

inline constexpr const char* kViewpointFile = "viewpoint.bcfv";
inline constexpr const char* kSnapshotFile = "snapshot.png";

/// What of a topic its markup points at.
struct MarkupForm {
  bool version_3 = false;
  std::string viewpoint_guid = {};  ///< empty: there is no viewpoint
};

/// Returns the file markup.bcf of a topic.
[[nodiscard]] std::string markup_file(const TopicFacts& facts, const MarkupForm& form);

}  // namespace strake::bcf
