// SPDX-License-Identifier: Apache-2.0
#include "cli/progress_line.hpp"

#include <fmt/core.h>

#include <chrono>
#include <cstddef>
#include <exception>
#include <new>
#include <utility>

namespace strake::cli {

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
  } catch (const std::exception&) {  // the host gives no thread for it: the run goes on untold
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
    tell();
  } catch (const std::bad_alloc&) {  // whoever does the work says so, if it has none either
  }
}

void ProgressLine::tell() {
  const auto start = std::chrono::steady_clock::now();
  double next_plain_s = kPlainLineEveryS;
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, console_.is_terminal() ? kTerminalTick : kPlainTick,
                         [this] { return done_; })) {
    const double elapsed =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (elapsed < kSilentS) continue;
    parallel::Progress::Snapshot now = progress_.snapshot();
    if (now.phase.empty()) now.phase = step_();
    if (console_.is_terminal()) {
      console_.show_status(progress_text(now, elapsed));
    } else if (elapsed >= next_plain_s) {
      next_plain_s = elapsed + kPlainLineEveryS;
      console_.say(progress_text(now, elapsed));
    }
  }
}

}  // namespace strake::cli
