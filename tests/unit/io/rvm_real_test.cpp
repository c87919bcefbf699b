// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>

#include "strake/io/reader.hpp"
#include "support/io_files.hpp"

namespace strake::io {
namespace {

/// What scripts/count_rvm.py, which shares no code with the reader, says about a file.
nlohmann::json counted_by_script(const std::filesystem::path& file) {
  const std::string command =
      "python3 '" STRAKE_SOURCE_DIR "/scripts/count_rvm.py' '" + file.string() + "'";
  std::string output;
  FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  std::array<char, 4096> buffer{};
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    output.append(buffer.data(), n);
  pclose(pipe);
  return nlohmann::json::parse(output, nullptr, false);
}

std::map<std::string, std::uint64_t> kinds_of(const model::Model& model) {
  std::map<std::string, std::uint64_t> kinds;
  for (const model::Body& body : model.bodies) {
    const model::Shape& shape = model.shapes[model::index(body.shape)];
    const auto* primitive = std::get_if<geometry::Primitive>(&shape);
    ++kinds[primitive ? std::string(geometry::kind_name(*primitive)) : "facet_group"];
  }
  return kinds;
}

class RvmRealFile : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const auto data = test::data_folder();
    if (!data) GTEST_SKIP() << "STRAKE_DATA is not set";
    path_ = *data / "rvm" / GetParam();
    if (!std::filesystem::exists(path_)) GTEST_SKIP() << path_ << " is absent";
  }
  std::filesystem::path path_;
};

TEST_P(RvmRealFile, CountsEqualAnIndependentCount) {
  const auto expected = counted_by_script(path_);
  if (!expected.is_object()) GTEST_SKIP() << "python3 is absent";
  std::ifstream in(path_, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const auto model = test::read_bytes(*make_rvm_reader(), bytes, path_);
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(model->groups.size(), expected["groups"]);
  EXPECT_EQ(model->objects.size(), expected["objects"]);
  // Some tori have neither width nor height, some cylinders no radius: skipped, and said so.
  const std::uint64_t skipped = model->diagnostics.count("rvm-bad-primitive");
  EXPECT_EQ(model->bodies.size() + skipped, expected["primitives"]);
  EXPECT_EQ(model->diagnostics.skipped(), skipped);
  std::uint64_t missing = 0;
  const auto kinds = kinds_of(*model);
  for (const auto& [kind, count] : expected["kinds"].items())
    missing += count.get<std::uint64_t>() - (kinds.contains(kind) ? kinds.at(kind) : 0);
  EXPECT_EQ(missing, skipped);
  std::uint64_t triangles = 0;
  for (const model::Body& body : model->bodies) {
    const auto* mesh =
        std::get_if<geometry::TriangleMesh>(&model->shapes[model::index(body.shape)]);
    if (mesh != nullptr) triangles += mesh->triangles.size();
  }
  EXPECT_EQ(triangles, expected["facet_triangles"]);
  EXPECT_EQ(model->diagnostics.count("rvm-facet-polygon"), 0U);
}

INSTANTIATE_TEST_SUITE_P(
    Files, RvmRealFile,
    ::testing::Values("equinor_rvmsharp/WD1-PSUP.RVM", "benvautrin_pmuc/plm-sample_11072013.rvm",
                      "vegarringdal_rvm2glb/HA-ARCH.RVM", "vegarringdal_rvm2glb/HA-HVAC.RVM",
                      "vegarringdal_rvm2glb/HA-MECH.RVM", "vegarringdal_rvm2glb/HA-SAFE.RVM"),
    [](const auto& param_info) { return std::to_string(param_info.index); });

}  // namespace
}  // namespace strake::io
