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
///     if (winding.openness(0.05) < 0.05 && winding.surrounds(point)) ...
///
/// 1. Floating point, the same on every machine: far triangles count together as what a small flat
///    one would fill (G. Barill et al., Fast Winding Numbers for Soups and Clouds, 2018), which is
///    off by about a hundredth. For what is to be told, not for what is to be decided.
/// 2. Where triangles do not all face the same way, more than two meet at an edge, or there are
///    several surfaces, as with a shelf within or a fin without, the sum says nothing. Then rays
///    tell: the directions that lead out meet no triangle, and from within a good part of the
///    others meets an odd number of them.
/// 3. Building costs n log n, a question some hundred boxes and triangles.
class WindingNumber {
 public:
  explicit WindingNumber(const Part& part);

  /// `at`: grid units, relative to the part's origin.
  [[nodiscard]] double at(const Vec3d& at) const;

  /// How far a ray goes to the surface, in lengths of `way`; nothing where it does not meet it.
  /// What is nearer than a millionth of `way` does not count.
  [[nodiscard]] std::optional<double> first_hit(const Vec3d& from, const Vec3d& way) const;

  /// The part of all directions that lead out of what the surface surrounds, on average over its
  /// inside: little for a body with a gap in a seam or a face too few, an eighth and more for a
  /// tank without its lid. 1 where it surrounds nothing much, as a deck and a shallow tray, and
  /// where it is certainly more than `most`.
  [[nodiscard]] double openness(double most) const;

  /// Whether a point is within, of a surface that is not very open.
  [[nodiscard]] bool surrounds(const Vec3d& at) const;

 private:
  struct Node {
    Box3d box;
    Vec3d area;                          ///< sum of the triangles' area vectors
    Vec3d centre;                        ///< of their areas
    double size = 0;                     ///< sum of their areas
    std::uint32_t first = 0, count = 0;  ///< of triangles_
    std::uint32_t left = 0;              ///< child, the right one behind it; 0: a leaf
  };

  /// Of the directions from a point, those that lead out and those that meet an odd number of
  /// triangles.
  struct Look {
    double out = 0, odd = 0;
  };

  [[nodiscard]] const Vec3d& corner(std::uint32_t triangle, std::size_t k) const;
  template <class Visit>
  void along(const Vec3d& from, const Vec3d& way, const double& far, const Visit& visit) const;
  [[nodiscard]] int crossings(const Vec3d& from, const Vec3d& way) const;
  [[nodiscard]] Look look_round(const Vec3d& from, int rays) const;
  [[nodiscard]] std::optional<double> out_of(const Vec3d& at) const;
  void split(std::size_t node);
  void measure(Node& node) const;

  std::vector<Vec3d> vertices_;
  std::vector<Triangle> triangles_;  ///< leaf by leaf
  std::vector<Node> nodes_;
  bool one_way_ = false;  ///< one surface of which all triangles face the same way
};

}  // namespace strake::geometry
