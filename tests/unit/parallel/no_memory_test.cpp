// SPDX-License-Identifier: Apache-2.0
// Every request for memory fails in turn, on whatever thread: each pattern gives the right result
// or an error, lets no exception out, ends, and leaves the team and the progress as they were.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "strake/parallel/collect.hpp"
#include "strake/parallel/count_fill.hpp"
#include "strake/parallel/distinct.hpp"
#include "strake/parallel/find.hpp"
#include "strake/parallel/heavy.hpp"
#include "strake/parallel/host_executor.hpp"
#include "strake/parallel/nested.hpp"
#include "strake/parallel/pieces.hpp"
#include "strake/parallel/pipeline.hpp"
#include "strake/parallel/precomputed.hpp"
#include "strake/parallel/progress.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/report.hpp"
#include "strake/parallel/reservations.hpp"
#include "strake/parallel/team.hpp"

namespace {

/// Requests until one fails, and from then on until a second does; below zero: none does.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): operator new has no arguments
std::atomic<long> requests_left{-1}, requests_between{-1};

void* memory_of(std::size_t bytes, std::size_t alignment = alignof(std::max_align_t)) {
  if (requests_left.load(std::memory_order_relaxed) >= 0 && requests_left.fetch_sub(1) == 0) {
    requests_left = requests_between.exchange(-1);
    throw std::bad_alloc();
  }
  const std::size_t whole = (bytes / alignment + 1) * alignment;
  void* const memory = std::aligned_alloc(alignment, whole);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t bytes) { return memory_of(bytes); }
void* operator new[](std::size_t bytes) { return memory_of(bytes); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return memory_of(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*bytes*/, std::align_val_t /*alignment*/) noexcept {
  std::free(memory);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*bytes*/) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t /*bytes*/) noexcept { std::free(memory); }

namespace strake::parallel {
namespace {

enum class Outcome : std::uint8_t { right, error, wrong };

Outcome outcome_of(const Status& status, bool right) {
  return !status ? Outcome::error : right ? Outcome::right : Outcome::wrong;
}
template <class T, class Right>
Outcome outcome_of(const Result<T>& result, Right&& right) {
  return !result ? Outcome::error : right(*result) ? Outcome::right : Outcome::wrong;
}

/// Long enough not to fit into a std::string itself.
constexpr const char* kName = "a region with a name that needs memory of its own";
constexpr std::size_t kItems = 60;
constexpr Region kRegion{.name = kName, .n = kItems, .grain = 3};

std::string text(std::size_t i) { return std::string(40, static_cast<char>('a' + i % 20)); }

Error an_error() { return {ErrorCode::input, text(1), text(2), text(3)}; }

bool fails_at_40(std::size_t i) {
  if (i == 40) throw std::runtime_error(text(i));
  return false;
}

constexpr std::array<std::uint32_t, 1> kSomeOrder = {0};

struct Pattern {
  const char* name;
  std::function<Outcome(const Context&)> run;
};

Outcome pipeline_run(const Context& context, bool fails) {
  std::size_t next = 0, written = 0;
  const Status status = pipeline(
      context, {.name = kName, .in_flight = 3},
      [&]() -> std::optional<std::string> {
        if (next == kItems) return std::nullopt;
        return text(next++);
      },
      [&](std::string&& item) -> Result<std::string> {
        if (fails && item == text(7)) return an_error();
        return item + item;
      },
      [&](std::string&& result) { written += result.size(); });
  return outcome_of(status, !fails && written == kItems * 80);
}

std::vector<Pattern> patterns() {
  // Made before requests are counted.
  const std::string identity = text(0);
  return {
      {"for_each",
       [](const Context& c) { return outcome_of(for_each(c, kRegion, [](std::size_t) {}), true); }},
      {"for_each, shares for all workers",
       [](const Context& c) {
         constexpr std::size_t kMany = 1000;
         std::atomic<std::size_t> runs{0};
         const Status status =
             for_each(c, {.name = kName, .n = kMany}, [&](std::size_t) { ++runs; });
         return outcome_of(status, runs == kMany);
       }},
      {"for_each, a Status",
       [](const Context& c) {
         return outcome_of(for_each(c, kRegion,
                                    [](std::size_t i) -> Status {
                                      if (i == 40) return an_error();
                                      return {};
                                    }),
                           false);
       }},
      {"for_each, an exception",
       [](const Context& c) {
         return outcome_of(for_each(c, kRegion,
                                    [](std::size_t i) {
                                      if (i == 40) throw std::runtime_error(text(i));
                                    }),
                           false);
       }},
      {"transform",
       [](const Context& c) {
         return outcome_of(transform(c, kRegion, text),
                           [](const auto& all) { return all.size() == kItems; });
       }},
      {"collect",
       [](const Context& c) {
         return outcome_of(collect<std::string>(c, kRegion,
                                                [](std::size_t i, std::vector<std::string>& out) {
                                                  out.push_back(text(i));
                                                }),
                           [](const auto& all) { return all.size() == kItems; });
       }},
      {"count_fill",
       [](const Context& c) {
         return outcome_of(count_fill<int>(
                               c, kRegion, [](std::size_t i) { return i % 3; },
                               [](std::size_t i, std::span<int> out) {
                                 for (int& value : out) value = static_cast<int>(i);
                               }),
                           [](const auto& packed) { return packed.values.size() == kItems; });
       }},
      {"reduce",
       [](const Context& c) {
         return outcome_of(
             reduce(
                 c, kRegion, std::string(),
                 [](std::string& partial, std::size_t i) { partial += text(i); },
                 [](std::string& into, const std::string& partial) { into += partial; }),
             [](const std::string& all) { return all.size() == kItems * 40; });
       }},
      {"reduce, short",
       [identity](const Context& c) {
         Region region = kRegion;
         region.alone_below = kItems + 1;
         return outcome_of(
             reduce(
                 c, region, identity,
                 [](std::string& partial, std::size_t i) { partial += text(i); },
                 [](std::string& into, const std::string& partial) { into += partial; }),
             [](const std::string& all) { return all.size() == 40 * (kItems + 2); });
       }},
      {"find_first",
       [](const Context& c) {
         return outcome_of(find_first(c, kRegion, [](std::size_t i) { return i == 33; }),
                           [](const auto& found) { return found == 33; });
       }},
      {"distinct",
       [](const Context& c) {
         return outcome_of(distinct(
                               c, kName, kItems, [](std::size_t i) { return mixed(0, i % 7); },
                               [](std::size_t i, std::size_t j) { return i % 7 == j % 7; }),
                           [](const Distinct& kinds) { return kinds.first.size() == 7; });
       }},
      {"for_each_by_weight",
       [](const Context& c) {
         std::atomic<int> runs{0};
         const Status status = for_each_by_weight(
             c, kRegion, 2, [](std::size_t i) { return i == 7 ? 1e6 : 1.0; },
             [&](std::size_t /*i*/) { ++runs; });
         return outcome_of(status, runs == kItems);
       }},
      {"for_each_nested",
       [](const Context& c) {
         std::atomic<int> runs{0};
         const Status status = for_each_nested(
             c, kRegion, 10, [](std::size_t row) { return row; },
             [&](std::size_t /*row*/, std::size_t /*column*/) { ++runs; });
         return outcome_of(status, runs == 45);
       }},
      {"pieces",
       [](const Context& /*c*/) {
         return outcome_of(pieces(
                               10, [](std::size_t i) { return i; }, 2),
                           [](const auto& all) { return all.size() == 25; });
       }},
      {"for_each_reserved",
       [](const Context& c) {
         std::atomic<int> runs{0};
         const auto run = for_each_reserved(
             c, {.name = kName, .n = kItems}, 5,
             [](std::size_t i, Claims& claims) { claims(i % 5); },
             [&](std::size_t /*i*/) { ++runs; });
         return outcome_of(run, [&](const ReservedRun&) { return runs == kItems; });
       }},
      {"transform, an error",
       [](const Context& c) {
         return outcome_of(transform(c, kRegion,
                                     [](std::size_t i) -> Result<int> {
                                       if (i == 40) return an_error();
                                       return 1;
                                     }),
                           [](const auto&) { return false; });
       }},
      {"transform_until, an exception",
       [](const Context& c) {
         return outcome_of(transform_until(
                               c, kRegion, [](std::size_t i) { return fails_at_40(i) ? 1 : 0; },
                               [](int) { return false; }),
                           [](const auto&) { return false; });
       }},
      {"find_first, an exception",
       [](const Context& c) {
         return outcome_of(find_first(c, kRegion, fails_at_40), [](const auto&) { return false; });
       }},
      {"all_of, an exception",
       [](const Context& c) {
         return outcome_of(all_of(c, kRegion, [](std::size_t i) { return !fails_at_40(i); }),
                           [](bool) { return false; });
       }},
      {"collect, an error",
       [](const Context& c) {
         return outcome_of(collect<int>(c, kRegion,
                                        [](std::size_t i, std::vector<int>& out) -> Status {
                                          out.push_back(1);
                                          if (i == 40) return an_error();
                                          return {};
                                        }),
                           [](const auto&) { return false; });
       }},
      {"reduce, an error",
       [](const Context& c) {
         return outcome_of(reduce(
                               c, kRegion, 0,
                               [](int& partial, std::size_t i) -> Status {
                                 partial += 1;
                                 if (i == 40) return an_error();
                                 return {};
                               },
                               [](int& into, int partial) { into += partial; }),
                           [](int) { return false; });
       }},
      {"count_fill, an exception of count",
       [](const Context& c) {
         return outcome_of(count_fill<int>(
                               c, kRegion, [](std::size_t i) { return fails_at_40(i) ? 1U : 2U; },
                               [](std::size_t, std::span<int>) {}),
                           [](const auto&) { return false; });
       }},
      {"distinct, an exception of hash",
       [](const Context& c) {
         return outcome_of(
             distinct(
                 c, kName, kItems,
                 [](std::size_t i) -> std::uint64_t { return fails_at_40(i) ? 1 : 0; },
                 [](std::size_t, std::size_t) { return true; }),
             [](const auto&) { return false; });
       }},
      {"distinct, an exception of same",
       [](const Context& c) {
         return outcome_of(distinct(
                               c, kName, kItems, [](std::size_t) { return std::uint64_t{1}; },
                               [](std::size_t, std::size_t i) { return !fails_at_40(i); }),
                           [](const auto&) { return false; });
       }},
      {"for_each_by_weight, an error of a heavy item and of a light one",
       [](const Context& c) {
         return outcome_of(for_each_by_weight(
                               c, kRegion, 2, [](std::size_t i) { return i == 40 ? 1e6 : 1.0; },
                               [](std::size_t i) -> Status {
                                 if (i == 40 || i == 50) return an_error();
                                 return {};
                               }),
                           false);
       }},
      {"for_each_by_weight, an exception of cost",
       [](const Context& c) {
         return outcome_of(
             for_each_by_weight(
                 c, kRegion, 2, [](std::size_t i) { return fails_at_40(i) ? 1.0 : 2.0; },
                 [](std::size_t) {}),
             false);
       }},
      {"for_each_nested, an exception of length",
       [](const Context& c) {
         return outcome_of(
             for_each_nested(
                 c, kRegion, kItems,
                 [](std::size_t row) -> std::size_t { return fails_at_40(row) ? 1 : 2; },
                 [](std::size_t, std::size_t) {}),
             false);
       }},
      {"for_each_reserved, an error",
       [](const Context& c) {
         return outcome_of(for_each_reserved(
                               c, kRegion, 5, [](std::size_t i, Claims& claims) { claims(i % 5); },
                               [](std::size_t i) -> Status {
                                 if (i == 40) return an_error();
                                 return {};
                               }),
                           [](const auto&) { return false; });
       }},
      {"for_each_reserved, an order",
       [](const Context& c) {
         Region region = kRegion;
         region.order = kSomeOrder;
         return outcome_of(
             for_each_reserved(
                 c, region, 5, [](std::size_t, Claims& claims) { claims(1); }, [](std::size_t) {}),
             [](const auto&) { return false; });
       }},
      {"for_each, an order of the wrong length",
       [](const Context& c) {
         Region region = kRegion;
         region.order = kSomeOrder;
         return outcome_of(for_each(c, region, [](std::size_t) {}), false);
       }},
      {"pipeline", [](const Context& c) { return pipeline_run(c, false); }},
      {"pipeline, an error", [](const Context& c) { return pipeline_run(c, true); }},
  };
}

/// What comes of a pattern when request number `request` fails, and so many after it another one
/// (below zero: none). False when none did: it has fewer.
bool survives(const Pattern& pattern, Executor* team, long request, long between) {
  Progress progress;
  RunReport report;
  const Context context{.team = team, .progress = &progress, .report = &report};
  std::optional<Outcome> outcome;
  requests_between = between;
  requests_left = request;
  try {
    outcome = pattern.run(context);
  } catch (...) {
  }
  // Where a second one was to fail, whether the first did shows in that it was taken up.
  const bool failed = between < 0 ? requests_left < 0 : requests_between < 0;
  requests_left = requests_between = -1;
  EXPECT_TRUE(outcome) << "an exception came out";
  EXPECT_NE(outcome, Outcome::wrong);
  EXPECT_EQ(progress.snapshot().phase, "");
  std::atomic<int> runs{0};
  EXPECT_TRUE(for_each({.team = team}, {.name = "after", .n = 10}, [&](std::size_t) { ++runs; }));
  EXPECT_EQ(runs, 10);
  return failed;
}

/// A sanitizer's runtime brings an operator new, too: the one in force must be ours.
TEST(NoMemory, is_what_a_request_meets) {
  requests_left = 1;
  operator delete(operator new(8));
  EXPECT_THROW(operator delete(operator new(8)), std::bad_alloc);
  EXPECT_EQ(requests_left.exchange(-1), -1);
}

TEST(NoMemory, is_an_error_wherever_it_happens) {
  Team team(3);
  HostExecutor host(3, [](unsigned count, const HostExecutor::Body& body) {
    for (unsigned i = 0; i < count; ++i) body(i);
  });
  for (const Pattern& pattern : patterns())
    for (Executor* const who : {static_cast<Executor*>(nullptr), static_cast<Executor*>(&team),
                                static_cast<Executor*>(&host)}) {
      SCOPED_TRACE(pattern.name);
      for (const long between : {-1, 0, 1, 3}) {
        long request = 0;
        while (survives(pattern, who, request, between) && !HasFailure()) ++request;
        ASSERT_FALSE(HasFailure()) << "request " << request << ", and " << between << " later";
        EXPECT_LT(request, 5000);
      }
    }
}

TEST(NoMemory, leaves_a_table_as_it_was) {
  Team team(3);
  const std::vector<std::uint32_t> wanted = {1, 5, 9, 1};
  for (const bool by_weight : {false, true})
    for (long request = 0;; ++request) {
      Precomputed<std::string> table(50);
      const Context context{.team = &team};
      std::optional<Status> status;
      requests_left = request;
      try {
        status = by_weight ? table.fill_by_weight(
                                 context, {.name = kName}, 2, wanted,
                                 [](std::size_t key) { return key == 5 ? 100.0 : 1.0; }, text)
                           : table.fill(context, {.name = kName}, wanted, text);
      } catch (...) {
      }
      const bool failed = requests_left.exchange(-1) < 0;
      ASSERT_TRUE(status) << "an exception came out at request " << request;
      ASSERT_EQ(table.find(5) != nullptr, static_cast<bool>(*status));
      if (*status) {
        EXPECT_EQ(*table.find(9), text(9));
      }
      if (!failed) break;
      ASSERT_LT(request, 5000);
    }
}

}  // namespace
}  // namespace strake::parallel
