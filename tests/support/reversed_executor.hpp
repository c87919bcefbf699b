// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/parallel/host_executor.hpp"

namespace strake::test {

/// Two workers one after the other: the second has its turn first, then the first what is left.
inline parallel::HostExecutor second_first() {
  return {2, [](unsigned, const parallel::HostExecutor::Body& seat) {
            seat(1);
            seat(0);
          }};
}

}  // namespace strake::test
