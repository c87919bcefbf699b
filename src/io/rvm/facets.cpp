// SPDX-License-Identifier: Apache-2.0
#include "io/rvm/facets.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

#include "strake/geometry/triangulate.hpp"

namespace strake::io::rvm {

namespace {

using geometry::Vec3d;

constexpr std::size_t kVertexBytes = 24;  // position and normal

/// Gives equal positions one index, in order of first appearance. Open addressing: a facet group
/// has few vertices, and there are many groups.
class Welder {
 public:
  Welder(std::size_t at_most, std::vector<Vec3d>& vertices)
      : slots_(std::bit_ceil(at_most * 2 + 2), kFree), vertices_(&vertices) {}

  std::uint32_t index_of(float x, float y, float z) {
    // Adding zero makes -0 the same as +0.
    const Vec3d v{static_cast<double>(x) + 0.0, static_cast<double>(y) + 0.0,
                  static_cast<double>(z) + 0.0};
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t at = hash(v) & mask;; at = (at + 1) & mask) {
      if (slots_[at] == kFree) {
        slots_[at] = static_cast<std::uint32_t>(vertices_->size());
        vertices_->push_back(v);
      }
      if ((*vertices_)[slots_[at]] == v) return slots_[at];
    }
  }

 private:
  static constexpr std::uint32_t kFree = 0xffffffffU;
  static std::size_t hash(const Vec3d& v) {
    std::uint64_t h = 0;
    for (const double c : {v.x, v.y, v.z}) {
      h = (h ^ std::bit_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15ULL;
      h ^= h >> 29;
    }
    return static_cast<std::size_t>(h);
  }
  std::vector<std::uint32_t> slots_;
  std::vector<Vec3d>* vertices_;
};

/// The contours of one polygon as vertex indices; ring i is indices[first[i] .. first[i + 1]).
struct Polygon {
  std::vector<std::uint32_t> indices;
  std::vector<std::uint32_t> first;

  void clear() {
    indices.clear();
    first.assign(1, 0);
  }
  [[nodiscard]] std::size_t rings() const { return first.size() - 1; }
};

class FacetBuilder {
 public:
  explicit FacetBuilder(Bytes payload)
      : in_(payload), welder_(payload.size() / kVertexBytes, out_.mesh.vertices) {}

  FacetMesh build() {
    out_.polygons = in_.u32();
    for (std::uint32_t p = 0; p < out_.polygons && !in_.failed(); ++p) {
      switch (read_polygon()) {
        case Read::good:
          add_polygon();
          break;
        case Read::nonfinite:
          ++out_.nonfinite;
          break;
        case Read::degenerate:
          ++out_.degenerate;
          break;
      }
    }
    return std::move(out_);
  }

 private:
  enum class Read { good, nonfinite, degenerate };

  Read read_polygon();
  [[nodiscard]] bool read_contour(bool& finite);
  void add_polygon();
  void add_quad();
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    out_.mesh.triangles.push_back({a, b, c});
    out_.mesh.faces.push_back(face_);
  }
  void add_fan();
  [[nodiscard]] bool is_convex() const;
  void add_general();
  [[nodiscard]] const Vec3d& at(std::uint32_t index) const { return out_.mesh.vertices[index]; }

  Cursor in_;
  FacetMesh out_;
  Welder welder_;
  Polygon polygon_;
  std::vector<Vec3d> points_;
  std::uint32_t face_ = 0;
};

/// Reads one contour as a ring without repeated neighbours; false when fewer than three remain.
bool FacetBuilder::read_contour(bool& finite) {
  const std::uint32_t count = in_.u32();
  const std::size_t begin = polygon_.indices.size();
  for (std::uint32_t v = 0; v < count && !in_.failed(); ++v) {
    const float x = in_.f32(), y = in_.f32(), z = in_.f32();
    in_.skip(kVertexBytes - 12);
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) {
      finite = false;
      continue;
    }
    out_.largest = std::max({out_.largest, std::fabs(x), std::fabs(y), std::fabs(z)});
    const std::uint32_t index = welder_.index_of(x, y, z);
    if (polygon_.indices.size() == begin || polygon_.indices.back() != index)
      polygon_.indices.push_back(index);
  }
  while (polygon_.indices.size() > begin + 1 && polygon_.indices.back() == polygon_.indices[begin])
    polygon_.indices.pop_back();
  if (polygon_.indices.size() - begin < 3) {
    polygon_.indices.resize(begin);
    return false;
  }
  polygon_.first.push_back(static_cast<std::uint32_t>(polygon_.indices.size()));
  return true;
}

FacetBuilder::Read FacetBuilder::read_polygon() {
  polygon_.clear();
  const std::uint32_t contours = in_.u32();
  bool finite = true, outer_kept = contours > 0;
  for (std::uint32_t c = 0; c < contours && !in_.failed(); ++c) {
    if (read_contour(finite)) continue;
    if (c == 0) {
      outer_kept = false;
    } else if (finite) {
      ++out_.short_contours;
    }
  }
  if (!finite) return Read::nonfinite;
  return outer_kept ? Read::good : Read::degenerate;
}

void FacetBuilder::add_polygon() {
  const std::vector<std::uint32_t>& ring = polygon_.indices;
  if (polygon_.rings() == 1 && ring.size() == 3) {
    add_triangle(ring[0], ring[1], ring[2]);
  } else if (polygon_.rings() == 1 && ring.size() == 4) {
    add_quad();
  } else {
    add_general();
  }
  ++face_;
}

/// Splits a quadrilateral along the diagonal whose two triangles bend least; a concave corner
/// shows as triangles that face apart, so it is split right by the same rule.
void FacetBuilder::add_quad() {
  const std::vector<std::uint32_t>& q = polygon_.indices;
  const auto normal = [&](std::size_t a, std::size_t b, std::size_t c) {
    return cross(at(q[b]) - at(q[a]), at(q[c]) - at(q[a]));
  };
  const auto cosine = [](const Vec3d& m, const Vec3d& n) {
    const double lengths = std::sqrt(dot(m, m)) * std::sqrt(dot(n, n));
    return lengths > 0 ? dot(m, n) / lengths : -1.0;
  };
  const double bend02 = cosine(normal(0, 1, 2), normal(0, 2, 3));
  const double bend13 = cosine(normal(0, 1, 3), normal(1, 2, 3));
  constexpr double kCosHalfDegree = 0.99996192306417;
  const bool one_face = std::max(bend02, bend13) >= kCosHalfDegree;
  // The first diagonal unless the second is really flatter: rounding must not choose.
  const bool second = bend13 > bend02 + 1e-9;
  add_triangle(q[0], q[1], second ? q[3] : q[2]);
  if (!one_face) ++face_;
  if (second)
    add_triangle(q[1], q[2], q[3]);
  else
    add_triangle(q[0], q[2], q[3]);
}

/// True when every corner of the only ring turns the same way and the fan from its first vertex
/// covers the polygon once.
bool FacetBuilder::is_convex() const {
  const std::vector<std::uint32_t>& ring = polygon_.indices;
  const std::size_t n = ring.size();
  Vec3d normal;
  for (std::size_t i = 2; i < n; ++i)
    normal = normal + cross(at(ring[i - 1]) - at(ring[0]), at(ring[i]) - at(ring[0]));
  const auto turns = [&](std::size_t a, std::size_t b, std::size_t c) {
    return dot(cross(at(ring[b]) - at(ring[a]), at(ring[c]) - at(ring[a])), normal) > 0;
  };
  for (std::size_t i = 0; i < n; ++i)
    if (!turns(i, (i + 1) % n, (i + 2) % n)) return false;
  for (std::size_t i = 2; i < n; ++i)
    if (!turns(0, i - 1, i)) return false;
  return true;
}

void FacetBuilder::add_fan() {
  for (std::size_t i = 2; i < polygon_.indices.size(); ++i)
    add_triangle(polygon_.indices[0], polygon_.indices[i - 1], polygon_.indices[i]);
}

void FacetBuilder::add_general() {
  if (polygon_.rings() == 1 && is_convex()) {
    add_fan();
    return;
  }
  points_.clear();
  for (const std::uint32_t index : polygon_.indices) points_.push_back(at(index));
  const geometry::FaceTriangles face = geometry::triangulate_face(points_, polygon_.first);
  if (face.fault == geometry::FaceFault::no_area && polygon_.rings() == 1) {
    add_fan();  // its edges may seal a solid
    return;
  }
  if (face.fault != geometry::FaceFault::none) {
    ++(face.fault == geometry::FaceFault::crossing ? out_.untriangulated : out_.degenerate);
    return;
  }
  for (const geometry::Triangle& t : face.triangles)
    add_triangle(polygon_.indices[t[0]], polygon_.indices[t[1]], polygon_.indices[t[2]]);
}

}  // namespace

std::optional<Bytes> take_facets(Cursor& cursor, Bytes all) {
  const std::size_t begin = cursor.at();
  const std::uint32_t polygons = cursor.u32();
  if (polygons > cursor.left() / 4) return std::nullopt;
  for (std::uint32_t p = 0; p < polygons; ++p) {
    const std::uint32_t contours = cursor.u32();
    if (contours > cursor.left() / 4) return std::nullopt;
    for (std::uint32_t c = 0; c < contours; ++c) {
      const std::size_t vertices = cursor.u32();
      if (vertices > cursor.left() / kVertexBytes) return std::nullopt;
      cursor.skip(vertices * kVertexBytes);
    }
  }
  if (cursor.failed()) return std::nullopt;
  return all.subspan(begin, cursor.at() - begin);
}

FacetMesh build_facets(Bytes payload) { return FacetBuilder(payload).build(); }

}  // namespace strake::io::rvm
