// SPDX-License-Identifier: Apache-2.0
#include "strake/io/output_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "support/io_files.hpp"

namespace strake::io {
namespace {

std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::ptrdiff_t files_in(const std::filesystem::path& folder) {
  return std::distance(std::filesystem::directory_iterator(folder), {});
}

TEST(OutputFile, AppearsOnlyWhenCommitted) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "out.txt";
  {
    Result<OutputFile> file = OutputFile::create(path);
    ASSERT_TRUE(file);
    file->write("hello ");
    EXPECT_FALSE(std::filesystem::exists(path));
    file->write("world");
    ASSERT_TRUE(file->commit());
    EXPECT_EQ(content(path), "hello world");
  }
  EXPECT_EQ(files_in(folder.path()), 1);
}

TEST(OutputFile, LeavesTheOldFileWhenDropped) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder.write("out.txt", "old");
  {
    Result<OutputFile> file = OutputFile::create(path);
    ASSERT_TRUE(file);
    file->write(std::string(3'000'000, 'x'));
  }
  EXPECT_EQ(content(path), "old");
  EXPECT_EQ(files_in(folder.path()), 1);
}

TEST(OutputFile, WritesMoreThanItsBuffer) {
  const test::TemporaryFolder folder;
  std::string all;
  Result<OutputFile> file = OutputFile::create(folder.path() / "out");
  ASSERT_TRUE(file);
  for (int i = 0; i < 300; ++i) {
    const std::string piece(static_cast<std::size_t>(i) * 97, static_cast<char>('a' + i % 26));
    file->write(piece);
    all += piece;
  }
  ASSERT_TRUE(file->commit());
  EXPECT_EQ(content(folder.path() / "out"), all);
}

TEST(OutputFile, WritesThroughLinksAndToDevices) {
  const test::TemporaryFolder folder;
  const std::filesystem::path target = folder.write("target", "old");
  std::filesystem::create_symlink(target, folder.path() / "link");
  ASSERT_TRUE(write_file(folder.path() / "link", "new"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link"));
  EXPECT_EQ(content(target), "new");
  EXPECT_TRUE(write_file("/dev/null", "gone"));
}

TEST(OutputFile, SaysWhyItCannotWrite) {
  const Result<OutputFile> file = OutputFile::create("/no/such/folder/out");
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, ErrorCode::output);
  EXPECT_EQ(file.error().where, "/no/such/folder/out");
  const Status full = write_file("/dev/full", "x");
  ASSERT_FALSE(full);
  EXPECT_EQ(full.error().code, ErrorCode::output);
}

}  // namespace
}  // namespace strake::io
