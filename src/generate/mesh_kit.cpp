// SPDX-License-Identifier: Apache-2.0
#include "generate/mesh_kit.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace strake::generate {
namespace {

using geometry::kNoFace;
using geometry::Triangle;
using geometry::Vec3d;
using geometry::Vec3l;

void add_triangle(GridMesh& mesh, const Triangle& t, std::uint32_t face) {
  mesh.triangles.push_back(t);
  mesh.faces.push_back(face);
}

void add_quad(GridMesh& mesh, const std::array<std::uint32_t, 4>& q, std::uint32_t face) {
  add_triangle(mesh, {q[0], q[1], q[2]}, face);
  add_triangle(mesh, {q[0], q[2], q[3]}, face);
}

/// The wall between two rings of equal count, the outer side to the left of first → second.
void add_wall(GridMesh& mesh, std::uint32_t low, std::uint32_t high, std::uint32_t count,
              std::uint32_t first_face) {
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t next = (k + 1) % count;
    add_quad(mesh, {low + k, low + next, high + next, high + k},
             first_face == kNoFace ? kNoFace : first_face + k);
  }
}

void add_cap(GridMesh& mesh, std::uint32_t first, std::uint32_t count, bool up,
             std::uint32_t face) {
  for (std::uint32_t k = 1; k + 1 < count; ++k)
    add_triangle(
        mesh,
        up ? Triangle{first, first + k, first + k + 1} : Triangle{first, first + k + 1, first + k},
        face);
}

std::uint32_t add_ring(GridMesh& mesh, const Turned& at, int sides) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  if (at.r == 0) {
    mesh.vertices.push_back({0, 0, at.z});
    return first;
  }
  for (const Flat& p : ring(sides, at.r)) mesh.vertices.push_back({p.u, p.v, at.z});
  return first;
}

/// A face is planar to the last bit only where the wall is upright or level.
std::uint32_t wall_face(const Turned& a, const Turned& b, std::uint32_t& next_face, int sides) {
  if (a.z == b.z) return next_face++;
  if (a.r != b.r) return kNoFace;
  const std::uint32_t first = next_face;
  next_face += static_cast<std::uint32_t>(sides);
  return first;
}

void add_turned_wall(GridMesh& mesh, const Turned& a, const Turned& b, const Triangle& rings,
                     std::uint32_t face) {
  const std::uint32_t low = rings[0], high = rings[1], n = rings[2];
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t next = (k + 1) % n;
    const std::uint32_t own = a.z == b.z || face == kNoFace ? face : face + k;
    if (a.r == 0)
      add_triangle(mesh, {low, high + next, high + k}, own);
    else if (b.r == 0)
      add_triangle(mesh, {low + k, low + next, high}, own);
    else
      add_quad(mesh, {low + k, low + next, high + next, high + k}, own);
  }
}

Vec3l rounded(const Vec3d& v) { return {std::llround(v.x), std::llround(v.y), std::llround(v.z)}; }

/// Directions of one place of a swept bar.
struct Station {
  Vec3d centre, across, beside;  ///< beside × across... an upright frame of the cross-section
};

Vec3l unit_between(const Vec3l& a, const Vec3l& b) {
  const auto sign = [](std::int64_t v) { return static_cast<std::int64_t>((v > 0) - (v < 0)); };
  return {sign(b.x - a.x), sign(b.y - a.y), sign(b.z - a.z)};
}

/// The frame after a 90° bend from direction d to e, and the stations of the bend between.
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

GridMesh make_box(const Vec3l& size) {
  const Outline base{{0, 0}, {size.x, 0}, {size.x, size.y}, {0, size.y}};
  return extrude(base, {}, size.z);
}

GridMesh extrude(const Outline& outer, std::span<const Outline> holes, std::int64_t length) {
  GridMesh mesh;
  std::vector<Outline> loops{outer};
  loops.insert(loops.end(), holes.begin(), holes.end());
  for (const std::int64_t z : {std::int64_t{0}, length})
    for (const Outline& loop : loops)
      for (const Flat& p : loop) mesh.vertices.push_back({p.u, p.v, z});
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

GridMesh turn(std::span<const Turned> profile, int sides) {
  GridMesh mesh;
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

GridMesh turn_ring(std::span<const Turned> profile, int sides) {
  GridMesh mesh;
  const auto n = static_cast<std::uint32_t>(sides);
  std::uint32_t face = 0;
  for (const Turned& p : profile) add_ring(mesh, p, sides);
  for (std::uint32_t i = 0; i < profile.size(); ++i) {
    const auto next = static_cast<std::uint32_t>((i + 1) % profile.size());
    add_turned_wall(mesh, profile[i], profile[next], {i * n, next * n, n},
                    wall_face(profile[i], profile[next], face, sides));
  }
  return mesh;
}

GridMesh sweep(std::span<const Vec3l> path, std::int64_t r, std::int64_t bend, int sides) {
  std::vector<Station> stations;
  const Vec3l start = unit_between(path[0], path[1]);
  const Vec3d across = start.x == 0 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  stations.push_back({path[0].as<double>(), across, cross(start.as<double>(), across)});
  for (std::size_t i = 1; i + 1 < path.size(); ++i)
    add_bend(stations, path[i],
             {unit_between(path[i - 1], path[i]), unit_between(path[i], path[i + 1])},
             static_cast<double>(bend));
  stations.push_back({path.back().as<double>(), stations.back().across, stations.back().beside});

  GridMesh mesh;
  const Outline section = ring(sides, r);
  const auto n = static_cast<std::uint32_t>(sides);
  for (const Station& s : stations)
    for (const Flat& p : section)
      mesh.vertices.push_back(rounded(s.centre + s.across * static_cast<double>(p.u) +
                                      s.beside * static_cast<double>(p.v)));
  add_cap(mesh, 0, n, false, 0);
  add_cap(mesh, static_cast<std::uint32_t>(stations.size() - 1) * n, n, true, 1);
  std::uint32_t face = 2;
  for (std::uint32_t s = 0; s + 1 < stations.size(); ++s) {
    const bool straight = s % 7 == 0;  // a bend has seven stations, a leg joins two bends
    add_wall(mesh, s * n, (s + 1) * n, n, straight ? face : kNoFace);
    if (straight) face += n;
  }
  return mesh;
}

void append(GridMesh& mesh, const GridMesh& other, const Vec3l& offset) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  std::uint32_t face = 0;
  for (const std::uint32_t f : mesh.faces)
    if (f != kNoFace && f >= face) face = f + 1;
  for (const Vec3l& v : other.vertices) mesh.vertices.push_back(v + offset);
  for (const Triangle& t : other.triangles)
    mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  for (const std::uint32_t f : other.faces) mesh.faces.push_back(f == kNoFace ? f : f + face);
}

GridMesh cycled(GridMesh mesh, int times, const Vec3l& offset) {
  for (Vec3l& v : mesh.vertices) {
    for (int k = 0; k < times; ++k) v = {v.z, v.x, v.y};
    v = v + offset;
  }
  return mesh;
}

void reverse(GridMesh& mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
}

double volume_mm3(const GridMesh& mesh) {
  double six = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3d a = mesh.vertices[t[0]].as<double>() * 1e-3;
    const Vec3d b = mesh.vertices[t[1]].as<double>() * 1e-3;
    const Vec3d c = mesh.vertices[t[2]].as<double>() * 1e-3;
    six += dot(a, cross(b, c));
  }
  return six / 6;
}

geometry::TriangleMesh to_mesh(const GridMesh& mesh) {
  geometry::TriangleMesh result;
  for (const Vec3l& v : mesh.vertices)
    result.vertices.push_back({static_cast<double>(v.x) / 1000, static_cast<double>(v.y) / 1000,
                               static_cast<double>(v.z) / 1000});
  result.triangles = mesh.triangles;
  result.faces = mesh.faces;
  result.sag_mm = 0;  // the mesh is the thing: no curved surface stands behind it
  return result;
}

}  // namespace strake::generate
