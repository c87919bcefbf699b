// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "hlr/sections/section_planes.hpp"
#include "strake/model/scene.hpp"

namespace strake::hlr {

/// Returns, by object, whether section planes leave it whole: it is drawn and in `to_solve`, some
/// plane cuts it, and none cuts it away wholly. Empty where nothing is requested, or there are no
/// planes.
///
/// It is decided exactly, by the vertices of all bodies of the object. A plane cuts it away wholly
/// where none lies strictly on the side that is kept; it cuts it where some do and some do not.
[[nodiscard]] std::vector<bool> find_uncut(const model::Scene& scene,
                                           const std::vector<bool>& drawn,
                                           const std::vector<bool>& to_solve,
                                           std::span<const SectionPlane> planes);

}  // namespace strake::hlr
