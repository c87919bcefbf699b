// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bcf/topics/topic_plan.hpp"
#include "strake/clash/clash.hpp"
#include "strake/clash/group.hpp"
#include "strake/model/model.hpp"
#include "strake/report/clash.hpp"
#include "strake/report/decisions.hpp"

namespace strake::bcf {

struct TopicComment {
  std::string guid, date, author, text;
  std::string changed = {}, changer = {};  ///< when it was edited and by whom; empty: it was not
};

/// A file that objects of a topic come from.
struct TopicFile {
  std::string name;          ///< as results call it
  std::string date = {};     ///< when it was written; empty: it does not say
  std::string project = {};  ///< the GlobalId of its IfcProject; empty: it is no IFC
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
  std::vector<TopicFile> files;        ///< those of its objects
};

/// Returns a date, a day or a time with any zone, as the schemas have it: in UTC to the second;
/// nothing where a text is none, as 2026-02-30 (decision 0112).
[[nodiscard]] std::optional<std::string> stated_time(std::string_view date);

/// The same, where a text that is none stands for BcfForm::date, or for 1970.
[[nodiscard]] std::string date_time(std::string_view date, const report::BcfForm& form);

/// Returns how many dates of decisions about topics are none. They are not written.
[[nodiscard]] std::uint64_t count_strange_dates(const report::ClashContents& contents,
                                                const TopicPlan& plan);

/// Returns when the newest file of a model says that it was written; empty where none says so.
[[nodiscard]] std::string newest_date(const model::Model& model);

[[nodiscard]] TopicFacts facts_of(const report::ClashContents& contents, const PlannedTopic& topic);

}  // namespace strake::bcf
