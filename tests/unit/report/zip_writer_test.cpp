// SPDX-License-Identifier: Apache-2.0
#include "report/zip/zip_writer.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "support/zip_reader.hpp"

namespace strake::report {
namespace {

TEST(ZipWriter, PiecesMakeTheFileThatTheyArePiecesOf) {
  std::string zip;
  auto append = [&](std::string_view bytes) { zip += bytes; };
  ZipWriter writer(append, "write less");
  std::string whole;
  for (std::size_t i = 0; i < 5000; ++i) whole += std::to_string(i * i) + (i % 3 == 0 ? "\n" : " ");
  ASSERT_TRUE(writer.add_file("a/first.txt", "first"));
  writer.begin("b.txt");
  for (std::size_t at = 0; at < whole.size(); at += 7001) {
    const Result<DeflatedPiece> piece = deflate_piece(std::string_view(whole).substr(at, 7001));
    ASSERT_TRUE(piece);
    std::string handed_on;
    append_piece(handed_on, *piece);
    writer.add(parse_piece(handed_on));
  }
  ASSERT_TRUE(writer.end());
  ASSERT_TRUE(writer.add_file("empty", ""));
  ASSERT_TRUE(writer.finish());
  const auto files = test::files_of_zip(zip);
  ASSERT_EQ(files.size(), 3U);
  EXPECT_EQ(files.at("a/first.txt"), "first");
  EXPECT_EQ(files.at("b.txt"), whole);
  EXPECT_EQ(files.at("empty"), "");
  EXPECT_LT(zip.size(), whole.size());
}

TEST(ZipWriter, AFileOfFourGibibytesIsAnError) {
  std::string zip;
  auto append = [&](std::string_view bytes) { zip += bytes; };
  ZipWriter writer(append, "write less");
  const Result<DeflatedPiece> piece = deflate_piece(std::string(1U << 20U, ' '));
  ASSERT_TRUE(piece);
  writer.begin("large");
  for (int i = 0; i < 4096; ++i) writer.add(*piece);
  const Status status = writer.end();
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::output);
  EXPECT_EQ(status.error().mend, "write less");
}

}  // namespace
}  // namespace strake::report
