// SPDX-License-Identifier: Apache-2.0
#include "strake/parallel/team.hpp"

#include <algorithm>
#include <exception>

// Decision 0063 says why a team neither grows nor shrinks, and sets no priorities.

namespace strake::parallel {

namespace {

/// How often a worker looks at a word before sleeping on it: some 30 microseconds, about what it
/// takes to wake up. So a wait costs at most twice the better of the two, and one worker's last
/// block or the caller's few lines between two regions put nobody to sleep. An empty region costs
/// 0.2 to 0.9 µs while the workers look, 30 to 70 once they sleep (decision 0033).
constexpr int kSpins = 1000;

/// Tells the core that this is a loop that waits: its other thread may go first.
void breathe() noexcept {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("isb");
#endif
}

void wait_while(const std::atomic<std::uint32_t>& word, std::uint32_t value, int spins) noexcept {
  for (int i = 0; i < spins; ++i) {
    if (word.load(std::memory_order_acquire) != value) return;
    breathe();
  }
  word.wait(value, std::memory_order_acquire);
}

}  // namespace

Team::Team(unsigned workers) : Executor(1) {
  // With more workers than processors the one that looks may keep the other from coming.
  spins_ = workers <= default_workers() ? kSpins : 0;
  const unsigned wanted = std::clamp(workers, 1U, kMaxWorkers) - 1;
  threads_.reserve(wanted);
  for (unsigned i = 0; i < wanted; ++i) {
    try {
      threads_.emplace_back([this, i] { serve(i + 1); });
    } catch (const std::exception&) {
      break;  // the host gives no more threads, or no memory: work with those that there are
    }
  }
  set_size(static_cast<unsigned>(threads_.size()) + 1);
}

Team::~Team() {
  closing_.store(true, std::memory_order_relaxed);
  generation_.fetch_add(1, std::memory_order_release);
  generation_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Team::call_all(FunctionRef<void(Seat)> body) noexcept {
  body_ = &body;
  pending_.store(static_cast<std::uint32_t>(threads_.size()), std::memory_order_relaxed);
  generation_.fetch_add(1, std::memory_order_release);
  generation_.notify_all();
  body(Seat{0, size()});
  for (std::uint32_t left = pending_.load(std::memory_order_acquire); left != 0;
       left = pending_.load(std::memory_order_acquire))
    wait_while(pending_, left, spins_);
}

void Team::serve(unsigned index) noexcept {
  // Every worker sees every generation: run() starts the next only when all have reported back.
  std::uint32_t visited = 0;
  for (;;) {
    wait_while(generation_, visited, spins_);
    visited = generation_.load(std::memory_order_acquire);
    if (closing_.load(std::memory_order_relaxed)) return;
    (*body_)(Seat{index, size()});
    if (pending_.fetch_sub(1, std::memory_order_acq_rel) == 1) pending_.notify_one();
  }
}

}  // namespace strake::parallel
