// SPDX-License-Identifier: Apache-2.0
#include "bcf/topics/topic_facts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "bcf/topics/ifc_guid.hpp"
#include "bcf/topics/reference.hpp"
#include "bcf/topics/words.hpp"
#include "bcf/xml/xml_text.hpp"
#include "clash/results/clash_key.hpp"
#include "core/number.hpp"
#include "core/text/counted.hpp"
#include "core/text/dates.hpp"
#include "report/clash/contents.hpp"

namespace strake::bcf {
namespace {

using clash::ResultRef;
using report::DecisionStatus;

constexpr std::size_t kTitleName = 60, kLongName = 200, kMaxListed = 20;
/// What elements inherit from what importers and readers make of the head of a file.
constexpr std::string_view kFileDate = "FileDate", kProjectId = "ProjectId";
constexpr std::string_view kNoDate = "1970-01-01T00:00:00Z";

const clash::Report& test_of(const report::ClashContents& contents, const ResultRef& result) {
  return contents.findings.tests[result.test];
}

std::string key_of(const report::ClashContents& contents, const ResultRef& result) {
  const clash::Pair& pair = pair_of(contents, result);
  return clash::pair_key(test_of(contents, result).name, contents.model, pair.a, pair.b);
}

/// Returns a name that people know an object by.
std::string_view shown_name(const model::Object& object) {
  return object.name.empty() ? std::string_view(object.id) : std::string_view(object.name);
}

/// Returns "HIT, 12.3 mm deep".
std::string measured(const clash::Pair& pair) {
  std::string text(name(pair.cls));
  if (pair.cls == clash::Class::contact) return text;
  text += ", " + fixed(std::abs(pair.d_mm), 1) + (pair.d_mm < 0 ? " mm deep" : " mm apart");
  return text;
}

std::string place(const geometry::Vec3d& mm) {
  constexpr double kMetre = 1000;
  return "x " + fixed(mm.x / kMetre, 3) + " m, y " + fixed(mm.y / kMetre, 3) + " m, z " +
         fixed(mm.z / kMetre, 3) + " m";
}

std::string title_of(const report::ClashContents& contents, const PlannedTopic& topic) {
  const clash::Pair& worst = pair_of(contents, topic.results.front());
  if (topic.group != nullptr)
    return counted(topic.results.size(), "clash, ", "clashes, worst ") + measured(worst) + ": " +
           short_name(topic.group->name, 2 * kTitleName);
  return measured(worst) + ": " +
         short_name(shown_name(contents.model.object(worst.a)), kTitleName) + " / " +
         short_name(shown_name(contents.model.object(worst.b)), kTitleName);
}

void append_object(std::string& text, std::string_view side, const model::Model& model,
                   model::ObjectId id) {
  const model::Object& object = model.object(id);
  text.append(side).append(short_name(shown_name(object), kLongName));
  text += " (" + short_name(model.files[object.file].label, kLongName);
  if (const std::string path = model.path(object); !path.empty())
    text += ", " + short_name(path, kLongName);
  text += ")\n";
}

void append_result(std::string& text, const report::ClashContents& contents,
                   const ResultRef& result) {
  const clash::Pair& pair = pair_of(contents, result);
  text += measured(pair) + ", at " + place(pair.point_mm) + "; ";
  text.append(relation_clause(pair.relation)).append(".\n");
  append_object(text, "A: ", contents.model, pair.a);
  append_object(text, "B: ", contents.model, pair.b);
}

ClashReference reference_of(const report::ClashContents& contents, const PlannedTopic& topic,
                            std::string_view assignee) {
  ClashReference reference;
  if (topic.group != nullptr) reference.group = topic.group->id;
  reference.assignee_mark = assignee_digest(assignee);
  const std::size_t named = std::min(topic.results.size(), kMaxReferred);
  for (std::size_t r = 0; r < named; ++r)
    reference.clashes.push_back({key_of(contents, topic.results[r]),
                                 current_status(decision_about(contents, topic.results[r]))});
  return reference;
}

std::string description_of(const report::ClashContents& contents, const PlannedTopic& topic,
                           const ClashReference& reference) {
  std::string text;
  const std::size_t listed = std::min(topic.results.size(), kMaxListed);
  for (std::size_t r = 0; r < listed; ++r) append_result(text, contents, topic.results[r]);
  if (listed < topic.results.size())
    text += "And " + std::to_string(topic.results.size() - listed) + " more.\n";
  if (kMaxReferred < topic.results.size())
    text +=
        "What is decided here holds for the worst " + std::to_string(kMaxReferred) + " of them.\n";
  if (const std::string& test = test_of(contents, topic.results.front()).name; !test.empty())
    text += "Test: " + short_name(test, kLongName) + "\n";
  return text + "\n" + reference_line(reference);
}

/// Returns class, test and disciplines of all results, each once and in that order.
std::vector<std::string> labels_of(const report::ClashContents& contents,
                                   const PlannedTopic& topic) {
  std::set<std::string> classes, tests, disciplines;
  for (const ResultRef& result : topic.results) {
    const clash::Report& test = test_of(contents, result);
    const clash::Pair& pair = pair_of(contents, result);
    classes.emplace(name(pair.cls));
    if (!test.name.empty()) tests.insert(short_name(test.name, kTitleName));
    if (test.disciplines.empty()) continue;
    for (const model::ObjectId id : {pair.a, pair.b})
      if (const std::uint32_t d = test.discipline[index(id)]; d != clash::kNoLabel)
        disciplines.insert(short_name(test.disciplines[d].name, kTitleName));
  }
  std::vector<std::string> labels;
  for (const std::set<std::string>* const some : {&classes, &tests, &disciplines})
    for (const std::string& label : *some)
      if (std::ranges::find(labels, label) == labels.end()) labels.push_back(label);
  return labels;
}

/// Returns whom all results are assigned to; nobody where they are not all assigned to the same.
std::string assignee_of(const report::ClashContents& contents, const PlannedTopic& topic) {
  std::string common;
  for (std::size_t r = 0; r < topic.results.size(); ++r) {
    const report::DecidedResult* const decided = decision_about(contents, topic.results[r]);
    const std::string assignee =
        decided == nullptr ? std::string() : compared_text(decided->decision->assignee);
    if (r > 0 && assignee != common) return {};
    common = assignee;
  }
  return common;
}

/// Returns what people said of a result.
std::vector<report::DecisionComment> all_comments(const report::Decision& decision) {
  if (!decision.comments.empty()) return decision.comments;
  if (decision.comment.empty()) return {};
  return {{decision.date, decision.by, decision.comment}};
}

/// Returns a comment as a topic has it. One that another program named has that name in the topic
/// that it was said in; no two topics have a comment of one GUID.
TopicComment topic_comment(const report::DecisionComment& stated, const std::string& topic,
                           const report::BcfForm& form) {
  const auto author_of = [&](const std::string& by) {
    const std::string author = compared_text(by);
    return author.empty() ? form.author : author;
  };
  TopicComment comment;
  comment.date = date_time(stated.at, form);
  comment.author = author_of(stated.by);
  comment.text = printable_lines(stated.text);
  if (!stated.first_at.empty()) {
    comment.date = date_time(stated.first_at, form);
    const std::string changer = std::exchange(comment.author, author_of(stated.first_by));
    if (auto changed = stated_time(stated.at)) {
      comment.changed = std::move(*changed);
      comment.changer = changer;
    }
  }
  if (!is_guid(stated.guid))
    comment.guid =
        part_guid(topic, "comment:" + comment.date + "\n" + comment.author + "\n" + comment.text);
  else if (stated.topic == topic)
    comment.guid = stated.guid;
  else
    comment.guid = part_guid(topic, "comment:" + stated.guid);
  return comment;
}

/// Returns the comments about all results; what was said of several at once stands there once, and
/// of what was edited the last form.
std::vector<TopicComment> comments_of(const report::ClashContents& contents,
                                      const PlannedTopic& topic, const std::string& guid) {
  std::map<std::string, TopicComment> by_guid;
  for (const ResultRef& result : topic.results) {
    const report::DecidedResult* const decided = decision_about(contents, result);
    if (decided == nullptr) continue;
    for (const report::DecisionComment& stated : all_comments(*decided->decision)) {
      TopicComment comment = topic_comment(stated, guid, contents.bcf);
      const auto [at, is_new] = by_guid.try_emplace(comment.guid, comment);
      if (!is_new && at->second.changed <= comment.changed) at->second = std::move(comment);
    }
  }
  std::vector<TopicComment> comments;
  for (auto& [of, comment] : by_guid) comments.push_back(std::move(comment));
  std::ranges::sort(comments, {}, [](const TopicComment& c) {
    return std::tie(c.date, c.author, c.text, c.guid);
  });
  return comments;
}

/// Returns what a file says of itself, where its elements inherit that.
std::string stated_of_file(const report::ClashContents& contents, model::ObjectId of_file,
                           std::string_view what) {
  return report::stated_text(contents.model, of_file, what).value_or(std::string());
}

std::vector<TopicFile> files_of(const report::ClashContents& contents, const PlannedTopic& topic) {
  std::map<std::uint32_t, model::ObjectId> some_object;
  for (const ResultRef& result : topic.results)
    for (const model::ObjectId id : {pair_of(contents, result).a, pair_of(contents, result).b})
      some_object.emplace(contents.model.object(id).file, id);
  std::vector<TopicFile> files;
  for (const auto& [number, id] : some_object) {
    TopicFile file{short_name(contents.model.files[number].label, kLongName)};
    file.date = utc_of(stated_of_file(contents, id, kFileDate)).value_or(std::string());
    if (std::string project = stated_of_file(contents, id, kProjectId); is_ifc_guid(project))
      file.project = std::move(project);
    files.push_back(std::move(file));
  }
  return files;
}

/// Returns when a decision was made, as exactly as it is known; empty where that is not known.
const std::string& decision_time(const report::Decision& decision) {
  return decision.at.empty() ? decision.date : decision.at;
}

/// Sets when and by whom a status was decided about last.
void set_change(TopicFacts& facts, const report::ClashContents& contents,
                const PlannedTopic& topic) {
  for (const ResultRef& result : topic.results) {
    const report::DecidedResult* const decided = decision_about(contents, result);
    if (decided == nullptr || decided->decision->by.empty()) continue;
    auto date = stated_time(decision_time(*decided->decision));
    if (!date || *date <= facts.changed) continue;
    facts.changed = std::move(*date);
    facts.changer = compared_text(decided->decision->by);
  }
}

}  // namespace

std::optional<std::string> stated_time(std::string_view date) {
  return is_day(date) ? utc_of(std::string(date) + "T00:00:00") : utc_of(date);
}

std::string date_time(std::string_view date, const report::BcfForm& form) {
  if (auto stated = stated_time(date)) return std::move(*stated);
  return stated_time(form.date).value_or(std::string(kNoDate));
}

std::uint64_t count_strange_dates(const report::ClashContents& contents, const TopicPlan& plan) {
  std::uint64_t count = 0;
  const auto take_latest = [&](std::string_view date) {
    if (!date.empty() && !stated_time(date)) ++count;
  };
  for (const PlannedTopic& topic : plan.topics)
    for (const ResultRef& result : topic.results) {
      const report::DecidedResult* const decided = decision_about(contents, result);
      if (decided == nullptr) continue;
      take_latest(decision_time(*decided->decision));
      for (const report::DecisionComment& stated : decided->decision->comments) {
        take_latest(stated.at);
        take_latest(stated.first_at);
      }
    }
  return count;
}

std::string newest_date(const model::Model& model) {
  std::string newest;
  const auto take_latest = [&](const model::Attributes& stated) {
    for (const auto& [name, value] : stated)
      if (name == kFileDate) newest = std::max(newest, utc_of(value).value_or(std::string()));
  };
  for (const model::Attributes& stated : model.group_attributes) take_latest(stated);
  for (const model::Object& object : model.objects) take_latest(object.attributes);
  return newest;
}

TopicFacts facts_of(const report::ClashContents& contents, const PlannedTopic& topic) {
  TopicFacts facts;
  facts.assignee = assignee_of(contents, topic);
  const ClashReference reference = reference_of(contents, topic, facts.assignee);
  facts.guid = guid_of(reference);
  facts.title = title_of(contents, topic);
  facts.status = topic_status(reference.status());
  facts.priority = priority(pair_of(contents, topic.results.front()).cls);
  facts.labels = labels_of(contents, topic);
  facts.created = date_time({}, contents.bcf);
  facts.author = contents.bcf.author;
  set_change(facts, contents, topic);
  facts.description = description_of(contents, topic, reference);
  facts.comments = comments_of(contents, topic, facts.guid);
  facts.files = files_of(contents, topic);
  return facts;
}

}  // namespace strake::bcf
