// SPDX-License-Identifier: Apache-2.0
#include "workbook/clash/clash_sheets.hpp"

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "clash/results/clash_key.hpp"
#include "report/exchange/clash_row.hpp"
#include "report/text/formatting.hpp"

namespace strake::workbook {
namespace {

using report::ClashContents;

/// Returns how wide a column is to be, in characters.
double width_of(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, double>, 11> kWidths{{{"key", 29},
                                                                         {"comment", 50},
                                                                         {"class", 22},
                                                                         {"relation", 16},
                                                                         {"group", 29},
                                                                         {"status", 11},
                                                                         {"kind", 14},
                                                                         {"test", 18},
                                                                         {"date", 12},
                                                                         {"allowed_by", 22},
                                                                         {"exempted_by", 22}}};
  for (const auto& [of, width] : kWidths)
    if (name == of) return width;
  if (name.ends_with("_name")) return 34;
  if (name.ends_with("_id") || name.ends_with("_file")) return 22;
  return 13;
}

/// Returns columns of these names, then those of the attributes that are requested.
std::vector<SheetColumn> columns_of(const ClashContents& contents,
                                    std::initializer_list<std::span<const char* const>> names) {
  std::vector<SheetColumn> columns;
  for (const std::span<const char* const> some : names)
    for (const std::string_view name : some) columns.push_back({std::string(name), width_of(name)});
  for (const std::string& attribute : contents.columns)
    for (const char* const side : {"a_@", "b_@"}) columns.push_back({side + attribute, 18});
  return columns;
}

std::optional<std::size_t> number_of(const std::vector<SheetColumn>& columns,
                                     std::string_view name) {
  const auto at = std::ranges::find(columns, name, &SheetColumn::name);
  return static_cast<std::size_t>(at - columns.begin());
}

/// The rows of all tests: of each the results, then the pairs that rules took out.
class ResultRows {
 public:
  ResultRows(const ClashContents& contents, const report::GroupNumbers& numbers)
      : contents_(contents), numbers_(numbers) {
    for (const clash::Report& test : contents.findings.tests) {
      first_.push_back(size_);
      size_ += test.pairs.size() + test.exempted_pairs.size();
    }
  }

  [[nodiscard]] std::size_t size() const { return size_; }

  void append(std::size_t i, SheetRow& row) const {
    const auto behind = std::ranges::upper_bound(first_, i);
    const auto t = static_cast<std::size_t>(behind - first_.begin()) - 1;
    const clash::Report& test = contents_.findings.tests[t];
    const std::size_t p = i - first_[t];
    if (p >= test.pairs.size()) {
      append_exempted_cells(row, contents_, test, test.exempted_pairs[p - test.pairs.size()], true);
      return;
    }
    const auto group = numbers_.of(t, p);
    append_result_cells(row, contents_, t, test.pairs[p],
                        group ? contents_.grouping->groups[*group].id : std::string_view(), true);
  }

 private:
  const ClashContents& contents_;
  const report::GroupNumbers& numbers_;
  std::vector<std::size_t> first_;
  std::size_t size_ = 0;
};

void append_box_cells(SheetRow& row, const geometry::Box3d& box) {
  report::append_point(row, (box.lo + box.hi) * 0.5);
  for (int k = 0; k < 3; ++k) row.number(box.lo[k], report::append_mm_floor);
  for (int k = 0; k < 3; ++k) row.number(box.hi[k], report::append_mm_ceil);
}

}  // namespace

Worksheet clash_sheet(const ClashContents& contents, const report::GroupNumbers& numbers) {
  const auto rows = std::make_shared<const ResultRows>(contents, numbers);
  Worksheet sheet{
      .name = "Clashes",
      .columns = columns_of(contents, {report::kResultColumns, report::kDecidedColumns}),
      .rows = rows->size(),
      .cells = {}};
  sheet.class_column = number_of(sheet.columns, "class");
  sheet.status_column = number_of(sheet.columns, "status");
  sheet.cells = [rows](std::size_t i, SheetRow& row) { rows->append(i, row); };
  return sheet;
}

Worksheet group_sheet(const ClashContents& contents) {
  Worksheet sheet{.name = "Groups",
                  .columns = {{"group", 29},
                              {"name", 50},
                              {"results", 10},
                              {"class", 22},
                              {"d_mm", 13},
                              {"HIT", 10},
                              {"CONTACT", 10},
                              {"CLEARANCE_VIOLATION", 22},
                              {"volume_mm3", 16}},
                  .cells = {}};
  for (const char* const corner : {"", "lo_", "hi_"})
    for (const char axis : std::string_view("xyz"))
      sheet.columns.push_back({std::string(corner) + axis + "_mm", 13});
  sheet.class_column = 3;
  if (contents.grouping == nullptr) return sheet;
  const std::vector<clash::Group>& groups = contents.grouping->groups;
  sheet.rows = groups.size();
  sheet.cells = [&groups](std::size_t i, SheetRow& row) {
    const clash::Group& group = groups[i];
    row.word(group.id).text(group.name).count(group.results.size()).word(name(group.worst));
    row.number(group.d_mm, report::append_mm);
    row.count(group.count_hit).count(group.count_contact).count(group.count_clearance);
    if (group.volume_mm3)
      row.number(*group.volume_mm3, report::append_mm);
    else
      row.blank();
    append_box_cells(row, group.box_mm);
  };
  return sheet;
}

Worksheet joint_sheet(const ClashContents& contents, const std::vector<report::PipeJoint>& joints) {
  return {.name = "Joints",
          .columns = columns_of(contents, {report::kJointColumns}),
          .rows = joints.size(),
          .cells = [&](std::size_t i, SheetRow& row) {
            report::append_joint_cells(row, contents, joints[i]);
          }};
}

Worksheet not_compared_sheet(const ClashContents& contents) {
  Worksheet sheet{.name = "Not compared",
                  .columns = {{"test", 18},
                              {"why", 26},
                              {"a_id", 22},
                              {"a_name", 34},
                              {"a_file", 22},
                              {"b_id", 22},
                              {"b_name", 34},
                              {"b_file", 22}},
                  .cells = {}};
  std::vector<std::pair<std::size_t, std::size_t>> all;
  for (std::size_t t = 0; t < contents.findings.tests.size(); ++t)
    for (std::size_t i = 0; i < contents.findings.tests[t].not_compared.size(); ++i)
      all.emplace_back(t, i);
  sheet.rows = all.size();
  sheet.cells = [all = std::move(all), &contents](std::size_t i, SheetRow& row) {
    const clash::Report& test = contents.findings.tests[all[i].first];
    const clash::NotCompared& what = test.not_compared[all[i].second];
    row.text(test.name).word(what.code);
    report::append_identity(row, contents.model, what.a);
    if (what.b) report::append_identity(row, contents.model, *what.b);
  };
  return sheet;
}

}  // namespace strake::workbook
