// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "strake/core/shared_array.hpp"
#include "strake/geometry/part.hpp"

namespace strake::geometry {

/// What determines the connectivity of a welded mesh: the source mesh without coordinates, and the
/// rank of each of its vertices in the order of coordinates.
struct MeshKey {
  std::span<const Triangle> triangles;
  std::span<const std::uint32_t> faces;
  std::span<const std::uint32_t> renumbered;
};

/// The connectivity of a mesh that is one shell without anything to repair, as its part holds it.
struct Connectivity {
  SharedArray<Triangle> triangles;
  SharedArray<std::uint32_t> faces;
  SharedArray<PartEdge> edges;
  SharedArray<std::uint32_t> edge_triangles;
  /// Edges that may be T-junctions, which depends on coordinates.
  SharedArray<std::uint32_t> uneven, folded;
  bool closed = false;
  bool inverted = false;  ///< the triangles are flipped against the source
};

/// A cache of connectivities that occur more than once. Plants and ships hold the same few pipes,
/// elbows and profiles in all sizes: the edges of each need to be found only once and, above all,
/// stored only once (decision 0013). It is bounded; what it lacks is
/// computed again.
class ConnectivityCache {
 public:
  /// Returns the connectivity for a key; null where it is not stored.
  [[nodiscard]] const Connectivity* find(const MeshKey& key);
  /// Whether the connectivity should be stored: the last find() was not the first one with this
  /// key.
  [[nodiscard]] bool should_store_last() const { return should_store_last_; }
  /// Stores the connectivity for the key of the last find().
  void store(const MeshKey& key, Connectivity connectivity);

 private:
  struct Entry {
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> faces, renumbered;
    Connectivity connectivity;
  };
  // A few dozen connectivities make up a plant of 100,000 meshes, of which 99 % repeat one. With
  // them its mesh checks take 0.55 of their time, its run 0.7 of the memory (decision 0013).
  static constexpr std::size_t kMaxBytes = std::size_t{32} << 20U;
  static constexpr std::size_t kRecentHashes = 4096;

  std::unordered_map<std::uint64_t, std::unique_ptr<Entry>> entries_;
  std::vector<std::uint64_t> recent_hashes_ = std::vector<std::uint64_t>(kRecentHashes, 0);
  std::uint64_t last_hash_ = 0;
  bool should_store_last_ = false;
  std::size_t bytes_ = 0;
};

}  // namespace strake::geometry
