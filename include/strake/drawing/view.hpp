// SPDX-License-Identifier: Apache-2.0
// Views from text: directions, eyes and section planes as users write them.
#pragma once

#include <optional>
#include <string_view>

#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::drawing {

/// A view direction in integers, with its error against the direction requested.
struct Direction {
  geometry::Vec3l vector;     ///< points to the viewer (or up); no common factor
  bool rounded = false;       ///< the text's decimals needed more than 20 bits
  double rounding_error = 0;  ///< sine of the angle between the direction requested and `vector`
};

/// Returns the direction to the viewer of "top", "bottom", "front", "back", "left", "right" or
/// "iso".
[[nodiscard]] Result<geometry::Vec3l> direction_by_name(std::string_view name);

/// Reads a direction such as "1,-2,1". Whole numbers up to 2^20 are taken as they are; decimals are
/// scaled exactly where possible, otherwise rounded to 20 bits of the largest component and
/// reported.
[[nodiscard]] Result<Direction> parse_direction(std::string_view text);

/// Returns the direction from one point to a different one: exact where 20 bits suffice, otherwise
/// rounded and reported.
[[nodiscard]] Direction direction_between(const geometry::Vec3l& from, const geometry::Vec3l& to);

/// Makes a view one in perspective: its direction becomes that from the target to the eye, which is
/// returned with its rounding. Error: the two are the same point.
[[nodiscard]] Result<Direction> set_perspective(const hlr::Perspective& perspective,
                                                hlr::View& view);

/// The former name of set_perspective().
[[deprecated("it is called set_perspective()")]] [[nodiscard]] inline Result<Direction> see_from(
    const hlr::Perspective& perspective, hlr::View& view) {
  return set_perspective(perspective, view);
}

/// A section plane, with the error of its normal against the one requested.
struct SectionText {
  hlr::Section section;
  bool rounded = false;
  double rounding_error = 0;  ///< sine of the angle between the normals
};

/// Reads a section plane. "z>4500mm" cuts away what lies above, "z<4500mm" what lies below,
/// "z=4500mm" what is nearer to a viewer in `direction`, or at `eye`. A normal may stand in the
/// place of the axis (x, y, z), written as a direction: "1,2,0>4500mm" cuts away what lies farther
/// than that along it from the model's origin. The plane goes through the grid point nearest to its
/// foot.
[[nodiscard]] Result<SectionText> parse_section(std::string_view text,
                                                const geometry::Vec3l& direction,
                                                const std::optional<geometry::Vec3l>& eye = {});

/// Returns the upward direction that people expect of a view: z, or for plans (viewed along z) y.
[[nodiscard]] geometry::Vec3l default_up(const geometry::Vec3l& direction);

/// Returns whether `up` shows on paper, that is, is not parallel to the direction.
[[nodiscard]] bool can_be_up(const geometry::Vec3l& up, const geometry::Vec3l& direction);

}  // namespace strake::drawing
