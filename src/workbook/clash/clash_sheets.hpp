// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "report/clash/group_numbers.hpp"
#include "report/exchange/pipe_joints.hpp"
#include "strake/report/clash.hpp"
#include "workbook/sheet/workbook.hpp"

namespace strake::workbook {

// These functions return sheets of what a report has, without rows where there is none. They refer
// to what they are given, and may have more rows than a sheet can.

/// All results, as CSV has them, with room for decisions.
[[nodiscard]] Worksheet clash_sheet(const report::ClashContents& contents,
                                    const report::GroupNumbers& numbers);
[[nodiscard]] Worksheet group_sheet(const report::ClashContents& contents);
[[nodiscard]] Worksheet joint_sheet(const report::ClashContents& contents,
                                    const std::vector<report::PipeJoint>& joints);
[[nodiscard]] Worksheet not_compared_sheet(const report::ClashContents& contents);

}  // namespace strake::workbook
