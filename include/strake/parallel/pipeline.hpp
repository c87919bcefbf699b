// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <limits>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "strake/parallel/detail/current_exception.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::parallel {

/// How a pipeline runs, described apart from what it does.
struct Flow {
  std::string_view name = {};  ///< in reports and messages
  /// Items between the source and the end of the sink at a time: bounds the memory. 0: four for
  /// each worker.
  std::size_t in_flight = 0;
};

namespace detail {

/// The state of one pipeline. A worker does what is most urgent: hand on the next result, fetch the
/// next item and work on it, or wait until there is either.
template <class Item, class Made>
class PipelineRun {
 public:
  static_assert(std::is_nothrow_move_constructible_v<Item> &&
                    std::is_nothrow_move_constructible_v<Made>,
                "items and results are handed from worker to worker");

  /// Throws std::bad_alloc.
  PipelineRun(std::string_view name, std::size_t in_flight) : name_(name), slots_(in_flight) {}

  template <class Source, class Work, class Sink>
  void serve(Source& source, Work& work, Sink& sink) {
    std::unique_lock lock(mutex_);
    while (!is_done()) {
      if (can_sink()) {
        sink_next(lock, sink);
      } else if (can_fetch()) {
        fetch_next(lock, source, work);
      } else {
        changed_.wait(lock);
      }
    }
    changed_.notify_all();
  }

  /// Nothing more is fetched or handed on.
  void stop() {
    const std::lock_guard lock(mutex_);
    limit_ = 0;
    changed_.notify_all();
  }

  /// Of the lowest item that failed.
  [[nodiscard]] Status outcome() {
    if (error_) return *std::move(error_);
    return {};
  }

 private:
  [[nodiscard]] bool is_done() const {
    return !sinking_ && sunk_ >= std::min(limit_, fetched_) && !may_fetch() && !fetching_;
  }
  [[nodiscard]] bool may_fetch() const { return open_ && fetched_ < limit_; }
  [[nodiscard]] bool can_fetch() const {
    return may_fetch() && !fetching_ && fetched_ - sunk_ < slots_.size();
  }
  [[nodiscard]] bool can_sink() const {
    return !sinking_ && sunk_ < std::min(limit_, fetched_) && slots_[sunk_ % slots_.size()];
  }

  template <class Source, class Work>
  void fetch_next(std::unique_lock<std::mutex>& lock, Source& source, Work& work) {
    const std::size_t i = fetched_;
    fetching_ = true;
    std::optional<Item> item;
    attempt(lock, i, [&]() -> Status {
      if (auto fetched = source()) item.emplace(std::move(*fetched));
      return {};
    });
    fetching_ = false;
    if (item) {
      ++fetched_;
    } else {
      open_ = false;
    }
    changed_.notify_all();
    if (!item) return;
    std::optional<Made> made;
    attempt(lock, i, [&]() -> Status {
      const Dropped<Item> after(item);
      if constexpr (!std::is_same_v<Made, std::remove_cvref_t<decltype(work(std::move(*item)))>>) {
        auto result = work(std::move(*item));
        if (!result) return std::move(result).error();
        made.emplace(std::move(*result));
      } else {
        made.emplace(work(std::move(*item)));
      }
      return {};
    });
    if (made) slots_[i % slots_.size()].emplace(std::move(*made));
    changed_.notify_all();
  }

  template <class Sink>
  void sink_next(std::unique_lock<std::mutex>& lock, Sink& sink) {
    std::optional<Made>& slot = slots_[sunk_ % slots_.size()];
    std::optional<Made> made(std::move(*slot));
    slot.reset();
    sinking_ = true;
    attempt(lock, sunk_, [&]() -> Status {
      const Dropped<Made> after(made);
      if constexpr (std::is_void_v<std::invoke_result_t<Sink&, Made&&>>) {
        sink(std::move(*made));
        return {};
      } else {
        return sink(std::move(*made));
      }
    });
    sinking_ = false;
    ++sunk_;
    changed_.notify_all();
  }

  /// Ends a value when a step is through with it, while the lock is open: who knows what its
  /// destructor waits for.
  template <class Value>
  class Dropped {
   public:
    explicit Dropped(std::optional<Value>& value) : value_(value) {}
    Dropped(const Dropped&) = delete;
    Dropped& operator=(const Dropped&) = delete;
    Dropped(Dropped&&) = delete;
    Dropped& operator=(Dropped&&) = delete;
    ~Dropped() { value_.reset(); }

   private:
    std::optional<Value>& value_;
  };

  /// Runs a step of an item with the lock open.
  template <class Step>
  void attempt(std::unique_lock<std::mutex>& lock, std::size_t item, Step&& step) {
    lock.unlock();
    Status status = status_of(name_, item, step);
    lock.lock();
    if (status || item >= limit_) return;
    limit_ = item;
    error_ = std::move(status).error();
  }

  std::string_view name_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::optional<Made>> slots_;  ///< of item i: i modulo their number
  std::size_t fetched_ = 0, sunk_ = 0;
  std::size_t limit_ = std::numeric_limits<std::size_t>::max();  ///< of what is still done
  bool open_ = true, fetching_ = false, sinking_ = false;
  std::optional<Error> error_;
};

}  // namespace detail

/// Takes items from a source one after another, works on them on all workers, and hands the results
/// to a sink one after another, in the source's order: for what does not fit into memory at once,
/// or where reading, computing and writing are to go on at the same time.
///
///     const Status status = pipeline(context, {.name = "convert"},
///         [&]() -> std::optional<Page> { return reader.next(); },
///         [&](Page&& page) { return converted(page); },
///         [&](std::string&& text) { file.write(text); });
///
/// `source()` gives a std::optional, none at the end; `work(item)` a result or a Result of one;
/// `sink(result)` returns void or Status. Source and sink are called on any worker, by one at a
/// time each; what they did is visible to their next call.
///
/// 1. The sink gets the results of all items, in order, whatever the team; without one all runs on
///    the calling thread.
/// 2. At most `in_flight` items are between source and sink.
/// 3. An error or exception in any of the three ends it: the sink has then had the results of all
///    items before, and the error is that of the lowest failing item. Items after it may have been
///    fetched and worked on.
/// 4. A triggered stop token returns ErrorCode::cancelled as soon as the running calls end.
///
/// Not promised: which worker makes which call. Cost per item: some microseconds; give it batches.
template <class Source, class Work, class Sink>
[[nodiscard]] Status pipeline(const Context& context, const Flow& flow, Source&& source,
                              Work&& work, Sink&& sink) {
  using Item = typename std::invoke_result_t<Source&>::value_type;
  static_assert(std::is_invocable_v<Work&, Item&&>, "work is called as work(item), an rvalue");
  detail::require_shareable<Work, Item&&>();
  detail::require_value<std::invoke_result_t<Work&, Item&&>>();
  using Made = detail::unwrapped_t<std::invoke_result_t<Work&, Item&&>>;
  const std::size_t workers = context.team == nullptr ? 1 : context.team->size();
  const std::size_t in_flight = flow.in_flight == 0 ? 4 * workers : flow.in_flight;
  std::optional<detail::PipelineRun<Item, Made>> run;
  try {
    run.emplace(flow.name, in_flight);
  } catch (const std::exception&) {
    return out_of_memory();
  }
  // Nobody knows how many items there are, so the region has no progress to show.
  Context own = context;
  own.progress = nullptr;
  const std::stop_callback on_stop(context.stop, [&] { run->stop(); });
  Status status = for_each(own, {.name = flow.name, .n = workers},
                           [&](std::size_t) { run->serve(source, work, sink); });
  return status ? run->outcome() : std::move(status);
}

}  // namespace strake::parallel
