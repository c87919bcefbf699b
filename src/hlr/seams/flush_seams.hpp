// SPDX-License-Identifier: Apache-2.0
// Flush seams: edges along which parts of one colour are joined into one flat surface.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "hlr/prepare/view_job.hpp"
#include "hlr/seams/shared_lines.hpp"
#include "strake/core/result.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// An edge of a part, and the intervals of it that are flush seams.
struct FlushSeam {
  std::uint32_t body = 0, part = 0, edge = 0;
  std::int64_t contact = 0;  ///< the largest contact distance of the parts that meet there
  LineMeasure on;
  /// Ascending, apart by more than the contact distance.
  std::vector<std::pair<geometry::Int128, geometry::Int128>> intervals;
};

/// Returns the flush seams of a job, by body, part and edge. A place of an edge is one where the
/// faces round it, its own and those of all edges that lie on it there, join flat: see join_flat().
/// Errors: those of find_shared_lines().
[[nodiscard]] Result<std::vector<FlushSeam>> find_flush_seams(const ViewJob& job,
                                                              const parallel::Context& context);

/// Takes the flush seams out of the pieces of a drawing of the job, in whatever state they are, and
/// counts the edges that had some. What is left of an edge beside a seam and is no longer than the
/// contact distance goes with it. Errors: as above.
[[nodiscard]] Status leave_out_flush_seams(const ViewJob& job, const parallel::Context& context,
                                           Drawing& drawing);

}  // namespace strake::hlr
