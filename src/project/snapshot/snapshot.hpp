// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "project/codec/blob.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

/// What a stored result was computed from, so that what changed since is known from the data alone.
namespace strake::project {

/// One state of the objects of a model, as one computation sees them.
struct Snapshot {
  Hash128 whole;                          ///< of what concerns no single object: rules, view
  std::vector<std::uint64_t> identities;  ///< of each object: file label and durable id
  std::vector<Hash128> signatures;        ///< of each object: all that the computation sees of it
  /// Of labels, ids and names of all objects (SignedModel::names); zeros: not known.
  Hash128 names = {};
  /// Of all that the above was made from. Two snapshots of one source are equal, so that the second
  /// need not be made; zeros: not known.
  Hash128 source = {};
  std::vector<Hash128> ranges = {};  ///< clash::Signatures::ranges

  /// Whether both are of the same objects, seen alike; what they were made from may differ.
  friend bool operator==(const Snapshot& a, const Snapshot& b) {
    return &a == &b ||
           (a.whole == b.whole && a.identities == b.identities && a.signatures == b.signatures);
  }
};

/// Whether two hashes are known, and equal.
[[nodiscard]] inline bool is_same_known(const Hash128& a, const Hash128& b) {
  return a == b && a != Hash128();
}

/// Returns of each clash::Signatures::kObjectsPerRange objects whether what both states say of them
/// is known to be the same, their numbers too, without a look at it; nothing where that is not
/// known of any.
[[nodiscard]] std::vector<bool> ranges_that_stand(const Snapshot& then, const Snapshot& now);

/// What identities of objects become where files have other labels.
using NewIdentities = std::unordered_map<std::uint64_t, std::uint64_t>;

/// Gives the objects of a snapshot the identities that they have under the labels of today. Names,
/// source and ranges are not known then.
void rename_objects(Snapshot& snapshot, const NewIdentities& renamed);

/// Returns an entry for each object (clash::element_hash).
[[nodiscard]] Result<std::vector<std::uint64_t>> identities(const model::Model& model,
                                                            const parallel::Context& context);

/// Returns for each object of `then` its number in `now`: model::kNoObject where none has its
/// identity and signature. Identities that are not unique match nothing. Ranges that stand are not
/// looked at.
[[nodiscard]] Result<std::vector<std::uint32_t>> unchanged(const Snapshot& then,
                                                           const Snapshot& now,
                                                           const parallel::Context& context);

void write(BlobWriter& out, const Snapshot& snapshot);
[[nodiscard]] Snapshot read_snapshot(BlobReader& in);

}  // namespace strake::project
