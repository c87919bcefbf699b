// SPDX-License-Identifier: Apache-2.0
// Projects that follow their files: which are read again, whose place they take, what is
// remembered.
#include "strake/project/update.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "support/io_files.hpp"

namespace strake::project {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNow = "2026-05-04T22:00:00Z";

/// An OBJ file with a triangle for each name, at x = 0, 10, 20 … or at `shift` beside it.
std::string triangles(const std::vector<std::string>& names, int shift = 0) {
  std::string text;
  int x = shift, corner = 1;
  for (const std::string& name : names) {
    const auto vertex = [&](int dx, int dy) {
      return "v " + std::to_string(x + dx) + ' ' + std::to_string(dy) + " 0\n";
    };
    text += "o " + name + '\n' + vertex(0, 0) + vertex(5, 0) + vertex(0, 5) + "f " +
            std::to_string(corner) + ' ' + std::to_string(corner + 1) + ' ' +
            std::to_string(corner + 2) + '\n';
    x += 10;
    corner += 3;
  }
  return text;
}

std::vector<std::string> names(const std::string& stem, int first, int last) {
  std::vector<std::string> found;
  for (int i = first; i < last; ++i) found.push_back(stem + std::to_string(i));
  return found;
}

class Updates : public testing::Test {
 protected:
  Project make(const std::vector<fs::path>& files) {
    Result<Project> project = Project::create(folder_.path() / "ship.strake");
    EXPECT_TRUE(project) << project.error().text();
    std::vector<io::FileToRead> given;
    for (const fs::path& file : files) given.push_back({file, {}});
    const Result<Update> done = add_model_files(*project, given, {kNow}, {});
    EXPECT_TRUE(done) << done.error().text();
    return std::move(*project);
  }

  static std::vector<std::string> labels(Project& project) {
    std::vector<std::string> found;
    const Result<std::vector<StoredFile>> files = project.files();
    EXPECT_TRUE(files);
    for (const StoredFile& file : *files) found.push_back(file.source.label);
    return found;
  }

  [[nodiscard]] const test::TemporaryFolder& folder() const { return folder_; }

 private:
  test::TemporaryFolder folder_;
};

std::uint64_t count(const Update& update, ChangeKind kind) { return update.changes.count(kind); }

TEST_F(Updates, OnlyWhatChangedIsReadAgain) {
  const fs::path a = folder().write("a.obj", triangles({"p", "q"}));
  const fs::path b = folder().write("b.obj", triangles({"r"}, 100));
  Project project = make({a, b});
  const Result<Update> nothing = update(project, {}, {kNow}, {});
  ASSERT_TRUE(nothing);
  EXPECT_EQ(nothing->revision.id, 0);
  EXPECT_TRUE(nothing->read.empty());
  EXPECT_EQ(nothing->changes.unchanged, 3U);
  EXPECT_EQ(folder().write("b.obj", triangles({"r"}, 200)), b);
  const Result<Update> done = update(project, {}, {kNow}, {});
  ASSERT_TRUE(done);
  EXPECT_EQ(done->read, std::vector<std::string>{"b.obj"});
  EXPECT_EQ(count(*done, ChangeKind::moved), 1U);
  EXPECT_EQ(done->changes.unchanged, 2U);
  const Result<std::vector<Revision>> known = revisions(project);
  ASSERT_TRUE(known);
  ASSERT_EQ(known->size(), 2U);
  EXPECT_EQ(known->front().id, done->revision.id);
  EXPECT_EQ(known->front().what, "update");
  EXPECT_EQ(known->front().counts, done->changes.counts);
  EXPECT_EQ(known->back().what, "add");
}

TEST_F(Updates, AFileOfAnotherNameTakesThePlaceOfTheOneThatItIs) {
  const fs::path a = folder().write("HA.obj", triangles(names("p", 0, 8)));
  const fs::path b = folder().write("HB.obj", triangles(names("q", 0, 8), 500));
  Project project = make({a, b});
  const fs::path revised = folder().write("HA_revB.obj", triangles(names("p", 0, 9)));
  const Result<Update> done = update(project, {{{revised, {}}}, {}}, {kNow}, {});
  ASSERT_TRUE(done) << done.error().text();
  EXPECT_EQ(count(*done, ChangeKind::added), 1U);
  EXPECT_EQ(done->changes.unchanged, 16U);
  EXPECT_EQ(labels(project), (std::vector<std::string>{"HA_revB.obj", "HB.obj"}));
  EXPECT_TRUE(done->changes.files.only_before.empty());
}

TEST_F(Updates, WhatIsLikeNothingIsRefused) {
  Project project = make({folder().write("a.obj", triangles(names("p", 0, 8)))});
  const fs::path other = folder().write("z.obj", triangles(names("z", 0, 8), 900));
  const Result<Update> refused = update(project, {{{other, {}}}, {}}, {kNow}, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::usage);
  const Result<Update> update_result =
      update(project, {{{other, {}}}, {"a.obj=z.obj"}}, {kNow}, {});
  ASSERT_TRUE(update_result) << update_result.error().text();
  EXPECT_EQ(labels(project), std::vector<std::string>{"z.obj"});
  EXPECT_EQ(count(*update_result, ChangeKind::added), 8U);
  EXPECT_EQ(count(*update_result, ChangeKind::removed), 8U);
}

TEST_F(Updates, AFileThatWasSplitIsTwo) {
  Project project = make({folder().write("a.obj", triangles(names("p", 0, 60)))});
  const fs::path most = folder().write("a1.obj", triangles(names("p", 0, 35)));
  const fs::path rest = folder().write("a2.obj", triangles(names("p", 35, 60), 350));
  const Result<Update> done = update(project, {{{most, {}}, {rest, {}}}, {}}, {kNow}, {});
  ASSERT_TRUE(done) << done.error().text();
  EXPECT_EQ(labels(project), (std::vector<std::string>{"a1.obj", "a2.obj"}));
  EXPECT_EQ(done->changes.unchanged, 60U);
}

TEST_F(Updates, WhatWasStatedOfAFileIsStatedOfItsSuccessor) {
  const fs::path a = folder().write("a.obj", triangles(names("p", 0, 8)));
  Result<Project> project = Project::create(folder().path() / "ship.strake");
  ASSERT_TRUE(project);
  const std::vector<io::FileToRead> given{{a, {1000.0, {}, {}}}};
  ASSERT_TRUE(add_model_files(*project, given, {kNow}, {}));
  const fs::path revised = folder().write("a_revB.obj", triangles(names("p", 0, 8)));
  const Result<Update> done = update(*project, {{{revised, {}}}, {}}, {kNow}, {});
  ASSERT_TRUE(done) << done.error().text();
  EXPECT_EQ(done->changes.unchanged, 8U);
  const Result<std::vector<StoredFile>> files = project->files();
  ASSERT_TRUE(files);
  EXPECT_EQ(files->front().options.unit_mm, 1000.0);
}

TEST_F(Updates, AfterAnErrorTheProjectIsAsItWas) {
  const fs::path a = folder().write("a.obj", triangles({"p"}));
  const fs::path b = folder().write("b.obj", triangles({"q"}, 50));
  Project project = make({a, b});
  EXPECT_EQ(folder().write("a.obj", triangles({"p"}, 7)), a);
  EXPECT_EQ(folder().write("b.obj", "nothing\n"), b);
  EXPECT_FALSE(update(project, {}, {kNow}, {}));
  fs::remove(b);
  EXPECT_FALSE(update(project, {}, {kNow}, {}));
  const Result<model::Model> model = project.model({});
  ASSERT_TRUE(model);
  ASSERT_EQ(model->objects.size(), 2U);
  const auto& mesh =
      std::get<geometry::TriangleMesh>(model->shapes[model::index(model->bodies.front().shape)]);
  EXPECT_EQ(mesh.vertices.front().x, 0);
  EXPECT_EQ(revisions(project)->size(), 1U);
}

TEST_F(Updates, LabelsFollowNamesakes) {
  fs::create_directory(folder().path() / "x");
  fs::create_directory(folder().path() / "y");
  Project project = make({folder().write("x/a.obj", triangles({"p"}))});
  const fs::path second = folder().write("y/a.obj", triangles({"q"}, 50));
  const std::vector<io::FileToRead> given{{second, {}}};
  ASSERT_TRUE(add_model_files(project, given, {kNow}, {}));
  EXPECT_EQ(labels(project), (std::vector<std::string>{"x/a.obj", "y/a.obj"}));
  const std::vector<std::string> gone{"y/a.obj"};
  const Result<Update> done = remove_model_files(project, gone, {kNow}, {});
  ASSERT_TRUE(done) << done.error().text();
  EXPECT_EQ(labels(project), std::vector<std::string>{"a.obj"});
  EXPECT_EQ(count(*done, ChangeKind::removed), 1U);
  EXPECT_EQ(done->changes.unchanged, 1U);
}

}  // namespace
}  // namespace strake::project
