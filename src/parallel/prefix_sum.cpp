// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "strake/parallel/slots.hpp"

namespace strake::parallel::detail {

namespace {

/// Lengths that one worker sums up at once.
constexpr std::size_t kLengthsPerRun = 16384;

/// Adds a number to each sum; false where one is too large to be counted.
bool add_up(std::span<std::size_t> lengths, std::size_t before) {
  for (std::size_t& length : lengths) {
    if (length > std::numeric_limits<std::size_t>::max() - before) return false;
    before = length += before;
  }
  return true;
}

Error too_many_elements() {
  return Error{ErrorCode::input, "more elements than can be counted", {}, {}};
}

}  // namespace

Status prefix_sum(const Context& context, std::span<std::size_t> lengths) {
  const Region runs{.name = "sums of lengths",
                    .n = (lengths.size() + kLengthsPerRun - 1) / kLengthsPerRun};
  if (runs.n <= 1 || context.team == nullptr)
    return add_up(lengths, 0) ? Status{} : Status{too_many_elements()};
  const auto run = [&](std::size_t r) {
    return lengths.subspan(r * kLengthsPerRun,
                           std::min(kLengthsPerRun, lengths.size() - r * kLengthsPerRun));
  };
  // Each run by itself, then what all runs before it come to.
  Status status = for_each(context, runs, [&](std::size_t r) -> Status {
    return add_up(run(r), 0) ? Status{} : Status{too_many_elements()};
  });
  if (!status) return status;
  Result<std::vector<std::size_t>> before = unset_slots<std::size_t>(runs.n);
  if (!before) return std::move(before).error();
  std::size_t sum = 0;
  for (std::size_t r = 0; r < runs.n; ++r) {
    (*before)[r] = sum;
    if (run(r).back() > std::numeric_limits<std::size_t>::max() - sum) return too_many_elements();
    sum += run(r).back();
  }
  return for_each(context, runs, [&](std::size_t r) {
    for (std::size_t& length : run(r)) length += (*before)[r];
  });
}

}  // namespace strake::parallel::detail
