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

constexpr std::size_t kClassColumns = 9, kDepthColumns = 10, kLeastGroupName = 8;

/// A row of the table of groups, or its head: class, numbers and, as it is shown, the name.
struct GroupRow {
  std::string_view cls;
  std::vector<std::string> numbers;
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

/// Returns the names of the groups in `room` columns, and puts the path that all begin with, if
/// they have one, into `lead`.
std::vector<std::string> shown_names(std::span<const clash::Group> groups, std::size_t room,
                                     std::string& lead) {
  std::vector<std::string_view> names;
  for (const clash::Group& group : groups) names.emplace_back(group.name);
  lead = common_lead(names);
  std::vector<std::string> shown;
  for (const std::string_view name : names) shown.push_back(without_lead(name, lead));
  return cut_apart(shown, room);
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
  const std::vector<std::string> lines = aligned(rows);
  const std::size_t taken = lines.front().size();
  std::string lead;
  const std::vector<std::string> names = shown_names(
      groups, options.width > taken + kLeastGroupName ? options.width - taken : kLeastGroupName,
      lead);
  std::string out;
  if (!lead.empty()) out = std::string(kLeadMark) + " stands for " + printable(lead) + "\n";
  out += ended(lines.front() + std::string(name(grouping.rules.by)));
  for (std::size_t g = 0; g < shown; ++g) out += ended(lines[g + 1] + names[g]);
  if (shown < all) {
    const std::size_t more = all - shown;
    out += "… and " + std::to_string(more) + (more == 1 ? " group more\n" : " groups more\n");
  }
  return out + "\n";
}

}  // namespace strake::report
