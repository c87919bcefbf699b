// SPDX-License-Identifier: Apache-2.0
// Scratch memory that each worker makes once and uses again for every item it gets.
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdio>
#include <vector>

#include "strake/parallel/team.hpp"
#include "strake/parallel/transform.hpp"

int main() {
  using namespace strake::parallel;
  constexpr std::size_t kItems = 5000;
  Team team(4);
  std::atomic<unsigned> made{0};
  const auto medians = transform_with(
      {.team = &team}, {.name = "medians", .n = kItems, .grain = 32},
      [&] {
        ++made;
        return std::vector<std::size_t>();
      },
      [](std::vector<std::size_t>& scratch, std::size_t i) {
        scratch.clear();  // keeps its memory: no allocation after the first items
        for (std::size_t k = 0; k < 101; ++k) scratch.push_back((i + k * 37) % 101);
        std::nth_element(scratch.begin(), scratch.begin() + 50, scratch.end());
        return scratch[50];
      });
  if (!medians) return 1;
  for (const std::size_t median : *medians)
    if (median != 50) return 1;
  if (made > team.size()) return 1;
  std::printf("%zu medians with no more scratch buffers than workers\n", medians->size());
  return 0;
}
