// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/obj/chunk.hpp"
#include "io/source/text_number.hpp"
#include "strake/geometry/mesh.hpp"
#include "strake/model/model.hpp"

/// Assembles the chunks of an OBJ file and builds the geometry of each object.
namespace strake::io::obj {

inline constexpr std::uint32_t kNoMaterial = 0xffffffffU;

/// A run of faces and polylines of one chunk with one object and one material.
struct GeometryRun {
  std::uint32_t chunk = 0;
  std::uint32_t face_begin = 0, face_end = 0;
  std::uint32_t polyline_begin = 0, polyline_end = 0;
  std::uint32_t material = kNoMaterial;  ///< index into ObjAssembly::material_names
};

/// An `o` or `g` of the file that has geometry.
struct ObjElement {
  std::string object_name;   ///< the name of the `o` above it; empty: none
  std::string group_name;    ///< the name of its own `g`; empty: the object itself
  std::uint32_t object = 0;  ///< ordinal of the `o` statement; 0: before any
  std::vector<GeometryRun> segments;
  bool incomplete = false;  ///< it has free-form geometry as well, or alone
};

/// What belongs together across the chunks of a file.
struct ObjAssembly {
  std::vector<std::uint64_t> vertex_base;   ///< per chunk, with the total at the end
  std::vector<std::uint64_t> line_base;     ///< per chunk: the lines before it
  std::vector<ObjElement> entries;          ///< in order of their first face or line
  std::vector<std::string> material_names;  ///< in order of first use
  std::vector<std::string> libraries;       ///< mtllib lines in order
};

/// Follows the o, g and usemtl statements through all chunks. A `g` that is named again under the
/// same `o` is continued; an `o` always starts anew.
[[nodiscard]] ObjAssembly assemble(const std::vector<ObjChunk>& chunks);

/// All that building an object needs; shared by the objects, changed by none.
struct BuildInput {
  std::span<const ObjChunk> chunks;
  const ObjAssembly* assembly = nullptr;
  std::span<const geometry::Vec3d>
      vertices;                             ///< the vertices of the file in order, in mm with z up
  std::span<const DigitStatistics> digits;  ///< the digits of each vertex
  std::span<const model::Color> colors;     ///< one per material of the assembly
};

/// The geometry of one object: its opaque faces are one mesh whatever their materials, because a
/// solid cut along its colours would be no solid; so are its transparent ones, but for those that
/// a solid does not close without (merge_transparent_shells).
struct BuiltObject {
  geometry::TriangleMesh opaque, transparent;
  geometry::Polylines lines;
  model::Color opaque_color, transparent_color, line_color;  ///< the colours of most faces or lines
  std::uint32_t crossing_faces = 0;                          ///< faces cut as fans
  bool part_transparent = false;  ///< some transparent faces are among the opaque
  double largest_mm = 0;          ///< the largest coordinate
  DigitStatistics digits;         ///< the digits of the vertices in use
  struct Damage {
    std::string message;
    std::uint64_t line = 0;  ///< 1-based
  };
  std::optional<Damage> damage;  ///< the first damage; the face or line that has it is left out
  std::uint64_t bad_faces = 0, bad_lines = 0;  ///< faces and lines that are left out

  [[nodiscard]] bool empty() const {
    return opaque.triangles.empty() && transparent.triangles.empty() && lines.points.empty();
  }
};

[[nodiscard]] BuiltObject build_object(const BuildInput& input, const ObjElement& entry);

}  // namespace strake::io::obj
