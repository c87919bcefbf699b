// SPDX-License-Identifier: Apache-2.0
#include "strake/io/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

namespace strake::io {
namespace {

Error cannot_write(const std::filesystem::path& path, int reason) {
  return {ErrorCode::output,
          "cannot be written: " + std::error_code(reason, std::generic_category()).message(),
          path.string(), "check the folder, its permissions and the free space"};
}

/// Symbolic links followed, so that the rename replaces the file and not the link to it.
std::filesystem::path real_target(const std::filesystem::path& path) {
  std::error_code failed;
  if (!std::filesystem::is_symlink(path, failed)) return path;
  std::filesystem::path target = std::filesystem::weakly_canonical(path, failed);
  return failed ? path : target;
}

constexpr std::size_t kBufferBytes = std::size_t{1} << 20;

}  // namespace

struct OutputFile::State {
  std::filesystem::path path;     ///< as the user calls it
  std::filesystem::path target;   ///< what it really is
  std::filesystem::path partial;  ///< empty: written directly
  int number = -1;
  int failure = 0;  ///< errno of the first failed write
  std::string buffer;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  State(State&&) = delete;
  State& operator=(State&&) = delete;
  ~State() {
    if (number >= 0) ::close(number);
    if (!partial.empty()) ::unlink(partial.c_str());
  }

  void send(std::string_view bytes);
  int open();
};

int OutputFile::State::open() {
  target = real_target(path);
  struct stat facts{};
  if (::stat(target.c_str(), &facts) == 0 && !S_ISREG(facts.st_mode)) {
    number = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
    return number < 0 ? errno : 0;
  }
  constexpr int kAttempts = 1000;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    std::filesystem::path name = target;
    name += ".partial" + std::to_string(attempt);
    number = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (number >= 0) {
      partial = std::move(name);
      return 0;
    }
    if (errno != EEXIST) return errno;
  }
  return EEXIST;
}

void OutputFile::State::send(std::string_view bytes) {
  while (failure == 0 && !bytes.empty()) {
    const auto written = ::write(number, bytes.data(), bytes.size());
    if (written >= 0)
      bytes.remove_prefix(static_cast<std::size_t>(written));
    else if (errno != EINTR)
      failure = errno;
  }
}

OutputFile::OutputFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
OutputFile::OutputFile(OutputFile&&) noexcept = default;
OutputFile& OutputFile::operator=(OutputFile&&) noexcept = default;
OutputFile::~OutputFile() = default;

Result<OutputFile> OutputFile::create(const std::filesystem::path& path) {
  auto state = std::make_unique<State>();
  state->path = path;
  if (const int failure = state->open(); failure != 0) return cannot_write(path, failure);
  state->buffer.reserve(kBufferBytes);
  return OutputFile(std::move(state));
}

void OutputFile::write(std::string_view bytes) {
  State& state = *state_;
  if (state.buffer.size() + bytes.size() > kBufferBytes) {
    state.send(state.buffer);
    state.buffer.clear();
  }
  if (bytes.size() > kBufferBytes)
    state.send(bytes);
  else
    state.buffer.append(bytes);
}

Status OutputFile::commit() {
  State& state = *state_;
  state.send(state.buffer);
  state.buffer.clear();
  if (state.failure != 0) return cannot_write(state.path, state.failure);
  if (::close(std::exchange(state.number, -1)) != 0) return cannot_write(state.path, errno);
  if (state.partial.empty()) return {};
  if (std::rename(state.partial.c_str(), state.target.c_str()) != 0)
    return cannot_write(state.path, errno);
  state.partial.clear();
  return {};
}

Status write_file(const std::filesystem::path& path, std::string_view bytes) {
  Result<OutputFile> file = OutputFile::create(path);
  if (!file) return file.error();
  file->write(bytes);
  return file->commit();
}

}  // namespace strake::io
