// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "strake/core/result.hpp"
#include "strake/parallel/progress.hpp"

/// The output on a terminal: messages, standard output and the progress line.
namespace strake::cli {

/// Standard error, shared by narration, errors and the progress line; thread-safe. What is printed
/// is shown as shown_line() returns it.
class Console {
 public:
  Console();

  void set_quiet(bool quiet);
  /// Whether standard error is a terminal, where a line may be drawn over.
  [[nodiscard]] bool is_terminal() const { return terminal_; }

  /// Whether narration is printed: what it takes work to say need not be found out otherwise.
  [[nodiscard]] bool narrates() const { return !quiet_; }
  /// Prints a line of narration; silent under --quiet.
  void note(std::string_view line);
  /// Prints "strake: ...", for what makes the exit code one of failure and standard output does not
  /// show, and for what makes the whole result doubtful; never silent.
  void warn(std::string_view line);
  /// Prints "strake: error: ..."; never silent.
  void error(std::string_view line);
  /// Prints a line that the user requested (--stats); never silent.
  void print(std::string_view line);
  /// Draws the progress line over the last one (terminals only); empty removes it.
  void show_status(std::string_view line);

 private:
  void put(std::string_view line);

  std::mutex mutex_;
  bool terminal_ = false, quiet_ = false;
  std::string status_;
};

/// Prints the line about ErrorCode::memory on standard error. It takes neither memory nor a lock,
/// so that it can be called wherever memory runs out.
void print_out_of_memory() noexcept;

/// Writes data to standard output. Errors: output, with the reason (a full disk).
[[nodiscard]] Status write_stdout(std::string_view text);

/// Returns "clash narrow phase [#####.....]  48 %  12 s" for a phase; without a total only the
/// time.
[[nodiscard]] std::string progress_text(const parallel::Progress::Snapshot& now, double elapsed_s);

/// Shows how far the run is, once it has taken more than a second: a line that is drawn over on a
/// terminal, a plain line every ten seconds elsewhere. It watches from a thread of its own.
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
  void show();

  Console& console_;
  const parallel::Progress& progress_;
  std::function<std::string()> step_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false;
  std::thread thread_;
};

}  // namespace strake::cli
