// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bcf/topics/topic_plan.hpp"
#include "strake/clash/clash.hpp"
#include "strake/clash/group.hpp"
#include "strake/model/model.hpp"
#include "strake/report/clash.hpp"
#include "strake/report/decisions.hpp"

namespace strake::bcf {

[[nodiscard]] const clash::Pair& pair_of(const report::ClashContents& contents,
                                         const clash::ResultRef& result);
/// Returns the decision about a result; null where there is none.
[[nodiscard]] const report::DecidedResult* decided_of(const report::ClashContents& contents,
                                                      const clash::ResultRef& result);

struct TopicComment {
  std::string guid, date, author, text;
};

/// What a topic says, whatever the version of its file.
struct TopicFacts {
  std::string guid, title, status, priority;
  std::vector<std::string> labels;
  std::string created, author;   ///< when and by whom
  std::string changed, changer;  ///< the last change of its status; empty: none
  std::string assignee;          ///< empty: nobody
  std::string description;
  std::vector<TopicComment> comments;  ///< by date
  std::vector<std::string> files;      ///< the labels of the files of its objects
};

/// Returns a date as the schemas have it, with the time; that of BcfForm::date, or 1970, where a
/// text is none.
[[nodiscard]] std::string date_time(const std::string& date, const report::BcfForm& form);

[[nodiscard]] TopicFacts facts_of(const report::ClashContents& contents, const PlannedTopic& topic);

}  // namespace strake::bcf
