// SPDX-License-Identifier: Apache-2.0
#include "io/source/input_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "strake/parallel/team.hpp"
#include "support/io_files.hpp"

namespace strake::io {
namespace {

/// Returns so many bytes, no two pieces of a file alike.
std::string bytes_of(std::size_t size) {
  std::string bytes(size, '\0');
  std::uint32_t state = 1;
  for (char& byte : bytes) {
    state = state * 1664525U + 1013904223U;
    byte = static_cast<char>(state >> 24U);
  }
  return bytes;
}

TEST(FileContent, IsTheFileWhateverItsSizeAndTheTeam) {
  constexpr std::size_t kPiece = std::size_t{4} << 20U;
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "x";
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, kPiece - 1, kPiece, kPiece + 1,
                                 2 * kPiece, 3 * kPiece + 12345}) {
    const std::string expected = bytes_of(size);
    std::ofstream(path, std::ios::binary)
        .write(expected.data(), static_cast<std::streamsize>(size));
    for (const unsigned workers : {1U, 3U}) {
      parallel::Team team(workers);
      const Result<FileContent> content =
          FileContent::read(path, {.team = workers > 1 ? &team : nullptr});
      ASSERT_TRUE(content) << size;
      EXPECT_EQ(as_text(content->bytes()), expected) << size << " by " << workers;
    }
  }
}

TEST(FileContent, IsCancelledWithItsRun) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "x";
  std::ofstream(path, std::ios::binary) << bytes_of(std::size_t{9} << 20U);
  const std::stop_source stop;
  stop.request_stop();
  const Result<FileContent> content = FileContent::read(path, {.stop = stop.get_token()});
  ASSERT_FALSE(content);
  EXPECT_EQ(content.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace strake::io
