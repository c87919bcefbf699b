// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <strake/core/result.hpp>
#include <strake/parallel/context.hpp>
#include <vector>

/// How many steps each of the numbers 1..n takes to reach 1 when even ones are halved and odd ones
/// become three times as much and one. Errors: a number over `ceiling` on the way.
[[nodiscard]] strake::Result<std::vector<std::uint32_t>> collatz_steps(
    std::uint32_t n, std::uint64_t ceiling, const strake::parallel::Context& context);
