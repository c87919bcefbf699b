// SPDX-License-Identifier: Apache-2.0
// Ends that meet in a real plant, where STRAKE_DATA names the folder that holds it, beside the
// joints that its attributes name.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "model/ends/end_joints.hpp"
#include "strake/io/reader.hpp"
#include "support/io_files.hpp"
#include "support/rules_models.hpp"

namespace strake::rules {
namespace {

constexpr const char* kEnds = "[[connected]]\nname = 'ends'\nends_within = '5mm'\n";
constexpr const char* kReferences =
    "[[connected]]\nname = 'references'\nhead = 'Href'\ntail = 'Tref'\nattributes = 'Cref'\n"
    "groups = true\n";

TEST(RealJoints, MostThatAttributesNameAreFoundByTheirEnds) {
  const auto folder = test::data_folder();
  if (!folder) GTEST_SKIP() << "STRAKE_DATA is not set";
  const std::vector<std::filesystem::path> files{*folder / "rvm" / "benvautrin_pmuc" /
                                                 "plm-sample_11072013.rvm"};
  const auto model = io::read_models(files, {}, {});
  ASSERT_TRUE(model) << model.error().text();
  const auto scene = make_scene(*model, {}, {}).value();
  const auto ends = model::ends_of(scene, std::vector<bool>(model->objects.size(), true));
  // As many as a program of its own counts for the primitives alone; meshes have more.
  EXPECT_GE(model::joints_of(ends, 5000, {}).value().size(), 87U);
  const auto by_references = test::run_rules(*model, kReferences);
  EXPECT_EQ(test::exempted(by_references.reports.at(0)), (test::Counts{{"references", 14}}));
  const auto both = test::run_rules(*model, std::string(kEnds) + kReferences);
  const test::Counts counts = test::exempted(both.reports.at(0));
  EXPECT_GE(counts.at(0).second, 80U);
  EXPECT_LE(counts.at(1).second, 3U);
}

}  // namespace
}  // namespace strake::rules
