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

/// What the connectivity of a welded mesh follows from: the mesh as it came but for coordinates,
/// and the number of each of its vertices in the order of coordinates.
struct MeshKey {
  std::span<const Triangle> triangles;
  std::span<const std::uint32_t> faces;
  std::span<const std::uint32_t> renumbered;
};

/// The connectivity of a mesh that is one shell without anything to mend, as its part holds it.
struct Connectivity {
  SharedArray<Triangle> triangles;
  SharedArray<std::uint32_t> faces;
  SharedArray<PartEdge> edges;
  SharedArray<std::uint32_t> edge_triangles;
  /// Whether there are T-junctions among these hangs on coordinates.
  SharedArray<std::uint32_t> uneven, folded;
  bool closed = false;
  bool inverted = false;  ///< the triangles are turned over from how they came
};

/// Connectivities that came more than once. Plants and ships hold the same few pipes, elbows and
/// profiles in all sizes: each of them needs its edges found only once, and held only once, which
/// is what counts (decision 0013). Bounded; what is not remembered is
/// worked out again.
class ConnectivityCache {
 public:
  /// Null where it is not known.
  [[nodiscard]] const Connectivity* find(const MeshKey& key);
  /// Whether it should be remembered: the last find() was not the first one with this key.
  [[nodiscard]] bool should_store_last() const { return wants_last_; }
  /// Remembers what the last find() asked for.
  void store(const MeshKey& key, Connectivity connectivity);

 private:
  struct Entry {
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> faces, renumbered;
    Connectivity connectivity;
  };
  static constexpr std::size_t kMostBytes = std::size_t{32} << 20U;
  static constexpr std::size_t kSeen = 4096;

  std::unordered_map<std::uint64_t, std::unique_ptr<Entry>> entries_;
  std::vector<std::uint64_t> seen_ = std::vector<std::uint64_t>(kSeen, 0);
  std::uint64_t last_hash_ = 0;
  bool wants_last_ = false;
  std::size_t bytes_ = 0;
};

}  // namespace strake::geometry
