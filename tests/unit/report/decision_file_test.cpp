// SPDX-License-Identifier: Apache-2.0
// How a file of decisions is read.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <string_view>

#include "report/text/csv_table.hpp"
#include "support/decided.hpp"

namespace strake::report {
namespace {

using test::error_of;
using test::parsed;

TEST(CsvTable, GivesBackWhatItReads) {
  for (const std::string_view text : {"a,b\r\n1,\"x \"\"y\"\"\nz\"\r\n",
                                      "\xEF\xBB\xBF"
                                      "a;b;c\n\n;;\n1;2",
                                      "a\tb\rc\td\r", "", "a"}) {
    const Result<CsvTable> table = parse_csv_table(text, "t.csv");
    ASSERT_TRUE(table) << text;
    EXPECT_EQ(csv_text(*table), text);
  }
}

TEST(CsvTable, ReadsWhateverIsLeftOfAFile) {
  const std::string whole = "\xEF\xBB\xBFkey;status;\"x\"\"y\"\r\n1;\"2\n3\";4\r5;;\n";
  std::size_t read = 0;
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    const std::string text = whole.substr(0, length);
    const Result<CsvTable> table = parse_csv_table(text, "t.csv");
    if (!table) continue;
    ++read;
    EXPECT_EQ(csv_text(*table), text);
    (void)parse_decisions(text, "t.csv");
  }
  EXPECT_GT(read, whole.size() / 2);
}

TEST(CsvTable, KnowsTheSeparatorAndTheLines) {
  const CsvTable table = parse_csv_table("key;\"a,b,c\";x\n\"1\n2\";3;4\n5;6;7\n", "t.csv").value();
  EXPECT_EQ(table.separator, ';');
  ASSERT_EQ(table.records.size(), 3U);
  EXPECT_EQ(table.records[1].line, 2U);
  EXPECT_EQ(table.records[2].line, 4U) << "a cell has a line break";
  EXPECT_EQ(cell_text(table.records[0].cells[1]), "a,b,c");
  EXPECT_EQ(cell_text("\"say \"\"no\"\"\""), "say \"no\"");
}

TEST(CsvTable, RefusesWhatIsNoCsv) {
  const auto error = [](std::string_view text) {
    const Result<CsvTable> table = parse_csv_table(text, "t.csv");
    return table ? "no error" : table.error().text();
  };
  EXPECT_EQ(
      error("a,b\n1,\"2\n"),
      "t.csv, line 2: a quote is not closed (end the cell with a quote; one within it is written "
      "twice)");
  EXPECT_EQ(
      error("a,b\n1,2\n\"3\"4,5\n"),
      "t.csv, line 3: there is text behind a quoted cell (write a quote within a cell twice)");
  EXPECT_EQ(error("a\nM\xFCller\n"),
            "t.csv, line 2: is not UTF-8 (save it in the spreadsheet as 'CSV UTF-8')");
}

TEST(Decisions, AreReadInAnyFormThatASpreadsheetWrites) {
  const std::string key(26, '0');
  for (const std::string& text :
       {"key,status,by,date,comment,d_mm\r\n" + key + ",Approved,Ann,2026-01-31,\"a, b\",-5.5\r\n",
        "\xEF\xBB\xBFKEY;Date;Status;Owner;By;Comment;d_mm\n" + key +
            ";31.1.2026;APPROVED;x;Ann;a, b;-5,5\n;;;;;;\n",
        "comment\tkey\tstatus\tby\tdate\td_mm\na, b\t" + key +
            "\tapproved\tAnn\t31.01.2026\t-5.5"}) {
    const DecisionFile file = parsed(text);
    ASSERT_EQ(file.decisions.size(), 1U) << text;
    const Decision& d = file.decisions[0];
    EXPECT_EQ(d.status, DecisionStatus::approved);
    EXPECT_EQ(d.by + "|" + d.date + "|" + d.comment, "Ann|2026-01-31|a, b");
    EXPECT_EQ(d.d_mm, -5.5);
    EXPECT_EQ(d.line, 2U);
  }
}

TEST(Decisions, ReportWhereAFileIsWrong) {
  const std::string key(26, '0'), head = "key,status,date,d_mm\n";
  EXPECT_TRUE(
      error_of("key,state\n")
          .starts_with(
              "d.csv, line 1: has no column 'status' but 'key', 'state' (write the headings"));
  EXPECT_TRUE(error_of("").starts_with("d.csv, line 1: is empty ("));
  EXPECT_TRUE(
      error_of("key,status,Key\n").starts_with("d.csv, line 1: has the column 'key' twice ("));
  EXPECT_EQ(error_of(head + "x,new,,\n"),
            "d.csv, line 2: 'x' is no key (a key is the 26 letters and digits that results have as "
            "'key')");
  for (const char* const rest : {",approved,,", ",,2026-01-31,", ",,,-5"})
    EXPECT_EQ(error_of(head + rest + "\n"),
              "d.csv, line 2: the row has no key (write the 26 letters and digits that its result "
              "has as 'key', or empty the row)")
        << rest;
  EXPECT_EQ(
      error_of(head + key + ",done,,\n"),
      "d.csv, line 2: 'done' is no status (write new, active, reviewed, approved or resolved)");
  for (const char* const date : {"2026-02-30", "1/2/2026", "yesterday", "31.13.2026", "2026-1"})
    EXPECT_EQ(
        error_of(head + key + ",new," + date + ",\n"),
        "d.csv, line 2: '" + std::string(date) + "' is no date (write 2026-01-31, or 31.1.2026)");
  EXPECT_EQ(error_of(head + key + ",new,,\n\n" + key + ",new,,\n"),
            "d.csv, line 4: the key stands in line 2 already (keep one of the two rows)");
  EXPECT_EQ(error_of(head + key + ",new,,deep\n").substr(0, 34),
            "d.csv, line 2: 'deep' is no number");
  EXPECT_EQ(error_of(head + key + ",new,,1,and more\n").substr(0, 67),
            "d.csv, line 2: the row has more cells than there are headings (put ");
}

TEST(Decisions, HaveNumbersThatCannotBeMistaken) {
  const std::string key(26, '0'), head = "key,status,regions,d_mm\n";
  for (const char* const places : {"0.5", "-3", "1.9", "1e99"})
    EXPECT_EQ(error_of(head + key + ",approved," + places + ",-5\n"),
              "d.csv, line 2: '" + std::string(places) +
                  "' is no number of places (write as many places as the result had, or nothing)");
  EXPECT_EQ(parsed(head + key + ",approved,0,-5\n").decisions[0].regions, 0U);
  EXPECT_EQ(parsed(head + key + ",approved,2.0,-5\n").decisions[0].regions, 2U);
  EXPECT_EQ(
      error_of(head + key + ",approved,,\"1,234\"\n"),
      "d.csv, line 2: '1,234' has a comma (write numbers as 1234.5, without commas, in a file "
      "separated by commas)");
  EXPECT_EQ(parsed("key\tstatus\td_mm\n" + key + "\tapproved\t-1,5\n").decisions[0].d_mm, -1.5);
  EXPECT_EQ(error_of("key,status,class\n" + key + ",approved,clash\n"),
            "d.csv, line 2: 'clash' is no class (write HIT, CONTACT or CLEARANCE_VIOLATION, or "
            "nothing)");
}

TEST(Decisions, AreNotInRowsThatStateNothing) {
  const std::string key(26, '0');
  EXPECT_TRUE(parsed("key,status,note\n,,a word\n , ,\n").decisions.empty());
  EXPECT_TRUE(parsed("key,status,class,test\n,,EXEMPTED,t\n").decisions.empty())
      << "a CSV of results has pairs that rules exempt, without keys";
}

TEST(Decisions, NameObjectsAsTheyAreCalled) {
  const std::string key(26, '0');
  const Decision row = parsed("key,status,test,a_file,a_id,a_name,b_file,b_id,b_name\n" + key +
                              ",new, t ,\"f \",'a,'-x,'=1,b,' +y\n")
                           .decisions.at(0);
  EXPECT_EQ(row.test + "|" + row.a.file + "|" + row.a.id + "|" + row.a.name, " t |f |'a|-x");
  EXPECT_EQ(row.b.file + "|" + row.b.id + "|" + row.b.name, "=1|b| +y");
}

TEST(Decisions, AreNotQuotedAtLength) {
  const std::string key(26, '0'), most(1'000'000, 'x');
  EXPECT_LT(error_of(most + "," + most + "\n").size(), 500U);
  EXPECT_LT(error_of("key,status\n" + most + ",new\n").size(), 500U);
  EXPECT_LT(error_of("key,status\n" + key + "," + most + "\n").size(), 500U);
}

}  // namespace
}  // namespace strake::report
