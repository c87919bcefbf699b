// SPDX-License-Identifier: Apache-2.0
#include "strake/parallel/region.hpp"

#include <chrono>
#include <exception>
#include <new>
#include <string>
#include <utility>

#include "strake/parallel/detail/current_exception.hpp"
#include "strake/parallel/progress.hpp"
#include "strake/parallel/report.hpp"

namespace strake::parallel::detail {

namespace {

/// With fewer blocks per worker, each is probably long, and one counter for all costs nothing
/// beside it: then the low ones go first, should the caller have put the long ones there. On two
/// cores an item taken one by one costs 15 to 35 ns with one counter, 2.5 to 6 with one for each
/// worker (decision 0033).
constexpr std::size_t kFewBlocks = 64;

double wall_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Error described(const char* what, std::string_view region, std::size_t item) {
  return {ErrorCode::internal,
          what,
          "region '" + std::string(region) + "', item " + std::to_string(item),
          {}};
}

/// Whether every block occurs in the order once.
bool is_permutation(std::span<const std::uint32_t> order) {
  std::vector<bool> visited(order.size(), false);
  for (const std::uint32_t block : order) {
    if (block >= visited.size() || visited[block]) return false;
    visited[block] = true;
  }
  return true;
}

/// Returns what one run of a region adds to the report. `alone`: it was run by one worker of
/// several.
RegionReport summary(const Region& region, std::span<const RegionCursor> seats, double wall,
                     bool alone) {
  RegionReport run;
  run.name = region.name;
  run.runs = alone ? 0 : 1;
  run.nested_runs = alone ? 1 : 0;
  for (const RegionCursor& seat : seats) {
    run.items += seat.items;
    if (alone) {
      run.nested_cpu_s += seat.busy_s;
    } else {
      run.longest_s = std::max(run.longest_s, seat.longest_s);
      run.busy_s.push_back(seat.busy_s);
    }
  }
  if (!alone) run.wall_s = wall;
  return run;
}

}  // namespace

Error order_given(const Region& region) noexcept try {
  return {ErrorCode::internal,
          "a visiting order for items that have one of their own",
          std::string(region.name),
          {}};
} catch (const std::bad_alloc&) {
  return out_of_memory();
}

Error error_of_current_exception(std::string_view region, std::size_t item) noexcept {
  try {
    throw;
  } catch (const std::bad_alloc&) {
  } catch (const std::exception& e) {
    try {
      return described(e.what(), region, item);
    } catch (...) {
    }
  } catch (...) {
    try {
      return described("an exception of unknown type", region, item);
    } catch (...) {
    }
  }
  return out_of_memory();
}

Error cancelled_error() { return {ErrorCode::cancelled, "cancelled", {}, {}}; }

void RegionRun::lower_limit(std::size_t item) noexcept {
  std::size_t now = limit_.load(std::memory_order_relaxed);
  while (item < now && !limit_.compare_exchange_weak(now, item, std::memory_order_relaxed)) {
  }
}

void RegionRun::fail(std::size_t item, Error error) noexcept {
  {
    const std::lock_guard lock(error_mutex_);
    if (!error_ || item < error_item_) {
      error_ = std::move(error);
      error_item_ = item;
    }
  }
  lower_limit(item);
}

void RegionRun::fail_with_current_exception(std::size_t item) noexcept {
  fail(item, error_of_current_exception(region_.name, item));
}

void RegionRun::open(RegionCursor& cursor, const Range& range) const {
  cursor.range_items = range.last - range.first;
  if (context_.report != nullptr) cursor.range_start_s = wall_s();
}

void RegionRun::note(RegionCursor& cursor) const {
  if (cursor.range_items == 0) return;
  cursor.items += cursor.range_items;
  if (counting_) context_.progress->add(cursor.range_items);
  if (context_.report != nullptr)
    cursor.longest_s = std::max(cursor.longest_s, wall_s() - cursor.range_start_s);
  cursor.range_items = 0;
}

void RegionRun::work(Seat seat, FunctionRef<void(RegionCursor&)> loop,
                     std::span<RegionCursor> seats) {
  RegionCursor cursor;
  cursor.seat = seat;
  cursor.hand = shares_.share_of(seat);
  if (seats.empty()) {
    loop(cursor);
    return;
  }
  const double start = thread_cpu_s();
  loop(cursor);
  cursor.busy_s = thread_cpu_s() - start;
  // A block's wall time may hold another program's turn on the core; its CPU time cannot be more
  // than the worker's.
  cursor.longest_s = std::min(cursor.longest_s, cursor.busy_s);
  seats[seat.index] = cursor;
}

Status RegionRun::run(FunctionRef<void(RegionCursor&)> loop) {
  try {
    if (Status status = start(); !status || blocks_ == 0) return status;
    call(loop);
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
  return outcome(context_.stop.stop_requested());
}

Status RegionRun::start() {
  if (context_.stop.stop_requested()) return cancelled_error();
  blocks_ = region_.blocks();
  ordered_ = !region_.order.empty();
  const auto misordered = [&](const std::string& what) {
    return Error{ErrorCode::internal, "a visiting order " + what, std::string(region_.name), {}};
  };
  if (ordered_ && region_.order.size() != blocks_)
    return misordered("of " + std::to_string(region_.order.size()) + " for " +
                      std::to_string(blocks_) + " blocks");
  if (ordered_ && !is_permutation(region_.order))
    return misordered("that does not name each of " + std::to_string(blocks_) + " blocks once");
  ordered_ = ordered_ && context_.distribution == Distribution::planned;
  return {};
}

void RegionRun::deal(const Executor* team) {
  const std::size_t workers = team != nullptr ? team->size() : 1;
  if (team == nullptr || region_.schedule == Schedule::static_blocks ||
      context_.distribution == Distribution::equal_ranges)
    return shares_.deal(blocks_, workers, blocks_, WorkStealingShares::Rest::kept);
  // A counter may pass the last block by a chunk for each worker, and must not come round again.
  const std::size_t room = (std::numeric_limits<std::size_t>::max() - blocks_) / (workers + 1);
  const std::size_t wanted = std::max(region_.chunk, context_.min_chunk);
  const std::size_t chunk = std::max<std::size_t>(std::min({wanted, blocks_, room}), 1);
  const bool ascending = ordered_ || visit_ == Visit::ascending || blocks_ / workers < kFewBlocks;
  shares_.deal(blocks_, ascending ? 1 : workers, chunk, WorkStealingShares::Rest::free);
}

void RegionRun::call(FunctionRef<void(RegionCursor&)> loop) {
  // One block needs no team; leaving it free lets the regions nested inside have it.
  Executor* const team = blocks_ > 1 ? context_.team : nullptr;
  deal(team);
  std::vector<RegionCursor> seats(context_.report == nullptr ? 0
                                  : team != nullptr          ? team->size()
                                                             : 1);
  const ProgressPhase phase(context_.progress, region_.name, region_.n);
  counting_ = phase.is_ours();
  observed_ = counting_ || context_.report != nullptr;
  const double start = context_.report != nullptr ? wall_s() : 0;
  // A single block is the caller's, and what is nested in it may have the team.
  bool whole = team != nullptr || context_.team == nullptr || context_.team->size() == 1;
  {
    // Cancelling is lowering the limit to nothing: items have one word to look at.
    const std::stop_callback on_stop(context_.stop, [this] { lower_limit(0); });
    if (team == nullptr) {
      work(Seat{}, loop, seats);
    } else {
      whole = team->run([&](Seat seat) { work(seat, loop, seats); });
    }
  }
  if (context_.report != nullptr)
    context_.report->add(summary(region_, seats, wall_s() - start, !whole));
}

Status RegionRun::outcome(bool cancelled) {
  if (cancelled) return cancelled_error();
  if (error_ && error_item_ <= limit()) return *std::move(error_);
  return {};
}

}  // namespace strake::parallel::detail
