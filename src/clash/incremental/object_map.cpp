// SPDX-License-Identifier: Apache-2.0
#include "clash/incremental/object_map.hpp"

#include <algorithm>
#include <iterator>

namespace strake::clash {
namespace {

/// Marks as changed what a longest ascending subsequence of the numbers leaves out (patience
/// sorting: pile k holds the smallest number that ends an ascending run of k + 1).
void keep_ascending(std::vector<std::uint32_t>& now) {
  std::vector<std::uint32_t> piles, before(now.size(), model::kNoObject);  // both by object before
  for (std::uint32_t o = 0; o < now.size(); ++o) {
    if (now[o] == model::kNoObject) continue;
    const auto pile =
        std::ranges::lower_bound(piles, now[o], {}, [&](std::uint32_t last) { return now[last]; });
    if (pile != piles.begin()) before[o] = *std::prev(pile);
    if (pile == piles.end())
      piles.push_back(o);
    else
      *pile = o;
  }
  std::vector<bool> kept(now.size(), false);
  for (std::uint32_t o = piles.empty() ? model::kNoObject : piles.back(); o != model::kNoObject;
       o = before[o])
    kept[o] = true;
  for (std::size_t o = 0; o < now.size(); ++o)
    if (!kept[o]) now[o] = model::kNoObject;
}

bool is_ascending(std::span<const std::uint32_t> now) {
  std::uint32_t next = 0;
  for (const std::uint32_t o : now) {
    if (o == model::kNoObject) continue;
    if (o < next) return false;
    next = o + 1;
  }
  return true;
}

/// Whether all objects that stay have the numbers that they had, as they nearly always do.
bool is_in_place(std::span<const std::uint32_t> now, std::size_t objects) {
  if (now.size() != objects) return false;
  for (std::uint32_t o = 0; o < now.size(); ++o)
    if (now[o] != o && now[o] != model::kNoObject) return false;
  return true;
}

}  // namespace

void ObjectMap::count_as_changed(std::uint32_t object) {
  before[now[object]] = model::kNoObject;
  now[object] = model::kNoObject;
  ++changed;
}

Result<ObjectMap> map_objects(std::span<const std::uint32_t> now, std::size_t objects) {
  if (is_in_place(now, objects)) {
    ObjectMap map;
    map.now.assign(now.begin(), now.end());
    map.before = map.now;
    map.changed = static_cast<std::size_t>(std::ranges::count(now, model::kNoObject));
    return map;
  }
  const Error misfit{ErrorCode::usage, "the objects of an earlier run are not mapped to these",
                     "earlier run", "map each to an object of this scene, and no two to one"};
  std::vector<bool> taken(objects, false);
  for (const std::uint32_t o : now) {
    if (o == model::kNoObject) continue;
    if (o >= objects || taken[o]) return misfit;
    taken[o] = true;
  }
  ObjectMap map;
  map.now.assign(now.begin(), now.end());
  if (!is_ascending(map.now)) keep_ascending(map.now);
  map.before.assign(objects, model::kNoObject);
  std::size_t kept = 0;
  for (std::uint32_t o = 0; o < map.now.size(); ++o) {
    if (map.now[o] == model::kNoObject) continue;
    map.before[map.now[o]] = o;
    map.renumbered = map.renumbered || map.now[o] != o;
    ++kept;
  }
  map.changed = objects - kept;
  return map;
}

}  // namespace strake::clash
