// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "report/report_writers.hpp"

namespace strake::publish {

/// The writers of workbooks, whose worst results have pictures wherever the model on the grid is
/// there.
[[nodiscard]] std::span<const report::ClashWriter> workbook_writers();

}  // namespace strake::publish
