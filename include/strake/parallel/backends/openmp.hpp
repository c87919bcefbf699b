// SPDX-License-Identifier: Apache-2.0
// For programs that are built with OpenMP: the library itself is not.
#pragma once

#ifndef _OPENMP
#error "build what includes this with OpenMP (-fopenmp): without it there is one thread only"
#endif

#include "strake/parallel/host_executor.hpp"

namespace strake::parallel {

/// Workers of OpenMP's own pool, as many as a region has seats:
///
///     HostExecutor workers(8, by_openmp());
[[nodiscard]] inline HostExecutor::Call by_openmp() {
  return [](unsigned count, const HostExecutor::Body& body) {
    const int seats = static_cast<int>(count);
#pragma omp parallel for num_threads(seats) schedule(static, 1)
    for (int i = 0; i < seats; ++i) body(static_cast<unsigned>(i));
  };
}

}  // namespace strake::parallel
