// SPDX-License-Identifier: Apache-2.0
#include "geometry/analyse/facing_one_way.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace strake::geometry {
namespace {

class Surfaces {
 public:
  Surfaces(GridMesh& mesh, const Topology& topology)
      : mesh_(mesh),
        topology_(topology),
        edges_(mesh.triangles.size()),
        facing_(mesh.triangles.size(), Facing::unknown) {
    std::vector<std::uint8_t> known(mesh.triangles.size(), 0);
    for (std::uint32_t e = 0; e + 1 < topology.edges.size(); ++e)
      for (const std::uint32_t t : topology.triangles_of(e)) edges_[t][known[t]++] = e;
  }

  std::uint64_t turn_from(std::uint32_t start) {
    if (facing_[start] != Facing::unknown || !flood(start)) return 0;
    std::ranges::sort(members_);
    const auto count = [&](Facing f) {
      return std::ranges::count_if(members_, [&](std::uint32_t t) { return facing_[t] == f; });
    };
    const auto one = count(Facing::one), other = count(Facing::other);
    Facing wrong = one < other ? Facing::one : Facing::other;
    if (one == other)
      wrong = facing_[members_.front()] == Facing::one ? Facing::other : Facing::one;
    for (const std::uint32_t t : members_)
      if (facing_[t] == wrong) std::swap(mesh_.triangles[t][1], mesh_.triangles[t][2]);
    return static_cast<std::uint64_t>(std::min(one, other));
  }

 private:
  enum class Facing : std::uint8_t { unknown, one, other };

  /// Fills `members_` with the surface that a triangle is of; false where its edges do not have two
  /// triangles each, or it has no two sides.
  bool flood(std::uint32_t start) {
    bool sound = true;
    members_.assign(1, start);
    facing_[start] = Facing::one;
    for (std::size_t i = 0; i < members_.size(); ++i) {
      const std::uint32_t t = members_[i];
      for (const std::uint32_t e : edges_[t]) {
        const auto around = topology_.triangles_of(e);
        if (around.size() != 2) {
          sound = false;
          continue;
        }
        const std::uint32_t beside = around[0] == t ? around[1] : around[0];
        const bool same =
            topology_.sense(e, mesh_.triangles[t]) != topology_.sense(e, mesh_.triangles[beside]);
        const Facing wanted = same == (facing_[t] == Facing::one) ? Facing::one : Facing::other;
        if (facing_[beside] == Facing::unknown) {
          facing_[beside] = wanted;
          members_.push_back(beside);
        }
        sound = sound && facing_[beside] == wanted;
      }
    }
    return sound;
  }

  GridMesh& mesh_;
  const Topology& topology_;
  std::vector<std::array<std::uint32_t, 3>> edges_;  ///< by triangle
  std::vector<Facing> facing_;
  std::vector<std::uint32_t> members_;
};

}  // namespace

std::uint64_t turn_to_face_one_way(GridMesh& welded, const Topology& topology) {
  const auto has_two = [&](std::uint32_t e) { return topology.triangles_of(e).size() == 2; };
  if (std::ranges::none_of(topology.uneven, has_two)) return 0;
  Surfaces surfaces(welded, topology);
  std::uint64_t turned = 0;
  for (const std::uint32_t e : topology.uneven)
    if (has_two(e)) turned += surfaces.turn_from(topology.triangles_of(e)[0]);
  return turned;
}

}  // namespace strake::geometry
