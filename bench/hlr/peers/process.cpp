// SPDX-License-Identifier: Apache-2.0
#include "hlr/peers/process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

#include "clocks.hpp"

namespace strake::bench {
namespace {

/// The process, as the leader of a group of its own; -1 where it cannot be started.
pid_t start(const std::vector<std::string>& words, const std::filesystem::path& log) {
  std::vector<char*> arguments;
  for (const std::string& w : words) arguments.push_back(const_cast<char*>(w.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                   0644);
  posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t process = -1;
  const int fault =
      posix_spawnp(&process, arguments[0], &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return fault == 0 ? process : -1;
}

}  // namespace

Ended run_to_end(const std::vector<std::string>& words, double limit_s,
                 const std::filesystem::path& log) {
  const pid_t process = start(words, log);
  if (process < 0) return {Ended::How::not_found, 0, {}};
  Ended ended;
  Lap lap;
  double waited_s = 0;
  int status = 0;
  while (waitpid(process, &status, WNOHANG) == 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    waited_s += lap();
    if (waited_s < limit_s) continue;
    kill(-process, SIGKILL);
    waitpid(process, &status, 0);
    ended.how = Ended::How::over_limit;
    break;
  }
  if (ended.how != Ended::How::over_limit && !WIFEXITED(status)) ended.how = Ended::How::killed;
  if (WIFEXITED(status)) ended.code = WEXITSTATUS(status);
  std::ifstream in(log);
  ended.output.assign(std::istreambuf_iterator<char>(in), {});
  return ended;
}

}  // namespace strake::bench
