// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <stop_token>

namespace strake::parallel {

class Executor;
class Progress;
class RunReport;

/// How the regions of a whole run share their items out: who does what, never a result. It is for
/// comparisons (docs/patterns/schedules.md); in earnest leave it as planned.
enum class Distribution : std::uint8_t {
  planned,   ///< as each region says, by its schedule and its visiting order
  in_order,  ///< the same, but no region has a visiting order: items come as they are numbered
  /// Worker w of W gets the w-th of W equal ranges of every region and nothing of another's; heavy
  /// items are not set apart.
  equal_ranges,
};

/// How a long computation runs; passed explicitly to everything that takes time. All parts may be
/// absent: no team means the same code on the calling thread with the same blocks and so the same
/// bytes, no progress and no report mean that nobody needs it.
struct Context {
  Executor* team = nullptr;      ///< a Team, or a host's workers; null: sequential
  std::stop_token stop = {};     ///< triggered: return ErrorCode::cancelled soon
  Progress* progress = nullptr;  ///< told how far the work is
  RunReport* report = nullptr;   ///< collects time and load balance per region
  Distribution distribution = Distribution::planned;
  /// Blocks that a worker takes at once, at least, whatever a region says: for measurements of how
  /// coarse the work may be. 0 counts as 1.
  std::size_t min_chunk = 1;
};

/// Returns how many workers a region of the run has: for other programs that are told how many
/// threads they may take. What is computed must not depend on it.
[[nodiscard]] unsigned workers_of(const Context& context);

}  // namespace strake::parallel
