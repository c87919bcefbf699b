// SPDX-License-Identifier: Apache-2.0
#include "strake/parallel/detail/first_touch.hpp"

#include <algorithm>

#include "strake/parallel/for_each.hpp"

namespace strake::parallel::detail {

namespace {

/// Bytes that a worker takes at once, and from which on a team is asked: one worker writes them in
/// about 30 microseconds where the memory is there, and waking the others takes as long.
constexpr std::size_t kBytesPerRun = std::size_t{256} << 10U, kBytesWorthIt = 4 * kBytesPerRun;

}  // namespace

bool is_worth_a_team(const Context& context, std::size_t n, std::size_t size) {
  return context.team != nullptr && n > kBytesWorthIt / size;
}

Status for_each_run_of_memory(const Context& context, std::size_t n, std::size_t size,
                              FunctionRef<void(std::size_t, std::size_t)> make) {
  Context whole = context;
  whole.stop = {};
  whole.progress = nullptr;
  const std::size_t run = std::max<std::size_t>(kBytesPerRun / size, 1);
  return for_each(whole, {.name = "memory for results", .n = (n - 1) / run + 1},
                  [&](std::size_t i) { make(i * run, std::min(n, (i + 1) * run)); });
}

}  // namespace strake::parallel::detail
