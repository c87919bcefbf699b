// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

#include "cli/output/console.hpp"

namespace strake::cli {

/// Turns Ctrl-C (SIGINT) and SIGTERM into a stop request, and makes sure that the program ends.
///
/// Make it before any other thread: it blocks both signals, which later threads inherit, and one
/// thread of its own waits for them. The first signal requests the stop; work that has not ended
/// kGraceMs later (a long step that does not look at its token) is not waited for: the partial
/// files of the guarded targets are removed and the process ends. So a cancelled run ends within
/// 100 ms and leaves no half-written file, whatever it was doing.
class Interrupts {
 public:
  static constexpr int kGraceMs = 25;
  /// Of a verb that a signal ends well: its project is closed, which may write to a slow disk.
  static constexpr int kLongGraceMs = 5000;

  explicit Interrupts(Console& console);
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;
  Interrupts(Interrupts&&) = delete;
  Interrupts& operator=(Interrupts&&) = delete;

  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }
  /// From now on a signal is how the verb ends, and what it does then is waited for.
  void expect() { grace_ms_ = kLongGraceMs; }
  /// Names a file that the run will write.
  void guard(const std::filesystem::path& target);

 private:
  [[nodiscard]] bool start();
  void wait();
  [[noreturn]] void end_now();

  Console& console_;
  std::stop_source source_;
  std::mutex mutex_;
  std::vector<std::filesystem::path> targets_;
  std::atomic<int> grace_ms_{kGraceMs};
  int signals_ = -1;  ///< signalfd
  int closing_ = -1;  ///< eventfd, readable once the program is done
  std::thread thread_;
};

}  // namespace strake::cli
