// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "strake/io/importer.hpp"
#include "strake/io/reader.hpp"
#include "support/gltf_files.hpp"
#include "support/io_files.hpp"

namespace strake::io {
namespace {

constexpr const char* kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

Result<model::Model> read_files(const std::vector<std::filesystem::path>& paths,
                                const ReadOptions& options = {}) {
  return read_models(paths, options, {});
}

TEST(Registry, KnowsAFileByItsContent) {
  const test::TemporaryFolder folder;
  const auto format = [&](const char* name, std::string_view content) {
    const Result<model::Model> model = read_files({folder.write(name, content)});
    return model ? model->files.at(0).format : model.error().text();
  };
  EXPECT_EQ(format("a.stl", kObj), "OBJ");
  EXPECT_EQ(format("b.obj",
                   "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                   "vertex 0 1 0\nendloop\nendfacet\nendsolid\n"),
            "STL text");
  EXPECT_EQ(format("c", test::triangle_glb(R"("nodes":[{"mesh":0}])")), "GLB");
}

TEST(Registry, ReadsSeveralFilesInAnyOrderAlike) {
  const test::TemporaryFolder folder;
  const std::filesystem::path a = folder.write("a.obj", kObj);
  const std::filesystem::path b =
      folder.write("b.glb", test::triangle_glb(R"("nodes":[{"mesh":0}])"));
  const Result<model::Model> one = read_files({a, b}), other = read_files({b, a});
  ASSERT_TRUE(one);
  ASSERT_TRUE(other);
  ASSERT_EQ(one->objects.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(one->objects[i].id, other->objects[i].id);
    EXPECT_EQ(one->files[one->objects[i].file].label, other->files[other->objects[i].file].label);
  }
  EXPECT_EQ(one->objects[0].name, "a");
}

TEST(Registry, NamesTheFileAndTheMend) {
  const test::TemporaryFolder folder;
  const auto check = [](const Result<model::Model>& result, const std::string& where) {
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::input);
    EXPECT_EQ(result.error().where, where);
    EXPECT_FALSE(result.error().mend.empty());
  };
  check(read_files({folder.path() / "missing.obj"}), (folder.path() / "missing.obj").string());
  check(read_files({folder.path()}), folder.path().string());
  check(read_files({"/dev/null"}), "/dev/null");
  const std::filesystem::path empty = folder.write("empty.glb", "");
  check(read_files({empty}), empty.string());
  const std::filesystem::path text = folder.write("letter.txt", "Dear reader,\nno model.\n");
  check(read_files({text}), text.string());
  const std::filesystem::path good = folder.write("good.obj", kObj);
  check(read_files({good, text}), text.string());
}

TEST(Registry, StatesHowAModelOfAnotherFormatIsConverted) {
  const test::TemporaryFolder folder;
  const auto stated = [&](const char* name) {
    // Without importers, which the machine may have: that of STEP is built beside this program.
    const std::array<FileToRead, 1> files{
        FileToRead{folder.write(name, "Dear reader,\nno model.\n"), {}}};
    return read_models(files, ImportSettings{}, {}).error().text();
  };
  const std::string formats =
      ": unsupported format (Strake reads RVM, glTF/GLB, OBJ, STL and PLY; ";
  EXPECT_NE(stated("a.txt").find(formats + "export the model as one of these; a program "
                                           "strake-import-txt in PATH would be taken, too)"),
            std::string::npos);
  EXPECT_NE(stated("a").find(formats + "export the model as one of these)"), std::string::npos);
  EXPECT_NE(stated("a.IFC").find("pip install 'strake[ifc]' (or convert it: IfcConvert"),
            std::string::npos);
  EXPECT_NE(stated("a.stp").find("./run step"), std::string::npos);
  EXPECT_NE(stated("a.brep").find(formats + "open it in a CAD program"), std::string::npos);
  EXPECT_NE(stated("a.fbx").find(formats + "open it in Blender"), std::string::npos);
}

TEST(Registry, RefusesImpossibleQuestions) {
  EXPECT_EQ(read_files({}).error().code, ErrorCode::usage);
  const test::TemporaryFolder folder;
  ReadOptions options;
  for (const double unit : {0.0, -1.0, 1e300}) {
    options.unit_mm = unit;
    EXPECT_EQ(read_files({folder.write("a.obj", kObj)}, options).error().code, ErrorCode::usage);
  }
}

}  // namespace
}  // namespace strake::io
