// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/report/clash.hpp"
#include "workbook/sheet/workbook.hpp"

namespace strake::workbook {

/// The most pictures of a workbook.
inline constexpr std::size_t kMaxPictures = 10;

/// Returns the sheet of the worst hits and clearance violations that no rule allows and that are
/// not settled, each with its picture: by class, then by d, then as in the findings. It has no rows
/// where nobody makes pictures (ClashContents::picture_of). Errors: those of who makes them;
/// cancelled.
[[nodiscard]] Result<Worksheet> picture_sheet(const report::ClashContents& contents,
                                              const parallel::Context& context);

}  // namespace strake::workbook
