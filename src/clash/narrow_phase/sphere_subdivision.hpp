// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "clash/pairs/pair_result.hpp"

namespace strake::clash {

/// Evaluates a pair by the narrow phase of D. Sanz Villafruela, "Novel Parallelization Techniques
/// for Computer Graphics Applications": the baseline that benchmarks compare with.
///
/// The boxes of the two parts, inflated by the reach, have a common box. It is halved along its
/// longest side again and again; a half whose surrounding sphere is farther from either part than
/// the reach allows is dropped. A sphere as small as the resolution gives its centre's distances to
/// both parts. The search ends at the first point that is a HIT. The cost is that of the area over
/// which the parts are near each other, in units of (gap - tolerance) squared: after `max_cells`
/// halves the result is what was found by then, with a bracket that says so.
///
/// Results carry brackets, so that their class is that of the exact narrow phase wherever it is not
/// flagged. Relations are coarse: SEPARATE, ABUT_OUTSIDE, INTERFERE, CROSS.
[[nodiscard]] PartPairResult evaluate_by_spheres(const PairOperand& a, const PairOperand& b,
                                                 const PairTolerances& options,
                                                 std::uint64_t max_cells, NarrowWork& work);

}  // namespace strake::clash
