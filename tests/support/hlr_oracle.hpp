// SPDX-License-Identifier: Apache-2.0
// A second oracle for hidden lines, in GMP rationals and in another manner than either solver:
// it never forms the interval that a face hides. It cuts an edge at every parameter where anything
// could change and asks at the middle of each cut whether the point, moved a hair to the left and
// a hair to the right, lies under a face.
#pragma once

#include <vector>

#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"

namespace strake::test {

/// What hlr::draw must give. The contact distance is options.contact_distance_mm, or 3 grid units
/// where negative; every file's precision must be 0. `lines`: intersections from end to end, by
/// object, as drawn with Stage::none; which these are is for another oracle to say.
[[nodiscard]] std::vector<hlr::EdgePiece> oracle_pieces(
    const model::Scene& scene, const hlr::View& view, const hlr::Options& options,
    const std::vector<hlr::EdgePiece>& lines = {});

/// One line per piece, for messages.
[[nodiscard]] std::string text(const std::vector<hlr::EdgePiece>& pieces);

[[nodiscard]] bool same_piece(const hlr::EdgePiece& x, const hlr::EdgePiece& y);

/// Where two lists first differ, or an empty string.
[[nodiscard]] std::string difference(const std::vector<hlr::EdgePiece>& expected,
                                     const std::vector<hlr::EdgePiece>& got);

}  // namespace strake::test
