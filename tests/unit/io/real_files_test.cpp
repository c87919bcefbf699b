// SPDX-License-Identifier: Apache-2.0
// Real files, when STRAKE_DATA names the folder that holds them: objects, triangles and segments
// must be what scripts/count_model.py counts, and what it refuses must be refused with a reason.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "strake/io/reader.hpp"
#include "support/io_files.hpp"

namespace strake::io {
namespace {

std::vector<std::filesystem::path> model_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    for (const char* known : {".obj", ".stl", ".ply", ".glb", ".gltf"})
      if (entry.is_regular_file() && extension == known) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<nlohmann::json> independent_counts(const std::vector<std::filesystem::path>& files) {
  std::string command = "python3 '" STRAKE_SOURCE_DIR "/scripts/count_model.py'";
  for (const std::filesystem::path& file : files) command += " '" + file.string() + "'";
  std::vector<nlohmann::json> counts;
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  std::array<char, 4096> line{};
  while (pipe && std::fgets(line.data(), line.size(), pipe.get()) != nullptr)
    counts.push_back(nlohmann::json::parse(line.data()));
  return counts;
}

nlohmann::json count(const model::Model& model) {
  std::size_t triangles = 0, segments = 0;
  for (const model::Body& body : model.bodies) {
    const model::Shape& shape = model.shapes[model::index(body.shape)];
    if (const auto* const mesh = std::get_if<geometry::TriangleMesh>(&shape))
      triangles += mesh->triangles.size();
    else if (const auto* const lines = std::get_if<geometry::Polylines>(&shape))
      segments += lines->points.size() - (lines->first.size() - 1);
  }
  return {{"objects", model.objects.size()}, {"triangles", triangles}, {"segments", segments}};
}

TEST(RealFiles, CountAsAnIndependentCountDoes) {
  const auto folder = test::data_folder();
  if (!folder) GTEST_SKIP() << "STRAKE_DATA is not set";
  std::vector<std::filesystem::path> files = model_files(*folder / "mesh");
  for (const std::filesystem::path& file : model_files(*folder / "gltf")) files.push_back(file);
  ASSERT_FALSE(files.empty());
  const std::vector<nlohmann::json> expected = independent_counts(files);
  ASSERT_EQ(expected.size(), files.size());
  for (std::size_t i = 0; i < files.size(); ++i) {
    SCOPED_TRACE(files[i].string());
    const Result<model::Model> model = read_models(std::span(&files[i], 1), {}, {});
    if (expected[i].contains("refused")) {
      ASSERT_FALSE(model);
      EXPECT_EQ(model.error().code, ErrorCode::input);
      EXPECT_NE(model.error().where.find(files[i].string()), std::string::npos);
      EXPECT_FALSE(model.error().mend.empty());
      std::printf("refused: %s\n", model.error().text().c_str());
      continue;
    }
    ASSERT_TRUE(model) << model.error().text();
    nlohmann::json counted = count(*model);
    counted["file"] = files[i].string();
    EXPECT_EQ(counted, expected[i]);
    EXPECT_GT(model->files[0].precision_mm, 0);
  }
}

}  // namespace
}  // namespace strake::io
