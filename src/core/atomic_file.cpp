// SPDX-License-Identifier: Apache-2.0
#include "strake/core/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <system_error>
#include <utility>

#include "strake/core/hash.hpp"

namespace strake {

namespace {

namespace fs = std::filesystem;

constexpr int kAttempts = 100;
constexpr std::size_t kBuffer = std::size_t{1} << 20U;

Error failure(const fs::path& target, int error) {
  std::string mend;
  if (error == ENOENT) mend = "make the folder first";
  if (error == EACCES || error == EPERM || error == EROFS)
    mend = "choose a folder you may write to";
  if (error == ENOSPC || error == EDQUOT) mend = "make room or choose another disk";
  if (error == EFBIG)
    mend =
        "raise the limit on the size of files (ulimit -f), or choose a disk "
        "that takes larger ones";
  return {ErrorCode::output, "cannot be written: " + std::generic_category().message(error),
          target.string(), std::move(mend)};
}

/// Brings the folder to the disk, and with it the entry of a rename.
void sync_folder(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

std::size_t longest_name(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const long longest = ::pathconf(folder.c_str(), _PC_NAME_MAX);
  return longest > 0 ? static_cast<std::size_t>(longest) : NAME_MAX;
}

/// Returns the name of a partial file. It holds the process, so that programs writing the same
/// target do not collide, and so that remove_partial_files() knows its own. A name that is as long
/// as the disk takes leaves no room for that: a hash of all of it replaces its end, which keeps
/// targets that begin alike apart.
fs::path partial_name(const fs::path& target, int attempt) {
  std::string name = target.filename().string();
  std::string own = ".";
  own += std::to_string(::getpid());
  own += '-';
  own += std::to_string(attempt);
  own += ".part";
  const std::size_t longest = longest_name(target);
  if (name.size() + own.size() > longest) {
    std::string hash = "~";
    hash += hash_bytes(std::as_bytes(std::span(name))).text();
    std::size_t kept = longest - std::min(longest, own.size() + hash.size());
    // The cut is not within a character of UTF-8, which some disks refuse.
    while (kept > 0 && (static_cast<unsigned char>(name[kept]) & 0xC0U) == 0x80U) --kept;
    name = name.substr(0, kept) + hash;
  }
  return target.parent_path() / (name + own);
}

/// Gives a file the rights of the one that it replaces. Not everybody may keep its owner and group:
/// where they cannot be kept, the new file is the writer's.
void take_over(int descriptor, const struct stat& replaced) {
  const bool owned = ::fchown(descriptor, replaced.st_uid, replaced.st_gid) == 0 ||
                     ::fchown(descriptor, static_cast<uid_t>(-1), replaced.st_gid) == 0;
  static_cast<void>(owned);
  // The mode is not left to open, which takes away what the umask says. A disk without modes
  // refuses.
  static_cast<void>(::fchmod(descriptor, replaced.st_mode & 0777U));
}

}  // namespace

fs::path resolve_links(const fs::path& target) {
  std::error_code error;
  fs::path path = target;
  for (int i = 0; i < 40 && fs::is_symlink(path, error); ++i) {
    const fs::path next = fs::read_symlink(path, error);
    if (error) break;
    path = next.is_absolute() ? next : path.parent_path() / next;
  }
  return path;
}

Result<AtomicFile> AtomicFile::create(const fs::path& target) {
  AtomicFile file;
  file.target_ = resolve_links(target);
  struct stat status{};
  const bool exists = ::stat(file.target_.c_str(), &status) == 0;
  if (!exists && errno == ELOOP) return failure(target, ELOOP);
  if (exists && S_ISDIR(status.st_mode)) return failure(target, EISDIR);
  if (exists && !S_ISREG(status.st_mode)) {
    file.direct_ = true;
    file.descriptor_ = ::open(file.target_.c_str(), O_WRONLY | O_CLOEXEC);
    if (file.descriptor_ < 0) return failure(target, errno);
    return file;
  }
  if (exists && ::access(file.target_.c_str(), W_OK) != 0) return failure(target, errno);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    file.temporary_ = partial_name(file.target_, attempt);
    const mode_t mode = exists ? status.st_mode & 0777U : 0666U;
    file.descriptor_ =
        ::open(file.temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (file.descriptor_ >= 0) {
      if (exists) take_over(file.descriptor_, status);
      return file;
    }
    if (errno != EEXIST) break;
  }
  const int error = errno;
  file.temporary_.clear();
  return failure(target, error);
}

AtomicFile::~AtomicFile() { discard(); }

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      error_(other.error_),
      direct_(other.direct_),
      target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      buffer_(std::move(other.buffer_)) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  if (this == &other) return *this;
  discard();
  descriptor_ = std::exchange(other.descriptor_, -1);
  error_ = other.error_;
  direct_ = other.direct_;
  target_ = std::move(other.target_);
  temporary_ = std::exchange(other.temporary_, {});
  buffer_ = std::move(other.buffer_);
  return *this;
}

void AtomicFile::discard() noexcept {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  temporary_.clear();
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  write(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

void AtomicFile::write(std::string_view text) {
  if (text.size() >= kBuffer) {
    flush();
    write_out(text.data(), text.size());
    return;
  }
  buffer_ += text;
  if (buffer_.size() >= kBuffer) flush();
}

void AtomicFile::flush() {
  write_out(buffer_.data(), buffer_.size());
  buffer_.clear();
}

void AtomicFile::write_out(const char* data, std::size_t size) {
  while (size > 0 && error_ == 0) {
    const ssize_t written = ::write(descriptor_, data, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      error_ = errno;
      return;
    }
    data += written;
    size -= static_cast<std::size_t>(written);
  }
}

Status AtomicFile::commit() { return put_in_place(true); }

Status AtomicFile::commit_soon() { return put_in_place(false); }

Status AtomicFile::put_in_place(bool at_once) {
  flush();
  // A pipe or a terminal has no disk to be brought to.
  if (error_ == 0 && !direct_ && at_once && ::fsync(descriptor_) != 0) error_ = errno;
  if (::close(std::exchange(descriptor_, -1)) != 0 && error_ == 0) error_ = errno;
  if (error_ == 0 && !direct_ && ::rename(temporary_.c_str(), target_.c_str()) != 0) error_ = errno;
  if (error_ != 0) {
    discard();
    return failure(target_, error_);
  }
  temporary_.clear();
  if (!direct_ && at_once) sync_folder(target_);
  return {};
}

void remove_partial_files(const fs::path& target) noexcept {
  try {
    const fs::path real = resolve_links(target);
    for (int attempt = 0; attempt < kAttempts; ++attempt)
      ::unlink(partial_name(real, attempt).c_str());
  } catch (...) {  // no memory for a name: there is nothing more to be done
  }
}

Status write_file(const fs::path& target, std::string_view text) {
  Result<AtomicFile> file = AtomicFile::create(target);
  if (!file) return file.error();
  file->write(text);
  return file->commit();
}

}  // namespace strake
