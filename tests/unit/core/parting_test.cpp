// SPDX-License-Identifier: Apache-2.0
#include "core/parting.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace strake {
namespace {

TEST(Parting, by_a_property_moves_as_few_as_it_can_and_always_the_same) {
  std::vector<int> numbers{1, 12, 3, 14, 15, 6, 17, 8};
  EXPECT_EQ(part_by(std::span(numbers), [](int n) { return n < 10; }), 4U);
  // From both ends at once, what stands on the wrong side changes places.
  EXPECT_EQ(numbers, (std::vector<int>{1, 8, 3, 6, 15, 14, 17, 12}));
  EXPECT_EQ(part_by(std::span(numbers), [](int n) { return n < 100; }), 8U);
  EXPECT_EQ(part_by(std::span(numbers), [](int n) { return n > 100; }), 0U);
  EXPECT_EQ(numbers, (std::vector<int>{1, 8, 3, 6, 15, 14, 17, 12}));
  EXPECT_EQ(part_by(std::span<int>(), [](int) { return true; }), 0U);
}

TEST(Parting, at_a_number_has_the_least_in_front) {
  for (std::size_t count = 0; count <= 6; ++count) {
    std::vector<int> numbers{4, 1, 5, 0, 3, 2};
    part_at(std::span(numbers), count, std::less());
    if (count < numbers.size()) {
      EXPECT_EQ(numbers[count], static_cast<int>(count));
    }
    std::sort(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(count));
    std::sort(numbers.begin() + static_cast<std::ptrdiff_t>(count), numbers.end());
    EXPECT_EQ(numbers, (std::vector<int>{0, 1, 2, 3, 4, 5})) << count;
  }
}

TEST(Parting, a_value_is_the_one_that_sorting_would_put_there) {
  for (std::size_t n = 0; n < 5; ++n) {
    std::vector<double> numbers{2.5, 0.5, 2.5, -1, 7};
    EXPECT_EQ(nth_value(std::span(numbers), n), (std::vector<double>{-1, 0.5, 2.5, 2.5, 7})[n]);
  }
}

}  // namespace
}  // namespace strake
