// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "report/report_writers.hpp"

namespace strake::bcf {

/// The formats that clash results are written in here, in the order of help and errors.
[[nodiscard]] std::span<const report::ClashWriter> clash_writers();

}  // namespace strake::bcf
