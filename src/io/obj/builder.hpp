// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/obj/assembly.hpp"
#include "io/obj/chunk.hpp"
#include "io/text_number.hpp"
#include "strake/geometry/mesh.hpp"
#include "strake/model/model.hpp"

namespace strake::io::obj {

/// All that building an object looks at; shared by the objects, changed by none.
struct BuildInput {
  std::span<const Chunk> chunks;
  const Assembly* assembly = nullptr;
  std::span<const geometry::Vec3d> vertices;  ///< of the file in order, in mm with z up
  std::span<const DigitStatistics> digits;    ///< of the vertices
  std::span<const model::Color> colors;       ///< per material of the assembly
};

/// The geometry of one object: its opaque faces are one mesh whatever their materials, because a
/// solid cut along its colours would be no solid; so are its transparent ones, but for those that
/// a solid does not close without (keep_solids_whole).
struct BuiltObject {
  geometry::TriangleMesh opaque, transparent;
  geometry::Polylines lines;
  model::Color opaque_color, transparent_color, line_color;  ///< of most of the faces or lines
  std::uint32_t crossing_faces = 0;                          ///< cut as fans
  bool part_transparent = false;                             ///< some are among the opaque
  double largest_mm = 0;                                     ///< coordinate
  DigitStatistics digits;                                    ///< of the vertices in use
  struct Damage {
    std::string message;
    std::uint64_t line = 0;  ///< 1-based
  };
  std::optional<Damage> damage;                ///< the first; what it is in is left out
  std::uint64_t bad_faces = 0, bad_lines = 0;  ///< that are left out

  [[nodiscard]] bool empty() const {
    return opaque.triangles.empty() && transparent.triangles.empty() && lines.points.empty();
  }
};

[[nodiscard]] BuiltObject build_object(const BuildInput& input, const Entry& entry);

}  // namespace strake::io::obj
