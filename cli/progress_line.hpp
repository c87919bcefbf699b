// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "cli/console.hpp"
#include "strake/parallel/progress.hpp"

namespace strake::cli {

/// "clash narrow phase [#####.....]  48 %  12 s" for a phase; without a total only the time.
[[nodiscard]] std::string progress_text(const parallel::Progress::Snapshot& now, double elapsed_s);

/// Shows how far the run is, once it has taken more than a second: a line that is drawn over on a
/// terminal, a plain line every ten seconds elsewhere. Looks from a thread of its own.
class ProgressLine {
 public:
  /// `step` names what is done while no region runs.
  ProgressLine(Console& console, const parallel::Progress& progress,
               std::function<std::string()> step);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ProgressLine(ProgressLine&&) = delete;
  ProgressLine& operator=(ProgressLine&&) = delete;

 private:
  void watch();
  void tell();

  Console& console_;
  const parallel::Progress& progress_;
  std::function<std::string()> step_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false;
  std::thread thread_;
};

}  // namespace strake::cli
