// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "strake/rules/rules.hpp"

namespace strake::rules {
namespace {

TEST(FileSettings, AreReadInTheOrderOfTheFile) {
  const auto rules = Rules::parse(
      "[[file]]\nname = '*.stl'\nunit = 'm'\nup_axis = 'y'\n[[file]]\nname = 'b.obj'\nunit = 'in'\n"
      "[[file]]\nname = 'c*'\nup_axis = 'x'",
      "r.toml");
  ASSERT_TRUE(rules) << rules.error().text();
  const auto files = rules->files();
  ASSERT_EQ(files.size(), 3U);
  EXPECT_EQ(files[0].name, "*.stl");
  EXPECT_EQ(files[0].unit_mm, 1000.0);
  EXPECT_EQ(files[0].up_axis, 'y');
  EXPECT_EQ(files[1].unit_mm, 25.4);
  EXPECT_FALSE(files[1].up_axis.has_value());
  EXPECT_FALSE(files[2].unit_mm.has_value());
  EXPECT_EQ(files[2].where, "r.toml, line 8: [[file]] 'c*'");
  EXPECT_TRUE(Rules::parse("", "r.toml")->files().empty());
}

TEST(FileSettings, AreOfFilesByNameOrWithFolders) {
  const auto is_of = [](const std::string& pattern, const std::string& path) {
    FileSettings file;
    file.name = pattern;
    return file.is_of(path);
  };
  EXPECT_TRUE(is_of("*.stl", "/p/hull/a.stl"));
  EXPECT_TRUE(is_of("a.stl", "a.stl"));
  EXPECT_TRUE(is_of("?.s[tv]l", "x/../b.stl"));
  EXPECT_FALSE(is_of("a.stl", "/p/ba.stl"));
  EXPECT_FALSE(is_of("hull", "/p/hull/a.stl"));
  EXPECT_TRUE(is_of("hull/*", "/p/hull/a.stl"));
  EXPECT_TRUE(is_of("p/hull/a.stl", "/p/hull/a.stl"));
  EXPECT_TRUE(is_of("/p/hull/a.stl", "/p/hull/a.stl"));
  EXPECT_FALSE(is_of("/hull/a.stl", "/p/hull/a.stl"));
  EXPECT_FALSE(is_of("pipes/*", "/p/hull/a.stl"));
  EXPECT_TRUE(is_of("*/a.stl", "a.stl")) << "in whatever folder the run is";
  EXPECT_FALSE(is_of("x/y/z/p/hull/a.stl", "/p/hull/a.stl"));
}

TEST(FileSettings, FaultsNamePlaceAndMend) {
  for (const auto& [text, fault] : std::vector<std::pair<std::string, std::string>>{
           {"[[file]]\nunit = 'm'", "r.toml, line 1, column 1: [[file]] has no 'name'"},
           {"[[file]]\nname = 'a'",
            "[[file]] 'a' says nothing of the file (write unit = \"m\", or up_axis = \"y\")"},
           {"[[file]]\nname = 'a'\nunit = 'cubit'",
            "r.toml, line 3, column 8: 'unit' of [[file]] 'a': 'cubit' is not a unit of length"},
           {"[[file]]\nname = 'a'\nunit = 1000",
            "is a whole number, not a unit of length in quotes, as \"m\""},
           {"[[file]]\nname = 'a'\nup_axis = 'up'", "write one of \"x\", \"y\", \"z\""},
           {"[file]\nname = 'a'", "write [[file]] with double brackets"}}) {
    const auto rules = Rules::parse(text, "r.toml");
    ASSERT_FALSE(rules) << text;
    EXPECT_NE(rules.error().text().find(fault), std::string::npos) << rules.error().text();
  }
}

}  // namespace
}  // namespace strake::rules
