// SPDX-License-Identifier: Apache-2.0
#include "io/importer/child_process.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <memory>
#include <system_error>
#include <thread>

namespace strake::io {

namespace {

/// What newer C libraries have: a program that is linked for an older one looks for it when it
/// runs. None: not there.
struct SpawnExtensions {
  int (*addchdir)(posix_spawn_file_actions_t*, const char*);  ///< glibc 2.29
  int (*addclosefrom)(posix_spawn_file_actions_t*, int);      ///< glibc 2.34

  static SpawnExtensions found() {
    return {std::bit_cast<decltype(addchdir)>(
                ::dlsym(RTLD_DEFAULT, "posix_spawn_file_actions_addchdir_np")),
            std::bit_cast<decltype(addclosefrom)>(
                ::dlsym(RTLD_DEFAULT, "posix_spawn_file_actions_addclosefrom_np"))};
  }
};

/// Whether a shell gives the child its folder, as the C library cannot.
bool needs_shell(const ChildProgram& program) {
  return !program.folder.empty() && SpawnExtensions::found().addchdir == nullptr;
}

/// Returns the words that start a program. A shell reads none of them, and takes its own `cd` where
/// the environment has a function of that name.
std::vector<std::string> words_of(const ChildProgram& program) {
  if (!needs_shell(program)) return program.words;
  std::vector<std::string> words{"/bin/sh", "-c",
                                 "unset -f cd command 2>/dev/null; cd -P -- \"$0\" && exec \"$@\"",
                                 program.folder.string()};
  words.insert(words.end(), program.words.begin(), program.words.end());
  return words;
}

/// How a child is started: its files, its group and its signals.
class SpawnOptions {
 public:
  explicit SpawnOptions(const ChildProgram& program) {
    ::posix_spawn_file_actions_init(&files_);
    if (program.input < 0)
      ::posix_spawn_file_actions_addopen(&files_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    else
      ::posix_spawn_file_actions_adddup2(&files_, program.input, STDIN_FILENO);
    constexpr mode_t kMode = 0644;
    ::posix_spawn_file_actions_addopen(&files_, STDOUT_FILENO, program.log.c_str(),
                                       O_WRONLY | O_CREAT | O_TRUNC | O_APPEND, kMode);
    ::posix_spawn_file_actions_adddup2(&files_, STDOUT_FILENO, STDERR_FILENO);
    // Behind the log, whose path may depend on our folder.
    const SpawnExtensions more = SpawnExtensions::found();
    if (!program.folder.empty() && more.addchdir != nullptr)
      more.addchdir(&files_, program.folder.c_str());
    // Files that other threads have opened by streams, which do not close themselves.
    if (more.addclosefrom != nullptr) more.addclosefrom(&files_, STDERR_FILENO + 1);
    ::posix_spawnattr_init(&attributes_);
    sigset_t none, ignored_by_us;
    sigemptyset(&none);
    sigemptyset(&ignored_by_us);
    for (const int signal : {SIGPIPE, SIGXFSZ}) sigaddset(&ignored_by_us, signal);
    ::posix_spawnattr_setsigmask(&attributes_, &none);
    ::posix_spawnattr_setsigdefault(&attributes_, &ignored_by_us);
    int flags = POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF;
    if (program.killed_with == KilledWith::its_group) flags |= POSIX_SPAWN_SETPGROUP;
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

/// A child of this process. None outlives the value, whatever is thrown meanwhile.
class OwnChild final : public RunningChild {
 public:
  OwnChild(pid_t process, KilledWith killed_with) : process_(process), killed_with_(killed_with) {}
  ~OwnChild() override {
    if (process_ > 0) wait_for_status();
  }
  OwnChild(const OwnChild&) = delete;
  OwnChild& operator=(const OwnChild&) = delete;
  OwnChild(OwnChild&&) = delete;
  OwnChild& operator=(OwnChild&&) = delete;

  /// It stays known to the system until end(), so that what it left running can still be found by
  /// its group.
  [[nodiscard]] bool has_ended() const override {
    siginfo_t info{};
    const int fault =
        ::waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT);
    return fault != 0 || info.si_pid == process_;
  }
  void kill() const override {
    ::kill(killed_with_ == KilledWith::its_group ? -process_ : process_, SIGKILL);
  }
  ChildEnd end() override {
    const int status = wait_for_status();
    if (WIFEXITED(status)) return {ChildEnd::How::exited, WEXITSTATUS(status), {}};
    return {ChildEnd::How::killed, WTERMSIG(status), {}};
  }

 private:
  int wait_for_status() {
    int status = 0;
    kill();
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    return status;
  }

  pid_t process_;
  KilledWith killed_with_;
};

constexpr std::size_t kMaxOutput = std::size_t{1} << 20U;

/// Returns the end of a file.
std::string end_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = in.tellg();
  in.seekg(std::max<std::streamoff>(0, size - static_cast<std::streamoff>(kMaxOutput)));
  return {std::istreambuf_iterator<char>(in), {}};
}

/// What a child writes. It appends, so that a log that is cut to nothing goes on from there.
class Log {
 public:
  explicit Log(const ChildProgram& program)
      : file_(program.log), max_bytes_(program.max_log_bytes) {}

  void keep_short() {
    std::error_code failed;
    const std::uintmax_t size = std::filesystem::file_size(file_, failed);
    if (failed || size <= max_bytes_) return;
    before_ = end_of(file_);
    std::filesystem::resize_file(file_, 0, failed);
  }
  [[nodiscard]] std::string end() const {
    const std::string text = before_ + end_of(file_);
    return text.substr(text.size() - std::min(text.size(), kMaxOutput));
  }

 private:
  std::filesystem::path file_;
  std::uintmax_t max_bytes_;
  std::string before_;
};

/// Waits until a child has ended or has to end before; returns why, if it has to.
std::optional<ChildEnd::How> wait_for(const RunningChild& child, const ChildProgram& program,
                                      Log& log, const std::stop_token& stop) {
  constexpr auto kPollInterval = std::chrono::milliseconds(5);
  // A program that was told to stop may end before this thread looks again.
  const std::stop_callback at_once(stop, [&] { child.kill(); });
  const auto begin = std::chrono::steady_clock::now();
  while (!child.has_ended()) {
    const std::chrono::duration<double> age = std::chrono::steady_clock::now() - begin;
    if (stop.stop_requested()) return ChildEnd::How::stopped;
    if (program.limit_s && age.count() >= *program.limit_s) return ChildEnd::How::over_limit;
    if (program.may_go_on && !program.may_go_on()) return ChildEnd::How::refused;
    log.keep_short();
    std::this_thread::sleep_for(kPollInterval);
  }
  return std::nullopt;
}

}  // namespace

std::unique_ptr<RunningChild> start_child(const ChildProgram& program) {
  // A shell that can be started says nothing of whether the program can.
  if (needs_shell(program) && ::access(program.words.front().c_str(), X_OK) != 0) return nullptr;
  const pid_t process = SpawnOptions(program).start(words_of(program));
  if (process < 0) return nullptr;
  return std::make_unique<OwnChild>(process, program.killed_with);
}

ChildEnd watch_child(RunningChild& child, const ChildProgram& program,
                     const std::stop_token& stop) {
  Log log(program);
  const std::optional<ChildEnd::How> why = wait_for(child, program, log, stop);
  ChildEnd end = child.end();
  if (why)
    end = {*why, 0, {}};
  else if (end.how == ChildEnd::How::killed && end.code == SIGKILL && stop.stop_requested())
    end = {ChildEnd::How::stopped, 0, {}};
  end.output = log.end();
  return end;
}

bool wait_for_end(const RunningChild& child, double seconds) {
  constexpr auto kPollInterval = std::chrono::milliseconds(1);
  const auto begin = std::chrono::steady_clock::now();
  while (!child.has_ended()) {
    const std::chrono::duration<double> age = std::chrono::steady_clock::now() - begin;
    if (age.count() >= seconds) return false;
    std::this_thread::sleep_for(kPollInterval);
  }
  return true;
}

ChildEnd run_child(const ChildProgram& program, const std::stop_token& stop) {
  const std::unique_ptr<RunningChild> child = start_child(program);
  return child ? watch_child(*child, program, stop) : ChildEnd{ChildEnd::How::not_started, 0, {}};
}

std::string signal_text(int signal) {
  struct Known {
    int signal;
    const char* name;
  };
  constexpr std::array<Known, 7> kKnown{{{SIGSEGV, "segmentation fault"},
                                         {SIGABRT, "abort"},
                                         {SIGBUS, "bus error"},
                                         {SIGFPE, "arithmetic fault"},
                                         {SIGILL, "illegal instruction"},
                                         {SIGKILL, "killed, as when memory runs out"},
                                         {SIGTERM, "terminated"}}};
  std::string text = "signal " + std::to_string(signal);
  const auto* const known = std::ranges::find(kKnown, signal, &Known::signal);
  if (known != kKnown.end()) text.append(" (").append(known->name).append(")");
  return text;
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

}  // namespace strake::io
