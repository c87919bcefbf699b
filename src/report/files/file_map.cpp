// SPDX-License-Identifier: Apache-2.0
#include "report/files/file_map.hpp"

#include <utility>

namespace strake::report {
namespace {

/// Returns a label that no file has: one cannot be called so.
std::string nowhere(std::string_view label) { return '\0' + std::string(label); }

}  // namespace

FileMap::FileMap(const FileMatches& files, Has has_before, Has has_after)
    : identity_(files.by_label_alone()), has_{std::move(has_before), std::move(has_after)} {
  if (identity_) return;
  link(files);
  group(files);
}

void FileMap::link(const FileMatches& files) {
  for (const FileMatch& match : files.matches) {
    LinkedFiles &before = links_[0][match.before], &after = links_[1][match.after];
    const bool part =
        match.relation == FileRelation::split || match.relation == FileRelation::merged;
    if (part) {
      before.parts.push_back(match.after);
      after.parts.push_back(match.before);
    } else {
      before.whole = match.after;
      after.whole = match.before;
    }
  }
}

void FileMap::group(const FileMatches& files) {
  for (auto& [label, links] : links_[1]) links.group = label;
  for (bool changed = true; changed;) {
    changed = false;
    for (const FileMatch& match : files.matches) {
      std::string_view &before = links_[0][match.before].group,
                       &after = links_[1][match.after].group;
      if (before == after) continue;
      // The least of all labels of a group reaches each of its files.
      const bool take_after = before.empty() || after < before;
      (take_after ? before : after) = take_after ? after : before;
      changed = true;
    }
  }
}

/// Returns the one file of the other run that has an object, as far as that can be known; empty:
/// none or several.
std::string_view FileMap::holder(RunSide run, std::string_view label, std::string_view id) const {
  const auto at = links(run).find(label);
  if (at == links(run).end()) return {};
  const RunSide other = opposite_run(run);
  if (!at->second.whole.empty() && has(other, at->second.whole, id)) return at->second.whole;
  std::string_view found;
  for (const std::string_view part : at->second.parts) {
    if (!has(other, part, id)) continue;
    if (!found.empty()) return {};
    found = part;
  }
  return found;
}

std::string FileMap::label_in_other(RunSide run, std::string_view label,
                                    std::string_view id) const {
  if (identity_) return std::string(label);
  const auto at = links(run).find(label);
  if (at == links(run).end()) return nowhere(label);
  // Most files are whole, and stay so.
  const LinkedFiles& own = at->second;
  if (own.parts.empty()) {
    const auto back = links(opposite_run(run)).find(own.whole);
    if (back->second.parts.empty()) return std::string(own.whole);
  }
  const std::string_view there = holder(run, label, id);
  const bool is_mutual = !there.empty() && holder(opposite_run(run), there, id) == label;
  return is_mutual ? std::string(there) : nowhere(label);
}

std::string FileMap::group_of(RunSide run, std::string_view label) const {
  if (identity_) return std::string(label);
  const auto at = links(run).find(label);
  return at == links(run).end() ? nowhere(label) : std::string(at->second.group);
}

}  // namespace strake::report
