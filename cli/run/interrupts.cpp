// SPDX-License-Identifier: Apache-2.0
#include "cli/run/interrupts.hpp"

#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <exception>

#include "cli/run/exit_code.hpp"
#include "strake/core/atomic_file.hpp"

namespace strake::cli {

namespace {

/// Whether a closed terminal is to end the program: nohup says that it is not.
bool heeds_hang_up() {
  struct sigaction now{};
  return ::sigaction(SIGHUP, nullptr, &now) == 0 && now.sa_handler != SIG_IGN;
}

}  // namespace

Interrupts::Interrupts(Console& console) : console_(console) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  if (heeds_hang_up()) sigaddset(&set, SIGHUP);
  if (::pthread_sigmask(SIG_BLOCK, &set, nullptr) != 0) return;
  signals_ = ::signalfd(-1, &set, SFD_CLOEXEC);
  closing_ = ::eventfd(0, EFD_CLOEXEC);
  if (signals_ >= 0 && closing_ >= 0 && start()) return;
  // Then Ctrl-C ends the program as it does by default.
  ::pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

bool Interrupts::start() {
  try {
    thread_ = std::thread([this] { wait(); });
  } catch (const std::exception&) {  // the host gives no more threads, or no memory for one
  }
  return thread_.joinable();
}

Interrupts::~Interrupts() {
  const std::uint64_t one = 1;
  if (thread_.joinable()) {
    if (::write(closing_, &one, sizeof one) == sizeof one) {
      thread_.join();
    } else {
      thread_.detach();
    }
  }
  if (signals_ >= 0) ::close(signals_);
  if (closing_ >= 0) ::close(closing_);
}

void Interrupts::guard(const std::filesystem::path& target) {
  const std::lock_guard lock(mutex_);
  targets_.push_back(target);
}

void Interrupts::wait() {
  std::array<pollfd, 2> files{{{.fd = closing_, .events = POLLIN, .revents = 0},
                               {.fd = signals_, .events = POLLIN, .revents = 0}}};
  while (::poll(files.data(), 2, -1) < 0 && errno == EINTR) {
  }
  if (files[0].revents != 0) return;
  source_.request_stop();
  int ready = 0;
  while ((ready = ::poll(files.data(), 1, grace_ms_)) < 0 && errno == EINTR) {
  }
  if (ready == 0) end_now();
}

void Interrupts::end_now() {
  try {
    console_.show_status("");
    console_.error("cancelled");
  } catch (const std::exception&) {  // no memory to say so: the files matter more
  }
  const std::lock_guard lock(mutex_);
  for (const std::filesystem::path& target : targets_) remove_partial_files(target);
  ::_exit(static_cast<int>(ExitCode::cancelled));
}

}  // namespace strake::cli
