// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "strake/parallel/executor.hpp"

namespace strake::parallel {

/// Runs regions on threads of the program that uses the library: a CAD system's own pool, an arena
/// of oneTBB (backends/tbb.hpp), OpenMP (backends/openmp.hpp). The results are those of a Team.
///
///     HostExecutor workers(8, [&](unsigned count, const HostExecutor::Body& body) {
///       pool.parallel_for(0, count, body);
///     });
///     const Context context{.team = &workers};
///
/// The host need not be trusted: seats that its function has not called by the time it returns, or
/// throws, are served by the calling thread; a seat is served once, however often it is called. A
/// host whose threads may call after that must have given them copies of `body`.
class HostExecutor final : public Executor {
 public:
  using Body = std::function<void(unsigned)>;
  /// Calls body(i) once for each i < count, concurrently if it can, and returns when all have
  /// returned.
  using Call = std::function<void(unsigned count, const Body& body)>;

  HostExecutor(unsigned workers, Call call);

 private:
  struct Run;
  void call_all(FunctionRef<void(Seat)> body) noexcept override;

  Call call_;
};

}  // namespace strake::parallel
