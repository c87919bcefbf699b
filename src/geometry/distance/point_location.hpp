// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0026 says why points in fans are located one after the other.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "geometry/bvh/pair_local_part.hpp"
#include "geometry/distance/bvh_in_frame.hpp"
#include "geometry/obb/rotated_part.hpp"
#include "strake/geometry/part_pair.hpp"

// Location of points in parts: of one, and of many with a tolerance band.

namespace strake::geometry {

/// Locates a point as side_of() of part_pair.hpp does; a rotated frame of the part, if given,
/// changes only the work.
[[nodiscard]] PointSide side_of(const PartWithBvh& part, const Vec3l& numerator,
                                std::int64_t denominator, QueryContext& work,
                                const RotatedFrame* frame);

enum class BandLocation : std::uint8_t { near_surface, inside, outside };

/// Returns a frame along the largest faces of a part; nothing where the part is too large to be
/// rotated.
[[nodiscard]] std::optional<RotatedFrame> frame_along_faces(const PartWithBvh& part,
                                                            const parallel::Context& context);

/// Locates many points, one after the other, in a part: within a band of its surface (distances are
/// floating point, relative error about 1e-12), else on which side of it (exactly).
///
/// Where a flat face is a fan of slivers, the boxes of half of them hold any point of it, and those
/// of rotated slivers any point of the body. For such a part the locator uses the rotated frame and
/// caches its last results: points near the surface are tried at the triangles that were near last,
/// and round them; and a point that no triangle can separate from an earlier one lies on the same
/// side. Points ordered so that near ones follow each other then cost little; any order gives the
/// same locations.
class PointLocator {
 public:
  /// `band`: grid units. `frame`: null, or a frame of this part; kept by reference.
  PointLocator(const PartWithBvh& part, double band, const RotatedFrame* frame);

  /// `at` is relative to the part's origin.
  [[nodiscard]] BandLocation location(const Vec3l& at, QueryContext& work);

 private:
  static constexpr std::size_t kRemembered = 8;

  struct Sided {
    Vec3d at;  ///< in the rotated frame
    BandLocation side = BandLocation::outside;
  };

  [[nodiscard]] bool is_near(const Vec3d& p, std::uint32_t triangle) const;
  [[nodiscard]] bool is_near_known(const Vec3d& p, QueryContext& work);
  template <class Visit>
  [[nodiscard]] bool candidates(const Vec3d& in_frame, QueryContext& work,
                                const Visit& visit) const;
  [[nodiscard]] bool near_surface(const Vec3d& p, const Vec3d& in_frame, QueryContext& work);
  [[nodiscard]] std::uint32_t towards(const Vec3d& p, std::uint32_t triangle) const;
  [[nodiscard]] const Sided* same_side(const Vec3d& in_frame, QueryContext& work) const;
  void remember(std::uint32_t triangle);

  PartWithBvh part_;
  PairLocalPart view_;
  double band_;
  const RotatedFrame* frame_;
  BvhInFrame boxes_;
  /// The latest results, as ring buffers.
  std::array<std::uint32_t, kRemembered> near_{};
  std::array<Sided, kRemembered> sided_{};
  std::size_t near_count_ = 0, sided_count_ = 0;
};

}  // namespace strake::geometry
