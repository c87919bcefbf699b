// SPDX-License-Identifier: Apache-2.0
#include "clash/incremental/renamed.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "clash/results/result_hash.hpp"
#include "strake/clash/incremental.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::clash {
namespace {

// Only shares the work out: between 1024 and 16'384 no difference can be seen (decision 0073).
constexpr std::size_t kGrain = 4096;

/// Which objects of an earlier run have other names now.
class RenamedObjects {
 public:
  RenamedObjects(const std::vector<std::uint64_t>& then, std::span<const std::uint64_t> now,
                 const ObjectMap& map)
      : then_(then), now_(now), map_(map) {}

  [[nodiscard]] bool stays(model::ObjectId o) const {
    return map_.now[index(o)] != model::kNoObject;
  }
  /// The object has to be one that stays.
  [[nodiscard]] bool is_renamed(model::ObjectId o) const { return then_[index(o)] != now(o); }
  [[nodiscard]] std::uint64_t then(model::ObjectId o) const { return then_[index(o)]; }
  [[nodiscard]] std::uint64_t now(model::ObjectId o) const { return now_[map_.now[index(o)]]; }

  /// Whether a pair stays, and has an object of another name.
  template <class T>
  [[nodiscard]] bool concern(const T& pair) const {
    return stays(pair.a) && stays(pair.b) && (is_renamed(pair.a) || is_renamed(pair.b));
  }

 private:
  const std::vector<std::uint64_t>& then_;
  std::span<const std::uint64_t> now_;
  const ObjectMap& map_;
};

}  // namespace

Result<std::vector<std::uint64_t>> hashes_of_names(const model::Model& model,
                                                   const parallel::Context& context) {
  const ElementHashes elements(model);
  return parallel::transform(
      context, {.name = "hashes of ids", .n = model.objects.size(), .grain = kGrain},
      [&](std::size_t o) { return elements.of(static_cast<std::uint32_t>(o)).low; });
}

bool have_labels_of(std::span<const std::uint64_t> earlier, const model::Model& model) {
  const std::vector<model::Object>& objects = model.objects;
  if (earlier.size() != objects.size()) return false;
  const ElementHashes elements(model);
  // Objects are ordered by label: one of each tells it.
  const auto label = [&](const model::Object& o) -> std::string_view {
    return model.files[o.file].label;
  };
  for (std::size_t o = 0; o < objects.size();) {
    if (elements.of(static_cast<std::uint32_t>(o)).low != earlier[o]) return false;
    const auto end = std::ranges::upper_bound(objects, label(objects[o]), {}, label);
    o = std::max(o + 1, static_cast<std::size_t>(end - objects.begin()));
  }
  return true;
}

Result<bool> have_same_names(const Report& earlier, const model::Model& model,
                             const parallel::Context& context) {
  const auto names = hashes_of_names(model, context);
  if (!names) return names.error();
  return earlier.kept && earlier.kept->elements == *names;
}

void mark_hashed_contacts_changed(const KeptForChanges& kept, std::span<const std::uint64_t> names,
                                  ObjectMap& map) {
  const RenamedObjects renamed(kept.elements, names, map);
  for (const UnlistedContact& contact : kept.unlisted)
    if (renamed.concern(contact))
      map.count_as_changed(index(renamed.is_renamed(contact.a) ? contact.a : contact.b));
}

Result<HashChange> rehash_renamed(const Report& earlier, std::span<const std::uint64_t> names,
                                  const ObjectMap& map, const parallel::Context& context) {
  if (!map.renumbered && std::ranges::equal(earlier.kept->elements, names)) return HashChange{};
  const RenamedObjects renamed(earlier.kept->elements, names, map);
  return parallel::reduce(
      context, {.name = "pairs under other names", .n = earlier.pairs.size(), .grain = kGrain},
      HashChange{},
      [&](HashChange& change, std::size_t i) {
        const Pair& pair = earlier.pairs[i];
        if (!renamed.concern(pair)) return;
        change.gone =
            sum(change.gone, hash_of(pair, earlier, renamed.then(pair.a), renamed.then(pair.b)));
        change.came =
            sum(change.came, hash_of(pair, earlier, renamed.now(pair.a), renamed.now(pair.b)));
      },
      [](HashChange& into, const HashChange& partial) {
        into.gone = sum(into.gone, partial.gone);
        into.came = sum(into.came, partial.came);
      });
}

}  // namespace strake::clash
