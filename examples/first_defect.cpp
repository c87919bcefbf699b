// SPDX-License-Identifier: Apache-2.0
// The first edge of a mesh that has not two triangles: found by a team, and the same one as by a
// single worker.
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <vector>

#include "strake/parallel/find.hpp"
#include "strake/parallel/team.hpp"

namespace {

/// How many triangles meet at each edge of a long mesh with a few defects.
std::vector<int> make_edges() {
  std::vector<int> triangles(1'000'000, 2);
  triangles[700'003] = 1;
  triangles[640'517] = 3;
  triangles[999'999] = 1;
  return triangles;
}

}  // namespace

int main() {
  const std::vector<int> triangles = make_edges();

  // Before.
  std::size_t expected = 0;
  while (expected < triangles.size() && triangles[expected] == 2) ++expected;

  // After.
  using namespace strake::parallel;
  for (const unsigned workers : {1U, 2U, 3U, 8U, 64U}) {
    Team team(workers);
    const Context context{.team = &team};
    const Region region{.name = "open edges", .n = triangles.size(), .grain = 4096};
    const auto found =
        find_first(context, region, [&](std::size_t e) { return triangles[e] != 2; });
    if (!found || *found != std::optional(expected)) return 1;

    // What is wrong with it, from the counts of the blocks up to the first bad one: the same sum of
    // work for any team.
    const auto blocks = transform_until(
        context, {.name = "blocks", .n = region.blocks()},
        [&](std::size_t b) {
          int good = 0;
          for (std::size_t e = b * 4096; e < std::min(triangles.size(), (b + 1) * 4096); ++e)
            good += triangles[e] == 2 ? 1 : 0;
          return good;
        },
        [](int good) { return good < 4096; });
    if (!blocks || blocks->size() != expected / 4096 + 1) return 1;

    const auto closed = all_of(context, region, [&](std::size_t e) { return triangles[e] == 2; });
    if (!closed || *closed) return 1;
  }
  std::printf("edge %zu has %d triangles\n", expected, triangles[expected]);
  return 0;
}
