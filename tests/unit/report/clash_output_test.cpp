// SPDX-License-Identifier: Apache-2.0
// What of a clash result is written, and in what form: attributes, forms of CSV, some classes only.
#include <gtest/gtest.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "report/text/csv.hpp"
#include "strake/report/clash.hpp"
#include "strake/report/clash_document.hpp"
#include "support/clash_model.hpp"
#include "support/row_of_boxes.hpp"

namespace strake::report {
namespace {

using nlohmann::json;
using test::ClashModel;
using test::findings_up_to_25_mm;

template <class Write>
std::string written(Write&& write, const ClashContents& contents) {
  std::string text;
  EXPECT_TRUE(write(contents, [&](std::string_view piece) { text += piece; }, {}));
  return text;
}

/// The first of the boxes inherits a tag, the second has one itself.
ClashModel tagged_boxes() {
  ClashModel m = test::row_of_boxes();
  m.model.groups.push_back({"plant", model::GroupId::none});
  m.model.set_attributes(model::GroupId{0}, {{"Tag", "of all"}, {"Area", "A;1"}});
  for (model::Object& object : m.model.objects) object.parent = model::GroupId{0};
  m.model.objects[1].attributes = {{"Tag", "=1+1"}, {"Tag", "second"}};
  return m;
}

std::vector<std::string> lines_of(const std::string& csv) {
  std::vector<std::string> lines;
  std::istringstream in(csv);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(ClashColumns, AreTheLastOfCsvInTheirOrder) {
  const ClashModel m = tagged_boxes();
  const clash::Findings findings = findings_up_to_25_mm(m);
  ClashContents contents{findings, m.model};
  const std::vector<std::string> plain = lines_of(written(write_clash_csv, contents));
  contents.columns = {"Area", "Tag", "None"};
  const std::vector<std::string> lines = lines_of(written(write_clash_csv, contents));
  ASSERT_EQ(lines.size(), 4U);
  const auto with = [&](std::size_t line, std::string_view more) {
    return plain[line].substr(0, plain[line].size() - 1) + std::string(more) + "\r";
  };
  EXPECT_EQ(lines[0], with(0, ",a_@Area,b_@Area,a_@Tag,b_@Tag,a_@None,b_@None"));
  EXPECT_EQ(lines[1], with(1, ",\"A;1\",\"A;1\",of all,\"'=1+1; second\",,"));
  EXPECT_EQ(lines[3], with(3, ",\"A;1\",\"A;1\",of all,of all,,"));
}

TEST(ClashColumns, AreAttributesOfBothInJson) {
  const ClashModel m = tagged_boxes();
  const clash::Findings findings = findings_up_to_25_mm(m);
  ClashContents contents{findings, m.model};
  EXPECT_EQ(written(write_clash_json, contents).find("attributes"), std::string::npos);
  contents.columns = {"Tag", "None"};
  const json hit = json::parse(written(write_clash_json, contents))["results"][0];
  EXPECT_EQ(hit["a"]["attributes"], json({{"Tag", "of all"}}));
  EXPECT_EQ(hit["b"]["attributes"], json({{"Tag", "=1+1; second"}}));
}

TEST(ClashCsv, HasTheFormThatASpreadsheetOpens) {
  const ClashModel m = tagged_boxes();
  const clash::Findings findings = findings_up_to_25_mm(m);
  ClashContents contents{findings, m.model};
  const std::string plain = written(write_clash_csv, contents);
  contents.csv = {.mark = true};
  EXPECT_EQ(written(write_clash_csv, contents), "\xEF\xBB\xBF" + plain);
  contents.csv = {.separator = ';', .decimal = ','};
  contents.columns = {"Area"};
  const std::string european = written(write_clash_csv, contents);
  EXPECT_TRUE(european.starts_with("a_id;a_name;a_file;b_id;")) << european;
  EXPECT_NE(european.find("\r\na;a;t.obj;b;b;t.obj;HIT;INTERFERE;-20,5;"), std::string::npos)
      << european;
  EXPECT_NE(european.find(";\"A;1\";\"A;1\"\r\n"), std::string::npos) << european;
  contents.csv = {.separator = '\t'};
  EXPECT_NE(written(write_clash_csv, contents).find("HIT\tINTERFERE\t-20.5\t"), std::string::npos);
}

TEST(ClashCsv, TheLogOfPairsHasTheSameForm) {
  const ClashModel m = tagged_boxes();
  const clash::Findings findings{{m.detect({.engine = {.log_pairs = true}})}, {}};
  const std::string log =
      written(write_pair_log,
              {.findings = findings, .model = m.model, .csv = {.separator = ';', .mark = true}});
  EXPECT_TRUE(log.starts_with("\xEF\xBB\xBFtest;a_id;a_name;")) << log;
}

TEST(ClashClasses, LeaveOthersOutAndReportIt) {
  const ClashModel m = tagged_boxes();
  clash::Findings findings = findings_up_to_25_mm(m);
  const WrittenClasses classes{.contact = false, .clearance_violation = false};
  leave_out_others(findings, classes);
  ASSERT_EQ(findings.tests[0].pairs.size(), 1U);
  EXPECT_EQ(findings.tests[0].count_contact, 1U);
  const std::string table = clash_table({findings, m.model}, {});
  EXPECT_NE(
      table.find("1 hit, 1 contact (1 left out by class), 1 clearance violation (1 left out by "
                 "class)\n"),
      std::string::npos)
      << table;
  const std::string text =
      written(write_clash_json, {.findings = findings, .model = m.model, .classes = classes});
  EXPECT_EQ(json::parse(text)["classes"], json({"HIT"}));
  EXPECT_EQ(json::parse(text)["results"].size(), 1U);
  EXPECT_EQ(json::parse(text)["tests"][0]["counts"]["CONTACT"], 1);
}

TEST(ClashClasses, KeepWhatMayBeOfOneOfThem) {
  const ClashModel m = tagged_boxes();
  clash::Findings findings = findings_up_to_25_mm(m);
  findings.tests[0].pairs[1].severest = clash::Class::hit;
  leave_out_others(findings, {.contact = false, .clearance_violation = false});
  ASSERT_EQ(findings.tests[0].pairs.size(), 2U);
  EXPECT_EQ(findings.tests[0].pairs[1].cls, clash::Class::contact);
}

TEST(ClashClasses, AreNoDocumentToCompareWith) {
  const ClashModel m = tagged_boxes();
  clash::Findings findings = findings_up_to_25_mm(m);
  const WrittenClasses classes{.contact = false};
  leave_out_others(findings, classes);
  std::istringstream in(
      written(write_clash_json, {.findings = findings, .model = m.model, .classes = classes}));
  const Result<ClashDocument> document = parse_clash_document(in, "hits.json");
  ASSERT_FALSE(document);
  EXPECT_NE(document.error().message.find("--class"), std::string::npos)
      << document.error().message;
}

TEST(Csv, ValuesThatAreNumbersHaveNoApostrophe) {
  const auto written = [](std::string_view text) {
    std::string out;
    CsvRow(out, {}).value(text);
    return out;
  };
  for (const char* const number : {"-1500", "+2.5", "-.5", "-1.5e-3", "-2E+4"})
    EXPECT_EQ(written(number), number);
  for (const char* const text : {"-1500+2", "-", "-.", "-1e", "-1.5.2", "=1", "-1 m", "@SUM"})
    EXPECT_EQ(written(text), "'" + std::string(text));
}

}  // namespace
}  // namespace strake::report
