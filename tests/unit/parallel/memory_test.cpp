// SPDX-License-Identifier: Apache-2.0
// Memory that a team provides and takes down, offsets that it sums up, items that it deals out, and
// the lowest item of each key.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <tuple>
#include <vector>

#include "strake/parallel/deal.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/lowest.hpp"
#include "strake/parallel/slots.hpp"
#include "strake/parallel/team.hpp"

namespace strake::parallel {
namespace {

constexpr std::array<unsigned, 4> kTeams{1, 2, 3, 8};

/// A value that is not all zeros, with memory that nobody names.
struct Numbered {
  std::int32_t number = 7;
  double none = 0;
  friend bool operator==(const Numbered&, const Numbered&) = default;
};

/// Takes memory, writes it full and gives it back, so that what comes next finds it so.
void soil_memory(std::size_t bytes) {
  const std::vector<unsigned char> soil(bytes, 0xab);
  EXPECT_EQ(std::ranges::count(soil, 0xab), static_cast<std::ptrdiff_t>(bytes));
}

template <class T>
void expect_default_values(std::size_t n) {
  for (const unsigned workers : kTeams) {
    Team team(workers);
    soil_memory(n * sizeof(T));
    const Result<std::vector<T>> made = slots<T>(n, {.team = &team});
    ASSERT_TRUE(made);
    EXPECT_EQ(made->size(), n);
    EXPECT_TRUE(std::ranges::all_of(*made, [](const T& value) { return value == T{}; }));
  }
}

TEST(Slots, AreDefaultValuesWhoeverMadeThem) {
  for (const std::size_t n : {0U, 1U, 1000U, 300'001U}) {
    expect_default_values<Numbered>(n);
    expect_default_values<std::uint8_t>(n * 16);
    expect_default_values<std::string>(n);
    expect_default_values<std::vector<int>>(n);
  }
}

TEST(Slots, ThatAreUnsetAreAVectorLikeAnyOther) {
  constexpr std::size_t kMany = 500'000;
  std::vector<Numbered> expected(kMany);
  for (std::size_t i = 0; i < kMany; ++i) expected[i] = {static_cast<std::int32_t>(i), 0.5};
  for (const unsigned workers : kTeams) {
    Team team(workers);
    const Context context{.team = &team, .stop = {}};
    Result<std::vector<Numbered>> made = unset_slots<Numbered>(kMany, context);
    ASSERT_TRUE(made);
    ASSERT_EQ(made->size(), kMany);
    const Status written = for_each(context, {.name = "written", .n = kMany, .grain = 100},
                                    [&](std::size_t i) { (*made)[i] = expected[i]; });
    ASSERT_TRUE(written);
    EXPECT_EQ(*made, expected);
    made->push_back({-1, 2});
    EXPECT_EQ(made->size(), kMany + 1);
    EXPECT_EQ(made->back(), (Numbered{-1, 2}));
    EXPECT_EQ(made->front(), expected.front());
    made->resize(3);
    made->shrink_to_fit();
    EXPECT_EQ(made->back(), expected[2]);
  }
  const auto none = unset_slots<Numbered>(0);
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->empty());
}

TEST(Slots, ThatAreUnsetHaveValuesWhereTheTypeNeedsThem) {
  soil_memory(1 << 22);
  const auto made = unset_slots<std::string>(100'000);
  ASSERT_TRUE(made);
  EXPECT_TRUE(std::ranges::all_of(*made, &std::string::empty));
}

TEST(Slots, OfMoreThanThereIsMemoryAreAnError) {
  constexpr std::size_t kTooMany = std::numeric_limits<std::size_t>::max() / 2;
  for (const auto& made : {slots<Numbered>(kTooMany), unset_slots<Numbered>(kTooMany)}) {
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().code, ErrorCode::memory);
  }
}

/// A value that counts where it lies how often it was ended.
struct Ended {
  std::uint8_t* times = nullptr;
  Ended() = default;
  Ended(const Ended&) = delete;
  Ended& operator=(const Ended&) = delete;
  Ended(Ended&&) = delete;
  Ended& operator=(Ended&&) = delete;
  ~Ended() {
    if (times != nullptr) ++*times;
  }
};

TEST(Slots, AreTakenDownOnceEachWhoeverTakesPart) {
  for (const std::size_t n : {0U, 1U, 1000U, 300'001U})
    for (const unsigned workers : kTeams) {
      Team team(workers);
      const std::stop_source stop;
      stop.request_stop();
      for (const Context& context :
           {Context{.team = &team}, Context{.team = &team, .stop = stop.get_token()}, Context{}}) {
        std::vector<std::uint8_t> times(n);
        std::vector<Ended> values(n);
        for (std::size_t i = 0; i < n; ++i) values[i].times = &times[i];
        clear(values, context);
        EXPECT_TRUE(values.empty());
        EXPECT_EQ(std::ranges::count(times, 1), static_cast<std::ptrdiff_t>(n));
        values = std::vector<Ended>(3);
        EXPECT_EQ(values.size(), 3U);
      }
    }
}

TEST(Offsets, AreTheSumsForAnyTeam) {
  for (const std::size_t n : {1U, 2U, 16'383U, 16'384U, 16'385U, 100'000U}) {
    std::vector<std::size_t> lengths(n);
    for (std::size_t i = 1; i < n; ++i) lengths[i] = i * i % 97;
    std::vector<std::size_t> expected = lengths;
    std::partial_sum(expected.begin(), expected.end(), expected.begin());
    for (const unsigned workers : kTeams) {
      Team team(workers);
      std::vector<std::size_t> summed = lengths;
      ASSERT_TRUE(detail::prefix_sum({.team = &team}, summed));
      EXPECT_EQ(summed, expected) << n << " lengths, " << workers << " workers";
      summed = lengths;
      ASSERT_TRUE(detail::prefix_sum({}, summed));
      EXPECT_EQ(summed, expected);
    }
  }
}

TEST(Offsets, ThatCannotBeCountedAreAnErrorForAnyTeam) {
  constexpr std::size_t kMax = std::numeric_limits<std::size_t>::max();
  // Within a run, between two, and the most that can be counted.
  for (const auto& [first, second, good] :
       {std::tuple(10U, 20U, false), std::tuple(10U, 40'000U, false), std::tuple(10U, 10U, true)}) {
    for (const unsigned workers : kTeams) {
      Team team(workers);
      std::vector<std::size_t> lengths(50'000);
      lengths[second] = 1;
      lengths[first] = kMax;
      const Status summed = detail::prefix_sum({.team = &team}, lengths);
      EXPECT_EQ(static_cast<bool>(summed), good) << first << ", " << second;
      if (!summed) {
        EXPECT_EQ(summed.error().code, ErrorCode::input);
      }
    }
  }
}

TEST(Deal, IsByLotsInTheOrderOfTheItemsForAnyTeam) {
  constexpr std::size_t kLots = 5;
  const auto lot_of = [](std::size_t i) { return i * i % 7 % (kLots + 1); };  // some in none
  for (const std::size_t n : {0U, 1U, 1000U, 100'003U}) {
    std::array<std::vector<std::uint64_t>, kLots> expected;
    for (std::size_t i = 0; i < n; ++i)
      if (lot_of(i) < kLots) expected.at(lot_of(i)).push_back(3 * i);
    for (const unsigned workers : kTeams) {
      Team team(workers);
      const auto dealt = deal<std::uint64_t, kLots>({.team = &team}, "dealt", n, lot_of,
                                                    [](std::size_t i) { return 3 * i; });
      ASSERT_TRUE(dealt);
      for (std::size_t lot = 0; lot < kLots; ++lot)
        EXPECT_TRUE(std::ranges::equal((*dealt)[lot], expected.at(lot))) << n << ", " << lot;
    }
  }
}

TEST(ItemsByKey, AreListsInTheOrderOfTheItemsForAnyTeam) {
  for (const std::size_t keys : {1U, 63U, 64U, 65U, 5000U})
    for (const std::size_t n : {0U, 1U, 1000U, 60'001U}) {
      const auto key_of = [&](std::size_t i) { return i * i % 10'007 % keys; };
      std::vector<std::vector<std::uint32_t>> expected(keys);
      for (std::size_t i = 0; i < n; ++i)
        expected[key_of(i)].push_back(static_cast<std::uint32_t>(i));
      for (const unsigned workers : kTeams) {
        Team team(workers);
        const auto lists = items_by_key({.team = &team}, "lists", n, keys, key_of);
        ASSERT_TRUE(lists);
        ASSERT_EQ(lists->size(), keys);
        for (std::size_t key = 0; key < keys; ++key)
          ASSERT_TRUE(std::ranges::equal((*lists)[key], expected[key])) << n << ", " << key;
      }
    }
}

TEST(ItemsByKey, OfNoKeysAreNone) {
  const auto lists = items_by_key({}, "lists", 0, 0, [](std::size_t) { return std::size_t{0}; });
  ASSERT_TRUE(lists);
  EXPECT_EQ(lists->size(), 0U);
}

TEST(Deal, ReportsTheLowestItemThatFails) {
  Team team(3);
  const auto dealt = deal<std::size_t, 2>(
      {.team = &team}, "dealt", 100'000,
      [](std::size_t i) -> std::size_t {
        if (i >= 20'000) throw std::runtime_error("no lot");
        return 0;
      },
      [](std::size_t i) { return i; });
  ASSERT_FALSE(dealt);
  EXPECT_EQ(dealt.error().message, "no lot");
}

TEST(Lowest, IsTheLowestItemOfEachKeyForAnyTeam) {
  constexpr std::size_t kItems = 200'000, kKeys = 1000;
  // The last keys have no item.
  const auto key = [](std::size_t i) { return i * 7919 % (kKeys - 10); };
  std::vector<std::uint32_t> expected(kKeys, Lowest::kNone);
  for (std::size_t i = kItems; i-- > 0;) expected[key(i)] = static_cast<std::uint32_t>(i);
  for (const unsigned workers : kTeams) {
    Team team(workers);
    Lowest lowest(kKeys);
    ASSERT_EQ(lowest.size(), kKeys);
    // From the last item on, so that nearly all are lower than what is known.
    const Status offered =
        for_each({.team = &team}, {.name = "offers", .n = kItems, .grain = 64}, [&](std::size_t i) {
          const std::size_t item = kItems - 1 - i;
          lowest.offer(key(item), item);
        });
    ASSERT_TRUE(offered);
    for (std::size_t k = 0; k < kKeys; ++k) EXPECT_EQ(lowest[k], expected[k]) << k;
  }
}

}  // namespace
}  // namespace strake::parallel
