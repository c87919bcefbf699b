// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "io/source/text_number.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::io::stl {

struct StlDamage {
  std::string message;
  std::uint64_t line = 0;  ///< 1-based
};

/// One "solid … endsolid" block; every three corners are a facet.
struct Solid {
  std::string name;
  std::vector<geometry::Vec3d> corners;
  DigitStatistics digits;           ///< the digits of its corners
  std::optional<StlDamage> damage;  ///< the first damage; its facet is left out
  std::uint64_t bad_facets = 0;     ///< facets that are left out
  /// The line on which it stops without its endsolid: what else it held cannot be known.
  std::optional<std::uint64_t> cut_off;
};

/// Whether the text starts with "solid" and goes on with facets or ends.
[[nodiscard]] bool is_like_ascii(std::string_view text);

/// Parses the text; returns nothing when stopped.
[[nodiscard]] std::optional<std::vector<Solid>> parse_ascii(std::string_view text,
                                                            const std::stop_token& stop);

}  // namespace strake::io::stl
