// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::drawing {

/// A view direction in integers, with how far it is from what was asked for.
struct Direction {
  geometry::Vec3l vector;     ///< points to the viewer (or up); no common factor
  bool rounded = false;       ///< the text's decimals needed more than 20 bits
  double rounding_error = 0;  ///< sine of the angle between what was asked for and `vector`
};

/// "top", "bottom", "front", "back", "left", "right" or "iso": the direction to the viewer.
[[nodiscard]] Result<geometry::Vec3l> direction_by_name(std::string_view name);

/// "1,-2,1" as a direction. Whole numbers up to 2^20 are taken as they are; decimals are scaled
/// exactly where they can be, otherwise rounded to 20 bits of the largest component and reported.
[[nodiscard]] Result<Direction> parse_direction(std::string_view text);

/// The direction from one point to another that is not the same: exact where 20 bits suffice,
/// otherwise rounded and reported.
[[nodiscard]] Direction direction_between(const geometry::Vec3l& from, const geometry::Vec3l& to);

/// Makes a view one in perspective: its direction is that from the target to the eye, returned with
/// how far it is from it. Error: the two are the same point.
[[nodiscard]] Result<Direction> see_from(const hlr::Perspective& perspective, hlr::View& view);

/// A section plane, with how far its normal is from what was asked for.
struct SectionText {
  hlr::Section section;
  bool rounded = false;
  double rounding_error = 0;  ///< sine of the angle between the normals
};

/// "z>4500mm" cuts away what lies above, "z<4500mm" what lies below, "z=4500mm" what is nearer to
/// a viewer in `direction`, or at `eye`. In the place of the axis (x, y, z) may stand the numbers
/// of a normal, as of a direction: "1,2,0>4500mm" cuts away what lies farther along it from the
/// model's origin than that. The plane goes through the grid point nearest to its foot.
[[nodiscard]] Result<SectionText> parse_section(std::string_view text,
                                                const geometry::Vec3l& direction,
                                                const std::optional<geometry::Vec3l>& eye = {});

/// The upward direction that people expect of a view: z, or for plans (viewed along z) y.
[[nodiscard]] geometry::Vec3l default_up(const geometry::Vec3l& direction);

/// Whether `up` shows on paper: it is not parallel to the direction.
[[nodiscard]] bool can_be_up(const geometry::Vec3l& up, const geometry::Vec3l& direction);

}  // namespace strake::drawing
