// SPDX-License-Identifier: Apache-2.0
#include "collatz.hpp"

#include <cstddef>
#include <strake/parallel/transform.hpp>
#include <string>

namespace {

strake::Result<std::uint32_t> steps_from(std::uint64_t number, std::uint64_t ceiling) {
  std::uint32_t steps = 0;
  for (std::uint64_t x = number; x != 1; ++steps) {
    x = x % 2 == 0 ? x / 2 : 3 * x + 1;
    if (x > ceiling)
      return strake::Error{.code = strake::ErrorCode::input,
                           .message = std::to_string(number) + " climbs too high",
                           .where = {},
                           .mend = {}};
  }
  return steps;
}

}  // namespace

strake::Result<std::vector<std::uint32_t>> collatz_steps(std::uint32_t n, std::uint64_t ceiling,
                                                         const strake::parallel::Context& context) {
  return strake::parallel::transform(context, {.name = "steps", .n = n, .grain = 64},
                                     [&](std::size_t i) { return steps_from(i + 1, ceiling); });
}
