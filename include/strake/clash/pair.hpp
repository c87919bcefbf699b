// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "strake/clash/options.hpp"
#include "strake/clash/relation.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/model/model.hpp"

/// What is found about one pair of objects.
namespace strake::clash {

/// The classes of a result, from the least to the most severe.
enum class Class : std::uint8_t { no_hit, clearance_violation, contact, hit };

/// What a part counts as, from the most to the least solid; `none` is not checked at all.
enum class Level : std::uint8_t { hard, soft, insulation, none };

/// Bits of Pair::flags.
enum Flag : std::uint16_t {
  kBorderline =
      1U << 0U,  ///< d cannot be distinguished from a threshold: the severer class is given
  kUncertain = 1U << 1U,  ///< the bracket straddles a threshold: the class is that of d
  kOpen = 1U << 2U,       ///< one of the two is an open surface
  kInverted = 1U << 3U,   ///< one of the two came inside out
};

/// One of several regions where a pair of objects meets or comes too near.
struct Region {
  Class cls = Class::no_hit;
  std::uint16_t flags = 0;
  double d_mm = 0, d_lower_mm = 0, d_upper_mm = 0;  ///< as in Pair, for this region alone
  geometry::Vec3d point_mm;
  geometry::Box3d box_mm;                ///< encloses the region
  std::uint32_t part_a = 0, part_b = 0;  ///< the deciding parts
  std::int32_t allowed = -1;             ///< the rule that allows it, as in Pair::allowed
  bool depth_complete = true;            ///< as in Pair
};

/// One pair of objects that is not NO_HIT; a < b in the durable order, whichever set they are in:
/// Report::in_a and in_b tell.
struct Pair {
  model::ObjectId a{}, b{};
  Class cls = Class::no_hit;
  Relation relation = Relation::separate;
  std::uint16_t flags = 0;
  /// The signed separation; negative is depth. The depth of a HIT is not the minimal translation
  /// distance (penetration depth as EPA returns it) but the largest distance that a point of the
  /// common part has from the surface of either; `away` is what moves the two apart there.
  double d_mm = 0;
  double d_lower_mm = 0, d_upper_mm = 0;  ///< the certified bracket round d
  geometry::Vec3d point_mm;  ///< the midpoint of the closest pair, or the deepest point
  /// A move of a by on_b - on_a, which is |d| long, brings the two points together. For d >= 0 they
  /// are the closest points; for d < 0 one is the deepest point, the other surface_mm().
  geometry::Vec3d on_a_mm, on_b_mm;
  /// The unit vector along which a moves away from b or out of it (`push_out` in files). It is zero
  /// where there is none: parts that touch, sheets that cross.
  geometry::Vec3d away;
  bool deep_in_a = false;  ///< for d < 0: d is measured to the surface of a
  /// False where a search for the depth ended at its work limit and left the bracket wider than it
  /// aims for.
  bool depth_complete = true;
  /// For a HIT of solids, where requested: the volume of the common parts of their parts, added up
  /// (what two parts of one object cover twice counts twice), with curved primitives as
  /// tessellated. It is absent where it would take too long.
  std::optional<double> volume_mm3 = {};
  std::uint32_t part_a = 0, part_b = 0;  ///< the deciding parts, numbered within their objects
  Level level_a = Level::hard, level_b = Level::hard;  ///< the levels of the deciding parts
  /// The rule that allows this result, as an index into Report::allowed; negative if none does.
  std::int32_t allowed = -1;
  /// The severest class that the brackets leave open for a result that no rule allows; where no
  /// rule allows this one, its own class. It is more than cls only with kUncertain. NO_HIT says
  /// that whatever the two turn out to be is allowed.
  Class severest = Class::no_hit;
  /// Where requested: the number of separate regions, 0 where there are too many triangles to tell
  /// them apart. If there are several, as many as requested are listed from
  /// Report::regions[first_region] on.
  std::uint32_t regions = 0, first_region = 0;
  /// For a result that no rule allows: the number of its regions that a rule does allow, which
  /// `regions` leaves out. They are counted whether regions are requested or not; as many as asked
  /// for are listed behind the others.
  std::uint32_t allowed_regions = 0;

  [[nodiscard]] std::uint32_t regions_listed(const Options& options) const {
    return regions < 2 ? 0 : options.engine.regions_listed_of(regions);
  }
  [[nodiscard]] std::uint32_t allowed_regions_listed(const Options& options) const {
    return options.engine.regions_listed_of(allowed_regions);
  }
  /// The nearest point of the surface that d is measured to, for d < 0.
  [[nodiscard]] const geometry::Vec3d& surface_mm() const { return deep_in_a ? on_a_mm : on_b_mm; }
};

/// A pair that an exemption took; a < b in the durable order.
struct ExemptedPair {
  model::ObjectId a{}, b{};
  std::uint32_t rule = 0;  ///< index into Report::exempted
};

}  // namespace strake::clash
