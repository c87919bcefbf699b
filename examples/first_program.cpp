// SPDX-License-Identifier: Apache-2.0
// The whole of a program: a team, a region, its results, and what to do when there are none.
#include <cstddef>
#include <cstdio>

#include "strake/parallel/team.hpp"
#include "strake/parallel/transform.hpp"

int main() {
  using namespace strake;  // Result, Status, Error
  using namespace strake::parallel;
  Team team(default_workers());
  const Context context{.team = &team};
  const auto squares = transform(context, {.name = "squares", .n = 1'000'000, .grain = 4096},
                                 [](std::size_t i) { return i * i; });
  if (!squares) {
    std::fprintf(stderr, "%s\n", squares.error().text().c_str());
    return 1;
  }
  std::printf("%zu\n", squares->back());

  // The same code without a team: on this thread, with the same result.
  const auto alone = transform(Context{}, {.name = "squares", .n = 1'000'000, .grain = 4096},
                               [](std::size_t i) { return i * i; });
  return alone && *alone == *squares ? 0 : 1;
}
