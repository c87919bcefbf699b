// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>

#include "same_bytes.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/team.hpp"

namespace convert {

/// Whether run(context), which returns a Result, gives the bytes of `expected` for no team and for
/// teams of 1, 2, 3, 8 and 64 workers. Says where it does not.
template <class T, class Run>
bool same_everywhere(const T& expected, Run&& run) {
  for (const unsigned workers : {0U, 1U, 2U, 3U, 8U, 64U}) {
    strake::parallel::Team team(workers);
    const auto result = run(strake::parallel::Context{.team = workers == 0 ? nullptr : &team});
    if (result && same_bytes(*result, expected)) continue;
    std::printf("%u workers give something else\n", workers);
    return false;
  }
  return true;
}

}  // namespace convert
