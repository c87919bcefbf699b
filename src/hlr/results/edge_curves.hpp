// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hlr/prepare/view_job.hpp"
#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// Finds the edges of a job that are chords of circles of round primitives. Errors: cancelled.
[[nodiscard]] Result<Curves> find_curves(const ViewJob& job, const parallel::Context& context);

}  // namespace strake::hlr
