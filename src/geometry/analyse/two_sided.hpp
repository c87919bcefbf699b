// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/analyse/topology.hpp"
#include "strake/geometry/analyse.hpp"
#include "strake/geometry/part.hpp"

namespace strake::geometry {

/// A closed shell of a welded mesh; its part is turned so that the volume is positive.
struct ClosedShell {
  std::uint32_t label = 0;
  int sign = 1;  ///< of the volume before the turn
};

/// Which closed shells are the far sides of skins that are drawn from both sides.
struct FarSides {
  std::vector<bool> shells;         ///< per closed shell
  std::vector<std::uint32_t> fins;  ///< triangles of these with both their sides in one such shell,
                                    ///< one of each pair: surfaces that hang on a skin
};

/// A mesh that is drawn from both sides would be its inside minus itself. A shell is a far side
/// where it stands in no material, is turned against the outermost shell round it (or inside out,
/// where there is none), and other shells run back along all of it: with its triangles, or as the
/// same body to within a grid unit. In material it bounds a cavity that something fills.
///
/// One shell per part and parent (see find_parents()). Linear in the triangles, but for nests of
/// many layers.
[[nodiscard]] FarSides find_far_sides(const GridMesh& welded, const ShellLabels& labels,
                                      std::span<const ClosedShell> shells,
                                      std::span<const Part> parts,
                                      std::span<const std::uint32_t> parents);

/// Whether a body of this volume under a skin of this area is nothing but that skin: no thicker
/// than a grid unit.
[[nodiscard]] bool is_hollow(double volume, double area);

}  // namespace strake::geometry
