// SPDX-License-Identifier: Apache-2.0
#include "geometry/one_side.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "strake/geometry/triangle_contact.hpp"

namespace strake::geometry {
namespace {

/// Most vertices of a times triangles of b.
constexpr std::size_t kMostSides = std::size_t{1} << 16U;

/// The planes that were last found to have a on one side: files write faces in turns.
class RecentPlanes {
 public:
  /// Whether a triangle lies in one of them, which then is the last.
  bool holds(const ExactTriangle& t) {
    for (std::size_t i = 0; i < planes_.size() && planes_[i]; ++i) {
      const ExactPlane& plane = *planes_[i];
      if (std::ranges::any_of(t.corner, [&](const Vec3l& p) { return plane.side(p) != 0; }))
        continue;
      std::rotate(planes_.begin(), planes_.begin() + static_cast<std::ptrdiff_t>(i),
                  planes_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      return true;
    }
    return false;
  }
  void add(const ExactPlane& plane) {
    std::ranges::rotate(planes_, planes_.end() - 1);
    planes_.front() = plane;
  }

 private:
  std::array<std::optional<ExactPlane>, 4> planes_;
};

}  // namespace

bool lies_on_one_side(const PartView& a, const PartView& b) {
  const auto vertices = static_cast<std::uint32_t>(a.part().vertices.size());
  const auto triangles = static_cast<std::uint32_t>(b.part().triangles.size());
  if (std::size_t{vertices} * triangles > kMostSides) return false;
  RecentPlanes known;
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const ExactTriangle face = b.triangle(t);
    if (known.holds(face)) continue;
    int side = 0;
    for (std::uint32_t v = 0; v < vertices; ++v) {
      const int other = face.plane.side(a.vertex(v));
      if (side * other < 0) return false;
      if (other != 0) side = other;
    }
    if (side == 0) return false;
    known.add(face.plane);
  }
  return true;
}

}  // namespace strake::geometry
