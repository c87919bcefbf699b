// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "strake/geometry/part.hpp"

namespace strake::geometry {

/// How often a surface, closed or not, winds round a point: the solid angle that its triangles
/// fill, by that of all directions (A. Jacobson, L. Kavan, O. Sorkine-Hornung, Robust
/// Inside-Outside Segmentation using Generalized Winding Numbers, 2013). 1 within a closed surface
/// and 0 outside, and nearly so where little of it is missing.
///
///     const WindingNumber winding(part);
///     if (std::fabs(winding.at(point)) > 0.5) ...
///
/// 1. Floating point, the same on every machine: far triangles count together as what a small flat
///    one would fill (G. Barill et al., Fast Winding Numbers for Soups and Clouds, 2018), which is
///    off by about a hundredth. For what is to be told, not for what is to be decided.
/// 2. Building costs n log n, a question some hundred boxes and triangles.
class WindingNumber {
 public:
  explicit WindingNumber(const Part& part);

  /// `at`: grid units, relative to the part's origin.
  [[nodiscard]] double at(const Vec3d& at) const;

  /// How far a ray goes to the surface, in lengths of `way`; nothing where it does not meet it.
  /// What is nearer than a millionth of `way` does not count.
  [[nodiscard]] std::optional<double> first_hit(const Vec3d& from, const Vec3d& way) const;

  /// Whether the surface encloses what it surrounds but for a little: on average over its inside no
  /// more than a twentieth of all directions lead out of it. So a body with a gap in a seam or a
  /// face too few does, and a tank without its lid, a deck and a shallow tray do not.
  [[nodiscard]] bool nearly_encloses() const;

 private:
  struct Node {
    Box3d box;
    Vec3d area;                          ///< sum of the triangles' area vectors
    Vec3d centre;                        ///< of their areas
    double size = 0;                     ///< sum of their areas
    std::uint32_t first = 0, count = 0;  ///< of triangles_
    std::uint32_t left = 0;              ///< child, the right one behind it; 0: a leaf
  };

  [[nodiscard]] const Vec3d& corner(std::uint32_t triangle, std::size_t k) const;
  void split(std::size_t node);
  void measure(Node& node) const;

  std::vector<Vec3d> vertices_;
  std::vector<Triangle> triangles_;  ///< leaf by leaf
  std::vector<Node> nodes_;
};

}  // namespace strake::geometry
