// SPDX-License-Identifier: Apache-2.0
#include "strake/core/atomic_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

namespace strake {
namespace {

namespace fs = std::filesystem;

class AtomicFileTest : public ::testing::Test {
 protected:
  AtomicFileTest()
      : folder_(fs::path(::testing::TempDir()) /
                ("strake_atomic_" + std::to_string(::getpid()) + "_" +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
  }
  ~AtomicFileTest() override { fs::remove_all(folder_); }
  AtomicFileTest(const AtomicFileTest&) = delete;
  AtomicFileTest& operator=(const AtomicFileTest&) = delete;
  AtomicFileTest(AtomicFileTest&&) = delete;
  AtomicFileTest& operator=(AtomicFileTest&&) = delete;

  [[nodiscard]] fs::path path(const std::string& name) const { return folder_ / name; }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  static std::string content(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

 private:
  fs::path folder_;
};

TEST_F(AtomicFileTest, appears_on_commit_only) {
  Result<AtomicFile> file = AtomicFile::create(path("a"));
  ASSERT_TRUE(file);
  file->write("one ");
  file->write("two");
  EXPECT_FALSE(fs::exists(path("a")));
  ASSERT_TRUE(file->commit());
  EXPECT_EQ(content(path("a")), "one two");
  EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFileTest, nothing_is_left_without_a_commit) {
  ASSERT_TRUE(write_file(path("a"), "before"));
  {
    Result<AtomicFile> file = AtomicFile::create(path("a"));
    ASSERT_TRUE(file);
    file->write(std::string(3 << 20, 'x'));
    const AtomicFile moved = std::move(*file);
    EXPECT_EQ(files(), 2U);
  }
  EXPECT_EQ(files(), 1U);
  EXPECT_EQ(content(path("a")), "before");
}

TEST_F(AtomicFileTest, takes_any_amount_in_any_pieces) {
  std::string expected;
  Result<AtomicFile> file = AtomicFile::create(path("big"));
  ASSERT_TRUE(file);
  for (std::size_t i = 0; i < 300; ++i) {
    const std::string piece(i * i % 40000, static_cast<char>('a' + i % 26));
    expected += piece;
    file->write(piece);
  }
  ASSERT_TRUE(file->commit());
  EXPECT_TRUE(content(path("big")) == expected);
}

TEST_F(AtomicFileTest, keeps_mode_and_links) {
  ASSERT_TRUE(write_file(path("real"), "old"));
  fs::permissions(path("real"), fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("real", path("link"));
  ASSERT_TRUE(write_file(path("link"), "new"));
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(content(path("real")), "new");
  EXPECT_EQ(fs::status(path("real")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

/// Whatever the mask of new files takes away.
TEST_F(AtomicFileTest, keeps_every_mode_of_what_it_replaces) {
  const mode_t mask = ::umask(022);
  for (const unsigned mode : {0600U, 0640U, 0644U, 0660U, 0664U, 0666U, 0755U, 0777U, 0200U}) {
    ASSERT_TRUE(write_file(path("a"), "old"));
    fs::permissions(path("a"), static_cast<fs::perms>(mode));
    ASSERT_TRUE(write_file(path("a"), "new"));
    EXPECT_EQ(static_cast<unsigned>(fs::status(path("a")).permissions()), mode);
    fs::remove(path("a"));
  }
  ASSERT_TRUE(write_file(path("a"), "new"));
  EXPECT_EQ(static_cast<unsigned>(fs::status(path("a")).permissions()), 0644U)
      << "where there is nothing to replace the mask counts";
  ::umask(mask);
}

/// Names up to the longest that the disk takes, of one byte a character and of three.
TEST_F(AtomicFileTest, takes_names_of_any_legal_length) {
  const auto longest = static_cast<std::size_t>(::pathconf(path("").c_str(), _PC_NAME_MAX));
  for (std::size_t length = longest - 40; length <= longest; ++length) {
    std::string three;
    while (three.size() + 3 <= length) three += "\xE2\x82\xAC";
    three.resize(length, 'x');
    for (const std::string& name : {std::string(length, 'n'), three}) {
      const Result<AtomicFile> left = AtomicFile::create(path(name));
      ASSERT_TRUE(left) << length;
      EXPECT_EQ(files(), 1U);
      remove_partial_files(path(name));
      EXPECT_EQ(files(), 0U);
      ASSERT_TRUE(write_file(path(name), "x")) << length;
      EXPECT_EQ(content(path(name)), "x");
      EXPECT_EQ(files(), 1U) << "nothing is left beside it";
      fs::remove(path(name));
    }
  }
  EXPECT_FALSE(write_file(path(std::string(longest + 1, 'n')), "x"));
  EXPECT_EQ(files(), 0U);
}

/// Long names that begin alike are targets of their own.
TEST_F(AtomicFileTest, long_names_stay_apart) {
  const std::string one = std::string(250, 'n') + "1", two = std::string(250, 'n') + "2";
  Result<AtomicFile> first = AtomicFile::create(path(one));
  Result<AtomicFile> second = AtomicFile::create(path(two));
  ASSERT_TRUE(first && second);
  first->write("1");
  second->write("2");
  remove_partial_files(path(one));
  EXPECT_FALSE(first->commit());
  ASSERT_TRUE(second->commit());
  EXPECT_EQ(content(path(two)), "2");
  EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFileTest, links_to_nowhere_are_followed_and_circles_are_errors) {
  fs::create_directory(path("sub"));
  fs::create_symlink("sub/b", path("a"));
  fs::create_symlink("../real", path("sub/b"));
  EXPECT_EQ(fs::weakly_canonical(resolve_links(path("a"))), fs::weakly_canonical(path("real")));
  ASSERT_TRUE(write_file(path("a"), "x"));
  EXPECT_EQ(content(path("real")), "x");
  EXPECT_TRUE(fs::is_symlink(path("a")) && fs::is_symlink(path("sub/b")));
  fs::create_symlink("two", path("one"));
  fs::create_symlink("one", path("two"));
  EXPECT_FALSE(write_file(path("one"), "x"));
  EXPECT_TRUE(fs::is_symlink(path("one")) && fs::is_symlink(path("two")));
}

TEST_F(AtomicFileTest, partial_files_can_be_removed_from_outside) {
  ASSERT_TRUE(write_file(path("a"), "before"));
  const Result<AtomicFile> first = AtomicFile::create(path("a"));
  const Result<AtomicFile> second = AtomicFile::create(path("a"));
  ASSERT_TRUE(first && second);
  EXPECT_EQ(files(), 3U);
  remove_partial_files(path("a"));
  EXPECT_EQ(files(), 1U);
  EXPECT_EQ(content(path("a")), "before");
}

TEST_F(AtomicFileTest, errors_name_the_file) {
  const Status missing = write_file(path("no/such/folder"), "x");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::output);
  EXPECT_NE(missing.error().text().find("no/such/folder"), std::string::npos);
  EXPECT_NE(missing.error().text().find("make the folder"), std::string::npos);
  ASSERT_FALSE(write_file(path(""), "x")) << "a folder is no file";
  EXPECT_EQ(files(), 0U);
}

TEST_F(AtomicFileTest, a_full_disk_is_an_error) {
  const Status status = write_file("/dev/full", "x");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::output);
}

TEST_F(AtomicFileTest, devices_are_written_directly) {
  EXPECT_TRUE(write_file("/dev/null", "x"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

}  // namespace
}  // namespace strake
