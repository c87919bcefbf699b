// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/place.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "strake/geometry/grid.hpp"

namespace strake::geometry {
namespace {

/// Beyond this distance from the local origin (17 m) a shape gets a base of its own: nearer ones
/// keep the local origin, so that a body's origin stays what the placement says.
constexpr std::int64_t kFar = std::int64_t{1} << 24;
constexpr std::int64_t kWidest = std::int64_t{1} << 31;

/// A coordinate that no placed point has.
constexpr std::int64_t kNowhere = std::numeric_limits<std::int64_t>::min();

Vec3l snap_or_nowhere(const Vec3d& mm) {
  const std::optional<Vec3l> p = snap(mm);
  return p ? *p : Vec3l{kNowhere, 0, 0};
}

std::vector<Vec3l> snap_all(const std::vector<Vec3d>& points, const Mat3d& linear) {
  std::vector<Vec3l> snapped;
  snapped.reserve(points.size());
  for (const Vec3d& p : points) snapped.push_back(snap_or_nowhere(linear * p));
  return snapped;
}

/// The base of points in a box, or nothing when int32 cannot span it.
std::optional<Vec3l> choose_base(const Box3l& box) {
  if (box.empty()) return Vec3l{};
  bool far = false;
  Vec3l centre;
  for (int k = 0; k < 3; ++k) {
    if (box.hi[k] - box.lo[k] >= kWidest) return std::nullopt;
    far = far || box.lo[k] < -kFar || box.hi[k] > kFar;
    centre[k] = box.lo[k] + (box.hi[k] - box.lo[k]) / 2;
  }
  return far ? centre : Vec3l{};
}

constexpr std::uint32_t kUnused = 0xffffffffU;

}  // namespace

std::optional<PlacedMesh> place(const TriangleMesh& mesh, const Mat3d& linear) {
  const std::vector<Vec3l> snapped = snap_all(mesh.vertices, linear);
  const bool mirrored = linear.determinant() < 0;
  PlacedMesh placed;
  std::vector<std::uint32_t> renumbered(snapped.size(), kUnused);
  std::vector<std::uint32_t> used;
  used.reserve(snapped.size());
  placed.mesh.triangles.reserve(mesh.triangles.size());
  if (!mesh.faces.empty()) placed.mesh.faces.reserve(mesh.triangles.size());
  Box3l box{{kWidest << 20, kWidest << 20, kWidest << 20},
            {-(kWidest << 20), -(kWidest << 20), -(kWidest << 20)}};
  const auto stands = [&](std::uint32_t v) {
    return v < snapped.size() && snapped[v].x != kNowhere;
  };
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    if (!stands(t[0]) || !stands(t[1]) || !stands(t[2])) {
      ++placed.bad_triangles;
      continue;
    }
    Triangle r{};
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& n = renumbered[t[k]];
      if (n == kUnused) {
        n = static_cast<std::uint32_t>(used.size());
        used.push_back(t[k]);
        box.include(snapped[t[k]]);
      }
      r[k] = n;
    }
    if (mirrored) std::swap(r[1], r[2]);
    placed.mesh.triangles.push_back(r);
    if (!mesh.faces.empty())
      placed.mesh.faces.push_back(i < mesh.faces.size() ? mesh.faces[i] : kNoFace);
  }
  const std::optional<Vec3l> base = choose_base(box);
  if (!base) return std::nullopt;
  placed.base = *base;
  placed.mesh.vertices.reserve(used.size());
  for (const std::uint32_t v : used)
    placed.mesh.vertices.push_back((snapped[v] - *base).as<std::int32_t>());
  return placed;
}

std::optional<PlacedWire> place(const Polylines& lines, const Mat3d& linear) {
  const std::vector<Vec3l> snapped = snap_all(lines.points, linear);
  PlacedWire wire;
  std::vector<Vec3l> kept;
  std::vector<std::uint32_t> first{0};
  Box3l box{{kWidest << 20, kWidest << 20, kWidest << 20},
            {-(kWidest << 20), -(kWidest << 20), -(kWidest << 20)}};
  for (std::size_t c = 0; c + 1 < lines.first.size(); ++c) {
    const std::size_t end = std::min<std::size_t>(lines.first[c + 1], snapped.size());
    for (std::size_t i = lines.first[c]; i < end; ++i) {
      if (snapped[i].x == kNowhere) {
        ++wire.bad_points;
        continue;
      }
      if (kept.size() > first.back() && kept.back() == snapped[i]) continue;
      kept.push_back(snapped[i]);
    }
    if (kept.size() - first.back() < 2)
      kept.resize(first.back());
    else
      first.push_back(static_cast<std::uint32_t>(kept.size()));
  }
  for (const Vec3l& p : kept) box.include(p);
  const std::optional<Vec3l> base = choose_base(box);
  if (!base) return std::nullopt;
  wire.base = *base;
  wire.part.kind = PartKind::wire;
  wire.part.edges.clear();
  for (const Vec3l& p : kept) {
    wire.part.vertices.push_back((p - *base).as<std::int32_t>());
    wire.part.box.include(wire.part.vertices.back());
  }
  wire.part.chain_first = std::move(first);
  return wire;
}

double stretch(const Mat3d& linear) {
  // The largest eigenvalue of the Gram matrix of the columns is at most its largest row sum;
  // columns at right angles make that exact.
  double largest = 0;
  for (int i = 0; i < 3; ++i) {
    double sum = 0;
    for (int j = 0; j < 3; ++j) {
      double product = 0;
      for (const Vec3d& row : linear.row) product += row[i] * row[j];
      sum += std::fabs(product);
    }
    largest = std::max(largest, sum);
  }
  return std::sqrt(largest) * (1 + 1e-12);
}

}  // namespace strake::geometry
