// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace strake::io {

/// Which processes end with a child that is killed.
enum class KilledWith : std::uint8_t {
  /// All that it started, also when it has ended by itself: it leads a group of its own, which
  /// Ctrl-C does not reach.
  its_group,
  nothing,  ///< it alone: it belongs to our group, and ends with us
};

/// Another program, run without a shell.
struct ChildProgram {
  std::vector<std::string> words;  ///< the first is searched in PATH where it has no slash
  std::optional<double> limit_s;   ///< after which it is killed
  std::filesystem::path log;       ///< takes all that it writes, and stays
  std::filesystem::path folder;    ///< its current folder; empty: ours
  int input = -1;                  ///< an open file of ours that it reads; none where negative
  /// A log that grows longer is begun anew: a program that repeats one warning may fill a disk.
  std::uintmax_t max_log_bytes = std::numeric_limits<std::uintmax_t>::max();
  KilledWith killed_with = KilledWith::its_group;
  /// Asked every few milliseconds where there is one; the child is killed when it says no.
  std::function<bool()> may_go_on;
};

/// How a child ended.
struct ChildEnd {
  enum class How : std::uint8_t {
    exited,
    not_started,  ///< it is not there, or no program
    over_limit,   ///< killed for its time
    refused,      ///< killed because `may_go_on` said no
    stopped,      ///< killed because the run was stopped
    killed,       ///< by a signal that is not ours
    lost,         ///< who was to say how it ended is gone, and it too
  } how = How::exited;
  int code = 0;        ///< exit status, or the signal of `killed`
  std::string output;  ///< the last of what the log holds, a megabyte at most
};

/// A program that has begun. What is left of it ends with the value.
class RunningChild {
 public:
  RunningChild() = default;
  virtual ~RunningChild() = default;
  RunningChild(const RunningChild&) = delete;
  RunningChild& operator=(const RunningChild&) = delete;
  RunningChild(RunningChild&&) = delete;
  RunningChild& operator=(RunningChild&&) = delete;

  [[nodiscard]] virtual bool has_ended() const = 0;
  /// Kills it with all that is to end with it. Any thread may call this.
  virtual void kill() const = 0;
  /// Kills it if it has not ended, and what it left running; returns how it ended, without output.
  virtual ChildEnd end() = 0;
};

/// Starts a program; null where it is not there, or no program. It has none of our open files but
/// its input, and no signal is blocked or ignored for it.
[[nodiscard]] std::unique_ptr<RunningChild> start_child(const ChildProgram& program);

/// Watches a program to its end, to its limit or until `stop` is requested.
[[nodiscard]] ChildEnd watch_child(RunningChild& child, const ChildProgram& program,
                                   const std::stop_token& stop);

/// Waits for the end of a program, so long at most; returns whether it has ended.
[[nodiscard]] bool wait_for_end(const RunningChild& child, double seconds);

/// Starts a program and watches it.
[[nodiscard]] ChildEnd run_child(const ChildProgram& program, const std::stop_token& stop);

/// Returns the end of an output in so many bytes at most, from the beginning of a line where there
/// is one.
[[nodiscard]] std::string tail_of(const std::string& output, std::size_t bytes);

/// Returns "signal 11 (segmentation fault)".
[[nodiscard]] std::string signal_text(int signal);

}  // namespace strake::io
