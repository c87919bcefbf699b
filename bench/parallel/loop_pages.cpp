// SPDX-License-Identifier: Apache-2.0
// What the pages of docs/patterns on loops and their results gain.
#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "parallel/items.hpp"
#include "parallel/pages.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/count_fill.hpp"
#include "strake/parallel/find.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/pieces.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/shape2.hpp"
#include "strake/parallel/team.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::bench {
namespace {

using parallel::Context;
using parallel::for_each;
using parallel::Team;

class LoopPages : public Pages {
 public:
  using Pages::Pages;

  bool run() {
    team();
    worker_context();
    results();
    counted();
    ordered_reduce();
    searching();
    flat_loops();
    pieces();
    return good_;
  }

 private:
  void team() {
    constexpr std::size_t kRegions = 200, kItems = 64;
    std::vector<std::uint64_t> out(kItems);
    const auto body = [&](std::size_t i) { out[i] = work(i, 400); };
    compare(fmt::format("Team: 200 loops of 64 items of {:.1f} us", us(400)),
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

  /// Terms over many orders of magnitude: a sum shows its grouping.
  void ordered_reduce() {
    constexpr std::size_t kTerms = 4'000'000, kGrain = 1024;
    const auto term = [](std::size_t i) {
      return std::ldexp(static_cast<double>(work(i, 4) >> 12U), -static_cast<int>(i % 41));
    };
    const auto blocks = [&](const Context& context) {
      const auto sum = parallel::reduce(
          context, {.name = "sum", .n = kTerms, .grain = kGrain}, 0.0,
          [&](double& partial, std::size_t i) { partial += term(i); },
          [](double& into, double partial) { into += partial; });
      return sum ? std::bit_cast<Digest>(*sum) : 0;
    };
    compare(
        "Ordered reduce: a sum of 4 million terms",
        {{"one thread", [&] { return blocks({}); }}, {"a team", [&] { return blocks(all()); }}});
    std::set<Digest> by_worker, by_block;
    for (unsigned workers = 1; workers <= 64; ++workers) {
      double total = 0;
      for (unsigned w = 0; w < workers; ++w) {
        double partial = 0;
        for (std::size_t i = kTerms * w / workers; i < kTerms * (w + 1) / workers; ++i)
          partial += term(i);
        total += partial;
      }
      by_worker.insert(std::bit_cast<Digest>(total));
      Team team(workers);
      by_block.insert(blocks({.team = &team}));
    }
    good_ = good_ && by_block.size() == 1;
    fmt::print("  different sums for 1 to 64 workers: {} of equal ranges by worker, {} of blocks\n",
               by_worker.size(), by_block.size());
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
};

}  // namespace

bool loop_pages(int rounds) { return LoopPages(rounds).run(); }

}  // namespace strake::bench
