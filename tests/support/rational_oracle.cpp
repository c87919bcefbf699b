// SPDX-License-Identifier: Apache-2.0
#include "support/rational_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace strake::testing {

using geometry::Triangle;
using geometry::Vec3i;

namespace {

RationalPoint rational(const Vec3i& p) { return {mpq_class(p.x), mpq_class(p.y), mpq_class(p.z)}; }

RationalPoint difference(const RationalPoint& a, const RationalPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

mpq_class inner(const RationalPoint& a, const RationalPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

RationalPoint outer(const RationalPoint& a, const RationalPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

RationalPoint between(const RationalPoint& p, const RationalPoint& q, const mpq_class& t) {
  return {p[0] + (q[0] - p[0]) * t, p[1] + (q[1] - p[1]) * t, p[2] + (q[2] - p[2]) * t};
}

/// normal · x <= limit.
struct HalfSpace {
  RationalPoint normal;
  mpq_class limit;

  [[nodiscard]] mpq_class excess(const RationalPoint& p) const { return inner(normal, p) - limit; }
};

/// The half-space that holds `inside`, bounded by the plane of three points.
HalfSpace half_space(const RationalPoint& p, const RationalPoint& q, const RationalPoint& r,
                     const RationalPoint& inside) {
  HalfSpace h{outer(difference(q, p), difference(r, p)), 0};
  h.limit = inner(h.normal, p);
  if (h.excess(inside) > 0) {
    for (mpq_class& c : h.normal) c = -c;
    h.limit = -h.limit;
  }
  return h;
}

std::array<HalfSpace, 4> half_spaces(const Tetrahedron& t) {
  std::array<HalfSpace, 4> r;
  for (std::size_t i = 0; i < 4; ++i)
    r[i] = half_space(rational(t[(i + 1) % 4]), rational(t[(i + 2) % 4]), rational(t[(i + 3) % 4]),
                      rational(t[i]));
  return r;
}

using RationalTet = std::array<RationalPoint, 4>;

/// Splits the part of a tetrahedron inside a half-space into tetrahedra.
void clip(const RationalTet& t, const HalfSpace& h, std::vector<RationalTet>& out) {
  std::vector<std::size_t> in, off;
  std::array<mpq_class, 4> e;
  for (std::size_t i = 0; i < 4; ++i) {
    e[i] = h.excess(t[i]);
    (e[i] <= 0 ? in : off).push_back(i);
  }
  const auto cut = [&](std::size_t i, std::size_t j) {
    return between(t[i], t[j], e[i] / (e[i] - e[j]));
  };
  if (off.empty()) {
    out.push_back(t);
  } else if (in.size() == 1) {
    out.push_back({t[in[0]], cut(in[0], off[0]), cut(in[0], off[1]), cut(in[0], off[2])});
  } else if (in.size() == 2) {
    const RationalPoint p0 = cut(in[0], off[0]), p1 = cut(in[0], off[1]);
    const RationalPoint q0 = cut(in[1], off[0]), q1 = cut(in[1], off[1]);
    out.push_back({t[in[0]], p0, p1, t[in[1]]});
    out.push_back({p0, p1, t[in[1]], q0});
    out.push_back({p1, t[in[1]], q0, q1});
  } else if (in.size() == 3) {
    const RationalPoint p = cut(in[0], off[0]), q = cut(in[1], off[0]), r = cut(in[2], off[0]);
    out.push_back({t[in[0]], t[in[1]], t[in[2]], p});
    out.push_back({t[in[1]], t[in[2]], p, q});
    out.push_back({t[in[2]], p, q, r});
  }
}

mpq_class volume6(const RationalTet& t) {
  return abs(inner(outer(difference(t[1], t[0]), difference(t[2], t[0])), difference(t[3], t[0])));
}

using Polygon = std::vector<RationalPoint>;

Polygon clip(const Polygon& polygon, const HalfSpace& h) {
  Polygon r;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const RationalPoint &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const mpq_class ep = h.excess(p), eq = h.excess(q);
    if (ep <= 0) r.push_back(p);
    if ((ep < 0 && eq > 0) || (ep > 0 && eq < 0)) r.push_back(between(p, q, ep / (ep - eq)));
  }
  return r;
}

/// Area of the projection that keeps it largest for the given plane.
mpq_class projected_area(const Polygon& polygon, std::size_t axis) {
  mpq_class sum = 0;
  const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const RationalPoint &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    sum += p[x] * q[y] - p[y] * q[x];
  }
  return abs(sum) / 2;
}

std::array<RationalPoint, 3> corners(const IndexedMesh& m, const Triangle& t) {
  return {rational(m.vertices[t[0]]), rational(m.vertices[t[1]]), rational(m.vertices[t[2]])};
}

std::size_t projection_axis(const std::array<RationalPoint, 3>& t) {
  const RationalPoint n = outer(difference(t[1], t[0]), difference(t[2], t[0]));
  return n[0] != 0 ? 0 : n[1] != 0 ? 1 : 2;
}

/// Projected area that two triangles share when they lie in one plane, else zero.
mpq_class coplanar_overlap(const std::array<RationalPoint, 3>& t,
                           const std::array<RationalPoint, 3>& u, std::size_t axis) {
  const RationalPoint n = outer(difference(u[1], u[0]), difference(u[2], u[0]));
  for (const RationalPoint& p : t)
    if (inner(n, difference(p, u[0])) != 0) return 0;
  Polygon polygon(t.begin(), t.end());
  for (std::size_t i = 0; i < 3; ++i) {
    // A plane through edge i, upright on the common plane.
    const RationalPoint& p = u[i];
    const RationalPoint& q = u[(i + 1) % 3];
    const RationalPoint up{p[0] + n[0], p[1] + n[1], p[2] + n[2]};
    polygon = clip(polygon, half_space(p, q, up, u[(i + 2) % 3]));
  }
  return projected_area(polygon, axis);
}

/// Corner, edge or face of a surface as points: the affine hull's base and directions follow.
using Simplex = std::vector<Vec3i>;

std::vector<Simplex> simplices(const IndexedMesh& m) {
  std::set<Simplex> all;
  for (const Triangle& t : m.triangles)
    for (unsigned mask = 1; mask < 8; ++mask) {
      Simplex s;
      for (unsigned i = 0; i < 3; ++i)
        if ((mask >> i & 1U) != 0) s.push_back(m.vertices[t[i]]);
      std::ranges::sort(s);
      all.insert(s);
    }
  std::vector<Simplex> r(all.begin(), all.end());
  std::ranges::sort(r, [](const Simplex& s, const Simplex& u) {
    return s.size() != u.size() ? s.size() < u.size() : s < u;
  });
  return r;
}

/// Solves the square system m x = r in place; nothing when it is singular.
std::optional<std::vector<mpq_class>> solve(std::vector<std::vector<mpq_class>> m,
                                            std::vector<mpq_class> r) {
  const std::size_t n = r.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    while (pivot < n && m[pivot][k] == 0) ++pivot;
    if (pivot == n) return std::nullopt;
    std::swap(m[k], m[pivot]);
    std::swap(r[k], r[pivot]);
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k || m[i][k] == 0) continue;
      const mpq_class f = m[i][k] / m[k][k];
      for (std::size_t j = k; j < n; ++j) m[i][j] -= f * m[k][j];
      r[i] -= f * r[k];
    }
  }
  for (std::size_t k = 0; k < n; ++k) r[k] /= m[k][k];
  return r;
}

/// Squared distance of two simplices' stationary points, where these lie in the simplices.
std::optional<mpq_class> stationary(const Simplex& a, const Simplex& b) {
  std::vector<RationalPoint> directions;
  for (std::size_t i = 1; i < a.size(); ++i)
    directions.push_back(difference(rational(a[i]), rational(a[0])));
  for (std::size_t i = 1; i < b.size(); ++i)
    directions.push_back(difference(rational(b[0]), rational(b[i])));
  if (directions.size() > 3) return std::nullopt;
  const RationalPoint base = difference(rational(a[0]), rational(b[0]));
  std::vector<std::vector<mpq_class>> gram;
  std::vector<mpq_class> right;
  for (const RationalPoint& u : directions) {
    gram.emplace_back();
    for (const RationalPoint& v : directions) gram.back().push_back(inner(u, v));
    right.push_back(-inner(u, base));
  }
  const auto x = solve(std::move(gram), std::move(right));
  if (!x) return std::nullopt;
  mpq_class sum_a = 0, sum_b = 0;
  RationalPoint gap = base;
  for (std::size_t i = 0; i < x->size(); ++i) {
    if ((*x)[i] < 0) return std::nullopt;
    (i + 1 < a.size() ? sum_a : sum_b) += (*x)[i];
    for (std::size_t k = 0; k < 3; ++k) gap[k] += (*x)[i] * directions[i][k];
  }
  if (sum_a > 1 || sum_b > 1) return std::nullopt;
  return inner(gap, gap);
}

template <class Points>
geometry::Box3l box_of(const Points& points) {
  geometry::Box3l box = geometry::empty_box<std::int64_t>();
  for (const Vec3i& p : points) box.include(p.as<std::int64_t>());
  return box;
}

/// For lattices of less than 2^30 units.
long squared_gap(const geometry::Box3l& a, const geometry::Box3l& b) {
  long sum = 0;
  for (int k = 0; k < 3; ++k) {
    const long gap = std::max({b.lo[k] - a.hi[k], a.lo[k] - b.hi[k], std::int64_t{0}});
    sum += gap * gap;
  }
  return sum;
}

std::array<Vec3i, 3> lattice_corners(const IndexedMesh& m, const Triangle& t) {
  return {m.vertices[t[0]], m.vertices[t[1]], m.vertices[t[2]]};
}

}  // namespace

mpq_class volume6(const std::vector<Tetrahedron>& pieces) {
  mpq_class sum = 0;
  for (const Tetrahedron& t : pieces)
    sum += volume6(RationalTet{rational(t[0]), rational(t[1]), rational(t[2]), rational(t[3])});
  return sum;
}

mpq_class common_volume6(const std::vector<Tetrahedron>& a, const std::vector<Tetrahedron>& b) {
  mpq_class sum = 0;
  for (const Tetrahedron& u : b) {
    const auto walls = half_spaces(u);
    for (const Tetrahedron& t : a) {
      if (!box_of(t).meets(box_of(u))) continue;
      std::vector<RationalTet> parts{
          {rational(t[0]), rational(t[1]), rational(t[2]), rational(t[3])}};
      for (const HalfSpace& wall : walls) {
        std::vector<RationalTet> kept;
        for (const RationalTet& part : parts) {
          // Nothing but a face, edge or corner inside: no volume.
          const bool touches = std::ranges::all_of(
              part, [&](const RationalPoint& p) { return wall.excess(p) >= 0; });
          if (!touches) clip(part, wall, kept);
        }
        parts = std::move(kept);
      }
      for (const RationalTet& part : parts) sum += volume6(part);
    }
  }
  return sum;
}

SheetCover sheet_cover(const IndexedMesh& sheet, const LatticeSolid& body) {
  SheetCover cover;
  for (const Triangle& triangle : sheet.triangles) {
    const auto t = corners(sheet, triangle);
    const std::size_t axis = projection_axis(t);
    cover.all += projected_area({t.begin(), t.end()}, axis);
    mpq_class through = 0, on_faces = 0, on_surface = 0;
    const geometry::Box3l box = box_of(lattice_corners(sheet, triangle));
    for (const Tetrahedron& piece : body.pieces) {
      if (!box.meets(box_of(piece))) continue;
      const auto walls = half_spaces(piece);
      Polygon polygon(t.begin(), t.end());
      bool on_face = false;
      for (const HalfSpace& wall : walls) {
        on_face |= std::ranges::all_of(t, [&](const auto& p) { return wall.excess(p) == 0; });
        polygon = clip(polygon, wall);
      }
      (on_face ? on_faces : through) += projected_area(polygon, axis);
    }
    for (const Triangle& u : body.mesh.triangles)
      if (box.meets(box_of(lattice_corners(body.mesh, u))))
        on_surface += coplanar_overlap(t, corners(body.mesh, u), axis);
    // A face between two pieces was met from both sides, one of the surface from one.
    cover.inside += through + (on_faces - on_surface) / 2;
    cover.on_surface += on_surface;
  }
  return cover;
}

SheetCover sheet_cover(const IndexedMesh& sheet, const IndexedMesh& other) {
  SheetCover cover;
  for (const Triangle& triangle : sheet.triangles) {
    const auto t = corners(sheet, triangle);
    const std::size_t axis = projection_axis(t);
    cover.all += projected_area({t.begin(), t.end()}, axis);
    for (const Triangle& u : other.triangles)
      cover.on_surface += coplanar_overlap(t, corners(other, u), axis);
  }
  return cover;
}

mpq_class squared_distance(const IndexedMesh& a, const IndexedMesh& b) {
  const std::vector<Simplex> of_a = simplices(a), of_b = simplices(b);
  std::vector<geometry::Box3l> boxes;
  for (const Simplex& s : of_b) boxes.push_back(box_of(s));
  std::optional<mpq_class> least;
  for (const Simplex& s : of_a) {
    const geometry::Box3l box = box_of(s);
    for (std::size_t i = 0; i < of_b.size(); ++i) {
      if (least && cmp(*least, squared_gap(box, boxes[i])) <= 0) continue;
      const auto d = stationary(s, of_b[i]);
      if (d && (!least || *d < *least)) least = d;
    }
  }
  return *least;
}

}  // namespace strake::testing
