// SPDX-License-Identifier: Apache-2.0
// Errors and cancellation: which error is reported, and how a run ends early.
#include <cstddef>
#include <cstdio>
#include <stop_token>
#include <string>

#include "strake/parallel/for_each.hpp"
#include "strake/parallel/team.hpp"

int main() {
  using namespace strake;
  using namespace strake::parallel;
  Team team(4);

  // Items 300, 600 and 900 fail. Whoever meets his first, the lowest is the one reported.
  const auto item = [](std::size_t i) -> Status {
    if (i % 300 == 0 && i > 0)
      return Error{ErrorCode::input, "face " + std::to_string(i) + " is degenerate", "hull", ""};
    return {};
  };
  for (int round = 0; round < 100; ++round) {
    const Status status = for_each({.team = &team}, {.name = "faces", .n = 1000}, item);
    if (status || status.error().message != "face 300 is degenerate") return 1;
  }

  // A stop token ends a run between two items.
  std::stop_source source;
  const Status stopped =
      for_each({.team = &team, .stop = source.get_token()},
               {.name = "endless", .n = std::size_t{1} << 50U}, [&](std::size_t i) {
                 if (i == 1000) source.request_stop();
               });
  if (stopped || stopped.error().code != ErrorCode::cancelled) return 1;
  std::puts("the lowest failing item, and an early end");
  return 0;
}
