// SPDX-License-Identifier: Apache-2.0
#include "bcf/input/read_bcf.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "bcf/input/xml_tree.hpp"
#include "bcf/input/zip_reader.hpp"
#include "core/text/dates.hpp"
#include "core/text_encoding.hpp"

namespace strake::bcf {
namespace {

constexpr std::size_t kMaxOfFile = std::size_t{16} << 20U, kMaxOfAll = std::size_t{512} << 20U;
constexpr std::string_view kMarkup = "/markup.bcf", kXmlBlanks = " \t\r\n";

/// Reads dates of a topic, and tells of those that are none.
class DateReader {
 public:
  DateReader(Diagnostics& diagnostics, const std::string& where)
      : diagnostics_(diagnostics), where_(where) {}

  /// Returns a date in UTC; nothing where there is none.
  std::optional<std::string> read(const pugi::xml_node& node, const char* name) {
    constexpr std::size_t kLongDate = 40;
    const std::string text = child_text(node, name);
    std::optional<std::string> date = utc_of(text);
    if (!date && !trimmed(text, kXmlBlanks).empty())
      diagnostics_.add(Severity::warning, "bcf-date-invalid",
                       "the " + std::string(name) + " " +
                           in_quotes(printable(std::string_view(text).substr(0, kLongDate))) +
                           " is no date as 2026-01-31T12:00:00+01:00, and is not taken",
                       where_);
    return date;
  }

 private:
  Diagnostics& diagnostics_;
  const std::string& where_;
};

ReadComment read_comment(const pugi::xml_node& node, DateReader& dates) {
  ReadComment comment{dates.read(node, "Date").value_or(std::string()), child_text(node, "Author"),
                      child_text(node, "Comment")};
  if (std::string guid = lowered(attribute_text(node, "Guid")); is_guid(guid))
    comment.guid = std::move(guid);
  // An edited comment is what was said last, by whom and when.
  const std::optional<std::string> changed = dates.read(node, "ModifiedDate");
  if (!changed) return comment;
  comment.first_date = std::exchange(comment.date, *changed);
  comment.first_author = comment.author;
  if (std::string changer = child_text(node, "ModifiedAuthor"); !changer.empty())
    comment.author = std::move(changer);
  return comment;
}

/// Takes the comments below a node; those that say nothing are about a viewpoint alone.
void take_comments(std::vector<ReadComment>& comments, const pugi::xml_node& parent,
                   DateReader& dates) {
  for (const pugi::xml_node& node : parent.children()) {
    if (!is_called(node, "Comment")) continue;
    ReadComment comment = read_comment(node, dates);
    if (!trimmed(comment.text, kXmlBlanks).empty()) comments.push_back(std::move(comment));
  }
}

/// Those of one date stay in the order of the file.
void sort_by_date(std::vector<ReadComment>& comments) {
  std::vector<std::pair<ReadComment, std::size_t>> placed;
  placed.reserve(comments.size());
  for (ReadComment& comment : comments) placed.emplace_back(std::move(comment), placed.size());
  std::sort(placed.begin(), placed.end(), [](const auto& a, const auto& b) {
    return std::tie(a.first.date, a.second) < std::tie(b.first.date, b.second);
  });
  for (std::size_t i = 0; i < placed.size(); ++i) comments[i] = std::move(placed[i].first);
}

/// Errors: input where there is no topic.
Result<ReadTopic> topic_of(const pugi::xml_document& document, const std::string& where,
                           Diagnostics& diagnostics) {
  const pugi::xml_node markup = child(document, "Markup");
  const pugi::xml_node node = child(markup, "Topic");
  ReadTopic topic;
  topic.guid = lowered(attribute_text(node, "Guid"));
  if (topic.guid.empty())
    return Error{ErrorCode::input, "there is no topic with a GUID", where, {}};
  topic.title = child_text(node, "Title");
  topic.status = attribute_text(node, "TopicStatus");
  topic.assignee = child_text(node, "AssignedTo");
  DateReader dates(diagnostics, where);
  topic.changed = dates.read(node, "ModifiedDate").value_or(std::string());
  topic.changer = child_text(node, "ModifiedAuthor");
  take_comments(topic.comments, markup, dates);
  take_comments(topic.comments, child(node, "Comments"), dates);
  sort_by_date(topic.comments);
  topic.reference = find_reference(child_text(node, "Description"));
  // A topic that quotes another one's description is about something else.
  if (topic.reference && guid_of(*topic.reference) != topic.guid) topic.reference.reset();
  return topic;
}

class BcfReader {
 public:
  BcfReader(ZipReader zip, std::string name) : zip_(std::move(zip)), name_(std::move(name)) {}

  Result<ReadFile> read(const parallel::Context& context) {
    if (const Status status = read_version(); !status) return status.error();
    for (const ZipReader::Entry& entry : zip_.entries()) {
      if (!entry.name.ends_with(kMarkup)) continue;
      if (context.stop.stop_requested()) return Error{ErrorCode::cancelled, "cancelled", {}, {}};
      if (const Status status = take(entry); !status) return status.error();
    }
    std::ranges::sort(file_.topics, {}, &ReadTopic::guid);
    const auto twice = std::ranges::adjacent_find(file_.topics, {}, &ReadTopic::guid);
    if (twice != file_.topics.end())
      return Error{ErrorCode::input, "two topics have the GUID " + in_quotes(twice->guid), name_,
                   "have it written again"};
    return std::move(file_);
  }

 private:
  Status read_version() {
    const auto entry = std::ranges::find(zip_.entries(), "bcf.version", &ZipReader::Entry::name);
    if (entry == zip_.entries().end())
      return Error{ErrorCode::input, "there is no bcf.version in it", name_,
                   "a BCF file is a zip archive with this file"};
    const Result<std::string> text = zip_.read(*entry, kMaxOfFile);
    if (!text) return text.error();
    pugi::xml_document document;
    if (const Status status = read_xml(document, *text, name_ + ", bcf.version"); !status)
      return status;
    file_.version = attribute_text(child(document, "Version"), "VersionId");
    if (file_.version == "2.1" || file_.version == "3.0") return {};
    return Error{ErrorCode::input,
                 "BCF of the version " + in_quotes(file_.version) + " is not read", name_,
                 "have it written as BCF 2.1 or 3.0"};
  }

  /// Takes a topic; one that is damaged is told about, and keeps no other from being read.
  Status take(const ZipReader::Entry& entry) {
    const std::string where = name_ + ", " + printable(entry.name);
    const Result<std::string> text = zip_.read(entry, kMaxOfFile);
    if (zip_.unpacked() > kMaxOfAll)
      return Error{ErrorCode::input, "its topics unpack to more than 512 MiB", name_,
                   "split it into several"};
    if (!text) return leave_out(text.error());
    pugi::xml_document document;
    if (const Status status = read_xml(document, *text, where); !status)
      return leave_out(status.error());
    Result<ReadTopic> topic = topic_of(document, where, file_.diagnostics);
    if (!topic) return leave_out(topic.error());
    file_.topics.push_back(std::move(*topic));
    return {};
  }

  Status leave_out(const Error& error) {
    if (error.code != ErrorCode::input) return error;
    file_.diagnostics.add(Severity::warning, "bcf-topic-damaged", error.message, error.where);
    return {};
  }

  ZipReader zip_;
  std::string name_;
  ReadFile file_;
};

}  // namespace

Result<ReadFile> read_bcf(const std::filesystem::path& file, const parallel::Context& context) {
  Result<ZipReader> zip = ZipReader::open(file);
  if (!zip) return zip.error();
  return BcfReader(std::move(*zip), file.string()).read(context);
}

}  // namespace strake::bcf
