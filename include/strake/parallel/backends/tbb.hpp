// SPDX-License-Identifier: Apache-2.0
// For programs that link oneTBB: the library itself does not.
#pragma once

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include "strake/parallel/host_executor.hpp"

namespace strake::parallel {

/// Workers of an arena, which must outlive the executor:
///
///     oneapi::tbb::task_arena arena(8);
///     HostExecutor workers(8, in_arena(arena));
///
/// Isolated: a worker that waits for the others does not start on tasks of the program meanwhile,
/// which would enter its locks and contexts a second time.
[[nodiscard]] inline HostExecutor::Call in_arena(oneapi::tbb::task_arena& arena) {
  return [&arena](unsigned count, const HostExecutor::Body& body) {
    arena.execute([&] {
      oneapi::tbb::this_task_arena::isolate([&] {
        oneapi::tbb::parallel_for(
            oneapi::tbb::blocked_range<unsigned>(0, count, 1),
            [&](const oneapi::tbb::blocked_range<unsigned>& seats) {
              for (unsigned i = seats.begin(); i != seats.end(); ++i) body(i);
            },
            oneapi::tbb::simple_partitioner());
      });
    });
  };
}

}  // namespace strake::parallel
