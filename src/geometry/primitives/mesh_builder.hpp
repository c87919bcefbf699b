// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "geometry/numeric/trig.hpp"
#include "geometry/primitives/tessellate.hpp"

// What the tessellations of all kinds share: circle points, the mesh builder and revolution sweeps.

namespace strake::geometry::tessellation {

/// The target of a tessellation: the map to the placed frame, and the sag in local length.
struct TessellationTarget {
  Mat3d linear;
  double sag = 0;
  /// Unit local direction to the viewer whose silhouettes are edges; none: no such view.
  std::optional<Vec3d> towards;
  /// The eye in local coordinates whose silhouettes are edges; none: no view in perspective.
  std::optional<Vec3d> eye;
};

/// The share of the sag that the chords of an end circle may take. The rest is for the other
/// direction of doubly curved faces, so that an elbow has the same end polygon as the pipe that it
/// continues.
inline constexpr double kRimShare = 0.75;

/// In radii: from an eye that is nearer to an axis or a centre than this there is no contour.
inline constexpr double kNearestEye = 1.02;

[[nodiscard]] Tessellation fault(std::string_view why);

/// Returns where an end circle starts in its own plane: the direction (cos, sin) between the two
/// plane axes whose images are given, chosen from the image's normal (up to sign) alone: the
/// projection of Z on the plane, or of X when the normal is within 26 degrees of Z.
[[nodiscard]] SinCos canonical_phase(const Vec3d& image_x, const Vec3d& image_y);

/// Returns the unit direction that a map takes to the given one, up to its length: a local normal
/// perpendicular to it has a placed one perpendicular to the given one. None where the map flattens
/// it.
[[nodiscard]] std::optional<Vec3d> local_direction(const Mat3d& linear, const Vec3d& placed);

/// Returns where the silhouette of a pipe lies in its section: perpendicular to the direction to
/// the viewer, given along two axes of the section and along the pipe. None where that is along the
/// pipe.
[[nodiscard]] std::optional<SinCos> contour_phase(double x, double y, double along);

/// Where a pipe turns away from an eye, as angles in its section: it faces the eye from `first` to
/// `second`, which is the larger one.
struct EyeContour {
  double first = 0, second = 0;

  /// Returns it for a pipe of this radius, from where the eye lies along two axes of the section.
  /// None where the eye lies in the pipe or so near to it that the far side would be most of the
  /// section.
  [[nodiscard]] static std::optional<EyeContour> of(double x, double y, double radius);

  /// Returns the angle of the side that faces away, the larger one.
  [[nodiscard]] double far_side() const { return 2 * kPi - (second - first); }
};

/// Whether an eye is so far from a pipe's axis, in its section, that both sides of its contour may
/// have equally many chords.
[[nodiscard]] bool is_far(double x, double y, double radius);

/// Returns a circle about local Z in a view in perspective: half of its chords on either side of
/// the contour, of which more are taken where the eye is near. None: no contour.
[[nodiscard]] std::optional<std::vector<SinCos>> rim_from_eye(const TessellationTarget& target,
                                                              double radius);

/// Returns point `k` of a circle of `segments` chords, half of them on either side of a contour.
[[nodiscard]] SinCos point_between(const EyeContour& contour, int segments, int k);

/// Returns where a circle about local Z starts: at the silhouette in a view, else at the canonical
/// phase.
[[nodiscard]] SinCos rim_phase(const TessellationTarget& target);

/// Returns the image of a local axis.
[[nodiscard]] Vec3d column(const Mat3d& m, int axis);

/// Returns points of a unit circle with a vertex at `phase`.
[[nodiscard]] std::vector<SinCos> rim(int segments, const SinCos& phase);

/// Returns the circle of a pipe of this radius about local Z: as its contour from the eye wants it,
/// else of `segments` chords with a vertex where circles start.
[[nodiscard]] std::vector<SinCos> rim_of(const TessellationTarget& target, double radius,
                                         int segments);

/// Returns a circle with two more points anywhere: points of it within a quarter of an even step of
/// one are dropped, unless one of them is that very point, and the two are left out where they lie
/// so near to each other.
[[nodiscard]] std::vector<SinCos> rim_with(const std::vector<SinCos>& regular,
                                           const std::array<SinCos, 2>& contours);

/// Returns the widest angle between consecutive points, which run counter-clockwise.
[[nodiscard]] double widest_step(std::span<const SinCos> rim);

/// Triangles in local coordinates, gathered face by face.
class MeshBuilder {
 public:
  /// In a view, a quad that is not planar gets the diagonal whose triangles both face the same way
  /// as the whole quad.
  explicit MeshBuilder(const std::optional<Vec3d>& towards = std::nullopt,
                       const std::optional<Vec3d>& eye = std::nullopt)
      : towards_(towards), eye_(eye) {}

  std::uint32_t vertex(const Vec3d& v);
  /// Adds a planar convex polygon, counter-clockwise seen from outside; `reversed` flips it.
  void polygon(std::span<const std::uint32_t> ring, bool reversed = false);
  /// Adds a planar quad as a face of its own.
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);
  /// Adds a planar quad to the face that `face()` returned.
  void quad_of(std::uint32_t face, std::uint32_t a, std::uint32_t b, std::uint32_t c,
               std::uint32_t d);
  [[nodiscard]] std::uint32_t face() { return faces_++; }
  [[nodiscard]] Tessellation take(double sag) &&;

 private:
  void triangle(std::uint32_t face, std::uint32_t a, std::uint32_t b, std::uint32_t c);
  [[nodiscard]] bool other_diagonal(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                                    std::uint32_t d) const;

  std::optional<Vec3d> towards_, eye_;
  TriangleMesh mesh_;
  std::uint32_t faces_ = 0;
};

/// Whether every length is finite and not negative.
[[nodiscard]] bool are_lengths(std::initializer_list<double> lengths);

[[nodiscard]] Tessellation make(const BoxPrimitive& p, const TessellationTarget& target);
[[nodiscard]] Tessellation make(const PyramidPrimitive& p, const TessellationTarget& target);
[[nodiscard]] Tessellation make(const CylinderPrimitive& p, const TessellationTarget& target);
[[nodiscard]] Tessellation make(const SnoutPrimitive& p, const TessellationTarget& target);
[[nodiscard]] Tessellation make(const SpherePrimitive& p, const TessellationTarget& target);
[[nodiscard]] Tessellation make(const EllipticalDishPrimitive& p, const TessellationTarget& target);
[[nodiscard]] Tessellation make(const SphericalDishPrimitive& p, const TessellationTarget& target);
[[nodiscard]] Tessellation make(const CircularTorusPrimitive& p, const TessellationTarget& target);
/// Returns a torus whose silhouettes from the eye run along its net; none where the eye is in or
/// near the tube, or looks along it. `segments` of a section, `rest` of the sag for the sweep.
[[nodiscard]] std::optional<Tessellation> torus_from_eye(const CircularTorusPrimitive& p,
                                                         const TessellationTarget& target,
                                                         int segments, double rest);

[[nodiscard]] Tessellation make(const RectangularTorusPrimitive& p,
                                const TessellationTarget& target);
[[nodiscard]] Tessellation make(const LinePrimitive& p, const TessellationTarget& target);

/// A point of a profile: distance from the axis and height along it.
struct ProfilePoint {
  double radius = 0, z = 0;
};

/// The directions in which a profile is swept about the local Z axis.
struct RevolutionSweep {
  std::vector<SinCos> directions;  ///< one more than there are steps, unless full
  bool full = false;               ///< the last direction is followed by the first again
};

/// Sweeps a profile, counter-clockwise in (radius, z), whose points at radius 0 stay on the axis.
/// An open profile with both ends on the axis, or a loop, gives a closed surface; a partial sweep
/// gets planar caps, which must be convex.
///
/// at(i, j) is point i of the profile at direction j; points at radius 0 must be so for every j.
template <class At>
std::vector<std::vector<std::uint32_t>> revolve(MeshBuilder& builder, const RevolutionSweep& sweep,
                                                std::size_t points, bool loop, At&& at) {
  const std::size_t count = sweep.directions.size();
  std::vector<std::vector<std::uint32_t>> grid(points, std::vector<std::uint32_t>(count));
  for (std::size_t i = 0; i < points; ++i)
    for (std::size_t j = 0; j < count; ++j) {
      const ProfilePoint p = at(i, j);
      const SinCos& d = sweep.directions[j];
      grid[i][j] = p.radius == 0 && j > 0
                       ? grid[i][0]
                       : builder.vertex({p.radius * d.cos, p.radius * d.sin, p.z});
    }
  const std::size_t bands = loop ? points : points - 1;
  for (std::size_t i = 0; i < bands; ++i) {
    const auto &low = grid[i], &high = grid[i + 1 == points ? 0 : i + 1];
    const bool flat = at(i, 0).z == at(i + 1 == points ? 0 : i + 1, 0).z && loop && points == 4;
    const std::uint32_t annulus = flat ? builder.face() : 0;
    for (std::size_t j = 0; j + (sweep.full ? 0 : 1) < count; ++j) {
      const std::size_t k = j + 1 == count ? 0 : j + 1;
      if (flat)
        builder.quad_of(annulus, low[j], low[k], high[k], high[j]);
      else
        builder.quad(low[j], low[k], high[k], high[j]);
    }
  }
  if (sweep.full) return grid;
  std::vector<std::uint32_t> first, last;
  for (const auto& row : grid) {
    first.push_back(row.front());
    last.push_back(row.back());
  }
  builder.polygon(first);
  builder.polygon(last, true);
  return grid;
}

}  // namespace strake::geometry::tessellation
