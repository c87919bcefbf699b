// SPDX-License-Identifier: Apache-2.0
#include "project/database/file_facts.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <string_view>

#include "project/database/schema.hpp"

namespace strake::project {

std::optional<std::pair<std::int64_t, std::int64_t>> size_and_time(
    const std::filesystem::path& file) {
  struct stat facts{};
  if (::stat(file.c_str(), &facts) != 0) return std::nullopt;
  return std::pair{std::int64_t{facts.st_size}, std::int64_t{facts.st_mtim.tv_sec} * 1'000'000'000 +
                                                    std::int64_t{facts.st_mtim.tv_nsec}};
}

std::optional<FileHead> read_head(const std::filesystem::path& file) {
  // It does not wait for the other end of a pipe.
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return std::nullopt;
  // Where the places are: "Database File Format" of SQLite, section 1.3.
  std::array<unsigned char, 100> bytes{};
  const auto got = ::pread(descriptor, bytes.data(), bytes.size(), 0);
  const int reason = errno;
  ::close(descriptor);
  errno = reason;
  if (got < 0) return std::nullopt;
  constexpr std::string_view kMagic("SQLite format 3\0", 16);
  FileHead head;
  head.is_database = static_cast<std::size_t>(got) == bytes.size() &&
                     std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) == 0;
  if (!head.is_database) return head;
  constexpr std::size_t kWriteVersion = 18, kReadVersion = 19, kApplication = 68;
  constexpr unsigned char kWriteLog = 2;
  head.has_write_log = bytes[kWriteVersion] == kWriteLog && bytes[kReadVersion] == kWriteLog;
  std::uint32_t application = 0;
  for (std::size_t i = 0; i < 4; ++i) application = application << 8U | bytes[kApplication + i];
  head.is_project = application == kApplicationId;
  return head;
}

}  // namespace strake::project
