// SPDX-License-Identifier: Apache-2.0
#include "cli/run/child_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

namespace strake::cli {

namespace {

/// How a child is started: its files, its group and its signals.
class SpawnOptions {
 public:
  SpawnOptions(const std::filesystem::path& log, KilledWith killed_with) {
    ::posix_spawn_file_actions_init(&files_);
    ::posix_spawn_file_actions_addopen(&files_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    constexpr mode_t kMode = 0644;
    ::posix_spawn_file_actions_addopen(&files_, STDOUT_FILENO, log.c_str(),
                                       O_WRONLY | O_CREAT | O_TRUNC, kMode);
    ::posix_spawn_file_actions_adddup2(&files_, STDOUT_FILENO, STDERR_FILENO);
    ::posix_spawnattr_init(&attributes_);
    sigset_t none, ignored_by_us;
    sigemptyset(&none);
    sigemptyset(&ignored_by_us);
    for (const int signal : {SIGPIPE, SIGXFSZ}) sigaddset(&ignored_by_us, signal);
    ::posix_spawnattr_setsigmask(&attributes_, &none);
    ::posix_spawnattr_setsigdefault(&attributes_, &ignored_by_us);
    int flags = POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF;
    if (killed_with == KilledWith::its_group) flags |= POSIX_SPAWN_SETPGROUP;
    ::posix_spawnattr_setflags(&attributes_, static_cast<short>(flags));
  }
  ~SpawnOptions() {
    ::posix_spawnattr_destroy(&attributes_);
    ::posix_spawn_file_actions_destroy(&files_);
  }
  SpawnOptions(const SpawnOptions&) = delete;
  SpawnOptions& operator=(const SpawnOptions&) = delete;
  SpawnOptions(SpawnOptions&&) = delete;
  SpawnOptions& operator=(SpawnOptions&&) = delete;

  /// Starts the program; -1 where that cannot be done.
  [[nodiscard]] pid_t start(const std::vector<std::string>& words) const {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    pid_t process = -1;
    const int fault =
        ::posix_spawnp(&process, arguments[0], &files_, &attributes_, arguments.data(), environ);
    return fault == 0 ? process : -1;
  }

 private:
  posix_spawn_file_actions_t files_{};
  posix_spawnattr_t attributes_{};
};

/// Kills what belongs to the child, if it has not ended, and returns how it ended.
int end_child(pid_t process, KilledWith killed_with) {
  int status = 0;
  ::kill(killed_with == KilledWith::its_group ? -process : process, SIGKILL);
  ::waitpid(process, &status, 0);
  return status;
}

/// Whether the child has ended. It stays known to the system until end_child(), so that what it
/// left running can still be found by its group.
bool has_ended(pid_t process) {
  siginfo_t info{};
  const int fault = ::waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOHANG | WNOWAIT);
  return fault != 0 || info.si_pid == process;
}

/// Returns the end of a file: a program that repeats one warning may fill a disk.
std::string end_of(const std::filesystem::path& file) {
  constexpr std::streamoff kMostBytes = 1 << 20;
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = in.tellg();
  in.seekg(std::max<std::streamoff>(0, size - kMostBytes));
  return {std::istreambuf_iterator<char>(in), {}};
}

ChildEnd wait_for(pid_t process, const ChildProgram& program, const std::stop_token& stop) {
  // Shorter than the time in which a program that was told to stop must have ended (Interrupts).
  constexpr auto kLook = std::chrono::milliseconds(5);
  const auto end =
      std::chrono::steady_clock::now() + std::chrono::duration<double>(program.limit_s);
  while (!has_ended(process)) {
    const bool stopped = stop.stop_requested();
    if (stopped || std::chrono::steady_clock::now() >= end) {
      end_child(process, program.killed_with);
      return {stopped ? ChildEnd::How::stopped : ChildEnd::How::over_limit, 0, {}};
    }
    std::this_thread::sleep_for(kLook);
  }
  const int status = end_child(process, program.killed_with);
  if (WIFEXITED(status)) return {ChildEnd::How::exited, WEXITSTATUS(status), {}};
  return {ChildEnd::How::killed, WTERMSIG(status), {}};
}

}  // namespace

ChildEnd run_child(const ChildProgram& program, const std::stop_token& stop) {
  const pid_t process = SpawnOptions(program.log, program.killed_with).start(program.words);
  if (process < 0) return {ChildEnd::How::not_started, 0, {}};
  ChildEnd end = wait_for(process, program, stop);
  end.output = end_of(program.log);
  return end;
}

std::string tail_of(const std::string& output, std::size_t bytes) {
  const std::size_t last = output.find_last_not_of(" \n\r\t");
  if (last == std::string::npos) return {};
  const std::string text = output.substr(0, last + 1);
  if (text.size() <= bytes) return text;
  const std::string tail = text.substr(text.size() - bytes);
  const std::size_t line = tail.find('\n');
  return line == std::string::npos ? tail : tail.substr(line + 1);
}

}  // namespace strake::cli
