// SPDX-License-Identifier: Apache-2.0
#include "generate/mesh_primitives.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace strake::generate {
namespace {

using geometry::kNoIndex;
using geometry::Triangle;
using geometry::Vec3d;
using geometry::Vec3l;

void add_triangle(MicrometreMesh& mesh, const Triangle& t, std::uint32_t face) {
  mesh.triangles.push_back(t);
  mesh.faces.push_back(face);
}

void add_quad(MicrometreMesh& mesh, const std::array<std::uint32_t, 4>& q, std::uint32_t face) {
  add_triangle(mesh, {q[0], q[1], q[2]}, face);
  add_triangle(mesh, {q[0], q[2], q[3]}, face);
}

/// Adds the wall between two rings of equal count, the outer side to the left of first → second.
void add_wall(MicrometreMesh& mesh, std::uint32_t low, std::uint32_t high, std::uint32_t count,
              std::uint32_t first_face) {
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t next = (k + 1) % count;
    add_quad(mesh, {low + k, low + next, high + next, high + k},
             first_face == kNoIndex ? kNoIndex : first_face + k);
  }
}

void add_cap(MicrometreMesh& mesh, std::uint32_t first, std::uint32_t count, bool up,
             std::uint32_t face) {
  for (std::uint32_t k = 1; k + 1 < count; ++k)
    add_triangle(
        mesh,
        up ? Triangle{first, first + k, first + k + 1} : Triangle{first, first + k + 1, first + k},
        face);
}

std::uint32_t add_ring(MicrometreMesh& mesh, const RevolutionPoint& at, int sides) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  if (at.r == 0) {
    mesh.vertices.push_back({0, 0, at.z});
    return first;
  }
  for (const ProfilePoint& p : ring(sides, at.r)) mesh.vertices.push_back({p.u, p.v, at.z});
  return first;
}

/// Returns the face of a wall, which is planar to the last bit only where it is upright or level.
std::uint32_t wall_face(const RevolutionPoint& a, const RevolutionPoint& b,
                        std::uint32_t& next_face, int sides) {
  if (a.z == b.z) return next_face++;
  if (a.r != b.r) return kNoIndex;
  const std::uint32_t first = next_face;
  next_face += static_cast<std::uint32_t>(sides);
  return first;
}

void add_turned_wall(MicrometreMesh& mesh, const RevolutionPoint& a, const RevolutionPoint& b,
                     const Triangle& rings, std::uint32_t face) {
  const std::uint32_t low = rings[0], high = rings[1], n = rings[2];
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t next = (k + 1) % n;
    const std::uint32_t own = a.z == b.z || face == kNoIndex ? face : face + k;
    if (a.r == 0)
      add_triangle(mesh, {low, high + next, high + k}, own);
    else if (b.r == 0)
      add_triangle(mesh, {low + k, low + next, high}, own);
    else
      add_quad(mesh, {low + k, low + next, high + next, high + k}, own);
  }
}

Vec3l rounded(const Vec3d& v) { return {std::llround(v.x), std::llround(v.y), std::llround(v.z)}; }

/// The directions at one place of a swept bar.
struct Station {
  Vec3d centre, across, beside;  ///< beside × across... an upright frame of the cross-section
};

Vec3l unit_between(const Vec3l& a, const Vec3l& b) {
  const auto sign = [](std::int64_t v) { return static_cast<std::int64_t>((v > 0) - (v < 0)); };
  return {sign(b.x - a.x), sign(b.y - a.y), sign(b.z - a.z)};
}

/// Adds the frame after a 90° bend from direction d to e, and the stations of the bend between.
void add_bend(std::vector<Station>& stations, const Vec3l& corner, const std::array<Vec3l, 2>& legs,
              double bend) {
  const Vec3d d = legs[0].as<double>(), e = legs[1].as<double>();
  const Vec3d axis = cross(d, e);
  const Vec3d centre = corner.as<double>() + (e - d) * bend;
  const Station before = stations.back();
  for (int step = 0; step <= 6; ++step) {
    const Vec3d cs = unit_15deg(step);
    const Vec3d radial = d * cs.y - e * cs.x;
    const auto swung = [&](const Vec3d& v) { return axis * dot(v, axis) - radial * dot(v, e); };
    stations.push_back({centre + radial * bend, swung(before.across), swung(before.beside)});
  }
}

}  // namespace

MicrometreMesh make_box(const Vec3l& size) {
  const OutlinePolygon base{{0, 0}, {size.x, 0}, {size.x, size.y}, {0, size.y}};
  return extrude(base, {}, size.z);
}

MicrometreMesh extrude(const OutlinePolygon& outer, std::span<const OutlinePolygon> holes,
                       std::int64_t length) {
  MicrometreMesh mesh;
  std::vector<OutlinePolygon> loops{outer};
  loops.insert(loops.end(), holes.begin(), holes.end());
  for (const std::int64_t z : {std::int64_t{0}, length})
    for (const OutlinePolygon& loop : loops)
      for (const ProfilePoint& p : loop) mesh.vertices.push_back({p.u, p.v, z});
  const auto top = static_cast<std::uint32_t>(mesh.vertices.size() / 2);
  for (const Triangle& t : triangulate_outline(outer, holes)) {
    add_triangle(mesh, {t[0], t[2], t[1]}, 0);
    add_triangle(mesh, {t[0] + top, t[1] + top, t[2] + top}, 1);
  }
  std::uint32_t first = 0, face = 2;
  for (std::size_t loop = 0; loop < loops.size(); ++loop) {
    const auto count = static_cast<std::uint32_t>(loops[loop].size());
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t a = first + k, b = first + (k + 1) % count;
      if (loop == 0)
        add_quad(mesh, {a, b, b + top, a + top}, face++);
      else
        add_quad(mesh, {b, a, a + top, b + top}, face++);
    }
    first += count;
  }
  return mesh;
}

MicrometreMesh revolve(std::span<const RevolutionPoint> profile, int sides) {
  MicrometreMesh mesh;
  const auto n = static_cast<std::uint32_t>(sides);
  std::uint32_t face = 0;
  std::uint32_t below = add_ring(mesh, profile.front(), sides);
  if (profile.front().r > 0) add_cap(mesh, below, n, false, face++);
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const std::uint32_t above = add_ring(mesh, profile[i], sides);
    add_turned_wall(mesh, profile[i - 1], profile[i], {below, above, n},
                    wall_face(profile[i - 1], profile[i], face, sides));
    below = above;
  }
  if (profile.back().r > 0) add_cap(mesh, below, n, true, face);
  return mesh;
}

MicrometreMesh revolve_ring(std::span<const RevolutionPoint> profile, int sides) {
  MicrometreMesh mesh;
  const auto n = static_cast<std::uint32_t>(sides);
  std::uint32_t face = 0;
  for (const RevolutionPoint& p : profile) add_ring(mesh, p, sides);
  for (std::uint32_t i = 0; i < profile.size(); ++i) {
    const auto next = static_cast<std::uint32_t>((i + 1) % profile.size());
    add_turned_wall(mesh, profile[i], profile[next], {i * n, next * n, n},
                    wall_face(profile[i], profile[next], face, sides));
  }
  return mesh;
}

MicrometreMesh sweep(std::span<const Vec3l> path, std::int64_t r, std::int64_t bend, int sides) {
  std::vector<Station> stations;
  const Vec3l start = unit_between(path[0], path[1]);
  const Vec3d across = start.x == 0 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  stations.push_back({path[0].as<double>(), across, cross(start.as<double>(), across)});
  for (std::size_t i = 1; i + 1 < path.size(); ++i)
    add_bend(stations, path[i],
             {unit_between(path[i - 1], path[i]), unit_between(path[i], path[i + 1])},
             static_cast<double>(bend));
  stations.push_back({path.back().as<double>(), stations.back().across, stations.back().beside});

  MicrometreMesh mesh;
  const OutlinePolygon section = ring(sides, r);
  const auto n = static_cast<std::uint32_t>(sides);
  for (const Station& s : stations)
    for (const ProfilePoint& p : section)
      mesh.vertices.push_back(rounded(s.centre + s.across * static_cast<double>(p.u) +
                                      s.beside * static_cast<double>(p.v)));
  add_cap(mesh, 0, n, false, 0);
  add_cap(mesh, static_cast<std::uint32_t>(stations.size() - 1) * n, n, true, 1);
  std::uint32_t face = 2;
  for (std::uint32_t s = 0; s + 1 < stations.size(); ++s) {
    const bool straight = s % 7 == 0;  // a bend has seven stations, a leg joins two bends
    add_wall(mesh, s * n, (s + 1) * n, n, straight ? face : kNoIndex);
    if (straight) face += n;
  }
  return mesh;
}

void append(MicrometreMesh& mesh, const MicrometreMesh& other, const Vec3l& offset) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  std::uint32_t face = 0;
  for (const std::uint32_t f : mesh.faces)
    if (f != kNoIndex && f >= face) face = f + 1;
  for (const Vec3l& v : other.vertices) mesh.vertices.push_back(v + offset);
  for (const Triangle& t : other.triangles)
    mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  for (const std::uint32_t f : other.faces) mesh.faces.push_back(f == kNoIndex ? f : f + face);
}

MicrometreMesh cycled(MicrometreMesh mesh, int times, const Vec3l& offset) {
  for (Vec3l& v : mesh.vertices) {
    for (int k = 0; k < times; ++k) v = {v.z, v.x, v.y};
    v = v + offset;
  }
  return mesh;
}

void reverse(MicrometreMesh& mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
}

double volume_mm3(const MicrometreMesh& mesh) {
  double six = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3d a = mesh.vertices[t[0]].as<double>() * 1e-3;
    const Vec3d b = mesh.vertices[t[1]].as<double>() * 1e-3;
    const Vec3d c = mesh.vertices[t[2]].as<double>() * 1e-3;
    six += dot(a, cross(b, c));
  }
  return six / 6;
}

geometry::TriangleMesh to_mesh(const MicrometreMesh& mesh) {
  geometry::TriangleMesh result;
  for (const Vec3l& v : mesh.vertices)
    result.vertices.push_back({static_cast<double>(v.x) / 1000, static_cast<double>(v.y) / 1000,
                               static_cast<double>(v.z) / 1000});
  result.triangles = mesh.triangles;
  result.faces = mesh.faces;
  result.sag_mm = 0;  // the mesh is the thing: no curved surface stands behind it
  return result;
}

namespace {

/// A polygon as a ring of indices into a table of points; holes are joined to it by bridges.
struct Loop {
  std::vector<ProfilePoint> points;
  std::vector<std::uint32_t> order;
};

std::int64_t turn_of(const ProfilePoint& a, const ProfilePoint& b, const ProfilePoint& c) {
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

bool in_closed_triangle(const ProfilePoint& p, const ProfilePoint& a, const ProfilePoint& b,
                        const ProfilePoint& c) {
  return turn_of(a, b, p) >= 0 && turn_of(b, c, p) >= 0 && turn_of(c, a, p) >= 0;
}

bool is_ear(const Loop& loop, std::size_t i) {
  const std::size_t n = loop.order.size();
  const ProfilePoint& a = loop.points[loop.order[(i + n - 1) % n]];
  const ProfilePoint& b = loop.points[loop.order[i]];
  const ProfilePoint& c = loop.points[loop.order[(i + 1) % n]];
  if (turn_of(a, b, c) <= 0) return false;
  return std::none_of(loop.order.begin(), loop.order.end(), [&](std::uint32_t index) {
    const ProfilePoint& p = loop.points[index];
    return !(p == a) && !(p == b) && !(p == c) && in_closed_triangle(p, a, b, c);
  });
}

bool properly_cross(const ProfilePoint& a, const ProfilePoint& b, const ProfilePoint& c,
                    const ProfilePoint& d) {
  const auto sign = [](std::int64_t v) { return (v > 0) - (v < 0); };
  return sign(turn_of(a, b, c)) * sign(turn_of(a, b, d)) <= 0 &&
         sign(turn_of(c, d, a)) * sign(turn_of(c, d, b)) <= 0;
}

/// Whether the segment between two points meets no edge that does not end in one of them.
bool is_visible_from(const Loop& loop, std::span<const std::vector<std::uint32_t>> others,
                     const ProfilePoint& from, const ProfilePoint& to) {
  const auto blocked = [&](const std::vector<std::uint32_t>& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const ProfilePoint& c = loop.points[ring[i]];
      const ProfilePoint& d = loop.points[ring[(i + 1) % ring.size()]];
      if (c == from || c == to || d == from || d == to) continue;
      if (properly_cross(from, to, c, d)) return true;
    }
    return false;
  };
  if (blocked(loop.order)) return false;
  return std::none_of(others.begin(), others.end(), blocked);
}

/// Joins the hole to the loop by the shortest bridge that crosses nothing.
void bridge(Loop& loop, std::span<const std::vector<std::uint32_t>> holes) {
  const std::vector<std::uint32_t>& hole = holes.front();
  std::int64_t best = -1;
  std::size_t best_outer = 0, best_hole = 0;
  for (std::size_t i = 0; i < loop.order.size(); ++i)
    for (std::size_t j = 0; j < hole.size(); ++j) {
      const ProfilePoint& a = loop.points[loop.order[i]];
      const ProfilePoint& b = loop.points[hole[j]];
      const std::int64_t d = (a.u - b.u) * (a.u - b.u) + (a.v - b.v) * (a.v - b.v);
      if ((best >= 0 && d >= best) || !is_visible_from(loop, holes, a, b)) continue;
      best = d, best_outer = i, best_hole = j;
    }
  std::vector<std::uint32_t> piece;
  for (std::size_t j = 0; j <= hole.size(); ++j)  // clockwise, as the inner side of a boundary runs
    piece.push_back(hole[(best_hole + hole.size() - j % hole.size()) % hole.size()]);
  piece.push_back(loop.order[best_outer]);
  loop.order.insert(loop.order.begin() + static_cast<std::ptrdiff_t>(best_outer) + 1, piece.begin(),
                    piece.end());
}

double tan_of_half_step(int sides) {                     // tan(180°/sides)
  double t = sides % 3 == 0 ? 1 / std::sqrt(3.0) : 1.0;  // 30° or 45°
  for (int n = sides % 3 == 0 ? 6 : 4; n < sides; n *= 2) t = (std::sqrt(1 + t * t) - 1) / t;
  return t;
}

}  // namespace

std::int64_t um(double mm) { return std::llround(mm * 1000); }

OutlinePolygon outline(std::span<const Vec3d> uv_mm) {
  OutlinePolygon result;
  for (const Vec3d& p : uv_mm) result.push_back({um(p.x), um(p.y)});
  return result;
}

OutlinePolygon ring(int sides, std::int64_t r) {
  const double t = tan_of_half_step(sides);
  const double c = (1 - t * t) / (1 + t * t), s = 2 * t / (1 + t * t);
  const int quarter = sides / 4;
  OutlinePolygon first;
  double u = 1, v = t;
  for (int k = 0; k < quarter; ++k) {
    first.push_back(
        {std::llround(u * static_cast<double>(r)), std::llround(v * static_cast<double>(r))});
    const double w = u * c - v * s;
    v = u * s + v * c;
    u = w;
  }
  first.back() = {first.front().v, first.front().u};  // the flat across v stands at exactly r too
  OutlinePolygon result;
  for (int q = 0; q < 4; ++q)
    for (const ProfilePoint& p : first)
      result.push_back(q == 0   ? p
                       : q == 1 ? ProfilePoint{-p.v, p.u}
                       : q == 2 ? ProfilePoint{-p.u, -p.v}
                                : ProfilePoint{p.v, -p.u});
  return result;
}

Vec3d unit_15deg(int step) {
  const int turned = ((step % 24) + 24) % 24;
  const int rest = turned % 6;
  const double cos_of[6] = {
      1,   (std::sqrt(6.0) + std::sqrt(2.0)) / 4, std::sqrt(3.0) / 2, std::sqrt(2.0) / 2,
      0.5, (std::sqrt(6.0) - std::sqrt(2.0)) / 4};
  const double c = cos_of[rest], s = rest == 0 ? 0 : cos_of[6 - rest];
  switch (turned / 6) {
    case 0:
      return {c, s, 0};
    case 1:
      return {-s, c, 0};
    case 2:
      return {-c, -s, 0};
    default:
      return {s, -c, 0};
  }
}

std::vector<Triangle> triangulate_outline(const OutlinePolygon& outer,
                                          std::span<const OutlinePolygon> holes) {
  Loop loop;
  loop.points = outer;
  for (std::uint32_t i = 0; i < outer.size(); ++i) loop.order.push_back(i);
  std::vector<std::vector<std::uint32_t>> rings;
  for (const OutlinePolygon& hole : holes) {
    std::vector<std::uint32_t>& indices = rings.emplace_back();
    for (const ProfilePoint& p : hole) {
      indices.push_back(static_cast<std::uint32_t>(loop.points.size()));
      loop.points.push_back(p);
    }
  }
  for (std::size_t h = 0; h < rings.size(); ++h) bridge(loop, std::span(rings).subspan(h));
  std::vector<Triangle> triangles;
  while (loop.order.size() > 3) {
    const std::size_t n = loop.order.size();
    std::size_t ear = 0;
    while (ear < n && !is_ear(loop, ear)) ++ear;
    if (ear == n) break;  // not a simple polygon: the edge check of the tests shows it
    triangles.push_back(
        {loop.order[(ear + n - 1) % n], loop.order[ear], loop.order[(ear + 1) % n]});
    loop.order.erase(loop.order.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  triangles.push_back({loop.order[0], loop.order[1], loop.order[2]});
  return triangles;
}

}  // namespace strake::generate
