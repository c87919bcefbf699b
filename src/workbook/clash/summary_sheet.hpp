// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "strake/report/clash.hpp"
#include "workbook/sheet/workbook.hpp"

namespace strake::workbook {

/// Returns the sheet that tells what was tested, by which rules and tolerances, what was found and
/// decided, what was not compared, and where the rows of the `others` are.
[[nodiscard]] Worksheet summary_sheet(const report::ClashContents& contents,
                                      std::span<const Worksheet> others);

}  // namespace strake::workbook
