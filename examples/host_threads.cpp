// SPDX-License-Identifier: Apache-2.0
// Regions on threads that a program has already, here a pool of its own: no second set of threads,
// and the same bytes.
#include <condition_variable>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <mutex>
#include <queue>
#include <thread>
#include <utility>
#include <vector>

#include "strake/parallel/host_executor.hpp"
#include "strake/parallel/reduce.hpp"

namespace {

/// The pool of some other program: it knows nothing of this library.
class Pool {
 public:
  explicit Pool(unsigned threads) {
    for (unsigned i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
  }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;
  ~Pool() {
    add({});
    for (std::thread& t : threads_) t.join();
  }

  void add(std::function<void()> job) {
    const std::lock_guard lock(mutex_);
    jobs_.push(std::move(job));
    more_.notify_all();
  }

 private:
  void work() {
    for (;;) {
      std::unique_lock lock(mutex_);
      more_.wait(lock, [this] { return !jobs_.empty(); });
      if (!jobs_.front()) return;  // stays there, for the others
      const std::function<void()> job = std::move(jobs_.front());
      jobs_.pop();
      lock.unlock();
      job();
    }
  }

  std::mutex mutex_;
  std::condition_variable more_;
  std::queue<std::function<void()>> jobs_;
  std::vector<std::thread> threads_;
};

double sum(const strake::parallel::Context& context) {
  const auto total = strake::parallel::reduce(
      context, {.name = "harmonic", .n = 1'000'000, .grain = 1000}, 0.0,
      [](double& part, std::size_t i) { part += 1.0 / static_cast<double>(i + 1); },
      [](double& into, double part) { into += part; });
  return total ? *total : 0;
}

}  // namespace

int main() {
  using strake::parallel::HostExecutor;
  Pool pool(3);
  // Seats that the pool does not come to in time are served by the thread that waits for them.
  HostExecutor workers(4, [&](unsigned count, const HostExecutor::Body& body) {
    for (unsigned i = 1; i < count; ++i) pool.add([body, i] { body(i); });
    body(0);
  });
  const double hosted = sum({.team = &workers}), alone = sum({});
  std::printf("%.17g on the pool, %.17g on one thread\n", hosted, alone);
  return hosted == alone ? 0 : 1;
}
