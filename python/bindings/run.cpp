// SPDX-License-Identifier: Apache-2.0
#include "python/bindings/run.hpp"

#include <nanobind/stl/string.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <stop_token>

#include "strake/parallel/progress.hpp"
#include "strake/parallel/team.hpp"

namespace nb = nanobind;

namespace strake::python {

namespace {

constexpr std::chrono::milliseconds kBetweenPolls{50};

void call_progress(const nb::object& progress, const parallel::Progress& of, const char* what) {
  if (progress.is_none()) return;
  const parallel::Progress::Snapshot now = of.snapshot();
  const double fraction =
      now.total == 0
          ? 0.0
          : std::min(1.0, static_cast<double>(now.done) / static_cast<double>(now.total));
  if (now.phase.empty())
    progress(fraction, what);
  else
    progress(fraction, now.phase);
}

bool is_over(const std::future<void>& job) {
  const nb::gil_scoped_release others_may_run;
  return job.wait_for(kBetweenPolls) == std::future_status::ready;
}

}  // namespace

void run_watched(const RunOptions& options, const char* what,
                 const std::function<void(const parallel::Context&)>& job) {
  if (!options.progress.is_none()) options.progress(0.0, what);
  std::stop_source stop;
  parallel::Progress progress;
  std::future<void> running = std::async(std::launch::async, [&] {
    parallel::Team team(options.threads.value_or(parallel::default_workers()));
    job({.team = &team, .stop = stop.get_token(), .progress = &progress});
  });
  std::optional<nb::python_error> raised;
  while (!is_over(running)) {
    if (raised) continue;
    try {
      if (PyErr_CheckSignals() != 0) throw nb::python_error();
      call_progress(options.progress, progress, what);
    } catch (const nb::python_error& error) {
      raised.emplace(error);
      stop.request_stop();
    }
  }
  if (raised) throw nb::python_error(std::move(*raised));
  running.get();
  if (!options.progress.is_none()) options.progress(1.0, what);
}

}  // namespace strake::python
