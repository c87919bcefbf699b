// SPDX-License-Identifier: Apache-2.0
#include "geometry/mesh_repair/topology.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace strake::geometry {
namespace {

/// A triangle at an edge, in the bucket of the edge's lower vertex: sorts by higher vertex, then by
/// triangle. Fits: three entries per triangle are numbered with 32 bits.
constexpr std::uint64_t half_edge(std::uint32_t high, std::size_t triangle, bool back) {
  return (std::uint64_t{high} << 32U) | (triangle << 1U) | (back ? 1U : 0U);
}
constexpr std::uint32_t high_of(std::uint64_t half) {
  return static_cast<std::uint32_t>(half >> 32U);
}
constexpr std::uint32_t triangle_of(std::uint64_t half) {
  return static_cast<std::uint32_t>(half) >> 1U;
}

void sort_bucket(std::span<std::uint64_t> bucket) {
  if (bucket.size() > 32) {
    std::sort(bucket.begin(), bucket.end());
    return;
  }
  for (std::size_t i = 1; i < bucket.size(); ++i) {
    const std::uint64_t moved = bucket[i];
    std::size_t k = i;
    for (; k > 0 && bucket[k - 1] > moved; --k) bucket[k] = bucket[k - 1];
    bucket[k] = moved;
  }
}

/// A triangle round an edge.
struct Spoke {
  std::uint32_t triangle = 0;
  int sense = 0;
  Vec3l arm;     ///< from the edge's first vertex to the corner off the edge
  int half = 0;  ///< angle from the first spoke: 0 in [0, pi), 1 in [pi, 2 pi)
};

/// The triangles round an edge whose shells, as known so far, do not balance there.
class Fan {
 public:
  Fan(std::span<const Vec3i> vertices, std::span<const Triangle> triangles,
      const Topology& topology)
      : vertices_(vertices), triangles_(triangles), topology_(topology) {}

  void gather(std::size_t edge, UnionFind& sets) {
    nets_.clear();
    for (const std::uint32_t t : topology_.triangles_of(edge))
      nets_.push_back({sets.root(t), topology_.sense(edge, triangles_[t]), t});
    std::sort(nets_.begin(), nets_.end());
    spokes_.clear();
    for (std::size_t i = 0; i < nets_.size();) {
      std::size_t end = i;
      int sum = 0;
      for (; end < nets_.size() && nets_[end].set == nets_[i].set; ++end) sum += nets_[end].sense;
      for (; i < end; ++i)
        if (sum != 0) spokes_.push_back({nets_[i].triangle, nets_[i].sense, {}, 0});
    }
  }
  [[nodiscard]] const std::vector<Spoke>& spokes() const { return spokes_; }

  /// Joins the two triangles on either side of each wedge of material. A triangle that runs along
  /// the edge has its material at smaller angles, seen along the edge.
  void join_wedges(std::size_t edge, UnionFind& sets) {
    sort_by_angle(edge);
    end_before_beginning(edge);
    std::vector<std::uint32_t> opened, unmatched;
    for (const Spoke& s : spokes_) {
      if (s.sense < 0) {
        opened.push_back(s.triangle);
      } else if (opened.empty()) {
        unmatched.push_back(s.triangle);
      } else {
        sets.join(opened.back(), s.triangle);
        opened.pop_back();
      }
    }
    // Wedges across the start of the round.
    for (const std::uint32_t t : unmatched) {
      if (opened.empty()) break;
      sets.join(opened.back(), t);
      opened.pop_back();
    }
  }

 private:
  struct Net {
    std::uint32_t set = 0;
    int sense = 0;
    std::uint32_t triangle = 0;
    friend auto operator<=>(const Net&, const Net&) = default;
  };

  /// Sign of axis x a · b: positive when b lies less than half a turn after a.
  [[nodiscard]] static int turn(const Vec3l& axis, const Vec3l& a, const Vec3l& b) {
    using Wide = __int128;
    const Wide value = b.x * (Wide{axis.y} * a.z - Wide{axis.z} * a.y) +
                       b.y * (Wide{axis.z} * a.x - Wide{axis.x} * a.z) +
                       b.z * (Wide{axis.x} * a.y - Wide{axis.y} * a.x);
    return value > 0 ? 1 : value < 0 ? -1 : 0;
  }

  void sort_by_angle(std::size_t edge) {
    const PartEdge& e = topology_.edges[edge];
    const Vec3l from = vertices_[e.v0].as<std::int64_t>();
    const Vec3l axis = vertices_[e.v1].as<std::int64_t>() - from;
    for (Spoke& s : spokes_)
      s.arm = vertices_[opposite_vertex(triangles_[s.triangle], e)].as<std::int64_t>() - from;
    const Vec3d first = cross(axis.as<double>(), spokes_[0].arm.as<double>());
    for (Spoke& s : spokes_) {
      const int side = turn(axis, spokes_[0].arm, s.arm);
      // In the plane of the first spoke the normals are parallel: the sign of their product is
      // safe in doubles.
      const bool behind = dot(first, cross(axis.as<double>(), s.arm.as<double>())) < 0;
      s.half = side < 0 || (side == 0 && behind) ? 1 : 0;
    }
    std::sort(spokes_.begin(), spokes_.end(), [&](const Spoke& a, const Spoke& b) {
      if (a.half != b.half) return a.half < b.half;
      const int order = turn(axis, a.arm, b.arm);
      // At one angle material ends before other material begins: solids back to back stay apart.
      if (order != 0) return order > 0;
      return a.sense != b.sense ? a.sense > b.sense : a.triangle < b.triangle;
    });
  }

  /// Whether two half-planes coincide up to the snap: those of two triangles of one flat face,
  /// triangulated along different diagonals.
  [[nodiscard]] static bool coincide(const Vec3d& axis, const Vec3d& a, const Vec3d& b) {
    constexpr double kSnapUnits = 4;     // grid units
    constexpr double kSmall = 1.0 / 64;  // of an angle
    const Vec3d n = cross(axis, a), m = cross(axis, b), sine = cross(n, m);
    const double nn = dot(n, n), mm = dot(m, m), off_a = dot(m, a), off_b = dot(n, b);
    return dot(n, m) > 0 && dot(sine, sine) <= kSmall * kSmall * nn * mm &&
           (off_a * off_a <= kSnapUnits * kSnapUnits * mm ||
            off_b * off_b <= kSnapUnits * kSnapUnits * nn);
  }

  /// For surfaces drawn from both sides: where material begins and ends at one angle up to the
  /// snap, it ends first, or each face would be a thin body of its own.
  void end_before_beginning(std::size_t edge) {
    const PartEdge& e = topology_.edges[edge];
    const Vec3d axis = vertices_[e.v1].as<double>() - vertices_[e.v0].as<double>();
    const auto one = [&](const Spoke& a, const Spoke& b) {
      return coincide(axis, a.arm.as<double>(), b.arm.as<double>());
    };
    // Round the edge any start is as good, but for one amid such spokes.
    for (std::size_t i = 0; i < spokes_.size() && one(spokes_.back(), spokes_.front()); ++i)
      std::rotate(spokes_.begin(), spokes_.begin() + 1, spokes_.end());
    for (std::size_t i = 1; i < spokes_.size(); ++i)
      for (std::size_t j = i; j > 0; --j) {
        if (spokes_[j - 1].sense > 0 || spokes_[j].sense < 0 || !one(spokes_[j - 1], spokes_[j]))
          break;
        std::swap(spokes_[j - 1], spokes_[j]);
      }
  }

  std::span<const Vec3i> vertices_;
  std::span<const Triangle> triangles_;
  const Topology& topology_;
  std::vector<Net> nets_;
  std::vector<Spoke> spokes_;
};

/// Whether two triangles with one edge in common have the third corner in common, too.
bool are_opposite(const Triangle& a, const Triangle& b) {
  return (a[0] ^ a[1] ^ a[2]) == (b[0] ^ b[1] ^ b[2]);
}

/// Half-edges by (lower vertex, higher vertex, triangle); scratch.first holds the bucket starts.
std::span<const std::uint64_t> sorted_halves(std::size_t vertices,
                                             std::span<const Triangle> triangles,
                                             TopologyScratch& scratch) {
  const std::span<std::uint32_t> first = first_n(scratch.first, vertices + 1);
  std::fill(first.begin(), first.end(), 0U);
  const auto each = [&](auto&& visit) {
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        visit(triangles[t][k], triangles[t][k == 2 ? 0 : k + 1], t);
  };
  each([&](std::uint32_t u, std::uint32_t v, std::size_t) { ++first[std::min(u, v) + 1]; });
  const std::span<std::uint32_t> next = first_n(scratch.next, vertices + 1);
  next[0] = 0;
  for (std::size_t v = 1; v < first.size(); ++v) next[v] = first[v] += first[v - 1];
  const std::span<std::uint64_t> halves = first_n(scratch.halves, triangles.size() * 3);
  each([&](std::uint32_t u, std::uint32_t v, std::size_t t) {
    halves[next[std::min(u, v)]++] = half_edge(std::max(u, v), t, u > v);
  });
  for (std::size_t v = 0; v < vertices; ++v)
    sort_bucket(halves.subspan(first[v], first[v + 1] - first[v]));
  return halves;
}

}  // namespace

Topology make_topology(std::size_t vertices, std::span<const Triangle> triangles,
                       TopologyScratch& scratch) {
  const std::span<const std::uint64_t> halves = sorted_halves(vertices, triangles, scratch);
  const std::span<PartEdge> edges = first_n(scratch.edges, halves.size() + 1);
  const std::span<std::uint32_t> around = first_n(scratch.edge_triangles, halves.size());
  scratch.uneven.clear();
  scratch.folded.clear();
  std::uint32_t count = 0;
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const std::uint32_t last = scratch.first[v + 1];
    for (std::uint32_t i = scratch.first[v]; i < last;) {
      const std::uint32_t begin = i, high = high_of(halves[begin]);
      for (; i < last && high_of(halves[i]) == high; ++i) around[i] = triangle_of(halves[i]);
      edges[count] = {v, high, begin};
      const bool even = i - begin == 2 && ((halves[begin] ^ halves[begin + 1]) & 1U) != 0;
      if (!even)
        scratch.uneven.push_back(count);
      else if (are_opposite(triangles[around[begin]], triangles[around[begin + 1]]))
        scratch.folded.push_back(count);
      ++count;
    }
  }
  edges[count] = {0, 0, static_cast<std::uint32_t>(halves.size())};
  return {edges.first(count + 1), around, scratch.uneven, scratch.folded};
}

ShellLabels label_shells(std::span<const Vec3i> vertices, std::span<const Triangle> triangles,
                         const Topology& topology, TopologyScratch& scratch) {
  UnionFind& sets = scratch.sets;
  sets.reset(triangles.size());
  for (std::size_t e = 0; e + 1 < topology.edges.size(); ++e) {
    const auto around = topology.triangles_of(e);
    if (around.size() == 2) sets.join(around[0], around[1]);
  }
  std::vector<std::uint32_t> open_at;  // a triangle of each edge that does not balance
  std::vector<std::size_t> crowded;    // edges with more than two triangles
  for (const std::uint32_t e : topology.uneven) {
    const auto around = topology.triangles_of(e);
    if (around.size() > 2)
      crowded.push_back(e);
    else
      open_at.push_back(around[0]);
  }
  Fan fan(vertices, triangles, topology);
  for (const std::size_t e : crowded) {
    fan.gather(e, sets);
    if (!fan.spokes().empty()) fan.join_wedges(e, sets);
  }
  for (const std::size_t e : crowded) {
    fan.gather(e, sets);
    for (const Spoke& s : fan.spokes()) open_at.push_back(s.triangle);
  }

  ShellLabels labels;
  labels.closed.assign(sets.count(), 1);
  if (sets.count() == 1) {
    labels.count = 1;
    if (!open_at.empty()) labels.closed[0] = 0;
    return labels;
  }
  labels.shell.resize(triangles.size());
  for (std::uint32_t t = 0; t < labels.shell.size(); ++t) {
    const std::uint32_t root = sets.root(t);
    labels.shell[t] = root == t ? labels.count++ : labels.shell[root];
  }
  for (const std::uint32_t t : open_at) labels.closed[labels.shell[t]] = 0;
  return labels;
}

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

std::uint64_t orient_consistently(GridMesh& welded, const Topology& topology) {
  const auto has_two = [&](std::uint32_t e) { return topology.triangles_of(e).size() == 2; };
  if (std::ranges::none_of(topology.uneven, has_two)) return 0;
  Surfaces surfaces(welded, topology);
  std::uint64_t turned = 0;
  for (const std::uint32_t e : topology.uneven)
    if (has_two(e)) turned += surfaces.turn_from(topology.triangles_of(e)[0]);
  return turned;
}

}  // namespace strake::geometry
