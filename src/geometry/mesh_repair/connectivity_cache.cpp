// SPDX-License-Identifier: Apache-2.0
#include "geometry/mesh_repair/connectivity_cache.hpp"

#include <cstring>
#include <utility>

#include "strake/core/hash.hpp"

namespace strake::geometry {
namespace {

std::uint64_t hash_of(const MeshKey& key) {
  const std::uint64_t triangles = hash_bytes(std::as_bytes(key.triangles)).low;
  const std::uint64_t faces = hash_bytes(std::as_bytes(key.faces)).low;
  const std::uint64_t order = hash_bytes(std::as_bytes(key.renumbered)).low;
  return triangles * 3 + faces * 5 + order;
}

std::size_t bytes_of(const MeshKey& key) {
  // The edges of a triangle take about as much again as the triangle, three times over.
  return key.triangles.size_bytes() * 4 + key.faces.size_bytes() * 2 + key.renumbered.size_bytes();
}

template <class T>
bool same(const std::vector<T>& a, std::span<const T> b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), b.size_bytes()) == 0);
}

}  // namespace

const Connectivity* ConnectivityCache::find(const MeshKey& key) {
  last_hash_ = hash_of(key);
  should_store_last_ = false;
  const auto at = entries_.find(last_hash_);
  if (at == entries_.end()) {
    // Most meshes of some models come only once: those cost a look and a word.
    std::uint64_t& recent = recent_hashes_[last_hash_ % kRecentHashes];
    should_store_last_ = recent == last_hash_ && bytes_ + bytes_of(key) <= kMaxBytes;
    recent = last_hash_;
    return nullptr;
  }
  const Entry& entry = *at->second;
  const bool equal = same(entry.triangles, key.triangles) && same(entry.faces, key.faces) &&
                     same(entry.renumbered, key.renumbered);
  return equal ? &entry.connectivity : nullptr;
}

void ConnectivityCache::store(const MeshKey& key, Connectivity connectivity) {
  bytes_ += bytes_of(key);
  entries_.emplace(last_hash_,
                   std::make_unique<Entry>(Entry{{key.triangles.begin(), key.triangles.end()},
                                                 {key.faces.begin(), key.faces.end()},
                                                 {key.renumbered.begin(), key.renumbered.end()},
                                                 std::move(connectivity)}));
}

}  // namespace strake::geometry
