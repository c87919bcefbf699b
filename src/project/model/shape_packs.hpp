// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/seeded_hash.hpp"
#include "project/database/database.hpp"
#include "project/model/shape_block.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

namespace strake::project {

/// Finds hashes in a table: theirs are the work of whoever made the file.
struct SeededHash128 {
  SeededHash seeded = {};
  [[nodiscard]] std::size_t operator()(const Hash128& hash) const {
    return seeded.of(std::as_bytes(std::span(&hash, 1)));
  }
};

/// The packs of a database, to which shapes are added.
class ShapePacks {
 public:
  [[nodiscard]] static Result<ShapePacks> open(Database& database);

  /// Stores those shapes that are in no pack yet; returns where each of those that are shared is,
  /// in their order. Errors: input for a shape that numbers what it does not have.
  [[nodiscard]] Result<std::vector<PackedShape>> add(std::span<const model::Shape> shapes,
                                                     const parallel::Context& context);

 private:
  explicit ShapePacks(Database& database) : database_(&database) {}
  Database* database_;
  std::unordered_map<Hash128, PackedShape, SeededHash128> known_;
};

/// Takes out what no file uses: packs of which nothing is used, and of others what makes up half of
/// them or more.
[[nodiscard]] Status sweep_packs(Database& database, const parallel::Context& context);

/// Whether the shapes of all packs are those whose hashes stand beside them. Errors: input.
[[nodiscard]] Status check_packs(Database& database, const parallel::Context& context);

/// A pack with its shapes.
struct UnpackedPack {
  std::uint32_t id = 0;
  std::vector<Hash128> hashes;
  std::vector<model::Shape> shapes;
};
/// Returns all packs, by id.
[[nodiscard]] Result<std::vector<UnpackedPack>> unpack_all(Database& database,
                                                           const parallel::Context& context);

}  // namespace strake::project
