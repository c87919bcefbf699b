// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "strake/clash/clash.hpp"
#include "strake/clash/policy.hpp"

/// What a test says of some of the objects of a model, numbered by their places in a list of them:
/// labels and what else is compared for being equal stays as it is.
namespace strake::clash {

[[nodiscard]] Sets sets_of(const Sets& all, std::span<const std::uint32_t> objects);
[[nodiscard]] Options options_of(const Options& all, std::span<const std::uint32_t> objects);
[[nodiscard]] Policy policy_of(const Policy& all, std::span<const std::uint32_t> objects);

}  // namespace strake::clash
