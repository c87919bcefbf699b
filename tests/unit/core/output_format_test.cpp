// SPDX-License-Identifier: Apache-2.0
#include "core/output_format.hpp"

#include <gtest/gtest.h>

#include <array>

namespace strake {
namespace {

struct NumberWriter {
  OutputFormat format;
  int number = 0;
};

constexpr std::array kTable{
    NumberWriter{{".json", " as {}"}, 1},
    NumberWriter{{".csv", ", or for spreadsheets as {} with a header"}, 2},
};

std::span<const NumberWriter> table() { return kTable; }

TEST(OutputFormat, TheSuffixPicksTheWriterInUpperCaseToo) {
  EXPECT_EQ(find_writer(table(), "a/b.json")->number, 1);
  EXPECT_EQ(find_writer(table(), "a.json.CSV")->number, 2);
}

TEST(OutputFormat, TheLongestSuffixThatFitsPicksTheWriter) {
  constexpr std::array kTwo{NumberWriter{{".json"}, 1}, NumberWriter{{".ifc.json"}, 2}};
  const std::span<const NumberWriter> two(kTwo);
  EXPECT_EQ(find_writer(two, "a.ifc.JSON")->number, 2);
  EXPECT_EQ(find_writer(two, "a.b.json")->number, 1);
  EXPECT_EQ(find_writer(two, "aifc.json")->number, 1);
  // Of a name that is nothing but a suffix the shorter one is left.
  EXPECT_EQ(find_writer(two, "x/.ifc.json")->number, 1);
}

TEST(OutputFormat, AnUnknownSuffixIsAnErrorThatNamesThoseThatAreKnown) {
  for (const char* const file : {"a.svg", "json", ".json", "a.json/b"}) {
    const Result<NumberWriter> writer = find_writer(table(), file);
    ASSERT_FALSE(writer) << file;
    EXPECT_EQ(writer.error().code, ErrorCode::usage);
    EXPECT_EQ(writer.error().message, "the format of '" + std::string(file) + "' is not known");
    EXPECT_EQ(writer.error().where, "");
    EXPECT_EQ(writer.error().mend, "end its name in .json or .csv");
  }
}

TEST(OutputFormat, HelpIsMadeOfWhatEachFormatAdds) {
  EXPECT_EQ(describe_formats("Result", formats_of(table())),
            "Result as .json, or for spreadsheets as .csv with a header");
  EXPECT_EQ(list_suffixes(formats_of(table()), "and"), ".json and .csv");
}

}  // namespace
}  // namespace strake
