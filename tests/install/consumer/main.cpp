// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <strake/parallel/team.hpp>
#include <vector>

#include "collatz.hpp"

int main() {
  constexpr std::uint32_t kNumbers = 100'000;
  constexpr std::uint64_t kNoCeiling = std::numeric_limits<std::uint64_t>::max();
  const auto alone = collatz_steps(kNumbers, kNoCeiling, {});
  if (!alone) {
    std::puts(alone.error().text().c_str());
    return 1;
  }

  // Below a hundred thousand 77,031 takes longest: 350 steps.
  const auto longest = std::max_element(alone->begin(), alone->end());
  std::printf("%td takes %u steps\n", longest - alone->begin() + 1, *longest);
  if (longest - alone->begin() + 1 != 77'031 || *longest != 350) return 1;

  for (const unsigned workers : {2U, 5U, 16U}) {
    strake::parallel::Team team(workers);
    const auto steps = collatz_steps(kNumbers, kNoCeiling, {.team = &team});
    if (!steps || *steps != *alone) {
      std::puts("a team gets other steps");
      return 1;
    }

    // 703 is the first whose way leads over a quarter of a million, to 250,504.
    const auto refused = collatz_steps(kNumbers, 250'000, {.team = &team});
    if (refused) {
      std::puts("an error is lost");
      return 1;
    }
    std::puts(refused.error().text().c_str());
    if (refused.error().message != "703 climbs too high") return 1;
  }
  return 0;
}
