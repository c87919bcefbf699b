// SPDX-License-Identifier: Apache-2.0
#include "geometry/analyse/seams.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "geometry/analyse/degenerate.hpp"
#include "geometry/box.hpp"
#include "strake/core/disjoint_sets.hpp"

namespace strake::geometry {
namespace {

/// An edge whichever way it runs; sorts by (lower vertex, higher vertex).
constexpr std::uint64_t edge_key(std::uint32_t u, std::uint32_t v) {
  return (std::uint64_t{std::min(u, v)} << 32U) | std::max(u, v);
}
constexpr std::uint32_t low_of(std::uint64_t key) { return static_cast<std::uint32_t>(key >> 32U); }
constexpr std::uint32_t high_of(std::uint64_t key) { return static_cast<std::uint32_t>(key); }

std::array<std::uint64_t, 3> keys_of(const Triangle& t) {
  return {edge_key(t[0], t[1]), edge_key(t[1], t[2]), edge_key(t[2], t[0])};
}

bool repeats_a_vertex(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// An edge of triangles without area. Those that hang together through edges lie on one line and
/// are known by the lowest of them.
struct SeamEdge {
  std::uint64_t key = 0;
  std::uint32_t line = 0;
  bool bounds = false;  ///< a triangle with an area has it, too

  friend auto operator<=>(const SeamEdge&, const SeamEdge&) = default;
};

/// Where the edges of triangles with an area are to be cut.
class Seams {
 public:
  Seams(std::size_t vertices, std::span<const Triangle> solid, std::span<const Triangle> flat)
      : on_edge_(vertices, 0) {
    list_edges(flat);
    for (const Triangle& t : solid)
      for (const std::uint64_t key : keys_of(t))
        if (const std::size_t e = find(key); e < edges_.size()) edges_[e].bounds = true;
    list_points();
  }

  [[nodiscard]] bool cut_nothing() const {
    return std::none_of(edges_.begin(), edges_.end(),
                        [&](const SeamEdge& e) { return !points_on(e).empty(); });
  }

  /// (line, vertex) of the places to cut an edge at, from its lower vertex to its higher one.
  [[nodiscard]] std::span<const std::uint64_t> points_on(std::uint64_t key) const {
    const std::size_t e = find(key);
    return e < edges_.size() ? points_on(edges_[e]) : std::span<const std::uint64_t>();
  }

 private:
  void list_edges(std::span<const Triangle> flat) {
    for (std::uint32_t f = 0; f < flat.size(); ++f)
      for (const std::uint64_t key : keys_of(flat[f])) edges_.push_back({key, f, false});
    std::sort(edges_.begin(), edges_.end());
    DisjointSets lines(flat.size());
    std::size_t count = 0;
    for (const SeamEdge& e : edges_) {
      if (count > 0 && edges_[count - 1].key == e.key)
        lines.join(edges_[count - 1].line, e.line);
      else
        edges_[count++] = e;
    }
    edges_.resize(count);
    for (SeamEdge& e : edges_) {
      e.line = lines.root(e.line);
      on_edge_[low_of(e.key)] = on_edge_[high_of(e.key)] = 1;
    }
  }

  /// Only the ends of edges with triangles on them: whatever hangs there on its own seals nothing.
  void list_points() {
    for (const SeamEdge& e : edges_) {
      if (!e.bounds) continue;
      points_.push_back(point(e.line, low_of(e.key)));
      points_.push_back(point(e.line, high_of(e.key)));
    }
    std::sort(points_.begin(), points_.end());
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
  }

  static constexpr std::uint64_t point(std::uint32_t line, std::uint32_t vertex) {
    return (std::uint64_t{line} << 32U) | vertex;
  }

  [[nodiscard]] std::span<const std::uint64_t> points_on(const SeamEdge& e) const {
    if (!e.bounds) return {};
    const auto first =
        std::upper_bound(points_.begin(), points_.end(), point(e.line, low_of(e.key)));
    const auto last = std::lower_bound(first, points_.end(), point(e.line, high_of(e.key)));
    return {first, last};
  }

  /// Past the last edge when it is none of them.
  [[nodiscard]] std::size_t find(std::uint64_t key) const {
    if (on_edge_[low_of(key)] == 0 || on_edge_[high_of(key)] == 0) return edges_.size();
    const auto at = std::lower_bound(edges_.begin(), edges_.end(), key,
                                     [](const SeamEdge& e, std::uint64_t k) { return e.key < k; });
    return at != edges_.end() && at->key == key ? static_cast<std::size_t>(at - edges_.begin())
                                                : edges_.size();
  }

  std::vector<std::uint8_t> on_edge_;  ///< per vertex: whether a seam edge ends there
  std::vector<SeamEdge> edges_;        ///< by key
  std::vector<std::uint64_t> points_;  ///< (line, vertex), ascending
};

/// Appends what a triangle is cut into, fans from the corner opposite its lowest edge to be cut,
/// and from there on. False when `most` triangles do not suffice.
bool cut_triangle(const Triangle& whole, const Seams& seams, std::size_t most,
                  std::vector<Triangle>& pieces) {
  std::vector<Triangle> left{whole};
  while (!left.empty()) {
    const Triangle t = left.back();
    left.pop_back();
    const auto keys = keys_of(t);
    std::size_t side = 3;
    for (std::size_t k = 0; k < 3; ++k)
      if (!seams.points_on(keys[k]).empty() && (side == 3 || keys[k] < keys[side])) side = k;
    if (side == 3) {
      pieces.push_back(t);
      continue;
    }
    const auto points = seams.points_on(keys[side]);
    if (pieces.size() + left.size() + points.size() > most) return false;
    const std::uint32_t from = t[side], to = t[(side + 1) % 3], top = t[(side + 2) % 3];
    std::uint32_t last = from;
    const auto add = [&](std::uint32_t v) {
      left.push_back({last, v, top});
      last = v;
    };
    for (std::size_t i = 0; i < points.size(); ++i)
      add(static_cast<std::uint32_t>(points[from < to ? i : points.size() - 1 - i]));
    add(to);
  }
  return true;
}

template <class Wide>
bool is_flat(std::span<const Vec3i> vertices, const Triangle& t) {
  return collinear<Wide>(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
}

}  // namespace

std::optional<SeamlessMesh> cut_at_seams(std::span<const Vec3i> vertices,
                                         std::span<const Triangle> triangles,
                                         std::span<const std::uint32_t> faces) {
  const bool narrow = is_narrow(box_of(vertices));
  SeamlessMesh mesh;
  std::vector<Triangle> solid, flat;
  std::vector<std::uint32_t> solid_faces;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Triangle& t = triangles[i];
    if (repeats_a_vertex(t)) continue;
    if (narrow ? is_flat<std::int64_t>(vertices, t) : is_flat<__int128>(vertices, t)) {
      flat.push_back(t);
      continue;
    }
    solid.push_back(t);
    if (!faces.empty()) solid_faces.push_back(faces[i]);
  }
  const Seams seams(vertices.size(), solid, flat);
  if (seams.cut_nothing()) return std::nullopt;
  const std::size_t most = 5 * triangles.size() + 64;
  for (std::size_t i = 0; i < solid.size(); ++i) {
    const std::size_t before = mesh.triangles.size();
    if (!cut_triangle(solid[i], seams, most, mesh.triangles)) return std::nullopt;
    mesh.cut += mesh.triangles.size() - before > 1 ? 1U : 0U;
    if (!faces.empty()) mesh.faces.resize(mesh.triangles.size(), solid_faces[i]);
  }
  return mesh;
}

}  // namespace strake::geometry
