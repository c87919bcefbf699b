// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <string_view>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/detail/function_ref.hpp"
#include "strake/parallel/detail/load_relaxed.hpp"
#include "strake/parallel/detail/work_stealing.hpp"
#include "strake/parallel/executor.hpp"

namespace strake::parallel {

enum class Schedule : std::uint8_t {
  dynamic,        ///< a worker that is free takes the next block: for items of unequal cost
  static_blocks,  ///< worker w of W gets the w-th of W equal ranges, the same in every region
};

/// A parallel loop over the items [0, n), described apart from what it does.
///
/// Items are gathered into fixed blocks: block k holds items [k·grain, (k+1)·grain). Blocks depend
/// on the region only, never on the number of workers, so what is combined per block comes out in
/// the same bits for any team. A worker runs the items of a block in ascending order.
struct Region {
  std::string_view name = {};  ///< in reports and messages
  std::size_t n = 0;           ///< number of items
  Schedule schedule = Schedule::dynamic;
  std::size_t grain = 1;  ///< items per block; 0 counts as 1
  std::size_t chunk = 1;  ///< blocks that a worker takes at once (dynamic)
  /// The order in which blocks are visited: empty for whichever is quickest to hand out, otherwise
  /// a permutation of [0, blocks()), anything else being an error. It changes who waits for whom,
  /// never a result. Looked at, not copied: it outlives the region. See longest_first.
  std::span<const std::uint32_t> order = {};
  /// Fewer items than this are one block that the caller runs on the spot: no team is asked, and
  /// neither token, progress nor report are looked at. For loops inside items, over the triangles
  /// of a part for instance: most are too short for a region, and one may be a million long.
  std::size_t alone_below = 0;

  [[nodiscard]] bool is_short() const { return n < alone_below; }
  [[nodiscard]] std::size_t block_size() const {
    return std::max<std::size_t>(is_short() ? n : grain, 1);
  }
  [[nodiscard]] std::size_t blocks() const {
    return n / block_size() + (n % block_size() != 0 ? 1 : 0);
  }
};

namespace detail {

/// The error of a pattern that makes a visiting order of its own and is given one.
[[nodiscard]] Error order_given(const Region& region) noexcept;

/// What the order in which items are visited is good for, when the region gives none.
enum class Visit : std::uint8_t {
  any,        ///< nothing: workers take neighbouring blocks while they can
  ascending,  ///< low items first, by all workers: for what the first few may decide
};

/// Where one worker stands in a region; lives on that worker's stack.
struct RegionCursor {
  Seat seat;
  WorkerShare hand;                         ///< blocks, as positions in the visiting order
  std::size_t range_items = 0;              ///< items of the range in hand, when observed
  double range_start_s = 0, longest_s = 0;  ///< wall clock
  double busy_s = 0;                        ///< CPU time, once the worker is done
  std::uint64_t items = 0;
};

/// A contiguous ascending range of items, whole blocks of one worker.
struct Range {
  std::size_t first = 0, last = 0;
};

/// Where the block of item i ends, of those that end at `last` at the latest.
[[nodiscard]] inline std::size_t block_end(std::size_t i, std::size_t block_size,
                                           std::size_t last) {
  const std::size_t first = i - i % block_size;
  return last - first > block_size ? first + block_size : last;
}

/// The one scheduler loop that every pattern runs on.
///
/// A pattern's worker loop takes ranges with next() and must leave a range at the first item that
/// is not below limit(): that is how both an error and a cancellation stop it.
class RegionRun {
 public:
  RegionRun(const Context& context, const Region& region, Visit visit = Visit::any)
      : context_(context), region_(region), visit_(visit) {}
  RegionRun(const RegionRun&) = delete;
  RegionRun& operator=(const RegionRun&) = delete;
  RegionRun(RegionRun&&) = delete;
  RegionRun& operator=(RegionRun&&) = delete;
  ~RegionRun() = default;

  /// Calls loop once on each worker that takes part and returns the lowest item's error, if any.
  /// Other errors: cancelled, out of memory, a visiting order that is none.
  [[nodiscard]] Status run(FunctionRef<void(RegionCursor&)> loop);

  /// The next range of items of this worker; false when there is none left.
  bool next(RegionCursor& cursor, Range& range) {
    if (observed_) note(cursor);
    WorkerShare& hand = cursor.hand;
    for (;;) {
      if (hand.position == hand.end && !shares_.take(hand, cursor.seat)) return false;
      const std::size_t size = region_.block_size();
      if (ordered_ || observed_) {
        const std::size_t at = hand.position++;
        range.first = (ordered_ ? std::size_t{region_.order[at]} : at) * size;
        range.last = range.first + std::min(size, region_.n - range.first);
      } else {
        range.first = hand.position * size;
        range.last = hand.end == blocks_ ? region_.n : hand.end * size;
        hand.position = hand.end;
      }
      if (range.first < limit()) break;
      // What follows in an ascending share is not below the limit either.
      if (!ordered_ || limit() == 0) shares_.leave(hand, cursor.seat);
    }
    if (observed_) open(cursor, range);
    return true;
  }

  /// Calls item(i), which tells whether to go on, for i up to `last` and below the limit; false if
  /// an item said no. `i` is left at that item, or at one that throws.
  ///
  /// The test stands at the loop's end: what the body reads through references is then certain to
  /// be read, and g++ reads it once before the loop rather than for every item (load_relaxed.hpp).
  template <class Item>
  bool each(std::size_t& i, std::size_t last, Item&& item) const {
    if (i >= last || i >= limit()) return true;
    do {
      if (!item(i)) return false;
    } while (++i < last && i < limit());
    return true;
  }

  /// Items at or above this index are not to be run any more.
  [[nodiscard]] std::size_t limit() const { return load_relaxed(limit_); }

  /// Items at or above this one need not be run any more: a limit never rises. Errors of such items
  /// count for nothing.
  void lower_limit(std::size_t item) noexcept;

  /// Records that an item failed; of several, the lowest is kept.
  void fail(std::size_t item, Error error) noexcept;
  /// The same for the exception that is being handled.
  void fail_with_current_exception(std::size_t item) noexcept;

 private:
  void open(RegionCursor& cursor, const Range& range) const;
  void note(RegionCursor& cursor) const;
  [[nodiscard]] Status start();
  void deal(const Executor* team);
  void call(FunctionRef<void(RegionCursor&)> loop);
  [[nodiscard]] Status outcome(bool cancelled);
  void work(Seat seat, FunctionRef<void(RegionCursor&)> loop, std::span<RegionCursor> seats);

  // Read by every worker at every range: kept apart from what they write.
  const Context& context_;
  const Region& region_;
  std::size_t blocks_ = 0;
  Visit visit_;
  bool ordered_ = false;   ///< by the region's order, which the run heeds
  bool observed_ = false;  ///< somebody wants progress or times: ranges are single blocks then
  bool counting_ = false;  ///< this region is the one whose progress is shown
  alignas(64) std::atomic<std::size_t> limit_{std::numeric_limits<std::size_t>::max()};
  alignas(64) WorkStealingShares shares_;
  std::mutex error_mutex_;
  std::optional<Error> error_;
  std::size_t error_item_ = std::numeric_limits<std::size_t>::max();
};

}  // namespace detail
}  // namespace strake::parallel
