// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/obj/chunk.hpp"

namespace strake::io::obj {

inline constexpr std::uint32_t kNoMaterial = 0xffffffffU;

/// A run of faces and polylines of one chunk with one object and one material.
struct Segment {
  std::uint32_t chunk = 0;
  std::uint32_t face_begin = 0, face_end = 0;
  std::uint32_t polyline_begin = 0, polyline_end = 0;
  std::uint32_t material = kNoMaterial;  ///< index into Assembly::material_names
};

/// An `o` or `g` of the file that has geometry.
struct Entry {
  std::string object_name;   ///< of the `o` that it stands under; empty: none
  std::string group_name;    ///< of its own `g`; empty: the object itself
  std::uint32_t object = 0;  ///< ordinal of the `o` statement, 0: before any
  std::vector<Segment> segments;
  bool incomplete = false;  ///< it has free-form geometry as well, or alone
};

/// The chunks in order, and what belongs together across them.
struct Assembly {
  std::vector<std::uint64_t> vertex_base;   ///< per chunk; the total at the end
  std::vector<std::uint64_t> line_base;     ///< per chunk: lines before it
  std::vector<Entry> entries;               ///< in order of their first face or line
  std::vector<std::string> material_names;  ///< in order of first use
  std::vector<std::string> libraries;       ///< mtllib lines in order
};

/// Follows the o, g and usemtl statements through all chunks. A `g` that is named again under the
/// same `o` goes on; an `o` always starts anew.
[[nodiscard]] Assembly assemble(const std::vector<Chunk>& chunks);

}  // namespace strake::io::obj
