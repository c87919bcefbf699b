// SPDX-License-Identifier: Apache-2.0
#include "sheets/spec/natural_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace strake::sheets {
namespace {

TEST(NaturalOrder, NumbersCountAsNumbers) {
  const std::vector<std::string> ordered{"",
                                         "2",
                                         "10",
                                         "A",
                                         "P1",
                                         "P1A2",
                                         "P1A10",
                                         "P2",
                                         "P02",
                                         "P002",
                                         "P2-1",
                                         "P10",
                                         "P99999999999999999999",
                                         "P100000000000000000000",
                                         "PA",
                                         "p1",
                                         "\xC3\xA9"};
  for (std::size_t i = 0; i < ordered.size(); ++i)
    for (std::size_t k = 0; k < ordered.size(); ++k)
      EXPECT_EQ(natural_less(ordered[i], ordered[k]), i < k) << ordered[i] << " " << ordered[k];
}

}  // namespace
}  // namespace strake::sheets
