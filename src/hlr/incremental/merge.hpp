// SPDX-License-Identifier: Apache-2.0
// An earlier drawing, of which some objects are replaced.
#pragma once

#include <vector>

#include "hlr/incremental/comparison.hpp"
#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// Lines that were found anew, and whose they are.
struct ResolvedLines {
  const std::vector<bool>& to_solve;  ///< by object
  const Drawing& drawing;             ///< its pieces, curves and counts are those of these objects
};

/// Makes of an earlier drawing that of the objects now: pieces, curves and counts of lines. Objects
/// that are neither requested nor in the earlier drawing have none. Errors: cancelled.
[[nodiscard]] Status merge_lines(const Comparison& comparison, const ResolvedLines& resolved,
                                 Drawing& earlier, const parallel::Context& context);

/// Makes of the account of an earlier drawing that of the objects now; the lines are merged
/// already. `drawn` is by object; empty: all. Errors: cancelled.
[[nodiscard]] Status merge_account(const model::Scene& scene, const std::vector<bool>& drawn,
                                   const Comparison& comparison, const ResolvedLines& resolved,
                                   Drawing& drawing, const parallel::Context& context);

}  // namespace strake::hlr
