// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "project/database/database.hpp"
#include "project/snapshot/snapshot.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

/// What the last result of a test was computed from, in the database: a head in the table `report`,
/// and parts of so many objects each in `snapshot_part`, of which a small change rewrites few.
namespace strake::project {

/// A snapshot as it was read.
struct StoredSnapshot {
  std::int64_t test = 0;  ///< the id of the test
  Snapshot snapshot;
  /// clash::KeptForChanges::elements; none where the result was not kept for changes, or where
  /// a version before 4 wrote it, which had them with what it kept.
  std::vector<std::uint64_t> elements;
  std::vector<Hash128> parts;  ///< hashes of its parts; none where a version before 4 wrote it
};

/// Reads the snapshot of a test, of which `head` is what its row in `report` has; `what` is what
/// errors call it. Errors: input for a damaged project; memory; cancelled.
[[nodiscard]] Result<StoredSnapshot> read_snapshot(Database& database, std::int64_t test,
                                                   std::span<const std::byte> head,
                                                   const std::string& what,
                                                   const parallel::Context& context);

/// The parts of a snapshot that are in the database.
struct StoredParts {
  std::span<const Hash128> hashes;
  /// Which of them are known to be those to be written (ranges_that_stand()), so that they need not
  /// be hashed to see it; empty: none is known.
  std::vector<bool> stand = {};
};

/// Writes the snapshot of a test, with as many elements as objects or none: the parts that are not
/// among those stored, and the head. Errors: those of the database; memory; cancelled.
[[nodiscard]] Status write_snapshot(Database& database, std::int64_t test, const Snapshot& snapshot,
                                    std::span<const std::uint64_t> elements,
                                    const StoredParts& stored, const parallel::Context& context);

}  // namespace strake::project
