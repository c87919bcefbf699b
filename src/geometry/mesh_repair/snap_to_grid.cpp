// SPDX-License-Identifier: Apache-2.0
#include "geometry/mesh_repair/snap_to_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "strake/geometry/grid.hpp"

namespace strake::geometry {
namespace {

constexpr std::int64_t kWidest = std::int64_t{1} << 31;

/// A coordinate that no placed point has.
constexpr std::int64_t kNowhere = std::numeric_limits<std::int64_t>::min();

Vec3l snap_or_nowhere(const Vec3d& mm) {
  const std::optional<Vec3l> p = snap(mm);
  return p ? *p : Vec3l{kNowhere, 0, 0};
}

void snap_all(const std::vector<Vec3d>& points, const Mat3d& linear, std::vector<Vec3l>& snapped) {
  snapped.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) snapped[i] = snap_or_nowhere(linear * points[i]);
}

/// The middle of points in a box, or nothing when int32 cannot span it: where the file's origin
/// lies must not show in what is worked out in doubles.
std::optional<Vec3l> choose_base(const Box3l& box) {
  if (box.empty()) return Vec3l{};
  Vec3l centre;
  for (int k = 0; k < 3; ++k) {
    if (box.hi[k] - box.lo[k] >= kWidest) return std::nullopt;
    centre[k] = box.lo[k] + (box.hi[k] - box.lo[k]) / 2;
  }
  return centre;
}

/// A box that any point on the grid makes that point.
constexpr Box3l kNoBox{{kWidest << 20, kWidest << 20, kWidest << 20},
                       {-(kWidest << 20), -(kWidest << 20), -(kWidest << 20)}};

}  // namespace

void GridSnapper::take_triangles(const TriangleMesh& mesh, bool mirrored) {
  const auto stands = [&](std::uint32_t v) {
    return v < snapped_.size() && snapped_[v].x != kNowhere;
  };
  used_.assign(snapped_.size(), 0);
  std::vector<Triangle>& triangles = placed_.mesh.triangles;
  std::vector<std::uint32_t>& faces = placed_.mesh.faces;
  triangles.resize(mesh.triangles.size());
  faces.clear();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    Triangle t = mesh.triangles[i];
    if (!stands(t[0]) || !stands(t[1]) || !stands(t[2])) continue;
    for (const std::uint32_t v : t) used_[v] = 1;
    if (mirrored) std::swap(t[1], t[2]);
    triangles[kept++] = t;
    if (!mesh.faces.empty()) faces.push_back(i < mesh.faces.size() ? mesh.faces[i] : kNoIndex);
  }
  triangles.resize(kept);
  placed_.bad_triangles = mesh.triangles.size() - kept;
}

bool GridSnapper::take_vertices() {
  Box3l box = kNoBox;
  std::size_t kept = 0;
  for (std::size_t v = 0; v < snapped_.size(); ++v) {
    if (used_[v] == 0) continue;
    box.include(snapped_[v]);
    ++kept;
  }
  const std::optional<Vec3l> base = choose_base(box);
  if (!base) return false;
  placed_.base = *base;
  std::vector<Vec3i>& vertices = placed_.mesh.vertices;
  vertices.clear();
  vertices.reserve(kept);
  if (kept == snapped_.size()) {
    for (const Vec3l& v : snapped_) vertices.push_back((v - *base).as<std::int32_t>());
    return true;
  }
  renumbered_.resize(snapped_.size());
  for (std::size_t v = 0; v < snapped_.size(); ++v) {
    if (used_[v] == 0) continue;
    renumbered_[v] = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back((snapped_[v] - *base).as<std::int32_t>());
  }
  for (Triangle& t : placed_.mesh.triangles)
    for (std::uint32_t& v : t) v = renumbered_[v];
  return true;
}

const SnappedMesh* GridSnapper::snap_to_grid(const TriangleMesh& mesh, const Mat3d& linear) {
  snap_all(mesh.vertices, linear, snapped_);
  take_triangles(mesh, linear.determinant() < 0);
  return take_vertices() ? &placed_ : nullptr;
}

std::optional<SnappedMesh> snap_to_grid(const TriangleMesh& mesh, const Mat3d& linear) {
  GridSnapper snapper;
  if (snapper.snap_to_grid(mesh, linear) == nullptr) return std::nullopt;
  return std::move(snapper.placed_);
}

std::optional<SnappedWire> snap_to_grid(const Polylines& lines, const Mat3d& linear) {
  std::vector<Vec3l> snapped;
  snap_all(lines.points, linear, snapped);
  SnappedWire wire;
  std::vector<Vec3l> kept;
  std::vector<std::uint32_t> first{0};
  Box3l box = kNoBox;
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
  for (const Vec3l& p : kept) {
    wire.part.vertices.push_back((p - *base).as<std::int32_t>());
    wire.part.box.include(wire.part.vertices.back());
  }
  wire.part.chain_first = std::move(first);
  return wire;
}

double largest_scale(const Mat3d& linear) {
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
