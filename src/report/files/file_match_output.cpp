// SPDX-License-Identifier: Apache-2.0
#include "report/files/file_match_output.hpp"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "core/text_encoding.hpp"
#include "report/json/json_writer.hpp"
#include "report/text/formatting.hpp"

namespace strake::report {
namespace {

/// The most files that a line names.
constexpr std::size_t kMaxNamed = 8;

std::string_view relation_name(FileRelation relation) {
  switch (relation) {
    case FileRelation::same_label:
      return "same label";
    case FileRelation::requested:
      return "asked";
    case FileRelation::renamed:
      return "renamed";
    case FileRelation::split:
      return "split";
    case FileRelation::merged:
      return "merged";
  }
  return "";
}

std::vector<FileMatch> those_of(const FileMatches& files,
                                std::initializer_list<FileRelation> relations) {
  std::vector<FileMatch> some;
  std::ranges::copy_if(files.matches, std::back_inserter(some), [&](const FileMatch& m) {
    return std::ranges::find(relations, m.relation) != relations.end();
  });
  return some;
}

/// Returns a whole number with a comma before each thousand.
std::string grouped(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, ",");
  return text;
}

std::string described(const FileMatch& m) {
  if (m.of == 0) return printable(m.before) + " -> " + printable(m.after);
  std::string text = printable(m.before) + " -> " + printable(m.after) + " (" +
                     (m.relation == FileRelation::requested ? "as asked for, " : "") +
                     grouped(m.common) + " of " + grouped(m.of) +
                     (m.by_places ? " places" : " ids");
  const bool part = m.relation == FileRelation::split || m.relation == FileRelation::merged;
  if (part)
    text += std::string(" of ") + (m.relation == FileRelation::split ? "the new" : "the old");
  return text + (part ? " file)" : " in common)");
}

template <class Item, class Describe>
std::string joined(const std::vector<Item>& items, std::string_view between, Describe&& describe) {
  std::string text;
  for (std::size_t i = 0; i < std::min(items.size(), kMaxNamed); ++i)
    text += (i > 0 ? std::string(between) : std::string()) + describe(items[i]);
  if (items.size() > kMaxNamed)
    text += " … and " + std::to_string(items.size() - kMaxNamed) + " more";
  return text;
}

std::string labels(const std::vector<std::string>& list, std::string_view between) {
  return joined(list, between, [](const std::string& label) { return printable(label); });
}

/// Whether a file is ambiguous for no other reason than that its candidates are.
bool follows_from_others(const FileMatches& files, const AmbiguousFile& file) {
  return !file.of_after && std::ranges::any_of(files.ambiguous, [&](const AmbiguousFile& other) {
    return other.of_after &&
           std::ranges::find(file.candidates, other.label) != file.candidates.end();
  });
}

}  // namespace

std::string file_matches_text(const FileMatches& files) {
  std::string text;
  const auto renamed = those_of(files, {FileRelation::requested, FileRelation::renamed});
  if (!renamed.empty())
    text += "files are taken as renamed: " + joined(renamed, ", ", described) + "\n";
  const auto parts = those_of(files, {FileRelation::split, FileRelation::merged});
  if (!parts.empty())
    text += "files are taken as split or merged: " + joined(parts, ", ", described) + "\n";
  for (const AmbiguousFile& file : files.ambiguous)
    if (!follows_from_others(files, file))
      text += printable(file.label) + " of the " + (file.of_after ? "new" : "old") +
              " run is equally like " + labels(file.candidates, " and ") +
              " and is matched with none (--match-files OLD=NEW says which it is)\n";
  if (!files.only_before.empty() && !files.only_after.empty())
    text += "files without a counterpart: " + labels(files.only_before, ", ") +
            " in the old run, " + labels(files.only_after, ", ") +
            " in the new one (--match-files OLD=NEW matches them)\n";
  return text;
}

void append_file_matches(std::string& out, const FileMatches& files) {
  const auto listed = those_of(files, {FileRelation::requested, FileRelation::renamed,
                                       FileRelation::split, FileRelation::merged});
  if (!listed.empty()) {
    out += ",\n";
    append_list(
        out, "files_matched", listed,
        [&](const FileMatch& m) {
          out += "{\"old\": ";
          append_json(out, m.before);
          out += ", \"new\": ";
          append_json(out, m.after);
          out += ", \"relation\": ";
          append_json(out, relation_name(m.relation));
          out += m.by_places ? ", \"by\": \"places\"" : ", \"by\": \"ids\"";
          out += ", \"common\": " + std::to_string(m.common) + ", \"of\": " + std::to_string(m.of);
          out += '}';
        },
        "\n  ");
  }
  if (files.ambiguous.empty()) return;
  out += ",\n";
  append_list(
      out, "files_ambiguous", files.ambiguous,
      [&](const AmbiguousFile& file) {
        out += file.of_after ? "{\"run\": \"new\", \"file\": " : "{\"run\": \"old\", \"file\": ";
        append_json(out, file.label);
        out += ", ";
        append_list(out, "may_be", file.candidates,
                    [&](const std::string& label) { append_json(out, label); });
        out += '}';
      },
      "\n  ");
}

}  // namespace strake::report
