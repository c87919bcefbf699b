// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nanobind/nanobind.h>

#include <functional>
#include <optional>
#include <utility>

#include "python/bindings/errors.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

/// Long calls of the library, made from Python.
namespace strake::python {

/// How a caller wants a call to run.
struct RunOptions {
  std::optional<unsigned> threads;  ///< absent: as many as the process can run at a time
  nanobind::object progress;        ///< None, or called with a fraction and the name of the step
};

/// Runs the job on a thread of its own, with a team, while the calling thread waits without the
/// GIL. Twenty times a second it takes the GIL, looks for signals and tells the progress: whatever
/// is raised there, KeyboardInterrupt above all, stops the job and is raised again when it has
/// ended.
void run_watched(const RunOptions& options, const char* what,
                 const std::function<void(const parallel::Context&)>& job);

/// Runs a job that returns a Result, and returns its value or raises its error.
template <class Job>
[[nodiscard]] auto run(const RunOptions& options, const char* what, Job&& job) {
  using Outcome = std::invoke_result_t<Job&, const parallel::Context&>;
  std::optional<Outcome> outcome;
  run_watched(options, what,
              [&](const parallel::Context& context) { outcome.emplace(job(context)); });
  if (!*outcome) raise(outcome->error());
  return std::move(**outcome);
}

/// The same for a job that returns a Status.
template <class Job>
void run_status(const RunOptions& options, const char* what, Job&& job) {
  Status status;
  run_watched(options, what, [&](const parallel::Context& context) { status = job(context); });
  check(status);
}

}  // namespace strake::python
