// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "bcf/input/zip_reader.hpp"
#include "report/zip/zip_writer.hpp"

namespace strake::bcf {
namespace {

std::string archive_of_two() {
  std::string bytes;
  const auto sink = [&](std::string_view piece) { bytes += piece; };
  report::ZipWriter zip(sink, "write less");
  EXPECT_TRUE(zip.add_folder("topic/"));
  EXPECT_TRUE(zip.add_file("topic/long", std::string(100'000, 'x')));
  EXPECT_TRUE(zip.add_file("topic/empty", std::string_view()));
  EXPECT_TRUE(zip.finish());
  return bytes;
}

class ZipFile : public testing::Test {
 protected:
  void SetUp() override {
    const testing::TestInfo* const info = testing::UnitTest::GetInstance()->current_test_info();
    file_ = std::filesystem::path(testing::TempDir()) / (std::string(info->name()) + ".zip");
  }
  void TearDown() override { std::filesystem::remove(file_); }
  void write(const std::string& bytes) const { std::ofstream(file_, std::ios::binary) << bytes; }
  std::filesystem::path file_;
};

TEST_F(ZipFile, IsReadByAnotherLibrary) {
  write(archive_of_two());
  Result<ZipReader> reader = ZipReader::open(file_);
  ASSERT_TRUE(reader) << reader.error().text();
  ASSERT_EQ(reader->entries().size(), 2U);
  EXPECT_EQ(reader->entries()[0].name, "topic/empty");
  EXPECT_EQ(reader->read(reader->entries()[0], 10).value(), "");
  EXPECT_EQ(reader->read(reader->entries()[1], 100'000).value(), std::string(100'000, 'x'));
}

TEST_F(ZipFile, UnpacksToNoMoreThanItMay) {
  write(archive_of_two());
  Result<ZipReader> reader = ZipReader::open(file_);
  ASSERT_TRUE(reader);
  const Result<std::string> read = reader->read(reader->entries()[1], 99'999);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::input);
}

TEST_F(ZipFile, EveryDamagedByteIsNoticedOrDoesNoHarm) {
  const std::string whole = archive_of_two();
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x41);
    write(damaged);
    Result<ZipReader> reader = ZipReader::open(file_);
    if (!reader) continue;
    for (const ZipReader::Entry& entry : reader->entries())
      if (const Result<std::string> read = reader->read(entry, 200'000); read) {
        EXPECT_LE(read->size(), 200'000U);
      }
  }
}

TEST(ZipWriter, IsTheSameFileAgain) {
  EXPECT_EQ(archive_of_two(), archive_of_two());
  EXPECT_LT(archive_of_two().size(), 1000U);
}

}  // namespace
}  // namespace strake::bcf
