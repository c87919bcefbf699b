// SPDX-License-Identifier: Apache-2.0
#include "support/lattice_solids.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "strake/geometry/predicates.hpp"

namespace strake::testing {

using geometry::Triangle;
using geometry::Vec3i;
using geometry::Vec3l;

namespace {

using Face = std::array<Vec3i, 3>;
using Cells = std::set<Vec3i>;

int below(std::mt19937_64& rng, int n) {
  return static_cast<int>(rng() % static_cast<std::uint64_t>(n));
}

std::int64_t volume6(const Tetrahedron& t) {
  const Vec3l u = (t[1] - t[0]).as<std::int64_t>(), v = (t[2] - t[0]).as<std::int64_t>();
  return dot(cross(u, v), (t[3] - t[0]).as<std::int64_t>());
}

/// The six tetrahedra of a box along its diagonal lo-hi: equal cells meet face to face.
std::vector<Tetrahedron> box_pieces(const Vec3i& lo, const Vec3i& hi) {
  std::vector<Tetrahedron> pieces;
  std::array<int, 3> axes{0, 1, 2};
  do {
    Tetrahedron t{lo, lo, lo, hi};
    t[1][axes[0]] = t[2][axes[0]] = hi[axes[0]];
    t[2][axes[1]] = hi[axes[1]];
    pieces.push_back(t);
  } while (std::next_permutation(axes.begin(), axes.end()));
  return pieces;
}

std::vector<Tetrahedron> cell_pieces(const Cells& cells) {
  std::vector<Tetrahedron> pieces;
  for (const Vec3i& c : cells)
    for (const Tetrahedron& t : box_pieces(c, c + Vec3i{1, 1, 1})) pieces.push_back(t);
  return pieces;
}

LatticeSolid solid_of(std::vector<Tetrahedron> pieces) {
  LatticeSolid s;
  s.mesh = surface_of(pieces);
  s.pieces = std::move(pieces);
  return s;
}

struct CellBox {
  Vec3i lo, hi;
};

CellBox random_box(std::mt19937_64& rng, int size) {
  CellBox b;
  for (int k = 0; k < 3; ++k) {
    b.lo[k] = below(rng, size);
    b.hi[k] = b.lo[k] + 1 + below(rng, size - b.lo[k]);
  }
  return b;
}

void for_cells(const CellBox& box, const auto& visit) {
  for (std::int32_t x = box.lo.x; x < box.hi.x; ++x)
    for (std::int32_t y = box.lo.y; y < box.hi.y; ++y)
      for (std::int32_t z = box.lo.z; z < box.hi.z; ++z) visit(Vec3i{x, y, z});
}

LatticeSolid plain_box(const CellBox& b) { return {box_mesh(b.lo, b.hi), box_pieces(b.lo, b.hi)}; }

/// Some boxes together, less some boxes: L and T shapes, notches, holes, cavities, loose parts.
Cells random_cells(std::mt19937_64& rng, int size) {
  Cells cells;
  while (cells.empty()) {
    for (int i = 1 + below(rng, 2); i > 0; --i)
      for_cells(random_box(rng, size), [&](const Vec3i& c) { cells.insert(c); });
    for (int i = below(rng, 3); i > 0; --i)
      for_cells(random_box(rng, size), [&](const Vec3i& c) { cells.erase(c); });
  }
  return cells;
}

/// A shell of cells round a hollow core.
Cells hollow_cells(std::mt19937_64& rng) {
  Cells cells;
  for_cells({{0, 0, 0}, {3, 3, 3}}, [&](const Vec3i& c) { cells.insert(c); });
  cells.erase({1, 1, 1});
  if (below(rng, 3) == 0) cells.erase({1, 1, 0});
  return cells;
}

bool shares_face(const Tetrahedron& a, const Tetrahedron& b) {
  int common = 0;
  for (const Vec3i& p : a) common += static_cast<int>(std::ranges::count(b, p));
  return common == 3;
}

/// A cluster of tetrahedra of the lattice grown face by face: slanted, often non-manifold.
std::vector<Tetrahedron> random_cluster(std::mt19937_64& rng, int size, int count) {
  Cells cells;
  for_cells({{0, 0, 0}, {size, size, size}}, [&](const Vec3i& c) { cells.insert(c); });
  std::vector<Tetrahedron> all = cell_pieces(cells), cluster;
  std::ranges::shuffle(all, rng);
  cluster.push_back(all.back());
  all.pop_back();
  while (static_cast<int>(cluster.size()) < count) {
    const auto next = std::ranges::find_if(all, [&](const Tetrahedron& t) {
      return std::ranges::any_of(cluster, [&](const Tetrahedron& u) { return shares_face(t, u); });
    });
    if (next == all.end()) break;
    cluster.push_back(*next);
    all.erase(next);
  }
  return cluster;
}

LatticeSolid random_tetrahedron(std::mt19937_64& rng, int size) {
  Tetrahedron t;
  do {
    for (Vec3i& p : t) p = {below(rng, size), below(rng, size), below(rng, size)};
  } while (volume6(t) == 0);
  return solid_of({t});
}

LatticeSolid random_solid(std::mt19937_64& rng) {
  switch (below(rng, 6)) {
    case 0:
      return plain_box(random_box(rng, 4));
    case 1:
      return random_tetrahedron(rng, 5);
    case 2:
      return solid_of(cell_pieces(random_cells(rng, 3)));
    case 3:
      return solid_of(cell_pieces(hollow_cells(rng)));
    default:
      return solid_of(random_cluster(rng, 2, 1 + below(rng, 10)));
  }
}

LatticeMap random_map(std::mt19937_64& rng) {
  LatticeMap m;
  if (below(rng, 2) == 0) m = axis_symmetry(below(rng, 48));
  if (below(rng, 3) == 0) m.row[static_cast<std::size_t>(below(rng, 3))] = {1, -1, 1};
  if (below(rng, 3) == 0) m.row[0] = m.row[0] * 2;
  if (m.orientation() == 0) m = {};
  for (int k = 0; k < 3; ++k) m.offset[k] = below(rng, 5) - 1;
  return m;
}

/// What is left of a block of cells when a body made of its cells' tetrahedra is taken out.
std::vector<Tetrahedron> rest_of(const Cells& block, const std::vector<Tetrahedron>& taken) {
  std::vector<Tetrahedron> rest;
  for (const Tetrahedron& t : cell_pieces(block))
    if (std::ranges::find(taken, t) == taken.end()) rest.push_back(t);
  return rest;
}

LatticePair fitted_pair(std::mt19937_64& rng) {
  Cells block;
  for_cells({{0, 0, 0}, {2 + below(rng, 2), 2, 2}}, [&](const Vec3i& c) { block.insert(c); });
  std::vector<Tetrahedron> cluster = random_cluster(rng, 2, 1 + below(rng, 14));
  std::vector<Tetrahedron> rest = rest_of(block, cluster);
  if (rest.empty()) rest = cluster;
  return {solid_of(std::move(cluster)), solid_of(std::move(rest)), "fitted"};
}

LatticePair nested_pair(std::mt19937_64& rng) {
  std::vector<Tetrahedron> outer = random_cluster(rng, 2, 4 + below(rng, 12)), inner;
  for (const Tetrahedron& t : outer)
    if (below(rng, 3) != 0) inner.push_back(t);
  if (inner.empty()) inner.push_back(outer.front());
  return {solid_of(std::move(inner)), solid_of(std::move(outer)), "nested"};
}

}  // namespace

Vec3i LatticeMap::operator()(const Vec3i& p) const {
  return Vec3i{dot(row[0], p), dot(row[1], p), dot(row[2], p)} + offset;
}

int LatticeMap::orientation() const {
  const geometry::Int128 d = geometry::det_exact(
      row[0].as<std::int64_t>(), row[1].as<std::int64_t>(), row[2].as<std::int64_t>());
  return (d > 0) - (d < 0);
}

IndexedMesh mapped(const IndexedMesh& mesh, const LatticeMap& map) {
  IndexedMesh r = mesh;
  for (Vec3i& v : r.vertices) v = map(v);
  return map.orientation() < 0 ? r.flipped() : r;
}

LatticeSolid mapped(const LatticeSolid& solid, const LatticeMap& map) {
  LatticeSolid r{mapped(solid.mesh, map), solid.pieces};
  for (Tetrahedron& t : r.pieces)
    for (Vec3i& p : t) p = map(p);
  return r;
}

LatticeMap axis_symmetry(int index) {
  std::array<int, 3> axes{0, 1, 2};
  for (int i = 0; i < index / 8; ++i) std::next_permutation(axes.begin(), axes.end());
  LatticeMap m;
  for (std::size_t k = 0; k < 3; ++k) {
    m.row[k] = {};
    m.row[k][axes[k]] = ((index >> k) & 1) != 0 ? -1 : 1;
  }
  return m;
}

IndexedMesh surface_of(const std::vector<Tetrahedron>& pieces) {
  std::map<Face, std::vector<Face>> faces;  // by sorted corners: the outward triangles
  for (const Tetrahedron& t : pieces) {
    const bool positive = volume6(t) > 0;
    for (std::size_t i = 0; i < 4; ++i) {
      Face f{t[(i + 1) % 4], t[(i + 2) % 4], t[(i + 3) % 4]};
      // Leaving out an odd corner of a positive tetrahedron gives an inward triangle.
      if (positive == (i % 2 == 1)) std::swap(f[1], f[2]);
      Face key = f;
      std::ranges::sort(key);
      faces[key].push_back(f);
    }
  }
  IndexedMesh m;
  for (const auto& [key, triangles] : faces) {
    if (triangles.size() != 1) continue;
    const auto base = static_cast<std::uint32_t>(m.vertices.size());
    m.vertices.insert(m.vertices.end(), triangles[0].begin(), triangles[0].end());
    m.triangles.push_back({base, base + 1, base + 2});
  }
  return m;
}

LatticePair random_pair(std::mt19937_64& rng) {
  LatticePair pair;
  switch (below(rng, 8)) {
    case 0:
      pair = fitted_pair(rng);
      break;
    case 1:
      pair = nested_pair(rng);
      break;
    case 2: {
      const LatticeSolid solid = random_solid(rng);
      pair = {solid, solid, "shifted copy"};
      for (int i = below(rng, 3); i > 0; --i) {
        LatticeMap shift;
        shift.offset[below(rng, 3)] = 1;
        pair.b = mapped(pair.b, shift);
      }
      break;
    }
    case 3: {
      // The one often whole inside the other, or in its cavity, touching here and there.
      LatticeMap triple, shift;
      for (Vec3i& row : triple.row) row = row * 3;
      for (int k = 0; k < 3; ++k) shift.offset[k] = below(rng, 8);
      pair = {mapped(random_solid(rng), triple), mapped(random_solid(rng), shift),
              "small in large"};
      break;
    }
    default: {
      LatticeMap coarse;
      const int factor = 1 + below(rng, 3);
      for (Vec3i& row : coarse.row) row = row * factor;
      pair = {mapped(random_solid(rng), coarse), mapped(random_solid(rng), random_map(rng)),
              "free"};
    }
  }
  if (below(rng, 2) == 0) std::swap(pair.a, pair.b);
  return pair;
}

IndexedMesh random_sheet(std::mt19937_64& rng) {
  const std::vector<Tetrahedron> pieces = random_cluster(rng, 2, 4 + below(rng, 8));
  std::set<Face> faces;
  for (const Tetrahedron& t : pieces)
    for (std::size_t i = 0; i < 4; ++i) {
      Face f{t[(i + 1) % 4], t[(i + 2) % 4], t[(i + 3) % 4]};
      std::ranges::sort(f);
      faces.insert(f);
    }
  IndexedMesh m;
  const int keep = 2 + below(rng, 4);
  for (const Face& f : faces) {
    if (below(rng, keep) != 0) continue;
    const auto base = static_cast<std::uint32_t>(m.vertices.size());
    m.vertices.insert(m.vertices.end(), f.begin(), f.end());
    m.triangles.push_back({base, base + 1, base + 2});
  }
  if (m.triangles.empty()) m = quad_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 1});
  return mapped(m, random_map(rng));
}

IndexedMesh subdivided(const IndexedMesh& mesh) {
  IndexedMesh m;
  for (const Triangle& t : mesh.triangles) {
    const Vec3i a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
    const auto middle = [](const Vec3i& p, const Vec3i& q) {
      const Vec3l s = p.as<std::int64_t>() + q.as<std::int64_t>();
      return Vec3l{s.x / 2, s.y / 2, s.z / 2}.as<std::int32_t>();
    };
    const Vec3i ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Face& f : {Face{a, ab, ca}, Face{ab, b, bc}, Face{ca, bc, c}, Face{ab, bc, ca}}) {
      const auto base = static_cast<std::uint32_t>(m.vertices.size());
      m.vertices.insert(m.vertices.end(), f.begin(), f.end());
      m.triangles.push_back({base, base + 1, base + 2});
    }
  }
  return m;
}

IndexedMesh shuffled(const IndexedMesh& mesh, std::mt19937_64& rng) {
  std::vector<std::uint32_t> place(mesh.vertices.size());
  std::iota(place.begin(), place.end(), 0U);
  std::ranges::shuffle(place, rng);
  IndexedMesh r = mesh;
  for (std::size_t i = 0; i < place.size(); ++i) r.vertices[place[i]] = mesh.vertices[i];
  for (Triangle& t : r.triangles) {
    for (std::uint32_t& v : t) v = place[v];
    std::rotate(t.begin(), t.begin() + below(rng, 3), t.end());
  }
  std::ranges::shuffle(r.triangles, rng);
  return r;
}

}  // namespace strake::testing
