// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "io/rvm/big_endian.hpp"
#include "io/source/units_and_axes.hpp"
#include "strake/geometry/primitive.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/model/model.hpp"

namespace strake::io::rvm {

inline constexpr std::uint32_t kLineKind = 10;
inline constexpr std::uint32_t kFacetKind = 11;

/// A PRIM, OBST or INSU chunk, its parameters still as the file's bytes.
struct PrimitiveChunk {
  std::uint64_t offset = 0;
  std::uint32_t kind = 0;
  model::Category category = model::Category::physical;
  std::uint8_t transparency = 0;   ///< percent
  std::array<float, 12> matrix{};  ///< columns X, Y, Z, origin; local mm to world metres
  std::array<float, 6> box{};      ///< as stored; not to be trusted
  Bytes parameters;                ///< the parameters of the kind, big-endian
};

/// Returns one more than the greatest kind that is known.
[[nodiscard]] std::size_t kind_count();

/// Returns the number of float parameters of kinds 1 to 10; 0 for any other kind.
[[nodiscard]] std::size_t parameter_count(std::uint32_t kind);

/// Returns "a cylinder", "a facet group": how messages call kinds 1 to 11; "a primitive" for any
/// other.
[[nodiscard]] std::string_view kind_with_article(std::uint32_t kind);

/// Returns the placement that a matrix stands for; nothing when an entry is not finite.
///
/// Matrices are float32 images of decimal numbers and of rotations. Both are undone within half a
/// float spacing: an origin becomes the shortest decimal millimetre value that rounds to the stored
/// float, a column that is one local millimetre long within float precision becomes exactly that
/// long. So coplanar faces of different elements stay coplanar.
[[nodiscard]] std::optional<geometry::Placement> placement_of(const std::array<float, 12>& matrix,
                                                              const SourceFrame& frame);

/// Whether the three columns are finite, mutually orthogonal and of similar length.
[[nodiscard]] bool is_plausible_frame(const std::array<float, 12>& matrix);

/// A primitive of kinds 1 to 10, or why there is none.
struct DecodedPrimitive {
  std::optional<geometry::Primitive> primitive;
  std::string_view problem;  ///< why it is absent, or what is odd about it
};
[[nodiscard]] DecodedPrimitive decode_primitive(const PrimitiveChunk& chunk);

}  // namespace strake::io::rvm
