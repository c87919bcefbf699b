// SPDX-License-Identifier: Apache-2.0
// What each page of docs/patterns gains: the loop as it was before and as it is after, taking turns
// on the same team, medians compared, results checked.
//
//     bench_patterns [ROUNDS]
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>

#include "parallel/pages.hpp"
#include "strake/parallel/team.hpp"

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 15;
  fmt::print("{} workers, medians of {} rounds\n", strake::parallel::default_workers(), rounds);
  const bool loops = strake::bench::loop_pages(rounds);
  const bool sharing = strake::bench::sharing_pages(rounds);
  return loops && sharing ? 0 : 1;
}
