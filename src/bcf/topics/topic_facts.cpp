// SPDX-License-Identifier: Apache-2.0
#include "bcf/topics/topic_facts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "bcf/topics/reference.hpp"
#include "bcf/topics/words.hpp"
#include "bcf/xml/xml_text.hpp"
#include "clash/results/clash_key.hpp"
#include "core/number.hpp"

namespace strake::bcf {
namespace {

using clash::ResultRef;
using report::DecisionStatus;

constexpr std::size_t kTitleName = 60, kLongName = 200, kMostListed = 20;
constexpr std::string_view kNoDate = "1970-01-01T00:00:00Z";

const clash::Report& test_of(const report::ClashContents& contents, const ResultRef& result) {
  return contents.findings.tests[result.test];
}

/// Returns the status of a result as it is now: what a file of decisions says of one that came back
/// no longer holds, and a project says what holds in its place.
DecisionStatus status_of(const report::ClashContents& contents, const ResultRef& result) {
  const report::DecidedResult* const decided = decided_of(contents, result);
  if (decided == nullptr) return DecisionStatus::undecided;
  const DecisionStatus said = decided->decision->status;
  if (decided->reopened == report::Reopened::no || said < DecisionStatus::approved) return said;
  return decided->reopened == report::Reopened::found_again ? DecisionStatus::undecided
                                                            : DecisionStatus::active;
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
    return std::to_string(topic.results.size()) +
           (topic.results.size() == 1 ? " clash, " : " clashes, worst ") + measured(worst) + ": " +
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

Reference reference_of(const report::ClashContents& contents, const PlannedTopic& topic,
                       std::string_view assignee) {
  Reference reference;
  if (topic.group != nullptr) reference.group = topic.group->id;
  reference.assignee_mark = mark_of(assignee);
  const std::size_t named = std::min(topic.results.size(), kMostReferred);
  for (std::size_t r = 0; r < named; ++r)
    reference.clashes.push_back(
        {key_of(contents, topic.results[r]), status_of(contents, topic.results[r])});
  return reference;
}

std::string description_of(const report::ClashContents& contents, const PlannedTopic& topic,
                           const Reference& reference) {
  std::string text;
  const std::size_t listed = std::min(topic.results.size(), kMostListed);
  for (std::size_t r = 0; r < listed; ++r) append_result(text, contents, topic.results[r]);
  if (listed < topic.results.size())
    text += "And " + std::to_string(topic.results.size() - listed) + " more.\n";
  if (kMostReferred < topic.results.size())
    text +=
        "What is decided here holds for the worst " + std::to_string(kMostReferred) + " of them.\n";
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
    const report::DecidedResult* const decided = decided_of(contents, topic.results[r]);
    const std::string assignee =
        decided == nullptr ? std::string() : compared_text(decided->decision->assignee);
    if (r > 0 && assignee != common) return {};
    common = assignee;
  }
  return common;
}

/// Returns what people said of a result.
std::vector<report::DecisionComment> said_of(const report::Decision& decision) {
  if (!decision.comments.empty()) return decision.comments;
  if (decision.comment.empty()) return {};
  return {{decision.date, decision.by, decision.comment}};
}

/// Returns the comments about all results; what was said of several at once stands there once.
std::vector<TopicComment> comments_of(const report::ClashContents& contents,
                                      const PlannedTopic& topic, const std::string& guid) {
  std::set<std::tuple<std::string, std::string, std::string>> said;
  for (const ResultRef& result : topic.results) {
    const report::DecidedResult* const decided = decided_of(contents, result);
    if (decided == nullptr) continue;
    for (const report::DecisionComment& comment : said_of(*decided->decision)) {
      std::string by = compared_text(comment.by);
      if (by.empty()) by = contents.bcf.author;
      said.emplace(date_time(comment.at, contents.bcf), std::move(by),
                   printable_lines(comment.text));
    }
  }
  std::vector<TopicComment> comments;
  for (const auto& [date, author, text] : said)
    comments.push_back(
        {part_guid(guid, "comment:" + date + "\n" + author + "\n" + text), date, author, text});
  return comments;
}

std::vector<std::string> files_of(const report::ClashContents& contents,
                                  const PlannedTopic& topic) {
  std::set<std::uint32_t> numbers;
  for (const ResultRef& result : topic.results)
    for (const model::ObjectId id : {pair_of(contents, result).a, pair_of(contents, result).b})
      numbers.insert(contents.model.object(id).file);
  std::vector<std::string> files;
  for (const std::uint32_t file : numbers)
    files.push_back(short_name(contents.model.files[file].label, kLongName));
  return files;
}

/// Sets when and by whom a status was decided about last.
void set_change(TopicFacts& facts, const report::ClashContents& contents,
                const PlannedTopic& topic) {
  for (const ResultRef& result : topic.results) {
    const report::DecidedResult* const decided = decided_of(contents, result);
    if (decided == nullptr || decided->decision->by.empty() || decided->decision->date.empty())
      continue;
    const std::string date = date_time(decided->decision->date, contents.bcf);
    if (date <= facts.changed) continue;
    facts.changed = date;
    facts.changer = compared_text(decided->decision->by);
  }
}

/// Whether a text is as 2026-01-31.
bool is_day(std::string_view text) {
  constexpr std::string_view kForm = "0000-00-00";
  if (text.size() != kForm.size()) return false;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (kForm[i] == '-' ? text[i] != '-' : text[i] < '0' || text[i] > '9') return false;
  return true;
}

}  // namespace

const clash::Pair& pair_of(const report::ClashContents& contents, const ResultRef& result) {
  return contents.findings.tests[result.test].pairs[result.pair];
}

const report::DecidedResult* decided_of(const report::ClashContents& contents,
                                        const ResultRef& result) {
  if (contents.decided == nullptr) return nullptr;
  return contents.decided->of(result.test, pair_of(contents, result));
}

std::string date_time(const std::string& date, const report::BcfForm& form) {
  constexpr std::size_t kDay = 10;
  if (is_day(date)) return date + "T00:00:00Z";
  if (is_day(std::string_view(date).substr(0, kDay)) && date.size() > kDay) return date;
  return form.date.empty() ? std::string(kNoDate) : form.date;
}

TopicFacts facts_of(const report::ClashContents& contents, const PlannedTopic& topic) {
  TopicFacts facts;
  facts.assignee = assignee_of(contents, topic);
  const Reference reference = reference_of(contents, topic, facts.assignee);
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
