// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cli/options/options.hpp"

namespace strake::cli {
namespace {

/// The unit of each file in mm, 0 where none is said; or the error.
struct Units {
  std::vector<double> mm;
  std::string error;
};

Units units(const std::vector<std::string>& files, const std::vector<std::string>& stated) {
  InputOptions options;
  options.files = files;
  options.units = stated;
  const auto read = files_to_read(options);
  if (!read) return {{}, read.error().text()};
  Units found;
  for (const io::FileToRead& file : *read) found.mm.push_back(file.options.unit_mm.value_or(0));
  return found;
}

using Numbers = std::vector<double>;

TEST(FilesToRead, AUnitIsOfAllFilesOrOfOne) {
  const std::vector<std::string> files{"x/a.stl", "b.stl"};
  EXPECT_EQ(units(files, {}).mm, (Numbers{0, 0}));
  EXPECT_EQ(units(files, {"m"}).mm, (Numbers{1000, 1000}));
  EXPECT_EQ(units(files, {"b.stl=m"}).mm, (Numbers{0, 1000}));
  EXPECT_EQ(units(files, {"a.stl=m", "b.stl=in"}).mm, (Numbers{1000, 25.4}));
}

TEST(FilesToRead, WhatIsStatedOfOneGoesBeforeWhatIsStatedOfAll) {
  EXPECT_EQ(units({"a.stl", "b.stl"}, {"a.stl=m", "in"}).mm, (Numbers{1000, 25.4}));
  EXPECT_EQ(units({"a.stl", "b.stl"}, {"in", "a.stl=m"}).mm, (Numbers{1000, 25.4}));
}

TEST(FilesToRead, AFileIsNamedByItsPathOrTheEndOfIt) {
  const std::vector<std::string> files{"/p/x/a.stl", "/p/y/a.stl", "a.stl", "/p/xb.stl"};
  EXPECT_EQ(units(files, {"x/a.stl=m"}).mm, (Numbers{1000, 0, 0, 0}));
  EXPECT_EQ(units(files, {"/p/y/a.stl=m"}).mm, (Numbers{0, 1000, 0, 0}));
  EXPECT_EQ(units(files, {"./a.stl=m"}).mm, (Numbers{0, 0, 1000, 0}));
  EXPECT_EQ(units(files, {"/p/z/../x/a.stl=m"}).mm, (Numbers{1000, 0, 0, 0}));
  EXPECT_NE(units(files, {"b.stl=m"}).error.find("none of the files"), std::string::npos);
  EXPECT_EQ(units({"a.stl", "./a.stl"}, {"a.stl=m"}).mm, (Numbers{1000, 1000}));
}

TEST(FilesToRead, NamesMayHoldEqualsSigns) {
  EXPECT_EQ(units({"rev=2/a=b.stl", "b.stl"}, {"a=b.stl=m"}).mm, (Numbers{1000, 0}));
  EXPECT_EQ(units({"rev=2/a=b.stl", "b.stl"}, {"rev=2/a=b.stl=m"}).mm, (Numbers{1000, 0}));
}

TEST(FilesToRead, WhatIsStatedInVainIsAnErrorThatStatesWhat) {
  const std::vector<std::string> files{"x/a.stl", "y/a.stl"};
  const auto expect_error = [&](const std::vector<std::string>& stated, const std::string& part) {
    const std::string error = units(files, stated).error;
    EXPECT_NE(error.find(part), std::string::npos) << error;
    EXPECT_NE(error.find("--unit"), std::string::npos) << error;
  };
  expect_error({"c.stl=m"}, "'c.stl' is none of the files");
  expect_error({"=m"}, "'' is none of the files");
  expect_error({"a.stl=m"}, "may be x/a.stl or y/a.stl");
  expect_error({"x/a.stl="}, "is not a unit of length");
  expect_error({"x/a.stl=cubit"}, "'cubit'");
  expect_error({"m", "mm"}, "more than once");
  expect_error({"x/a.stl=m", "./x/a.stl=mm"}, "more than once for x/a.stl");
}

TEST(FilesToRead, TheUpwardAxisIsStatedAlike) {
  InputOptions options;
  options.files = {"a.stl", "b.stl", "c.stl"};
  options.up_axes = {"y", "b.stl=x", "c.stl=z"};
  const auto read = files_to_read(options);
  ASSERT_TRUE(read);
  EXPECT_EQ((*read)[0].options.up_axis, io::UpAxis::y);
  EXPECT_EQ((*read)[1].options.up_axis, io::UpAxis::x);
  EXPECT_EQ((*read)[2].options.up_axis, io::UpAxis::z);
  options.up_axes = {"b.stl=q"};
  EXPECT_FALSE(files_to_read(options));
}

}  // namespace
}  // namespace strake::cli
