// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stop_token>
#include <thread>
#include <vector>

#include "strake/parallel/bounded_queue.hpp"

namespace strake::parallel {
namespace {

struct Note {
  unsigned producer = 0;
  std::uint32_t number = 0;
};

TEST(BoundedQueue, loses_nothing_between_any_number_of_producers_and_consumers) {
  constexpr std::uint32_t kNotes = 2000;
  for (const std::size_t capacity : {1U, 2U, 64U})
    for (unsigned producers = 1; producers <= 8; producers *= 2)
      for (unsigned consumers = 1; consumers <= 8; consumers *= 2) {
        BoundedQueue<Note> queue(capacity);
        std::atomic<unsigned> producing{producers};
        std::vector<std::vector<Note>> got(consumers);
        std::vector<std::thread> threads;
        for (unsigned p = 0; p < producers; ++p)
          threads.emplace_back([&, p] {
            for (std::uint32_t n = 0; n < kNotes; ++n) EXPECT_TRUE(queue.push({p, n}));
            if (--producing == 0) queue.close();
          });
        for (unsigned c = 0; c < consumers; ++c)
          threads.emplace_back([&, c] {
            while (const auto note = queue.pop()) got[c].push_back(*note);
          });
        for (std::thread& t : threads) t.join();
        std::vector<std::vector<int>> observed(producers, std::vector<int>(kNotes, 0));
        for (const std::vector<Note>& notes : got) {
          std::vector<std::int64_t> last(producers, -1);
          for (const Note& note : notes) {
            ++observed[note.producer][note.number];
            EXPECT_GT(note.number, last[note.producer]) << "a producer's values stay in order";
            last[note.producer] = note.number;
          }
        }
        for (const auto& counts : observed)
          EXPECT_EQ(counts, std::vector<int>(kNotes, 1))
              << capacity << ' ' << producers << ' ' << consumers;
      }
}

TEST(BoundedQueue, what_is_in_comes_out_after_the_end) {
  BoundedQueue<int> queue(3);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(queue.push(int{i}));
  queue.close();
  queue.close();
  EXPECT_FALSE(queue.push(7));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(queue.pop(), i);
  EXPECT_EQ(queue.pop(), std::nullopt);
  EXPECT_EQ(queue.pop(), std::nullopt);
}

TEST(BoundedQueue, holds_one_value_at_least) {
  BoundedQueue<int> queue(0);
  EXPECT_EQ(queue.capacity(), 1U);
  EXPECT_TRUE(queue.push(1));
  EXPECT_EQ(queue.pop(), 1);
}

TEST(BoundedQueue, closing_wakes_all_who_wait) {
  for (int round = 0; round < 100; ++round) {
    BoundedQueue<int> full(1), empty(1);
    ASSERT_TRUE(full.push(0));
    std::vector<std::jthread> threads;
    std::atomic<int> refused{0}, none{0};
    for (int i = 0; i < 3; ++i) {
      threads.emplace_back([&] { refused += full.push(1) ? 0 : 1; });
      threads.emplace_back([&] { none += empty.pop() ? 0 : 1; });
    }
    if (round % 2 == 0) std::this_thread::yield();
    full.close();
    empty.close();
    threads.clear();
    EXPECT_EQ(refused, 3);
    EXPECT_EQ(none, 3);
  }
}

TEST(BoundedQueue, a_stop_wakes_who_waits_and_keeps_the_value) {
  for (int round = 0; round < 100; ++round) {
    BoundedQueue<std::unique_ptr<int>> full(1), empty(1);
    ASSERT_TRUE(full.push(std::make_unique<int>(1)));
    std::stop_source stop;
    auto kept = std::make_unique<int>(2);
    std::jthread pushing([&] { EXPECT_FALSE(full.push(std::move(kept), stop.get_token())); });
    std::jthread popping([&] { EXPECT_FALSE(empty.pop(stop.get_token())); });
    if (round % 2 == 0) std::this_thread::yield();
    stop.request_stop();
    pushing.join();
    popping.join();
    ASSERT_TRUE(kept);
    EXPECT_EQ(*kept, 2);
    EXPECT_EQ(**full.pop(stop.get_token()), 1) << "a value that is there is given";
  }
}

}  // namespace
}  // namespace strake::parallel
