// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/output_format.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/report/clash.hpp"

namespace strake::workbook {

/// Writes clash results as a workbook (decision 0082): a summary, the results as CSV has them with
/// filters, colours and a list to pick the status from, pictures of the worst where somebody makes
/// them, groups, joints of pipes, what was not compared. Names are text, never formulas. Errors:
/// those of write_workbook(), and of contents.picture_of.
[[nodiscard]] Status write_clash_workbook(const report::ClashContents& contents, report::Sink sink,
                                          const parallel::Context& context = {});

/// The format, as tables of writers have it.
inline constexpr OutputFormat kClashWorkbook{".xlsx", ", for Excel and LibreOffice as {}"};

}  // namespace strake::workbook
