// SPDX-License-Identifier: Apache-2.0
#include "strake/parallel/executor.hpp"

#include <atomic>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "strake/parallel/context.hpp"
#include "strake/parallel/host_executor.hpp"

namespace strake::parallel {

unsigned workers_of(const Context& context) {
  return context.team == nullptr ? 1 : context.team->size();
}

bool Executor::run(FunctionRef<void(Seat)> body) noexcept {
  if (size_ == 1 || busy_.exchange(true, std::memory_order_acquire)) {
    body(Seat{0, 1});
    return size_ == 1;
  }
  call_all(body);
  busy_.store(false, std::memory_order_release);
  return true;
}

/// The seats of one region. It is shared with what the host was given: a host that calls it too
/// late, or keeps it, finds all seats taken.
struct HostExecutor::Run {
  Run(unsigned count, FunctionRef<void(Seat)> work) : body(work), taken(count) {}

  /// Ends the program if the body throws, as the contract says: to the host it would be as if it
  /// had not called.
  void serve(unsigned index) noexcept {
    if (index >= taken.size() || taken[index].exchange(true, std::memory_order_relaxed)) return;
    body(Seat{index, static_cast<unsigned>(taken.size())});
    if (done.fetch_add(1, std::memory_order_acq_rel) + 1 == taken.size()) done.notify_one();
  }

  FunctionRef<void(Seat)> body;
  std::vector<std::atomic<bool>> taken;
  std::atomic<std::uint32_t> done{0};
};

HostExecutor::HostExecutor(unsigned workers, Call call)
    : Executor(workers), call_(std::move(call)) {}

void HostExecutor::call_all(FunctionRef<void(Seat)> body) noexcept {
  std::shared_ptr<Run> run;
  Body seat;  // until all have been served: a host that throws may have threads that it is in
  try {
    run = std::make_shared<Run>(size(), body);
    seat = [run](unsigned index) {
      const std::shared_ptr<Run> kept = run;  // the last word of a seat is read after the last seat
      kept->serve(index);
    };
    call_(size(), seat);
  } catch (...) {
    // What the host has not called is served below; without memory there is one seat.
    if (!run) return body(Seat{0, 1});
  }
  for (unsigned i = 0; i < size(); ++i) run->serve(i);
  for (std::uint32_t now = run->done.load(std::memory_order_acquire); now != size();
       now = run->done.load(std::memory_order_acquire))
    run->done.wait(now, std::memory_order_acquire);
}

}  // namespace strake::parallel
