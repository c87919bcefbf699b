// SPDX-License-Identifier: Apache-2.0
// Threads with lives of their own and a queue between them: three read, two work, and no more than
// eight jobs lie between them. Which worker had which job is chance; the sum of whole numbers is
// not.
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <thread>
#include <vector>

#include "strake/parallel/bounded_queue.hpp"

int main() {
  using strake::parallel::BoundedQueue;
  constexpr unsigned kReaders = 3, kWorkers = 2, kJobs = 5000;
  BoundedQueue<std::uint64_t> jobs(8);
  std::atomic<unsigned> reading{kReaders};
  std::vector<std::uint64_t> sums(kWorkers, 0);
  {
    std::vector<std::jthread> threads;
    for (unsigned r = 0; r < kReaders; ++r)
      threads.emplace_back([&, r] {
        for (std::uint64_t job = r; job < kJobs; job += kReaders)
          if (!jobs.push(std::uint64_t{job})) return;  // closed: nobody works any more
        if (--reading == 0) jobs.close();              // the last one out
      });
    for (unsigned w = 0; w < kWorkers; ++w)
      threads.emplace_back([&, w] {
        std::uint64_t sum = 0;
        while (const auto job = jobs.pop()) sum += *job * *job;
        sums[w] = sum;
      });
  }  // all have ended
  const std::uint64_t total = sums[0] + sums[1];
  std::printf("sum of %u squares: %llu\n", kJobs, static_cast<unsigned long long>(total));
  return total == std::uint64_t{kJobs - 1} * kJobs * (2 * kJobs - 1) / 6 ? 0 : 1;
}
