// SPDX-License-Identifier: Apache-2.0
// What the pages of docs/patterns on what items share, and on who watches them, gain.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <random>
#include <vector>

#include "parallel/items.hpp"
#include "parallel/pages.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/item_locks.hpp"
#include "strake/parallel/optional_lock.hpp"
#include "strake/parallel/pipeline.hpp"
#include "strake/parallel/precomputed.hpp"
#include "strake/parallel/progress.hpp"
#include "strake/parallel/report.hpp"
#include "strake/parallel/reservations.hpp"
#include "strake/parallel/team.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::bench {
namespace {

using parallel::Context;
using parallel::for_each;
using parallel::Team;

class SharingPages : public Pages {
 public:
  using Pages::Pages;

  bool run() {
    precomputed();
    locks();
    optional_lock();
    reservations();
    pipeline();
    errors();
    reports();
    return good_;
  }

 private:
  void precomputed() {
    constexpr std::size_t kPairs = 400000, kParts = 2000;
    const auto part_of = [](std::size_t i) { return work(i, 3) % kParts; };
    const auto make = [](std::size_t part) { return work(part, 20000); };
    compare(fmt::format("Precomputed: 400,000 looks at 2,000 values of {:.0f} us", us(20000)),
            {{"a cache with a lock",
              [&] {
                std::vector<std::optional<std::uint64_t>> cache(kParts);
                std::mutex mutex;
                std::vector<std::uint64_t> out(kPairs);
                return checked(for_each(all(), {.name = "p", .n = kPairs, .grain = 64},
                                        [&](std::size_t i) {
                                          const std::lock_guard lock(mutex);
                                          std::optional<std::uint64_t>& one = cache[part_of(i)];
                                          if (!one) one = make(part_of(i));
                                          out[i] = *one ^ i;
                                        }),
                               [&] { return digest(out); });
              }},
             {"filled, then read", [&] {
                std::vector<std::uint32_t> wanted(kPairs);
                for (std::size_t i = 0; i < kPairs; ++i)
                  wanted[i] = static_cast<std::uint32_t>(part_of(i));
                parallel::Precomputed<std::uint64_t> values(kParts);
                if (!values.fill(all(), {.name = "values"}, wanted, make)) return Digest{0};
                std::vector<std::uint64_t> out(kPairs);
                return checked(
                    for_each(all(), {.name = "p", .n = kPairs, .grain = 1024},
                             [&](std::size_t i) { out[i] = *values.find(wanted[i]) ^ i; }),
                    [&] { return digest(out); });
              }}});
  }

  void locks() {
    constexpr std::size_t kFrom = 2000, kTo = 300;
    const auto light = [](std::size_t from, std::size_t to) {
      return work(from * kTo + to, 8) & 255U;
    };
    std::vector<std::uint64_t> sums(kTo);
    const auto scatter = [&](auto&& add) {
      std::ranges::fill(sums, 0);
      return checked(for_each(all(), {.name = "s", .n = kFrom},
                              [&](std::size_t from) {
                                for (std::size_t to = 0; to < kTo; ++to) add(to, light(from, to));
                              }),
                     [&] { return digest(sums); });
    };
    compare("Item locks: 600,000 additions into 300 sums",
            {{"one lock for all",
              [&] {
                std::mutex mutex;
                return scatter([&](std::size_t to, std::uint64_t value) {
                  const std::lock_guard lock(mutex);
                  sums[to] += value;
                });
              }},
             {"a lock for each",
              [&] {
                parallel::ItemLocks each(kTo);
                return scatter([&](std::size_t to, std::uint64_t value) {
                  const auto held = each.hold(to);
                  sums[to] += value;
                });
              }},
             {"gathered, no lock", [&] {
                const auto gathered =
                    parallel::transform(all(), {.name = "g", .n = kTo}, [&](std::size_t to) {
                      std::uint64_t sum = 0;
                      for (std::size_t from = 0; from < kFrom; ++from) sum += light(from, to);
                      return sum;
                    });
                return gathered ? digest(*gathered) : 0;
              }}});
  }

  void optional_lock() {
    constexpr std::size_t kItems = 2000000;
    std::mutex mutex;
    std::uint64_t sum = 0;
    const auto run_with = [&](const Context& context, auto&& guarded) {
      sum = 0;
      return checked(for_each(context, {.name = "o", .n = kItems, .grain = 1024}, guarded),
                     [&] { return sum; });
    };
    compare("Optional lock: 2 million additions on one thread",
            {{"a mutex",
              [&] {
                return run_with({}, [&](std::size_t i) {
                  const std::lock_guard lock(mutex);
                  sum += i;
                });
              }},
             {"an optional lock, context without a team", [&] {
                const Context alone;
                return run_with(alone, [&](std::size_t i) {
                  const parallel::OptionalLock lock(mutex, alone);
                  sum += i;
                });
              }}});
  }

  /// Pairs of neighbours on a grid, in an order that chance decides: each takes both ends if they
  /// are free.
  void reservations() {
    constexpr std::uint32_t kSide = 400, kNone = 0;
    std::vector<std::array<std::uint32_t, 2>> pairs;
    for (std::uint32_t at = 0; at < kSide * kSide; ++at) {
      if ((at + 1) % kSide != 0) pairs.push_back({at, at + 1});
      if (at + kSide < kSide * kSide) pairs.push_back({at, at + kSide});
    }
    std::ranges::shuffle(pairs, std::mt19937(3));
    for (const std::uint32_t rounds : {0U, 300U, 3000U}) {
      std::vector<std::uint64_t> owner(std::size_t{kSide} * kSide);
      const auto free = [&](std::size_t i) {
        return owner[pairs[i][0]] == kNone && owner[pairs[i][1]] == kNone;
      };
      const auto take = [&](std::size_t i) {
        const std::uint64_t mark = work(i + 1, rounds) | 1U;
        for (const std::uint32_t end : pairs[i]) owner[end] = mark;
      };
      compare(fmt::format("Reservations: 320,000 pairs, the act {:.1f} us", us(rounds)),
              {{"one thread, in order",
                [&] {
                  std::ranges::fill(owner, 0);
                  for (std::size_t i = 0; i < pairs.size(); ++i)
                    if (free(i)) take(i);
                  return digest(owner);
                }},
               {"for_each_reserved", [&] {
                  std::ranges::fill(owner, 0);
                  const auto run = parallel::for_each_reserved(
                      all(), {.name = "r", .n = pairs.size(), .grain = 64}, owner.size(),
                      [&](std::size_t i, parallel::Claims& claims) {
                        for (const std::uint32_t end : pairs[i]) claims(end);
                        return free(i);
                      },
                      take);
                  return run ? digest(owner) : 0;
                }}});
    }
  }

  void pipeline() {
    constexpr std::size_t kItems = 3000;
    const auto read = [](std::size_t i) { return work(i, 20000); };
    const auto made = [](std::uint64_t item) { return work(item, 60000); };
    const auto write = [](Digest& file, std::uint64_t value) { file = work(file ^ value, 20000); };
    compare(fmt::format("Pipeline: 3,000 items, read {0:.0f} us, work {1:.0f} us, write {0:.0f} us",
                        us(20000), us(60000)),
            {{"one thread",
              [&] {
                Digest file = 0;
                for (std::size_t i = 0; i < kItems; ++i) write(file, made(read(i)));
                return file;
              }},
             {"read all, work on the team, write all",
              [&] {
                Digest file = 0;
                std::vector<std::uint64_t> items(kItems);
                for (std::size_t i = 0; i < kItems; ++i) items[i] = read(i);
                const auto done =
                    parallel::transform(all(), {.name = "w", .n = kItems},
                                        [&](std::size_t i) { return made(items[i]); });
                if (!done) return Digest{0};
                for (const std::uint64_t value : *done) write(file, value);
                return file;
              }},
             {"pipeline, 8 items held at a time", [&] {
                Digest file = 0;
                std::size_t next = 0;
                return checked(parallel::pipeline(
                                   all(), {.name = "p", .in_flight = 8},
                                   [&]() -> std::optional<std::uint64_t> {
                                     if (next == kItems) return std::nullopt;
                                     return read(next++);
                                   },
                                   [&](std::uint64_t&& item) { return made(item); },
                                   [&](std::uint64_t&& value) { write(file, value); }),
                               [&] { return file; });
              }}});
  }

  void errors() {
    constexpr std::size_t kItems = 1000000;
    std::vector<std::uint64_t> out(kItems);
    compare(fmt::format("Errors: a million items of {:.0f} ns that could fail", us(30) * 1e3),
            {{"body returns nothing",
              [&] {
                return checked(for_each(all(), {.name = "e", .n = kItems, .grain = 256},
                                        [&](std::size_t i) { out[i] = work(i, 30); }),
                               [&] { return digest(out); });
              }},
             {"body returns a Status", [&] {
                return checked(for_each(all(), {.name = "e", .n = kItems, .grain = 256},
                                        [&](std::size_t i) -> Status {
                                          out[i] = work(i, 30);
                                          if (out[i] == 0)
                                            return Error{ErrorCode::input, "nothing", {}, {}};
                                          return {};
                                        }),
                               [&] { return digest(out); });
              }}});
  }

  void reports() {
    constexpr std::size_t kItems = 200000;
    std::vector<std::uint64_t> out(kItems);
    const auto run_on = [&](const Context& context) {
      return checked(for_each(context, {.name = "r", .n = kItems},
                              [&](std::size_t i) { out[i] = work(i, 1000); }),
                     [&] { return digest(out); });
    };
    compare(fmt::format("Reports: 200,000 items of {:.1f} us, a block each", us(1000)),
            {{"nobody asks", [&] { return run_on(all()); }},
             {"a Progress",
              [&] {
                parallel::Progress progress;
                return run_on({.team = &team_, .progress = &progress});
              }},
             {"a Progress and a RunReport", [&] {
                parallel::Progress progress;
                parallel::RunReport report;
                return run_on({.team = &team_, .progress = &progress, .report = &report});
              }}});
  }
};

}  // namespace

bool sharing_pages(int rounds) { return SharingPages(rounds).run(); }

}  // namespace strake::bench
