// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "report/clash/group_numbers.hpp"
#include "strake/clash/group.hpp"
#include "strake/parallel/team.hpp"
#include "strake/report/clash.hpp"
#include "support/clash_model.hpp"
#include "support/row_of_boxes.hpp"
#include "support/zip_reader.hpp"
#include "workbook/clash/clash_sheets.hpp"
#include "workbook/clash/picture_sheet.hpp"
#include "workbook/workbook_writers.hpp"

namespace strake::workbook {
namespace {

using report::ClashContents;
using test::ClashModel;
using test::findings_up_to_25_mm;
using test::row_of_boxes;

std::string written(const ClashContents& contents, const parallel::Context& context = {}) {
  std::string bytes;
  EXPECT_TRUE(write_clash_workbook(contents, [&](std::string_view s) { bytes += s; }, context));
  return bytes;
}

bool has(std::string_view text, std::string_view part) { return text.find(part) != text.npos; }

/// The smallest PNG there is, but for its size: 16 x 12 it says.
std::string tiny_png() {
  return std::string("\x89PNG\r\n\x1A\n\0\0\0\rIHDR\0\0\0\x10\0\0\0\x0C\x08\2\0\0\0", 29);
}

TEST(ClashWorkbook, HasASummaryAndTheResultsWithFilterColoursAndAListOfStatuses) {
  const ClashModel m = row_of_boxes();
  const clash::Findings findings = findings_up_to_25_mm(m);
  auto files = test::files_of_zip(written({findings, m.model}));
  ASSERT_TRUE(files.contains("[Content_Types].xml"));
  EXPECT_TRUE(has(files["xl/workbook.xml"], "<sheet name=\"Summary\" sheetId=\"1\""));
  EXPECT_TRUE(has(files["xl/workbook.xml"], "<sheet name=\"Clashes\" sheetId=\"2\""));
  const std::string& sheet = files["xl/worksheets/sheet2.xml"];
  EXPECT_TRUE(has(sheet, "state=\"frozen\"")) << sheet;
  EXPECT_TRUE(has(sheet, "<v>-20.5</v>")) << sheet;
  EXPECT_TRUE(has(sheet, "<autoFilter ref=\"A1:AP4\"/>")) << sheet;
  EXPECT_TRUE(has(sheet, "sqref=\"G2:G4\"")) << sheet;
  EXPECT_TRUE(has(sheet, "<formula1>\"new,active,reviewed,approved,resolved\"</formula1>"));
  EXPECT_FALSE(files.contains("xl/worksheets/sheet3.xml"));
}

TEST(ClashWorkbook, BytesAreThoseOfAnyTeam) {
  ClashModel m;
  for (int i = 0; i < 3000; ++i)
    m.box("box " + std::to_string(i), {i * 90.0, 0, 0}, {i * 90.0 + 100, 100, 100});
  const clash::Findings findings = findings_up_to_25_mm(m);
  ASSERT_GT(findings.tests[0].pairs.size(), 2048U);
  const std::string one = written({findings, m.model});
  for (const unsigned threads : {2U, 3U, 8U}) {
    parallel::Team team(threads);
    EXPECT_TRUE(written({findings, m.model}, {.team = &team}) == one) << threads;
  }
}

TEST(ClashWorkbook, GroupsAndPicturesHaveSheets) {
  const ClashModel m = row_of_boxes();
  const clash::Findings findings = findings_up_to_25_mm(m);
  const Result<clash::Grouping> grouping =
      clash::group_results(findings, m.model, {.by = clash::GroupBy::element});
  ASSERT_TRUE(grouping);
  ClashContents contents{.findings = findings, .model = m.model, .grouping = &*grouping};
  std::vector<clash::ResultRef> requested;
  contents.picture_of = [&](const clash::ResultRef& r,
                            const parallel::Context&) -> Result<std::string> {
    requested.push_back(r);
    return r.pair == 2 ? std::string() : tiny_png();
  };
  auto files = test::files_of_zip(written(contents));
  // The worst first; the contact is none of them, and of the other there is no picture.
  EXPECT_EQ(requested, (std::vector<clash::ResultRef>{{0, 0}, {0, 2}}));
  EXPECT_TRUE(has(files["xl/workbook.xml"], "name=\"Pictures\" sheetId=\"3\""));
  EXPECT_TRUE(has(files["xl/workbook.xml"], "name=\"Groups\" sheetId=\"4\""));
  EXPECT_EQ(files["xl/media/image1.png"], tiny_png());
  EXPECT_FALSE(files.contains("xl/media/image2.png"));
  const std::string& drawing = files["xl/drawings/drawing3.xml"];
  EXPECT_TRUE(has(drawing, "<xdr:row>1</xdr:row>")) << drawing;
  EXPECT_TRUE(has(drawing, "cx=\"3048000\" cy=\"2286000\"")) << drawing;
  const std::string& sheet = files["xl/worksheets/sheet3.xml"];
  EXPECT_TRUE(has(sheet, "<drawing r:id=\"rId1\"/>"));
  EXPECT_TRUE(has(sheet, "defaultRowHeight=\"190\" customHeight=\"1\"")) << sheet;
  EXPECT_TRUE(has(sheet, "<row r=\"1\" ht=\"15\" customHeight=\"1\">")) << sheet;
  EXPECT_TRUE(has(sheet, "<row r=\"2\">")) << sheet;
}

TEST(ClashWorkbook, WhatAPictureFailsByIsTheErrorOfTheWriter) {
  const ClashModel m = row_of_boxes();
  const clash::Findings findings = findings_up_to_25_mm(m);
  ClashContents contents{findings, m.model};
  contents.picture_of = [](const clash::ResultRef&, const parallel::Context&) {
    return Result<std::string>(Error{ErrorCode::memory, "no memory", {}, {}});
  };
  const Status status = write_clash_workbook(contents, [](std::string_view) {});
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::memory);
}

TEST(ClashWorkbook, RowsThatASheetCannotHaveStandOnFurtherOnes) {
  const ClashModel m = row_of_boxes();
  const clash::Findings findings = findings_up_to_25_mm(m);
  const ClashContents contents{findings, m.model};
  const report::GroupNumbers numbers(contents);
  std::vector<Worksheet> sheets;
  append_split(sheets, clash_sheet(contents, numbers), 2);
  ASSERT_EQ(sheets.size(), 2U);
  EXPECT_EQ(sheets[0].name, "Clashes");
  EXPECT_EQ(sheets[1].name, "Clashes 2");
  EXPECT_EQ(sheets[1].rows, 1U);
  std::string third;
  SheetRow row(third, 1);
  sheets[1].cells(0, row);
  EXPECT_TRUE(has(third, "CLEARANCE_VIOLATION")) << third;
}

TEST(ClashWorkbook, ACancelledRunIsAnError) {
  const ClashModel m = row_of_boxes();
  const clash::Findings findings = findings_up_to_25_mm(m);
  const std::stop_source stop;
  stop.request_stop();
  const Status status = write_clash_workbook({findings, m.model}, [](std::string_view) {},
                                             {.stop = stop.get_token()});
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace strake::workbook
