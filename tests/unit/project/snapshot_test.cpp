// SPDX-License-Identifier: Apache-2.0
#include "project/snapshot/snapshot.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include "strake/clash/incremental.hpp"

namespace strake::project {
namespace {

Snapshot snapshot(const std::vector<std::uint64_t>& identities,
                  const std::vector<std::uint64_t>& signatures) {
  Snapshot made{{1, 2}, identities, {}};
  for (const std::uint64_t s : signatures) made.signatures.push_back({s, s});
  return made;
}

TEST(Snapshot, knows_objects_that_moved_in_the_order) {
  const Snapshot then = snapshot({7, 1, 9, 3}, {70, 10, 90, 30});
  const Snapshot now = snapshot({3, 2, 7, 9}, {30, 20, 71, 90});
  EXPECT_EQ(unchanged(then, now, {}).value(),
            (std::vector<std::uint32_t>{model::kNoObject, model::kNoObject, 3, 0}));
}

TEST(Snapshot, takes_no_object_for_one_of_several_with_its_identity) {
  const Snapshot twice = snapshot({5, 5, 6}, {1, 1, 2}), once = snapshot({5, 6}, {1, 2});
  EXPECT_EQ(unchanged(twice, once, {}).value(),
            (std::vector<std::uint32_t>{model::kNoObject, model::kNoObject, 1}));
  EXPECT_EQ(unchanged(once, twice, {}).value(), (std::vector<std::uint32_t>{model::kNoObject, 2}));
}

TEST(Snapshot, what_stands_is_not_looked_at) {
  constexpr std::size_t kRange = clash::Signatures::kObjectsPerRange, kObjects = 2 * kRange + 10;
  std::vector<std::uint64_t> numbers(kObjects);
  std::iota(numbers.begin(), numbers.end(), 5);
  Snapshot then = snapshot(numbers, numbers);
  then.names = {3, 4};
  then.ranges = {{1, 1}, {2, 2}, {3, 3}};
  Snapshot now = then;
  now.ranges[1] = {2, 9};
  now.signatures[kRange + 7] = now.signatures.back() = {0, 0};
  EXPECT_EQ(ranges_that_stand(then, now), (std::vector<bool>{true, false, true}));
  // The last one would be seen as another if its range were looked at.
  const std::vector<std::uint32_t> mapped = unchanged(then, now, {}).value();
  for (std::uint32_t o = 0; o < kObjects; ++o)
    EXPECT_EQ(mapped[o], o == kRange + 7 ? model::kNoObject : o);
  for (Snapshot (*const spoiled)(Snapshot) :
       std::vector<Snapshot (*)(Snapshot)>{[](Snapshot s) { return s.names = {}, s; },
                                           [](Snapshot s) { return s.names = {3, 5}, s; },
                                           [](Snapshot s) { return s.whole = {1, 3}, s; },
                                           [](Snapshot s) { return s.ranges.clear(), s; },
                                           [](Snapshot s) { return s.identities.pop_back(), s; }}) {
    const Snapshot other = spoiled(now);
    EXPECT_TRUE(ranges_that_stand(then, other).empty());
  }
}

TEST(Snapshot, refuses_one_that_lacks_signatures) {
  EXPECT_FALSE(unchanged(snapshot({1, 2}, {1}), snapshot({1}, {1}), {}));
}

TEST(Snapshot, maps_many_as_a_plain_search_does) {
  std::mt19937_64 random(3);
  Snapshot then, now;
  for (int i = 0; i < 5000; ++i) {
    const std::uint64_t identity = random();
    if (random() % 10 != 0) {
      then.identities.push_back(identity);
      then.signatures.push_back({identity, 0});
    }
    if (random() % 10 != 0) {
      now.identities.push_back(identity);
      now.signatures.push_back({identity, random() % 10 == 0 ? 1U : 0U});
    }
  }
  const std::vector<std::uint32_t> mapped = unchanged(then, now, {}).value();
  for (std::size_t i = 0; i < then.identities.size(); ++i) {
    std::uint32_t expected = model::kNoObject;
    for (std::uint32_t o = 0; o < now.identities.size(); ++o)
      if (now.identities[o] == then.identities[i] && now.signatures[o] == then.signatures[i])
        expected = o;
    ASSERT_EQ(mapped[i], expected);
  }
}

TEST(Snapshot, is_read_as_it_was_written) {
  const Snapshot written = snapshot({1, 2, 3}, {4, 5, 6});
  BlobWriter out;
  write(out, written);
  const std::vector<std::byte> bytes = out.finish().value();
  BlobReader in = BlobReader::open(bytes, "it").value();
  EXPECT_EQ(read_snapshot(in), written);
  EXPECT_TRUE(in.finish());
}

}  // namespace
}  // namespace strake::project
