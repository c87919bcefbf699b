// SPDX-License-Identifier: Apache-2.0
#include "report/table/group_table.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/number.hpp"
#include "core/text_encoding.hpp"
#include "report/table/pair_table.hpp"
#include "report/text/columns.hpp"
#include "report/text/formatting.hpp"
#include "report/text/table_names.hpp"

namespace strake::report {
namespace {

constexpr std::size_t kClassColumns = 9, kDepthColumns = 10, kGroupIndent = 4;
/// The least columns for a name, and those by which it stands beside the numbers although it is
/// wider.
constexpr std::size_t kMinGroupName = 8, kMinBeside = 24;

/// A row of the table of groups, or its head: class, numbers and, as it is shown, the name.
struct GroupRow {
  std::string_view cls;
  std::vector<std::string> numbers;
  std::string place = {};  ///< where it stands before the name, below the numbers
};

GroupRow row_of(const clash::Group& group, bool place) {
  const geometry::Vec3d d = group.box_mm.hi - group.box_mm.lo;
  GroupRow row{short_class_name(group.worst),
               {fixed(group.d_mm, 3), std::to_string(group.results.size()),
                fixed(std::max({d.x, d.y, d.z}) / 1000, 1)}};
  if (place)
    for (std::string& text : place_text((group.box_mm.lo + group.box_mm.hi) * 0.5))
      row.numbers.push_back(std::move(text));
  return row;
}

/// Returns the rows as text, aligned, each of the same width.
std::vector<std::string> aligned(const std::vector<GroupRow>& rows) {
  std::vector<std::size_t> widths(rows.front().numbers.size());
  widths.front() = kDepthColumns;
  for (const GroupRow& row : rows)
    for (std::size_t c = 0; c < widths.size(); ++c)
      widths[c] = std::max(widths[c], row.numbers[c].size());
  std::vector<std::string> lines;
  for (const GroupRow& row : rows) {
    std::string& line = lines.emplace_back(fit_to_columns(row.cls, kClassColumns) + "  ");
    for (std::size_t c = 0; c < widths.size(); ++c)
      line += right_aligned(row.numbers[c], widths[c]) + "  ";
  }
  return lines;
}

/// Returns the names of the groups as they are shown but for their width, and puts the path that
/// all begin with, if they have one, into `lead`.
std::vector<std::string> names_of(std::span<const clash::Group> groups, std::string& lead) {
  std::vector<std::string_view> names;
  for (const clash::Group& group : groups) names.emplace_back(group.name);
  lead = common_lead(names);
  std::vector<std::string> shown;
  for (const std::string_view name : names) shown.push_back(without_lead(name, lead));
  return shown;
}

std::size_t widest_of(const std::vector<std::string>& texts) {
  std::size_t widest = 0;
  for (const std::string& text : texts) widest = std::max(widest, columns_in(text));
  return widest;
}

/// Returns what is left of a line, but no less than a name needs.
std::size_t room_behind(std::size_t taken, std::size_t width) {
  return std::max(width - std::min(width, taken), kMinGroupName);
}

/// Takes the last three numbers, which are the place, out of the rows and puts them before the
/// names.
void move_places(std::vector<GroupRow>& rows) {
  constexpr std::ptrdiff_t kPlaceNumbers = 3;
  for (GroupRow& row : rows) {
    const auto first = row.numbers.end() - kPlaceNumbers;
    for (auto number = first; number != row.numbers.end(); ++number)
      row.place += (number == first ? "" : " ") + *number;
    row.place += "  ";
    row.numbers.erase(first, row.numbers.end());
  }
}

/// Cuts names that are wider than the terminal; returns whether they, and the heading above them,
/// stand behind the numbers. Else they stand below them, and the places with them where even the
/// numbers are too wide.
bool fit_names(std::vector<GroupRow>& rows, std::vector<std::string>& names,
               std::string_view heading, bool place, std::size_t width) {
  const std::size_t taken = aligned(rows).front().size();
  const std::size_t room = width - std::min(width, taken);
  const std::size_t wanted = std::max(widest_of(names), columns_in(heading));
  if (room >= std::min(wanted, kMinBeside)) {
    names = shorten_distinctly(names, room_behind(taken, width));
    return true;
  }
  if (place && taken > width) move_places(rows);
  std::size_t before = kGroupIndent;
  for (const GroupRow& row : rows) before = std::max(before, kGroupIndent + row.place.size());
  names = shorten_distinctly(names, room_behind(before, width));
  return false;
}

}  // namespace

std::string group_table(const clash::Grouping& grouping, const TableOptions& options) {
  // The name of a group by proximity, or of one that is split by it, has its place.
  const bool place = grouping.rules.by != clash::GroupBy::proximity && !grouping.rules.apart;
  const std::size_t all = grouping.groups.size(), shown = std::min(options.rows, all);
  const std::span groups = std::span(grouping.groups).first(shown);
  std::vector<GroupRow> rows{{"class", {"d mm", "results", "size m"}}};
  if (place) rows[0].numbers.insert(rows[0].numbers.end(), {"x mm", "y mm", "z mm"});
  for (const clash::Group& group : groups) rows.push_back(row_of(group, place));
  std::string lead;
  std::vector<std::string> names = names_of(groups, lead);
  const std::string_view heading = name(grouping.rules.by);
  const bool beside = fit_names(rows, names, heading, place, options.width);
  names.emplace(names.begin(), heading);
  const std::vector<std::string> lines = aligned(rows);
  std::string out;
  if (!lead.empty()) out = std::string(kLeadMark) + " stands for " + printable(lead) + "\n";
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const std::string below = rows[r].place + names[r];
    out += ended(beside ? lines[r] + names[r] : lines[r]);
    if (!beside && !below.empty()) out += ended(std::string(kGroupIndent, ' ') + below);
  }
  if (shown < all) {
    const std::size_t more = all - shown;
    out += "… and " + std::to_string(more) + (more == 1 ? " group more\n" : " groups more\n");
  }
  return out + "\n";
}

}  // namespace strake::report
