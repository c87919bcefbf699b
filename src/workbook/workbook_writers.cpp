// SPDX-License-Identifier: Apache-2.0
#include "workbook/workbook_writers.hpp"

#include <utility>
#include <vector>

#include "report/clash/group_numbers.hpp"
#include "workbook/clash/clash_sheets.hpp"
#include "workbook/clash/picture_sheet.hpp"
#include "workbook/clash/summary_sheet.hpp"
#include "workbook/sheet/workbook.hpp"

namespace strake::workbook {
Status write_clash_workbook(const report::ClashContents& contents, report::Sink sink,
                            const parallel::Context& context) {
  const report::GroupNumbers numbers(contents);
  Result<Worksheet> pictures = picture_sheet(contents, context);
  if (!pictures) return pictures.error();
  const Result<std::vector<report::PipeJoint>> joints = report::pipe_joints(contents, context);
  if (!joints) return joints.error();
  std::vector<Worksheet> sheets;
  append_split(sheets, clash_sheet(contents, numbers));
  for (const Worksheet& sheet : {std::move(*pictures), group_sheet(contents),
                                 joint_sheet(contents, *joints), not_compared_sheet(contents)})
    if (sheet.rows > 0) append_split(sheets, sheet);
  sheets.insert(sheets.begin(), summary_sheet(contents, sheets));
  return write_workbook(sheets, sink, context);
}

}  // namespace strake::workbook
