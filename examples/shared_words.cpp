// SPDX-License-Identifier: Apache-2.0
// What workers may share while they run: a flag that is only ever set, an allowance, the lowest
// item of a key, a lock per item, a lock that is none on one thread. And the form that shares
// nothing, with the same result.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <mutex>
#include <vector>

#include "strake/parallel/allowance.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/item_locks.hpp"
#include "strake/parallel/lowest.hpp"
#include "strake/parallel/marks.hpp"
#include "strake/parallel/optional_lock.hpp"
#include "strake/parallel/team.hpp"
#include "strake/parallel/transform.hpp"

namespace {

constexpr std::size_t kLamps = 4000, kWalls = 300;

/// How much light of a lamp falls on a wall; nothing of most.
std::uint32_t light(std::size_t lamp, std::size_t wall) {
  const std::uint64_t h = (lamp * kWalls + wall + 1) * 0x9e3779b97f4a7c15ULL;
  return h >> 56U < 20 ? static_cast<std::uint32_t>(h >> 40U & 0xffU) : 0;
}

}  // namespace

int main() {
  using namespace strake;
  using namespace strake::parallel;
  constexpr std::uint32_t kBright = 40'000;
  std::vector<std::uint32_t> expected(kWalls, 0), first_lamp(kWalls, Lowest::kNone);
  for (std::size_t lamp = 0; lamp < kLamps; ++lamp)
    for (std::size_t wall = 0; wall < kWalls; ++wall) {
      expected[wall] = std::min(kBright, expected[wall] + light(lamp, wall));
      if (first_lamp[wall] == Lowest::kNone && light(lamp, wall) > 0)
        first_lamp[wall] = static_cast<std::uint32_t>(lamp);
    }

  for (const unsigned workers : {1U, 2U, 3U, 8U, 64U}) {
    Team team(workers);
    const Context context{.team = &team};

    // Scatter: each lamp writes into the walls that it reaches. The least of two sums that only
    // grow is the same whoever comes first.
    std::vector<std::uint32_t> scattered(kWalls, 0);
    ItemLocks locks(kWalls);
    Marks bright(kWalls);
    Allowance rays(kLamps * kWalls);
    std::mutex count_mutex;
    std::size_t lamps = 0;
    const Status status =
        for_each(context, {.name = "lamps", .n = kLamps}, [&](std::size_t lamp) -> Status {
          if (!rays.take(kWalls)) return Error{ErrorCode::input, "too many rays", {}, {}};
          for (std::size_t wall = 0; wall < kWalls; ++wall) {
            if (bright.is_set(wall)) continue;  // seen late it is work in vain, no more
            const std::uint32_t more = light(lamp, wall);
            if (more == 0) continue;
            const auto held = locks.hold(wall);
            scattered[wall] = std::min(kBright, scattered[wall] + more);
            if (scattered[wall] == kBright) bright.set(wall);
          }
          const OptionalLock lock(count_mutex, context);
          ++lamps;
          return {};
        });
    if (!status || scattered != expected || lamps != kLamps) return 1;

    // The first lamp of each wall: lamps offer in any order.
    Lowest first(kWalls);
    const Status offered =
        for_each(context, {.name = "first lamps", .n = kLamps}, [&](std::size_t lamp) {
          for (std::size_t wall = 0; wall < kWalls; ++wall)
            if (light(lamp, wall) > 0) first.offer(wall, lamp);
        });
    if (!offered) return 1;
    for (std::size_t wall = 0; wall < kWalls; ++wall)
      if (first[wall] != first_lamp[wall]) return 1;

    // Gather: each wall asks the lamps. Nothing is shared, and it stops when it knows enough.
    const auto gathered = transform(context, {.name = "walls", .n = kWalls}, [&](std::size_t wall) {
      std::uint32_t sum = 0;
      for (std::size_t lamp = 0; lamp < kLamps && sum < kBright; ++lamp)
        sum = std::min(kBright, sum + light(lamp, wall));
      return sum;
    });
    if (!gathered || *gathered != expected) return 1;
  }
  const auto bright = std::ranges::count(expected, kBright);
  std::printf("%zu walls, %td of them bright, by scattering and by gathering\n", kWalls, bright);
  return 0;
}
