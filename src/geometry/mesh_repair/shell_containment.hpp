// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/mesh_repair/mesh_repair.hpp"
#include "geometry/mesh_repair/topology.hpp"
#include "strake/geometry/part.hpp"

// Which closed shell contains which, and which are back sides of surfaces.

namespace strake::geometry {

inline constexpr std::uint32_t kNoShell = 0xffffffffU;

/// Returns, for each closed shell (each a solid part of positive volume), the smallest other shell
/// that contains it without being crossed by it, or kNoShell. Exact.
[[nodiscard]] std::vector<std::uint32_t> find_containing_shells(std::span<const Part> shells);

/// A closed shell of a welded mesh; its part is flipped so that the volume is positive.
struct ClosedShell {
  std::uint32_t label = 0;
  int sign = 1;  ///< of the volume before the flip
};

/// The closed shells that are back sides of surfaces drawn from both sides.
struct BackShells {
  std::vector<bool> shells;         ///< per closed shell
  std::vector<std::uint32_t> fins;  ///< one of each pair of their triangles with both sides in one
                                    ///< such shell: surfaces attached to a shell
};

/// Finds the back sides: a mesh drawn from both sides would be its interior minus itself. A shell
/// is a back side where it lies in no material, is oriented against the outermost shell round it
/// (or inside out, where there is none), and other shells of opposite orientation cover all of it:
/// with its triangles, or as the same body to within a grid unit. In material it bounds a cavity
/// that something fills.
///
/// One shell per part and parent (see find_containing_shells()). Linear in the triangles, but for
/// nests of many layers.
[[nodiscard]] BackShells find_back_shells(const GridMesh& welded, const ShellLabels& labels,
                                          std::span<const ClosedShell> shells,
                                          std::span<const Part> parts,
                                          std::span<const std::uint32_t> parents);

/// Whether a body of this volume and surface area is hollow: no thicker than a grid unit.
[[nodiscard]] bool is_hollow(double volume, double area);

}  // namespace strake::geometry
