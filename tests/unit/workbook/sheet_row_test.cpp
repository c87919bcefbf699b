// SPDX-License-Identifier: Apache-2.0
#include "workbook/sheet/sheet_row.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace strake::workbook {
namespace {

std::string cell(std::string_view raw) {
  std::string out;
  append_cell_text(out, raw);
  return out;
}

TEST(SheetRow, ColumnsAreNamedByLetters) {
  EXPECT_EQ(column_name(0), "A");
  EXPECT_EQ(column_name(25), "Z");
  EXPECT_EQ(column_name(26), "AA");
  EXPECT_EQ(column_name(701), "ZZ");
  EXPECT_EQ(column_name(702), "AAA");
}

TEST(SheetRow, ATextIsAStringWhateverItBeginsWith) {
  std::string out;
  SheetRow row(out, 6);
  row.text("=1+1").blank().text("<&>\"").text("");
  row.end();
  EXPECT_EQ(out,
            "<row r=\"7\"><c r=\"A7\" s=\"3\" t=\"inlineStr\"><is><t xml:space=\"preserve\">=1+1"
            "</t></is></c><c r=\"C7\" s=\"3\" t=\"inlineStr\"><is><t xml:space=\"preserve\">"
            "&lt;&amp;&gt;&quot;</t></is></c></row>");
}

TEST(SheetRow, AValueIsANumberWhereNothingOfItGetsLost) {
  const auto is_number = [](std::string_view value) {
    std::string out;
    SheetRow(out, 0).value(value);
    return out.find("<v>") != std::string::npos;
  };
  for (const char* const number : {"12", "-0.5", "0.25", "0", "-10"})
    EXPECT_TRUE(is_number(number)) << number;
  for (const char* const text :
       {"007", "-007", "+5", "12E3", "1e3", "12345678901234567", "1.2.3", "=1", "", "nan", "12 mm"})
    EXPECT_FALSE(is_number(text)) << text;
}

TEST(SheetRow, WhatXmlCannotHaveBecomesAMark) {
  EXPECT_EQ(cell("a\x01\xFF\xE2\x80\xAE z\r\nb\tc"),
            "a\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD z\nb\tc");
}

TEST(SheetRow, WhatReadersTakeForAnEscapeStaysWhatItIs) {
  EXPECT_EQ(cell("_x0041_ _x00_ _X0041_"), "_x005F_x0041_ _x00_ _X0041_");
}

TEST(SheetRow, ACellEndsWhereItHasToAndReportsIt) {
  const std::string most(kMaxCellWords, 'x');
  EXPECT_EQ(cell(most), most);
  EXPECT_EQ(cell(most + "x"), most.substr(1) + "\xE2\x80\xA6");
  // A character beyond the first plane is two words.
  std::string wide;
  for (int i = 0; i < 20000; ++i) wide += "\xF0\x9F\x9A\xA2";
  const std::string cut = cell(wide);
  EXPECT_EQ(cut.size(), (kMaxCellWords / 2) * 4 + 3);
  EXPECT_TRUE(cut.ends_with("\xE2\x80\xA6"));
}

}  // namespace
}  // namespace strake::workbook
