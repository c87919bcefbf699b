// SPDX-License-Identifier: Apache-2.0
// What each page of docs/patterns gains: the loop as it was before and as it is after, taking turns
// on the same team, medians compared, results checked.
//
//     bench_patterns [ROUNDS]
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "clocks.hpp"
#include "parallel/items.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/count_fill.hpp"
#include "strake/parallel/find.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/item_locks.hpp"
#include "strake/parallel/optional_lock.hpp"
#include "strake/parallel/pieces.hpp"
#include "strake/parallel/pipeline.hpp"
#include "strake/parallel/precomputed.hpp"
#include "strake/parallel/progress.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/report.hpp"
#include "strake/parallel/reservations.hpp"
#include "strake/parallel/shape2.hpp"
#include "strake/parallel/team.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::bench {
namespace {

using parallel::Context;
using parallel::for_each;
using parallel::Team;

/// A number that stands for a result: equal results, equal numbers. Cheap, as it is in the times.
using Digest = std::uint64_t;

template <class Values>
Digest digest(const Values& values) {
  Digest all = 0, odd = 1;
  for (const auto& value : values) {
    all += static_cast<Digest>(value) * odd;
    odd += 2;
  }
  return all;
}

/// Runs what must succeed; a failure shows as a wrong result.
Digest checked(const Status& status, const std::function<Digest()>& result) {
  return status ? result() : 0;
}

struct Way {
  std::string name;
  std::function<Digest()> run;
  std::vector<double> seconds = {};

  [[nodiscard]] double median() {
    std::ranges::sort(seconds);
    return seconds[seconds.size() / 2];
  }
};

class Pages {
 public:
  explicit Pages(int rounds) : rounds_(rounds), team_(parallel::default_workers()) {}

  bool run() {
    fmt::print("{} workers, medians of {} rounds\n", team_.size(), rounds_);
    team();
    worker_context();
    results();
    counted();
    searching();
    flat_loops();
    pieces();
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
  [[nodiscard]] Context all() { return {.team = &team_}; }

  /// Every way once in each round; their results must be the same.
  void compare(const std::string& page, std::vector<Way> ways) {
    std::optional<Digest> expected;
    for (int round = 0; round < rounds_; ++round)
      for (Way& way : ways) {
        Lap lap;
        const Digest result = way.run();
        way.seconds.push_back(lap());
        if (!expected) expected = result;
        if (result == *expected) continue;
        fmt::print("{}, {}: WRONG RESULT\n", page, way.name);
        good_ = false;
      }
    fmt::print("{}\n", page);
    const double first = ways.front().median();
    for (Way& way : ways)
      fmt::print("  {:<58}{:10.3f} ms{:8.2f} times\n", way.name, way.median() * 1e3,
                 first / way.median());
  }

  void team() {
    constexpr std::size_t kRegions = 200, kItems = 64;
    std::vector<std::uint64_t> out(kItems);
    const auto body = [&](std::size_t i) { out[i] = work(i, 400); };
    compare("Team: 200 short loops",
            {{"one thread",
              [&] {
                for (std::size_t r = 0; r < kRegions; ++r)
                  for (std::size_t i = 0; i < kItems; ++i) body(i);
                return digest(out);
              }},
             {"threads started for each",
              [&] {
                for (std::size_t r = 0; r < kRegions; ++r) {
                  std::vector<std::thread> threads;
                  for (unsigned w = 0; w < team_.size(); ++w)
                    threads.emplace_back([&, w] {
                      for (std::size_t i = w; i < kItems; i += team_.size()) body(i);
                    });
                  for (std::thread& thread : threads) thread.join();
                }
                return digest(out);
              }},
             {"a team", [&] {
                for (std::size_t r = 0; r < kRegions; ++r)
                  good_ = for_each(all(), {.name = "t", .n = kItems, .grain = 8}, body) && good_;
                return digest(out);
              }}});
  }

  void worker_context() {
    constexpr std::size_t kItems = 20000, kScratch = 65536;
    std::vector<std::uint64_t> out(kItems);
    // A table that an item uses a corner of, and leaves clean.
    const auto use = [&](std::vector<std::uint32_t>& table, std::size_t i) {
      for (std::uint32_t k = 0; k < 16; ++k) out[i] += ++table[work(i, k) % kScratch];
      for (std::uint32_t k = 0; k < 16; ++k) table[work(i, k) % kScratch] = 0;
    };
    compare("Worker context: a table of 256 KB that an item uses a corner of",
            {{"made for each item",
              [&] {
                std::ranges::fill(out, 0);
                return checked(for_each(all(), {.name = "w", .n = kItems, .grain = 16},
                                        [&](std::size_t i) {
                                          std::vector<std::uint32_t> table(kScratch);
                                          use(table, i);
                                        }),
                               [&] { return digest(out); });
              }},
             {"made for each worker", [&] {
                std::ranges::fill(out, 0);
                return checked(
                    parallel::for_each_with(
                        all(), {.name = "w", .n = kItems, .grain = 16},
                        [] { return std::vector<std::uint32_t>(kScratch); },
                        [&](std::vector<std::uint32_t>& table, std::size_t i) { use(table, i); }),
                    [&] { return digest(out); });
              }}});
  }

  void results() {
    constexpr std::size_t kItems = 400000;
    const auto hits = [](std::size_t i, auto&& add) {
      const std::uint64_t x = work(i, 50);
      for (std::uint64_t k = 0; k < x % 5; ++k) add(i * 8 + k);
    };
    compare("Results: none to four from each of 400,000 items",
            {{"one thread",
              [&] {
                std::vector<std::size_t> all_hits;
                for (std::size_t i = 0; i < kItems; ++i)
                  hits(i, [&](std::size_t hit) { all_hits.push_back(hit); });
                return digest(all_hits);
              }},
             {"a vector with a lock, sorted at the end",
              [&] {
                std::vector<std::size_t> all_hits;
                std::mutex mutex;
                const Status status =
                    for_each(all(), {.name = "h", .n = kItems, .grain = 64}, [&](std::size_t i) {
                      hits(i, [&](std::size_t hit) {
                        const std::lock_guard lock(mutex);
                        all_hits.push_back(hit);
                      });
                    });
                std::ranges::sort(all_hits);
                return checked(status, [&] { return digest(all_hits); });
              }},
             {"collect", [&] {
                const auto all_hits = parallel::collect<std::size_t>(
                    all(), {.name = "h", .n = kItems, .grain = 64},
                    [&](std::size_t i, std::vector<std::size_t>& out) {
                      hits(i, [&](std::size_t hit) { out.push_back(hit); });
                    });
                return all_hits ? digest(*all_hits) : 0;
              }}});
  }

  void counted() {
    constexpr std::size_t kItems = 200000;
    const auto many = [](std::size_t i) { return work(i, 4) % 40; };
    compare("Results: lists whose lengths are known, 4 million values",
            {{"a vector for each, put end to end",
              [&] {
                std::vector<std::vector<std::uint64_t>> lists(kItems);
                const Status status =
                    for_each(all(), {.name = "l", .n = kItems, .grain = 64}, [&](std::size_t i) {
                      for (std::uint64_t k = 0; k < many(i); ++k) lists[i].push_back(i ^ k);
                    });
                std::vector<std::uint64_t> values;
                for (const auto& list : lists)
                  values.insert(values.end(), list.begin(), list.end());
                return checked(status, [&] { return values.size() ^ values.back(); });
              }},
             {"count_fill", [&] {
                const auto packed = parallel::count_fill<std::uint64_t>(
                    all(), {.name = "l", .n = kItems, .grain = 64}, many,
                    [](std::size_t i, std::span<std::uint64_t> out) {
                      for (std::uint64_t k = 0; k < out.size(); ++k) out[k] = i ^ k;
                    });
                return packed ? packed->values.size() ^ packed->values.back() : 0;
              }}});
  }

  void searching() {
    constexpr std::size_t kItems = 1000000, kFirst = 200000;
    const auto bad = [](std::size_t i) { return work(i, 30) != 0 && i >= kFirst && i % 7 == 0; };
    compare("Searching: the first of a million, after a fifth of them",
            {{"one thread, leaves at the first",
              [&] {
                std::size_t i = 0;
                while (i < kItems && !bad(i)) ++i;
                return i;
              }},
             {"all items, then the lowest",
              [&] {
                const auto flags = parallel::transform(
                    all(), {.name = "f", .n = kItems, .grain = 1024},
                    [&](std::size_t i) { return static_cast<std::uint8_t>(bad(i)); });
                if (!flags) return std::size_t{0};
                return static_cast<std::size_t>(std::ranges::find(*flags, 1) - flags->begin());
              }},
             {"find_first", [&] {
                const auto found =
                    parallel::find_first(all(), {.name = "f", .n = kItems, .grain = 1024}, bad);
                return found ? found->value_or(0) : 0;
              }}});
  }

  void flat_loops() {
    constexpr std::size_t kRows = 3, kColumns = 300000;
    std::vector<std::uint64_t> out(kRows * kColumns);
    const auto body = [&](std::size_t row, std::size_t column) {
      out[row * kColumns + column] = work(row ^ column, 100);
    };
    compare("Flat loops: 3 rows of 300,000",
            {{"rows as items",
              [&] {
                return checked(for_each(all(), {.name = "r", .n = kRows},
                                        [&](std::size_t row) {
                                          for (std::size_t c = 0; c < kColumns; ++c) body(row, c);
                                        }),
                               [&] { return digest(out); });
              }},
             {"Shape2", [&] {
                const parallel::Shape2 shape{kRows, kColumns};
                return checked(for_each(all(), {.name = "r", .n = shape.size(), .grain = 4096},
                                        [&](std::size_t flat) {
                                          const auto [row, column] = shape.index(flat);
                                          body(row, column);
                                        }),
                               [&] { return digest(out); });
              }}});
  }

  void pieces() {
    // A thousand meshes of twenty triangles, and one of 20,000 at the end.
    std::vector<std::size_t> sizes(1000, 20);
    sizes.push_back(20000);
    const auto triangle = [](std::size_t m, std::size_t t) { return work(m * 32768 + t, 500); };
    compare("Pieces: a thousand small meshes, then one as large as all of them",
            {{"meshes as items",
              [&] {
                const auto sums = parallel::transform(all(), {.name = "m", .n = sizes.size()},
                                                      [&](std::size_t m) {
                                                        std::uint64_t sum = 0;
                                                        for (std::size_t t = 0; t < sizes[m]; ++t)
                                                          sum ^= triangle(m, t);
                                                        return sum;
                                                      });
                return sums ? digest(*sums) : 0;
              }},
             {"pieces of 512", [&] {
                const auto cut =
                    parallel::pieces(sizes.size(), [&](std::size_t m) { return sizes[m]; }, 512);
                if (!cut) return Digest{0};
                const auto parts =
                    parallel::transform(all(), {.name = "m", .n = cut->size()}, [&](std::size_t k) {
                      const auto& piece = (*cut)[k];
                      std::uint64_t sum = 0;
                      for (std::size_t t = piece.first; t < piece.last; ++t)
                        sum ^= triangle(piece.item, t);
                      return sum;
                    });
                if (!parts) return Digest{0};
                std::vector<std::uint64_t> sums(sizes.size(), 0);
                for (std::size_t k = 0; k < cut->size(); ++k) sums[(*cut)[k].item] ^= (*parts)[k];
                return digest(sums);
              }}});
  }

  void precomputed() {
    constexpr std::size_t kPairs = 400000, kParts = 2000;
    const auto part_of = [](std::size_t i) { return work(i, 3) % kParts; };
    const auto make = [](std::size_t part) { return work(part, 20000); };
    compare("Precomputed: 400,000 looks at 2,000 values of 20 us",
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
      compare(fmt::format("Reservations: 320,000 pairs, the act some {} ns", rounds * 7 / 10),
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
    compare("Pipeline: 3,000 items, read 15 us, work 45 us, write 15 us",
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
    compare("Errors: a million items of 20 ns that could fail",
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
    compare("Reports: 200,000 items of 0.7 us, a block each",
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

  int rounds_;
  Team team_;
  bool good_ = true;
};

}  // namespace
}  // namespace strake::bench

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 15;
  return strake::bench::Pages(rounds).run() ? 0 : 1;
}
