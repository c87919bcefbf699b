// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "clash/incremental/object_map.hpp"
#include "strake/clash/clash.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

/// Objects that are what they were under other names: of a report only the hash shows them.
namespace strake::clash {

/// Returns what KeptForChanges::elements is for these objects. Errors: cancelled.
[[nodiscard]] Result<std::vector<std::uint64_t>> hashes_of_names(const model::Model& model,
                                                                 const parallel::Context& context);

/// Whether objects whose ids are those that an earlier run had, of which `earlier` are the hashes,
/// lie in files of the labels that these had: then the hashes are the same.
[[nodiscard]] bool have_labels_of(std::span<const std::uint64_t> earlier,
                                  const model::Model& model);

/// Counts as changed the objects that have other names and a contact of which only the hash was
/// kept: it has to be found again to be hashed under the new name. `names` are those of today.
void mark_hashed_contacts_changed(const KeptForChanges& kept, std::span<const std::uint64_t> names,
                                  ObjectMap& map);

/// What hashes of pairs come to.
struct HashChange {
  Hash128 gone, came;
};

/// Returns the hashes under the former names and under those of today of the pairs that stay and
/// have an object with another name. Errors: cancelled.
[[nodiscard]] Result<HashChange> rehash_renamed(const Report& earlier,
                                                std::span<const std::uint64_t> names,
                                                const ObjectMap& map,
                                                const parallel::Context& context);

}  // namespace strake::clash
