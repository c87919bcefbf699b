// SPDX-License-Identifier: Apache-2.0
#include "bcf/output/extensions.hpp"

#include <set>
#include <string_view>

#include "bcf/topics/topic_facts.hpp"
#include "bcf/topics/words.hpp"
#include "bcf/xml/xml_text.hpp"

namespace strake::bcf {
namespace {

template <class Words>
void list(XmlWriter& xml, std::string_view list_name, std::string_view word_name,
          const Words& words) {
  xml.begin(list_name);
  for (const std::string_view word : words) xml.leaf_if(word_name, word);
  xml.end();
}

}  // namespace

std::string version_file(bool version_3) {
  XmlWriter xml("Version");
  xml.attribute("VersionId", version_3 ? "3.0" : "2.1");
  if (!version_3) xml.leaf("DetailedVersion", "2.1");
  return xml.finish();
}

std::string extensions_file(const report::ClashContents& contents, const TopicPlan& plan) {
  std::set<std::string> labels, users;
  for (const PlannedTopic& topic : plan.topics) {
    const TopicFacts facts = facts_of(contents, topic);
    labels.insert(facts.labels.begin(), facts.labels.end());
    users.insert(facts.author);
    users.insert(facts.changer);
    users.insert(facts.assignee);
    for (const TopicComment& comment : facts.comments) {
      users.insert(comment.author);
      users.insert(comment.changer);
    }
  }
  std::vector<std::string_view> statuses;
  for (const report::DecisionStatus status : report::kDecisionStatuses)
    statuses.push_back(topic_status(status));
  XmlWriter xml("Extensions");
  list(xml, "TopicTypes", "TopicType", std::vector<std::string_view>{kTopicType});
  list(xml, "TopicStatuses", "TopicStatus", statuses);
  std::vector<std::string_view> priorities;
  for (const clash::Class cls :
       {clash::Class::hit, clash::Class::clearance_violation, clash::Class::contact})
    priorities.push_back(priority(cls));
  list(xml, "Priorities", "Priority", priorities);
  list(xml, "TopicLabels", "TopicLabel", labels);
  list(xml, "Users", "User", users);
  return xml.finish();
}

}  // namespace strake::bcf
