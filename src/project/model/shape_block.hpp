// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "project/model/blocks.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"

/// Blocks of a file's shapes, and packs of meshes and polylines, which files share.
namespace strake::project {

/// A shape of a pack: the id of the pack, and its number there.
struct PackedShape {
  std::uint32_t pack = 0, number = 0;
  friend auto operator<=>(const PackedShape&, const PackedShape&) = default;
};

/// Whether a shape is stored in a pack, once for all files; primitives are smaller than what it
/// takes to find them again.
[[nodiscard]] inline bool is_shared(const model::Shape& shape) {
  return !std::holds_alternative<geometry::Primitive>(shape);
}

/// `packed` says where the shared ones are, in their order.
[[nodiscard]] Result<Blob> pack_shapes(std::span<const model::Shape> shapes,
                                       std::span<const PackedShape> packed);

/// A shape of a block that is to come from a pack.
struct SharedShape {
  std::uint32_t at = 0;  ///< in the block
  PackedShape from;
};

/// Takes the primitives of a block, and returns where the other shapes are to come from.
[[nodiscard]] Result<std::vector<SharedShape>> unpack_shapes(std::span<const std::byte> blob,
                                                             std::string what,
                                                             std::span<model::Shape> shapes);

/// Returns the hash of all that there is of a mesh or of polylines, to the last bit.
[[nodiscard]] Hash128 shape_hash(const model::Shape& shape);
/// Returns about how many bytes a mesh or polylines take before they are compressed.
[[nodiscard]] std::uint64_t shape_bytes(const model::Shape& shape);
/// Whether what a mesh or polylines number is there.
[[nodiscard]] bool is_sound(const model::Shape& shape);

/// Packs shapes, of which one that is no longer in use is null, with a seal over their hashes,
/// which stand beside them: shape_hash() of each, zeros where it is not in use.
[[nodiscard]] Result<Blob> pack_meshes(std::span<const model::Shape* const> shapes,
                                       std::span<const Hash128> hashes);
/// Returns the shapes; those that are no longer in use are empty meshes. Errors: input for what is
/// damaged, and where the hashes are not those that the shapes were stored with.
[[nodiscard]] Result<std::vector<model::Shape>> unpack_meshes(std::span<const std::byte> blob,
                                                              std::span<const Hash128> hashes,
                                                              std::string what);

}  // namespace strake::project
