// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "clash/narrow_part.hpp"

namespace strake::clash {

/// The answer for two primitives that have a closed form: about their true surfaces, so without
/// sag. None where they are within a micrometre of a touch: whether the triangles touch is decided
/// exactly, by judge_flush() and look_at(), before the closed form is asked again.
[[nodiscard]] std::optional<PartAnswer> judge_analytic(const NarrowPart& a, const NarrowPart& b,
                                                       const NarrowOptions& options);

/// The answer for a pair that touches in a coordinate plane between its boxes, if it does: wants no
/// trees. `separated` tells whether there is such a plane, then look_at() need not ask whether
/// interiors meet.
[[nodiscard]] std::optional<PartAnswer> judge_flush(const NarrowPart& a, const NarrowPart& b,
                                                    const NarrowOptions& options, bool& separated);

/// A certain lower bound on the signed separation of two framed parts as they are on the grid, grid
/// units; the same whichever is called a, its normal that of their canonical order. Not below
/// parting_gap(): the pair is NO_HIT.
[[nodiscard]] geometry::PartingGap gap_between(const NarrowPart& a, const NarrowPart& b,
                                               const NarrowOptions& options);

/// The answer for a pair that lies face to face within the contact distance, however it stands:
/// wants no trees. `gap` is that of gap_between(). `asked` tells whether none is the answer, then
/// look_at() need not ask again.
[[nodiscard]] std::optional<PartAnswer> judge_flush_askew(const NarrowPart& a, const NarrowPart& b,
                                                          const NarrowOptions& options,
                                                          const geometry::PartingGap& gap,
                                                          bool& asked, NarrowWork& work);

/// Class, relation, separation and witness of two parts, but for the distance of those that are
/// apart and the depth of those whose interiors meet. Swapping the parts mirrors the relation and
/// moves the witness to the other origin; every other bit of an answer stays the same.
[[nodiscard]] FirstLook look_at(const NarrowPart& a, const NarrowPart& b,
                                const NarrowOptions& options, const KnownBefore& known,
                                NarrowWork& work);

/// The answer for a pair that is apart, if nearer than `reach` and than anybody asked; otherwise
/// it is NO_HIT.
[[nodiscard]] PartAnswer judge_distance(const NarrowPart& a, const NarrowPart& b,
                                        const NarrowOptions& options, double reach,
                                        NarrowWork& work);

/// The answer for a pair that needs its depth.
[[nodiscard]] PartAnswer judge_depth(const NarrowPart& a, const NarrowPart& b,
                                     const FirstLook& look, const KnownBefore& known,
                                     const NarrowOptions& options, NarrowWork& work);

}  // namespace strake::clash
