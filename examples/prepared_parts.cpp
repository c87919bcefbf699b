// SPDX-License-Identifier: Apache-2.0
// What pairs need of their parts is worked out before them, once for each part that needs it, by
// all workers: no cache that fills itself while it is asked.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <utility>
#include <vector>

#include "strake/parallel/precomputed.hpp"
#include "strake/parallel/team.hpp"
#include "strake/parallel/transform.hpp"

namespace {

constexpr std::size_t kParts = 10'000;

/// Dear to make.
struct Tree {
  std::uint64_t leaves = 0;
};
Tree plant(std::size_t part) {
  Tree tree;
  for (std::size_t k = 0; k < 1000; ++k) tree.leaves += (part * k) % 7;
  return tree;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> make_pairs() {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t i = 0; i < 3000; ++i) pairs.emplace_back(i * 37 % 900, 900 + i * 53 % 800);
  return pairs;
}

}  // namespace

int main() {
  const auto pairs = make_pairs();

  // Before: a cache, which on several threads is a race or a lock in every look-up.
  std::vector<Tree> cache(kParts);
  std::vector<bool> known(kParts, false);
  const auto cached = [&](std::uint32_t part) -> const Tree& {
    if (!known[part]) cache[part] = plant(part);
    known[part] = true;
    return cache[part];
  };
  std::vector<std::uint64_t> expected;
  for (const auto& [a, b] : pairs) expected.push_back(cached(a).leaves * cached(b).leaves);

  // After: which trees are needed, the trees, the pairs.
  using namespace strake::parallel;
  std::size_t made = 0;
  for (const unsigned workers : {1U, 2U, 3U, 8U, 64U}) {
    Team team(workers);
    const Context context{.team = &team};
    std::vector<std::uint32_t> wanted;
    for (const auto& [a, b] : pairs) wanted.insert(wanted.end(), {a, b});
    Precomputed<Tree> trees(kParts);
    if (!trees.fill(context, {.name = "trees"}, wanted, plant)) return 1;
    const auto results =
        transform(context, {.name = "pairs", .n = pairs.size(), .grain = 16}, [&](std::size_t i) {
          return trees.find(pairs[i].first)->leaves * trees.find(pairs[i].second)->leaves;
        });
    if (!results || *results != expected) return 1;
    made = 0;
    for (std::size_t part = 0; part < kParts; ++part)
      if (trees.find(part) != nullptr) ++made;
  }
  std::printf("%zu pairs of %zu parts: %zu trees\n", pairs.size(), kParts, made);
  return 0;
}
