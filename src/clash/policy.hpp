// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "strake/clash/policy.hpp"

namespace strake::clash {

// What the rules of a policy say, each by itself.

/// A usage error for a policy whose lists do not have one entry per object.
[[nodiscard]] Status check(const Policy& policy, std::size_t objects);

/// Whether pairs of two objects are left out.
[[nodiscard]] bool exempts(const SameLabel& test, std::uint32_t a, std::uint32_t b);
[[nodiscard]] bool exempts(const Linked& test, std::uint32_t a, std::uint32_t b);

/// Whether a result is meant, by its depth and its point, of whatever objects. `moved_mm`: what the
/// snap accounts for in its bracket.
[[nodiscard]] bool allows(const Allowed& rule, const Pair& pair, double moved_mm);
/// Of a result that is meant: whether its bracket reaches as deep as the rule allows.
[[nodiscard]] bool is_as_deep_as_allowed(const Allowed& rule, const Pair& pair);

/// Whether every place of a box lies within the rule's region and cavity.
[[nodiscard]] bool holds_all(const Allowed& rule, const geometry::Box3d& box);

}  // namespace strake::clash
