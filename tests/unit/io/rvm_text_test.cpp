// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "strake/io/reader.hpp"
#include "support/io_files.hpp"

namespace strake::io {
namespace {

using geometry::Vec3d;

constexpr const char* kText =
    "HEAD\n    1    1\nspec\n\nnow\nme\n"
    "MODL\n    1    1\nP\n/M\n"
    "CNTB\n    1    2\n/A b\n  1000.00000  2000.00000  3000.00000\n 6\n"
    "PRIM\n 1 1\n 8\n"
    "  0.0000000 0.0000000 0.0010000 1.0000000\n"
    "  0.0010000 0.0000000 0.0000000 2.0000000\n"
    "  0.0000000 0.0010000 0.0000000 3.0000000\n"
    "  -50.00000 -50.00000 -200.00000\n 50.00000 50.00000 200.00000\n"
    "  50.00000 400.00000\n"
    "PRIM\n 1 1\n 11\n"
    "  0.0010000 0 0 0\n 0 0.0010000 0 0\n 0 0 0.0010000 0\n 0 0 0\n 1 1 1\n"
    "  1\n 1\n 3\n"
    "  123456789.12345-123456789.00000      0.00000\n 0.0 0.0 1.0\n"
    "  10.0 0.0 0.0\n 0.0 0.0 1.0\n 0.0 10.0 0.0\n 0.0 0.0 1.0\n"
    "CNTE\n 1 2\nEND:\n 1 1\n";

Result<model::Model> read_text(const std::string& text) {
  return test::read_bytes(*make_rvm_reader(), text, "test.rev");
}

TEST(RvmText, ReadsTheSameAsBinary) {
  EXPECT_EQ(
      make_rvm_reader()->recognise({"x.rvm", std::as_bytes(std::span(std::string_view(kText)))}),
      90);
  const auto model = read_text(kText);
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(model->files[0].format, "RVM text");
  ASSERT_EQ(model->objects.size(), 1U);
  EXPECT_EQ(model->objects[0].name, "/A b");
  ASSERT_EQ(model->bodies.size(), 2U);
  EXPECT_EQ(model->bodies[0].placement * Vec3d(0, 0, 200), Vec3d(1200, 2000, 3000));
  const auto& mesh = std::get<geometry::TriangleMesh>(model->shapes.at(1));
  ASSERT_EQ(mesh.vertices.size(), 3U);
  // Two numbers of fixed width that touch.
  EXPECT_EQ(mesh.vertices[0], Vec3d(123456792, -123456792, 0));
  EXPECT_EQ(model->diagnostics.kept().size(), model->diagnostics.count("coarse-coordinates"));
}

TEST(RvmText, LineEndsOfOtherSystemsAndAMarkAtTheStart) {
  std::string text = "\xEF\xBB\xBF";
  for (const char c : std::string(kText)) {
    if (c == '\n') text += '\r';
    text += c;
  }
  const auto model = read_text(text);
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(model->objects[0].name, "/A b");
  EXPECT_EQ(model->bodies.size(), 2U);
}

TEST(RvmText, ADamagedChunkIsNamedByItsLine) {
  std::string text = kText;
  text.replace(text.find("50.00000 400.00000"), 18, "fifty");
  const auto model = read_text(text);
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(model->bodies.size(), 1U);
  ASSERT_EQ(model->diagnostics.count("rvm-damaged-chunk"), 1U);
  EXPECT_EQ(model->diagnostics.kept().at(0).where, "test.rev, line 16");
  ASSERT_EQ(model->objects.size(), 1U);
  EXPECT_TRUE(model->objects[0].incomplete);
}

TEST(RvmText, AChunkThatIsNotKnownIsMissingFromItsGroup) {
  std::string text = kText;
  text.replace(text.find("PRIM"), 4, "WHAT");
  const auto model = read_text(text);
  ASSERT_TRUE(model) << model.error().text();
  ASSERT_EQ(model->objects.size(), 1U);
  EXPECT_TRUE(model->objects[0].incomplete);
  EXPECT_EQ(model->objects[0].body_count, 1U);
  EXPECT_EQ(model->diagnostics.count("rvm-unknown-chunk"), 1U);
}

TEST(RvmText, EveryTruncationIsSurvived) {
  const std::string text = kText;
  for (std::size_t length = 0; length < text.size(); ++length) {
    const auto model = read_text(text.substr(0, length));
    EXPECT_TRUE(!model || model->bodies.size() <= 2) << length;
  }
}

TEST(RvmText, HugeCountsAllocateNothing) {
  std::string text = kText;
  text.replace(text.find("  1\n 1\n 3\n"), 10, "4000000000\n");
  const auto model = read_text(text);
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(model->bodies.size(), 1U);
}

}  // namespace
}  // namespace strake::io
