// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hlr/prepare/view_job.hpp"
#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// Finds the lines of the objects that `input.whole` requests, as they are in the whole view:
/// pieces, curves, counts by object, counters and reports. The scene must have all that may hide or
/// cross them. Errors: those of prepare_view().
[[nodiscard]] Result<Drawing> solve_part(const ViewInput& input, const parallel::Context& context);

}  // namespace strake::hlr
