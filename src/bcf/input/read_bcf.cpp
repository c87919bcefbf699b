// SPDX-License-Identifier: Apache-2.0
#include "bcf/input/read_bcf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

#include "bcf/input/xml_tree.hpp"
#include "bcf/input/zip_reader.hpp"
#include "core/text_encoding.hpp"

namespace strake::bcf {
namespace {

constexpr std::size_t kMostOfFile = std::size_t{16} << 20U, kMostOfAll = std::size_t{512} << 20U;
constexpr std::string_view kMarkup = "/markup.bcf";

/// Reads a number of so many digits at a place of a text.
std::optional<int> digits_at(std::string_view text, std::size_t at, std::size_t count) {
  if (at + count > text.size()) return std::nullopt;
  int value = 0;
  for (const char c : text.substr(at, count)) {
    if (c < '0' || c > '9') return std::nullopt;
    value = 10 * value + (c - '0');
  }
  return value;
}

/// Reads what stands behind the seconds: a fraction, which is dropped, and a zone, in minutes.
std::optional<int> zone_minutes(std::string_view rest) {
  if (rest.starts_with('.')) {
    rest.remove_prefix(1);
    rest.remove_prefix(std::min(rest.find_first_not_of("0123456789"), rest.size()));
  }
  if (rest.empty() || rest == "Z") return 0;
  constexpr std::size_t kLength = 6;  // +01:00
  if (rest.size() != kLength || (rest[0] != '+' && rest[0] != '-') || rest[3] != ':')
    return std::nullopt;
  const std::optional<int> hours = digits_at(rest, 1, 2), minutes = digits_at(rest, 4, 2);
  if (!hours || !minutes) return std::nullopt;
  const int total = 60 * *hours + *minutes;
  constexpr int kFarthest = 14 * 60;
  if (*minutes > 59 || total > kFarthest) return std::nullopt;
  return rest[0] == '-' ? -total : total;
}

ReadComment read_comment(const pugi::xml_node& node) {
  ReadComment comment{utc_of(child_text(node, "Date")).value_or(std::string()),
                      child_text(node, "Author"), child_text(node, "Comment")};
  // An edited comment is what was said last, by whom and when.
  if (const auto changed = utc_of(child_text(node, "ModifiedDate"))) comment.date = *changed;
  if (std::string changer = child_text(node, "ModifiedAuthor"); !changer.empty())
    comment.author = std::move(changer);
  return comment;
}

/// Takes the comments below a node; those that say nothing are about a viewpoint alone.
void take_comments(std::vector<ReadComment>& comments, const pugi::xml_node& parent) {
  for (const pugi::xml_node& node : parent.children()) {
    if (!is_called(node, "Comment")) continue;
    ReadComment comment = read_comment(node);
    if (!trimmed(comment.text, " \t\r\n").empty()) comments.push_back(std::move(comment));
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
Result<ReadTopic> topic_of(const pugi::xml_document& document, const std::string& where) {
  const pugi::xml_node markup = child(document, "Markup");
  const pugi::xml_node node = child(markup, "Topic");
  ReadTopic topic;
  topic.guid = lowered(attribute_text(node, "Guid"));
  if (topic.guid.empty())
    return Error{ErrorCode::input, "there is no topic with a GUID", where, {}};
  topic.title = child_text(node, "Title");
  topic.status = attribute_text(node, "TopicStatus");
  topic.assignee = child_text(node, "AssignedTo");
  topic.changed = utc_of(child_text(node, "ModifiedDate")).value_or(std::string());
  topic.changer = child_text(node, "ModifiedAuthor");
  take_comments(topic.comments, markup);
  take_comments(topic.comments, child(node, "Comments"));
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
    const Result<std::string> text = zip_.read(*entry, kMostOfFile);
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
    const Result<std::string> text = zip_.read(entry, kMostOfFile);
    if (zip_.unpacked() > kMostOfAll)
      return Error{ErrorCode::input, "its topics unpack to more than 512 MiB", name_,
                   "split it into several"};
    if (!text) return leave_out(text.error());
    pugi::xml_document document;
    if (const Status status = read_xml(document, *text, where); !status)
      return leave_out(status.error());
    Result<ReadTopic> topic = topic_of(document, where);
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

std::optional<std::string> utc_of(std::string_view date) {
  namespace chrono = std::chrono;
  date = trimmed(date, " \t\r\n");
  constexpr std::string_view kForm = "0000-00-00T00:00:00";
  if (date.size() < kForm.size()) return std::nullopt;
  for (std::size_t i = 0; i < kForm.size(); ++i)
    if (kForm[i] != '0' && date[i] != kForm[i]) return std::nullopt;
  std::array<int, 6> parts{};
  constexpr std::array<std::size_t, 6> kPlaces{0, 5, 8, 11, 14, 17};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::optional<int> part = digits_at(date, kPlaces[i], i == 0 ? 4 : 2);
    if (!part) return std::nullopt;
    parts[i] = *part;
  }
  const std::optional<int> zone = zone_minutes(date.substr(kForm.size()));
  const chrono::year_month_day day{chrono::year(parts[0]),
                                   chrono::month(static_cast<unsigned>(parts[1])),
                                   chrono::day(static_cast<unsigned>(parts[2]))};
  // Seconds that are put in before midnight count as those after it; 24:00 is the next day.
  if (!zone || !day.ok() || parts[3] > 24 || parts[4] > 59 || parts[5] > 60) return std::nullopt;
  if (parts[3] == 24 && parts[4] + parts[5] > 0) return std::nullopt;
  const chrono::sys_seconds at = chrono::sys_days(day) + chrono::hours(parts[3]) +
                                 chrono::minutes(parts[4]) + chrono::seconds(parts[5]) -
                                 chrono::minutes(*zone);
  const chrono::sys_days midnight = chrono::floor<chrono::days>(at);
  const chrono::year_month_day utc(midnight);
  // The schemas know no year 0.
  if (utc.year() < chrono::year(1) || utc.year() > chrono::year(9999)) return std::nullopt;
  const chrono::hh_mm_ss time(at - midnight);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", static_cast<int>(utc.year()),
                     static_cast<unsigned>(utc.month()), static_cast<unsigned>(utc.day()),
                     time.hours().count(), time.minutes().count(), time.seconds().count());
}

}  // namespace strake::bcf
