// SPDX-License-Identifier: Apache-2.0
#include "io/file_content.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <new>
#include <string>
#include <system_error>

namespace strake::io {
namespace {

Error cannot_read(const std::filesystem::path& path, int reason) {
  return Error{ErrorCode::input,
               "cannot be read: " + std::error_code(reason, std::generic_category()).message(),
               path.string(), "check the path and the permissions"};
}

/// An open file that closes itself.
class Descriptor {
 public:
  /// Does not wait for the other end of a pipe, which is no model anyway.
  explicit Descriptor(const std::filesystem::path& path)
      : number_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor(Descriptor&&) = delete;
  Descriptor& operator=(Descriptor&&) = delete;

  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

}  // namespace

Result<FileContent> FileContent::read(const std::filesystem::path& path) {
  const Descriptor file(path);
  if (file.number() < 0) return cannot_read(path, errno);
  struct stat facts{};
  if (::fstat(file.number(), &facts) != 0) return cannot_read(path, errno);
  if (S_ISDIR(facts.st_mode)) return cannot_read(path, EISDIR);
  if (!S_ISREG(facts.st_mode))
    return Error{ErrorCode::input, "is not a regular file", path.string(),
                 "give a model file; a pipe or a device must be saved to one first"};

  FileContent content;
  const auto size = static_cast<std::size_t>(facts.st_size);
  content.data_.reset(new (std::nothrow) std::byte[size]);
  if (content.data_ == nullptr) return out_of_memory();
  while (content.size_ < size) {
    constexpr std::size_t kMost = std::size_t{1} << 30;  // one read() takes no more than 2 GiB
    const auto got = ::read(file.number(), content.data_.get() + content.size_,
                            std::min(size - content.size_, kMost));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return cannot_read(path, errno);
    if (got == 0) break;
    content.size_ += static_cast<std::size_t>(got);
  }
  return content;
}

}  // namespace strake::io
