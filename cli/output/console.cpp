// SPDX-License-Identifier: Apache-2.0
#include "cli/output/console.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstddef>
#include <exception>
#include <new>
#include <system_error>
#include <utility>

#include "cli/output/shown_text.hpp"
#include "core/stopwatch.hpp"

namespace strake::cli {

namespace {

bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

constexpr std::string_view kEraseLine = "\r\x1b[K";

}  // namespace

Console::Console() : terminal_(::isatty(STDERR_FILENO) == 1) {}

void Console::set_quiet(bool quiet) {
  const std::lock_guard lock(mutex_);
  quiet_ = quiet;
}

void Console::put(std::string_view line) {
  std::string text;
  if (!status_.empty()) text += kEraseLine;
  text += line;
  text += '\n';
  text += status_;
  (void)write_all(STDERR_FILENO, text);  // there is nowhere to report that errors cannot be shown
}

void Console::note(std::string_view line) {
  const std::lock_guard lock(mutex_);
  if (!quiet_) put(shown_line(line));
}

void Console::print(std::string_view line) {
  const std::lock_guard lock(mutex_);
  put(line);
}

void Console::warn(std::string_view line) {
  const std::lock_guard lock(mutex_);
  put("strake: " + shown_line(line));
}

void Console::error(std::string_view line) {
  const std::lock_guard lock(mutex_);
  put("strake: error: " + shown_line(line));
}

void Console::show_status(std::string_view line) {
  const std::lock_guard lock(mutex_);
  if (!terminal_ || quiet_) return;
  std::string shown = shown_line(line);
  if (shown == status_) return;
  std::string text(kEraseLine);
  text += shown;
  status_ = std::move(shown);
  (void)write_all(STDERR_FILENO, text);
}

void print_out_of_memory() noexcept {
  if (::isatty(STDERR_FILENO) == 1) (void)write_all(STDERR_FILENO, kEraseLine);
  (void)write_all(STDERR_FILENO,
                  "strake: error: out of memory (use a machine with more memory, or a part of the "
                  "model)\n");
}

Status write_stdout(std::string_view text) {
  if (write_all(STDOUT_FILENO, text)) return {};
  return Error{ErrorCode::output, "cannot be written: " + std::generic_category().message(errno),
               "standard output",
               "is the disk full that it goes to, or the program gone that reads it?"};
}

namespace {

constexpr double kSilentS = 1, kPlainLineEveryS = 10;
constexpr std::chrono::milliseconds kTerminalTick{100}, kPlainTick{1000};
constexpr std::size_t kBarWidth = 24;

}  // namespace

std::string progress_text(const parallel::Progress::Snapshot& now, double elapsed_s) {
  if (now.total == 0) return fmt::format("{}  {:.0f} s", now.phase, elapsed_s);
  const double share = static_cast<double>(now.done) / static_cast<double>(now.total);
  const auto filled = static_cast<std::size_t>(share * static_cast<double>(kBarWidth));
  return fmt::format("{} [{}{}] {:3.0f} %  {:.0f} s", now.phase, std::string(filled, '#'),
                     std::string(kBarWidth - filled, '.'), share * 100, elapsed_s);
}

ProgressLine::ProgressLine(Console& console, const parallel::Progress& progress,
                           std::function<std::string()> step)
    : console_(console), progress_(progress), step_(std::move(step)) {
  try {
    thread_ = std::thread([this] { watch(); });
  } catch (const std::exception&) {  // the host gives no thread: the run goes on without progress
  }
}

ProgressLine::~ProgressLine() {
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
  console_.show_status("");
}

void ProgressLine::watch() {
  try {
    show();
  } catch (const std::bad_alloc&) {  // whoever does the work says so, if it has none either
  }
}

void ProgressLine::show() {
  const Stopwatch watch;
  double next_plain_s = kPlainLineEveryS;
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, console_.is_terminal() ? kTerminalTick : kPlainTick,
                         [this] { return done_; })) {
    const double elapsed = watch.seconds();
    if (elapsed < kSilentS) continue;
    parallel::Progress::Snapshot now = progress_.snapshot();
    if (now.phase.empty()) now.phase = step_();
    if (console_.is_terminal()) {
      console_.show_status(progress_text(now, elapsed));
    } else if (elapsed >= next_plain_s) {
      next_plain_s = elapsed + kPlainLineEveryS;
      console_.note(progress_text(now, elapsed));
    }
  }
}

}  // namespace strake::cli
