// SPDX-License-Identifier: Apache-2.0
#include "cli/console.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <system_error>

#include "strake/core/text.hpp"

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

void Console::say(std::string_view line) {
  const std::lock_guard lock(mutex_);
  if (!quiet_) put(printable(line));
}

void Console::print(std::string_view line) {
  const std::lock_guard lock(mutex_);
  put(line);
}

void Console::warn(std::string_view line) {
  const std::lock_guard lock(mutex_);
  put("strake: " + printable(line));
}

void Console::error(std::string_view line) {
  const std::lock_guard lock(mutex_);
  put("strake: error: " + printable(line));
}

void Console::show_status(std::string_view line) {
  const std::lock_guard lock(mutex_);
  if (!terminal_ || quiet_ || line == status_) return;
  std::string text(kEraseLine);
  text += line;
  status_ = line;
  (void)write_all(STDERR_FILENO, text);
}

void say_out_of_memory() noexcept {
  if (::isatty(STDERR_FILENO) == 1) (void)write_all(STDERR_FILENO, kEraseLine);
  (void)write_all(STDERR_FILENO,
                  "strake: error: out of memory (use a machine with more memory, or a part of the "
                  "model)\n");
}

Status write_stdout(std::string_view text) {
  if (write_all(STDOUT_FILENO, text)) return {};
  return Error{ErrorCode::output,
               "cannot be written: " + std::generic_category().message(errno),
               "standard output",
               {}};
}

}  // namespace strake::cli
