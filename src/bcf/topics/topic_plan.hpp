// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "strake/clash/group.hpp"
#include "strake/report/clash.hpp"

namespace strake::bcf {

/// What a topic is about.
struct PlannedTopic {
  const clash::Group* group = nullptr;    ///< null: one result
  std::vector<clash::ResultRef> results;  ///< the worst first; never empty
};

/// What no topic is about.
struct LeftOutCounts {
  std::uint64_t groups = 0;    ///< beyond the most topics
  std::uint64_t results = 0;   ///< beyond the most topics, where there are no groups
  std::uint64_t contacts = 0;  ///< not requested
};

struct TopicPlan {
  std::vector<PlannedTopic> topics;  ///< in their order
  LeftOutCounts left_out;
};

/// Chooses topics: the groups in their order; without groups the results that no rule allows, those
/// that nobody needs to look at behind all others, then by class, by d and in their durable order.
/// A contact that somebody decided about is requested by that.
[[nodiscard]] TopicPlan plan_topics(const report::ClashContents& contents);

}  // namespace strake::bcf
