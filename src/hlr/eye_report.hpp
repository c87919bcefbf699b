// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hlr/job.hpp"
#include "strake/core/diagnostics.hpp"

namespace strake::hlr {

/// Objects in whose solids the eye of a view in perspective lies, so that they hide all outside,
/// and those on whose surface it lies, which it does not see. For a job that is otherwise ready.
[[nodiscard]] Diagnostics report_eye(const Job& job);

}  // namespace strake::hlr
