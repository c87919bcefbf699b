// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "strake/geometry/part.hpp"

namespace strake::geometry {

/// How often a surface, closed or not, winds round a point: the solid angle of its triangles over
/// that of all directions (A. Jacobson, L. Kavan, O. Sorkine-Hornung, Robust Inside-Outside
/// Segmentation using Generalized Winding Numbers, 2013). It is 1 within a closed surface and 0
/// outside, and nearly so where little of the surface is missing.
///
///     const WindingNumber winding(part);
///     if (winding.openness(0.05) < 0.05 && winding.surrounds(point)) ...
///
/// 1. Floating point, the same on every machine: far triangles count together as a small flat one
///    (G. Barill et al., Fast Winding Numbers for Soups and Clouds, 2018), which is off by about a
///    hundredth. Use it for marks such as UNCERTAIN, not for classes.
/// 2. Where triangles do not all face the same way, more than two meet at an edge, or there are
///    several surfaces, as with a shelf inside or a fin outside, the sum is meaningless. Then rays
///    decide: the directions that lead out meet no triangle, and from inside a good part of the
///    others meets an odd number of them.
/// 3. Building costs n log n; a query visits some hundred boxes and triangles.
class WindingNumber {
 public:
  explicit WindingNumber(const Part& part);

  /// Returns the winding number at a point in grid units, relative to the part's origin.
  [[nodiscard]] double at(const Vec3d& at) const;

  /// Returns the distance along a ray to the surface, in lengths of `way`; nothing where it misses.
  /// Hits nearer than a millionth of `way` do not count.
  [[nodiscard]] std::optional<double> first_hit(const Vec3d& from, const Vec3d& way) const;

  /// Returns the share of directions that lead out of the surface, on average over its interior:
  /// little for a body with a gap in a seam or a missing face, an eighth and more for a tank
  /// without its lid. 1 where it surrounds almost nothing, as a deck or a shallow tray, and where
  /// the share is certainly more than `limit`.
  [[nodiscard]] double openness(double limit) const;

  /// Whether a surface that is not very open surrounds a point.
  [[nodiscard]] bool surrounds(const Vec3d& at) const;

 private:
  struct Node {
    Box3d box;
    Vec3d area;                          ///< sum of the triangles' area vectors
    Vec3d centre;                        ///< of their areas
    double size = 0;                     ///< sum of their areas
    std::uint32_t first = 0, count = 0;  ///< of triangles_
    std::uint32_t left = 0;              ///< left child, the right one follows it; 0: a leaf
  };

  [[nodiscard]] const Vec3d& corner(std::uint32_t triangle, std::size_t k) const;
  template <class Visit>
  void along(const Vec3d& from, const Vec3d& way, const double& far, const Visit& visit) const;
  [[nodiscard]] int crossings(const Vec3d& from, const Vec3d& way) const;
  [[nodiscard]] std::optional<double> share_out(const Vec3d& from, int rays, double limit) const;
  [[nodiscard]] std::optional<double> out_of(const Vec3d& at) const;
  void split(std::size_t node);
  void measure(Node& node) const;

  std::vector<Vec3d> vertices_;
  std::vector<Triangle> triangles_;  ///< leaf by leaf
  std::vector<Node> nodes_;
  bool one_way_ = false;  ///< one surface, all of whose triangles face the same way
};

}  // namespace strake::geometry
