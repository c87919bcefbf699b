// SPDX-License-Identifier: Apache-2.0
#include "io/rvm/facet_group.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "strake/geometry/triangulate.hpp"

namespace strake::io::rvm {

namespace {

using geometry::Vec3d;

constexpr std::size_t kVertexBytes = 24;  // position and normal

constexpr std::uint32_t kNowhere = 0xffffffffU;

struct FacetVertex {
  float x = 0, y = 0, z = 0;

  [[nodiscard]] bool finite() const {
    return std::isfinite(x) && std::isfinite(y) && std::isfinite(z);
  }
  [[nodiscard]] float largest() const {
    return std::max({std::fabs(x), std::fabs(y), std::fabs(z)});
  }
  /// Adding zero makes -0 the same as +0.
  [[nodiscard]] Vec3d position() const {
    return {static_cast<double>(x) + 0.0, static_cast<double>(y) + 0.0,
            static_cast<double>(z) + 0.0};
  }
};

FacetVertex read_corner(BigEndianCursor& in) {
  FacetVertex corner;
  corner.x = in.f32();
  corner.y = in.f32();
  corner.z = in.f32();
  in.skip(kVertexBytes - 12);  // a normal
  return corner;
}

/// Reads all corners of a facet group, one after another.
std::vector<FacetVertex> read_corners(BigEndianCursor in) {
  std::vector<FacetVertex> corners;
  corners.reserve(in.left() / kVertexBytes);
  const std::uint32_t polygons = in.u32();
  for (std::uint32_t p = 0; p < polygons && !in.failed(); ++p) {
    const std::uint32_t contours = in.u32();
    for (std::uint32_t c = 0; c < contours && !in.failed(); ++c) {
      const std::uint32_t count = in.u32();
      for (std::uint32_t v = 0; v < count && !in.failed(); ++v) corners.push_back(read_corner(in));
    }
  }
  return corners;
}

struct NumberedCorner {
  FacetVertex at;
  std::uint32_t number = 0;

  [[nodiscard]] bool same_place(const NumberedCorner& other) const {
    return at.x == other.at.x && at.y == other.at.y && at.z == other.at.z;
  }
  friend bool operator<(const NumberedCorner& a, const NumberedCorner& b) {
    if (a.at.x != b.at.x) return a.at.x < b.at.x;
    if (a.at.y != b.at.y) return a.at.y < b.at.y;
    if (a.at.z != b.at.z) return a.at.z < b.at.z;
    return a.number < b.number;
  }
};

/// Gives equal positions one vertex, in order of first appearance, and each corner its vertex:
/// kNowhere where it has no position. It sorts: corners can be made to collide in any hash.
std::vector<std::uint32_t> weld(std::span<const FacetVertex> corners,
                                std::vector<Vec3d>& vertices) {
  std::vector<NumberedCorner> sorted;
  sorted.reserve(corners.size());
  for (std::uint32_t i = 0; i < corners.size(); ++i)
    if (corners[i].finite()) sorted.push_back({corners[i], i});
  std::sort(sorted.begin(), sorted.end());
  // First the corner at which each place appears first, then the vertex that this one has by then.
  std::vector<std::uint32_t> vertex_of(corners.size(), kNowhere);
  std::uint32_t first = 0;
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    if (k == 0 || !sorted[k].same_place(sorted[k - 1])) first = sorted[k].number;
    vertex_of[sorted[k].number] = first;
  }
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    std::uint32_t& vertex = vertex_of[i];
    if (vertex == kNowhere) continue;
    if (vertex != i) {
      vertex = vertex_of[vertex];
      continue;
    }
    vertex = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back(corners[i].position());
  }
  return vertex_of;
}

/// The contours of one polygon as vertex indices; ring i is indices[first[i] .. first[i + 1]).
struct FacetPolygon {
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
      : in_(payload), corners_(read_corners(in_)), vertex_of_(weld(corners_, out_.mesh.vertices)) {}

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

  BigEndianCursor in_;
  FacetMesh out_;
  std::vector<FacetVertex> corners_;
  std::vector<std::uint32_t> vertex_of_;  ///< per corner
  std::size_t corner_ = 0;                ///< the next
  FacetPolygon polygon_;
  std::vector<Vec3d> points_;
  std::uint32_t face_ = 0;
};

/// Reads one contour as a ring without repeated neighbours; returns false when fewer than three
/// remain.
bool FacetBuilder::read_contour(bool& finite) {
  const std::uint32_t count = in_.u32();
  const std::size_t begin = polygon_.indices.size();
  for (std::uint32_t v = 0; v < count && !in_.failed(); ++v) {
    in_.skip(kVertexBytes);
    const std::uint32_t index = vertex_of_[corner_];
    const FacetVertex& corner = corners_[corner_++];
    if (index == kNowhere) {
      finite = false;
      continue;
    }
    out_.largest = std::max(out_.largest, corner.largest());
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

/// Whether every corner of the only ring turns the same way and the fan from its first vertex
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

std::optional<Bytes> take_facet_bytes(BigEndianCursor& cursor, Bytes all) {
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

FacetMesh triangulate_facets(Bytes payload) { return FacetBuilder(payload).build(); }

}  // namespace strake::io::rvm
