// SPDX-License-Identifier: Apache-2.0
#include "strake/parallel/reservations.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "strake/parallel/detail/current_exception.hpp"
#include "strake/parallel/progress.hpp"

namespace strake::parallel::detail {

namespace {

/// This many slots of a round keep their places in one list.
constexpr std::size_t kRun = 64;
/// The number of items of the first round, and of a round at most: what it notes down should stay
/// in the cache. With 320,000 pairs two workers are 1.9 times as fast as the plain loop where an
/// act takes 4 µs, 1.0 to 1.3 times where it takes 0.4 (bench patterns).
constexpr std::size_t kFirstRound = 2048, kLongestRound = 65536;
/// Rounds with fewer items are not worth a team: items that conflict go one by one. Between 2 and
/// 32 ships show no difference (decision 0073).
constexpr std::size_t kFew = 8;

enum class Slot : std::uint8_t { waits, done, failed };

/// Returns an item's bid for a place. The item that bids higher gets it; 0 is nobody's bid.
std::uint32_t bid_of(std::uint32_t item) {
  return std::numeric_limits<std::uint32_t>::max() - item;
}

void raise(std::atomic<std::uint32_t>& bid, std::uint32_t to) {
  std::uint32_t now = bid.load(std::memory_order_relaxed);
  while (now < to && !bid.compare_exchange_weak(now, to, std::memory_order_relaxed)) {
  }
}

class Rounds {
 public:
  Rounds(const Context& context, const Region& region, std::size_t places)
      : inner_(context),
        region_(region),
        claims_name_(std::string(region.name) + ", claims"),
        bids_(places),
        end_(region.n) {
    inner_.progress = nullptr;  // it counts items that are done, not those that are tried
  }

  Result<ReservedRun> run(FunctionRef<bool(std::size_t, Claims&)> claim,
                          FunctionRef<Status(std::size_t)> act, const ProgressPhase& phase) {
    ReservedRun run;
    while (gather()) {
      run.rounds += 1;
      run.claims += items_.size();
      if (Status status = claim_all(claim); !status && !drop_from_failed(status))
        return std::move(status).error();
      if (Status status = act_all(act); !status && !drop_from_failed(status))
        return std::move(status).error();
      phase.add(end_round());
    }
    if (error_) return *std::move(error_);
    return run;
  }

 private:
  /// Gathers the items of the next round, ascending: those that wait, then new ones. Returns false
  /// when none is left.
  bool gather() {
    const std::size_t again = std::min(size_, waiting_.size() - head_);
    const auto first = waiting_.begin() + static_cast<std::ptrdiff_t>(head_);
    items_.assign(first, first + static_cast<std::ptrdiff_t>(again));
    head_ += again;
    // Nobody overtakes one that waits.
    while (head_ == waiting_.size() && items_.size() < size_ && next_ < end_)
      items_.push_back(static_cast<std::uint32_t>(next_++));
    slots_.assign(items_.size(), Slot::waits);
    ends_.resize(items_.size());
    lists_.resize(std::max(lists_.size(), items_.size() / kRun + 1));
    return !items_.empty();
  }

  Status claim_all(FunctionRef<bool(std::size_t, Claims&)> claim) {
    return for_each(inner_, {.name = claims_name_, .n = items_.size(), .grain = kRun},
                    [&](std::size_t slot) -> Status {
                      Status status = claim_one(claim, slot);
                      if (!status) slots_[slot] = Slot::failed;
                      return status;
                    });
  }

  /// Claims the places of a slot. Slots of one list come to one worker, in ascending order: they
  /// are a block of the region.
  Status claim_one(FunctionRef<bool(std::size_t, Claims&)> claim, std::size_t slot) {
    const std::uint32_t item = items_[slot];
    return status_of(region_.name, item, [&]() -> Status {
      std::vector<std::size_t>& list = lists_[slot / kRun];
      if (slot % kRun == 0) list.clear();
      const std::size_t first = list.size();
      Claims claims(list);
      if (!claim(item, claims)) {
        list.resize(first);
        slots_[slot] = Slot::done;
      }
      ends_[slot] = list.size();
      for (const std::size_t place : std::span(list).subspan(first)) {
        if (place >= bids_.size())
          return Error{ErrorCode::internal,
                       "place " + std::to_string(place) + " of " + std::to_string(bids_.size()),
                       "region '" + std::string(region_.name) + "', item " + std::to_string(item),
                       {}};
        raise(bids_[place], bid_of(item));
      }
      return {};
    });
  }

  Status act_all(FunctionRef<Status(std::size_t)> act) {
    Region acts = region_;
    acts.n = items_.size();
    acts.alone_below = 0;  // of all items, not of a round's
    Context context = inner_;
    if (acts.n < kFew) context.team = nullptr;
    return for_each(context, acts, [&](std::size_t slot) -> Status {
      if (slots_[slot] == Slot::done) return {};
      const std::uint32_t item = items_[slot];
      const std::uint32_t mine = bid_of(item);
      const std::span<const std::size_t> places = places_of(slot);
      const auto held = [&](std::size_t place) {
        return bids_[place].load(std::memory_order_relaxed) == mine;
      };
      if (std::ranges::all_of(places, held)) {
        Status status = status_of(region_.name, item, [&] { return act(item); });
        slots_[slot] = status ? Slot::done : Slot::failed;
        if (!status) return status;
      }
      // Another item that wants such a place sees a bid not its own, before this and after.
      for (const std::size_t place : places)
        if (held(place)) bids_[place].store(0, std::memory_order_relaxed);
      return {};
    });
  }

  [[nodiscard]] std::span<const std::size_t> places_of(std::size_t slot) const {
    const std::size_t first = slot % kRun == 0 ? 0 : ends_[slot - 1];
    return std::span(lists_[slot / kRun]).subspan(first, ends_[slot] - first);
  }

  /// Handles an error: keeps it if it is an item's, and goes on with the items below that one
  /// alone, of which one may fail, too. The bids of the others stay behind, and any of those that
  /// go on bids higher. Returns false when the error is nobody's: out of memory, or cancelled,
  /// which it then is.
  bool drop_from_failed(Status& status) {
    if (inner_.stop.stop_requested()) {
      status = cancelled_error();
      return false;
    }
    const auto failed = std::ranges::find(slots_, Slot::failed);
    if (failed == slots_.end()) return false;
    const auto slot = static_cast<std::size_t>(failed - slots_.begin());
    error_ = std::move(status).error();
    items_.resize(slot);
    slots_.resize(slot);
    waiting_.clear();  // all of them come after those of this round
    head_ = 0;
    end_ = next_;
    return true;
  }

  /// Puts the items that failed to claim in front of those that wait; returns how many succeeded.
  std::size_t end_round() {
    std::size_t kept = 0;
    for (std::size_t slot = 0; slot < items_.size(); ++slot)
      if (slots_[slot] == Slot::waits) items_[kept++] = items_[slot];
    const std::size_t done = items_.size() - kept;
    // Where most are in vain the next round is shorter, where few are it is longer.
    if (done * 4 >= items_.size() * 3) size_ = std::min(size_ * 2, kLongestRound);
    if (done * 4 < items_.size()) size_ = std::max<std::size_t>(size_ / 2, 1);
    const auto first = items_.begin(), last = first + static_cast<std::ptrdiff_t>(kept);
    if (head_ >= kept) {
      head_ -= kept;
      std::copy(first, last, waiting_.begin() + static_cast<std::ptrdiff_t>(head_));
    } else {
      waiting_.assign(first, last);
      head_ = 0;
    }
    return done;
  }

  Context inner_;
  const Region& region_;
  const std::string claims_name_;
  std::vector<std::atomic<std::uint32_t>> bids_;
  std::size_t next_ = 0, end_;          ///< items that no round has had yet
  std::size_t size_ = kFirstRound;      ///< the most of a round
  std::vector<std::uint32_t> waiting_;  ///< from head_ on, ascending
  std::size_t head_ = 0;

  // The following are of the round, by slot.
  std::vector<std::uint32_t> items_;
  std::vector<Slot> slots_;
  std::vector<std::size_t> ends_;                ///< end of its places in its list
  std::vector<std::vector<std::size_t>> lists_;  ///< by kRun slots
  std::optional<Error> error_;
};

}  // namespace

Result<ReservedRun> run_reserved(const Context& context, const Region& region, std::size_t places,
                                 FunctionRef<bool(std::size_t, Claims&)> claim,
                                 FunctionRef<Status(std::size_t)> act) {
  if (!region.order.empty()) return order_given(region);
  if (context.stop.stop_requested()) return cancelled_error();
  try {
    if (region.n >= std::numeric_limits<std::uint32_t>::max())
      return Error{ErrorCode::internal,
                   "more items than there are numbers to bid with",
                   std::string(region.name),
                   {}};
    const ProgressPhase phase(context.progress, region.name, region.n);
    return Rounds(context, region, places).run(claim, act, phase);
  } catch (const std::exception&) {
    return out_of_memory();
  }
}

}  // namespace strake::parallel::detail
