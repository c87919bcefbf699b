// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/core/hash.hpp"

namespace strake::clash {

/// Returns a usage error for a tolerance that is no length from 0 to a kilometre, and for what
/// objects add to it where that is none or is not of so many objects.
[[nodiscard]] Status check(const Tolerances& tolerances, std::size_t objects);

/// Returns a usage error for a tolerance that makes no sense or sets of the wrong size.
[[nodiscard]] Status check(const Options& options, const Sets& sets, std::size_t objects);

/// Whether each number has a name, or none has.
[[nodiscard]] bool are_named(const std::vector<std::uint32_t>& numbers,
                             const std::vector<Hash128>& names);

/// Returns the contact distance δ in grid units of a body whose source has this precision.
[[nodiscard]] double contact_distance(const Options& options, float precision_um);

/// Returns the step of a body's numbers in grid units where it is so coarse that a touch cannot be
/// distinguished from what is a step off; 0 where it is not, and where the contact distance is
/// given.
[[nodiscard]] float coarse_step(const Options& options, float precision_um);

}  // namespace strake::clash
