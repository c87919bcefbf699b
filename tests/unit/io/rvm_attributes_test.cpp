// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <string>

#include "io/rvm/attributes.hpp"
#include "strake/io/reader.hpp"
#include "support/io_files.hpp"
#include "support/rvm_writer.hpp"

namespace strake::io {
namespace {

using test::RvmWriter;

constexpr std::string_view kFirstLine =
    "CADC_Attributes_File v1.0 , start: NEW , end: END , name_end: := , sep: &end&\n";

std::string attributes_of(std::string_view blocks) {
  return std::string(kFirstLine) +
         "NEW Header Information\n  Source:= PDMS Data &end& Date:= 1 Jan 2020\nEND\n" +
         std::string(blocks);
}

TEST(RvmAttributes, ParsesBlocksKeysAndValues) {
  const std::string text = attributes_of(
      "NEW /A\n  Name:= '/A' &end& Type:= SITE\n"
      "\tNEW /B\n :EDF.CODE:= \"x:=y\"\n  Derived length (mm):= 12mm\n  Empty:=\n END\n"
      "END\nNEW /C\n nonsense\n NEW /D\n");
  const auto file = rvm::parse_attributes(text);
  ASSERT_TRUE(file) << file.error().text();
  ASSERT_EQ(file->nodes.size(), 4U);
  EXPECT_EQ(file->nodes[0].name, "/A");
  EXPECT_EQ(file->nodes[0].values.size(), 2U);
  EXPECT_EQ(file->nodes[0].values[0].second, "/A");
  EXPECT_EQ(file->nodes[1].parent, 0U);
  EXPECT_EQ(file->nodes[1].values[0].first, ":EDF.CODE");
  EXPECT_EQ(file->nodes[1].values[0].second, "x:=y");
  EXPECT_EQ(file->nodes[1].values[1].first, "Derived length (mm)");
  EXPECT_EQ(file->nodes[1].values[2].second, "");
  EXPECT_EQ(file->nodes[3].parent, 2U);
  EXPECT_EQ(file->unreadable_lines, 1U);
}

/// Cut anywhere: what is left is refused, is told to end early, or holds only whole elements.
TEST(RvmAttributes, WhatIsCutOffIsReported) {
  const std::string text = attributes_of(
      "NEW /A\n Name:= '/A' &end& Type:= SITE\nNEW /B\n k:= 1\nEND\nEND\nNEW /C\n l:= 2\nEND\n");
  ASSERT_FALSE(rvm::parse_attributes(text)->ends_early);
  for (std::size_t length = 0; length < text.size(); ++length) {
    const std::string rest = text.substr(0, length);
    const auto file = rvm::parse_attributes(rest);
    if (!file || file->ends_early) continue;
    int open = 0;
    bool outside = true;  // nothing but blanks since an element closed
    for (std::size_t at = 0; at < rest.size();) {
      const std::size_t end = std::min(rest.find('\n', at), rest.size());
      const std::string line = rest.substr(at, end - at);
      open += line.starts_with("NEW ") ? 1 : line == "END" ? -1 : 0;
      outside = line.empty() || line == "END" || line.starts_with("CADC");
      at = end + 1;
    }
    EXPECT_TRUE(open == 0 && (outside || file->unreadable_lines > 0)) << rest;
  }
}

TEST(RvmAttributes, ObeysTheDeclaredTokens) {
  const auto file = rvm::parse_attributes(
      "AVEVA_Attributes_File v1.0 , start: <<, end: >>, name_end: =, sep: ;\n"
      "<< /A\n k = v ; l = w\n>>\n");
  ASSERT_TRUE(file) << file.error().text();
  ASSERT_EQ(file->nodes.size(), 1U);
  ASSERT_EQ(file->nodes[0].values.size(), 2U);
  EXPECT_EQ(file->nodes[0].values[1].first, "l");
  EXPECT_EQ(file->nodes[0].values[1].second, "w");
}

TEST(RvmAttributes, RefusesOtherFiles) {
  EXPECT_FALSE(rvm::parse_attributes("hello\n"));
  EXPECT_FALSE(rvm::parse_attributes(""));
  EXPECT_NE(rvm::parse_attributes("Data Listing of x\n").error().message.find("listing"),
            std::string::npos);
}

/// Elements without a name of their own are numbered by the source, and so is what is below them.
TEST(RvmAttributes, NumbersOfTheSourceAreNoLastingIds) {
  RvmWriter w;
  w.head().modl();
  w.cntb("/S").prim(9, {1});
  w.cntb("EQUI 12 of ZONE /S").prim(9, {2}).cntb("/N").prim(9, {3}).cnte().cnte();
  w.cntb("12 of 13").prim(9, {4}).cnte().cntb("BOX of 1 of /S").prim(9, {5}).cnte();
  w.cntb("").prim(9, {6}).cnte().cnte();
  w.finish();
  const std::string_view bytes(reinterpret_cast<const char*>(w.bytes().data()), w.bytes().size());
  const auto model = test::read_bytes(*make_rvm_reader(), bytes, "model.rvm");
  ASSERT_TRUE(model) << model.error().text();
  std::vector<bool> positional;
  for (const model::Object& o : model->objects) positional.push_back(o.positional_id);
  EXPECT_EQ(positional, (std::vector<bool>{false, true, true, false, false, true}));
}

/// Two sites that both have a child "/X", one of which also exists elsewhere under another parent.
TEST(RvmAttributes, MatchesByPathThenByUniqueNameAndNeverAmbiguously) {
  const test::TemporaryFolder folder;
  RvmWriter w;
  w.head().modl();
  w.cntb("/S1").cntb("/X").prim(9, {1}).cnte().cnte();
  w.cntb("/S2").cntb("/X").prim(9, {2}).cnte().cntb("/U").prim(9, {3}).cnte().cnte();
  w.cntb("/ELSEWHERE").cntb("/X").prim(9, {4}).cnte().cnte();
  w.finish();
  const auto path = folder.path() / "Model.RVM";
  const std::string_view bytes(reinterpret_cast<const char*>(w.bytes().data()), w.bytes().size());
  std::ofstream(path, std::ios::binary) << bytes;
  std::ofstream(folder.path() / "model.ATT", std::ios::binary)
      << "\xEF\xBB\xBF"
      << attributes_of(
             "NEW /S1\n NEW /X\n RefNo:= =1/1\n k:= one\n END\nEND\n"
             "NEW /S2\n NEW /X\n RefNo:= =0/0\n k:= two\n END\nEND\n"
             "NEW /OTHER\n NEW /U\n Name:= =7/8\n k:= \xC3\xB8\n END\nEND\n");
  const auto model = test::read_bytes(*make_rvm_reader(), bytes, path);
  ASSERT_TRUE(model) << model.error().text();
  ASSERT_EQ(model->objects.size(), 4U);
  EXPECT_EQ(model->objects[0].id, "=1/1");
  EXPECT_EQ(model->objects[0].attributes.back().second, "one");
  EXPECT_EQ(model->objects[1].id, "/S2/X") << "a null reference is no reference";
  EXPECT_EQ(model->objects[1].attributes.back().second, "two");
  EXPECT_EQ(model->objects[2].id, "=7/8") << "found by its name alone";
  EXPECT_EQ(model->objects[2].attributes.back().second, "\xC3\xB8");
  EXPECT_TRUE(model->objects[3].attributes.empty()) << "/X alone is ambiguous";
  ASSERT_EQ(model->diagnostics.count("rvm-attributes-matched"), 1U);
  EXPECT_EQ(model->diagnostics.kept().back().message,
            "5 of 7 groups have attributes; 1 of 6 attribute records belong to no group of the "
            "model");
}

/// A branch without primitives of its own, and an equipment that has some and holds a nozzle.
TEST(RvmAttributes, GroupsThatHoldOthersHaveTheirs) {
  const test::TemporaryFolder folder;
  RvmWriter w;
  w.head().modl();
  w.cntb("/B1").cntb("ELBOW 1").prim(9, {1}).cnte().cntb("FLANGE 1").prim(9, {2}).cnte().cnte();
  w.cntb("/E1").prim(9, {3}).cntb("NOZZLE 1").prim(9, {4}).cnte().cnte();
  w.finish();
  static_cast<void>(folder.write(
      "m.att", attributes_of("NEW /B1\n Tref:= =7/8\n Area:= 3\n"
                             "NEW ELBOW 1\n Area:= 4\n END\nNEW FLANGE 1\n k:= 1\n END\nEND\n"
                             "NEW /E1\n Area:= 5\nNEW NOZZLE 1\n Name:= =7/8\n END\nEND\n")));
  const std::string_view bytes(reinterpret_cast<const char*>(w.bytes().data()), w.bytes().size());
  const auto model = test::read_bytes(*make_rvm_reader(), bytes, folder.path() / "m.rvm");
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(model->group_attributes.size(), 2U) << "once for all objects below";
  const auto value = [&](const std::string& name, std::string_view attribute) {
    for (const model::Object& o : model->objects) {
      const model::Attributes* const stated = model->stated(o, attribute).attributes;
      if (o.name != name || stated == nullptr) continue;
      for (const auto& [key, text] : *stated)
        if (key == attribute) return text;
    }
    return std::string();
  };
  EXPECT_EQ(value("FLANGE 1", "Tref"), "=7/8");
  EXPECT_EQ(value("FLANGE 1", "Area"), "3");
  EXPECT_EQ(value("ELBOW 1", "Area"), "4");
  EXPECT_EQ(value("NOZZLE 1", "Area"), "5") << "from an object";
  EXPECT_EQ(value("NOZZLE 1", "Tref"), "");
}

TEST(RvmAttributes, ABadAttributeFileDoesNotCostTheModel) {
  const test::TemporaryFolder folder;
  RvmWriter w;
  w.head().modl().cntb("/A").prim(9, {1}).cnte().finish();
  static_cast<void>(folder.write("m.txt", "shopping list\n"));
  const std::string_view bytes(reinterpret_cast<const char*>(w.bytes().data()), w.bytes().size());
  const auto model = test::read_bytes(*make_rvm_reader(), bytes, folder.path() / "m.rvm");
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_EQ(model->diagnostics.count("rvm-attributes-unread"), 1U);
}

}  // namespace
}  // namespace strake::io
