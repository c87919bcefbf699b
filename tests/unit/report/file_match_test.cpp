// SPDX-License-Identifier: Apache-2.0
#include "strake/report/file_match.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "report/files/file_map.hpp"

namespace strake::report {
namespace {

using Ids = std::vector<std::string>;
using Places = std::vector<std::uint64_t>;

/// Ids p<from> to p<to - 1>.
Ids ids(int from, int to) {
  Ids all;
  for (int i = from; i < to; ++i) all.push_back("p" + std::to_string(i));
  return all;
}

Ids both(Ids one, const Ids& other) {
  one.insert(one.end(), other.begin(), other.end());
  return one;
}

FileContents file(std::string label, Ids of, const Places& places = {}) {
  std::ranges::sort(of);
  FileContents contents{std::move(label), std::move(of), {}};
  for (const std::uint64_t place : places) contents.places.push_back({0, place});
  std::ranges::sort(contents.places);
  return contents;
}

FileMatches matched(std::vector<FileContents> before, std::vector<FileContents> after,
                    const std::vector<FilePair>& given_pairs = {}) {
  auto files = match_files({std::move(before), {}}, {std::move(after), {}}, given_pairs);
  EXPECT_TRUE(files) << files.error().text();
  return files ? std::move(*files) : FileMatches{};
}

std::string faults_of(const std::vector<FilePair>& given_pairs) {
  const auto files = match_files({{file("a", {}), file("b", {})}, {}},
                                 {{file("b", {}), file("c", {})}, {}}, given_pairs);
  return files ? "" : files.error().text();
}

TEST(FileMatch, FilesOfEqualLabelsAreOneWhateverIsInThem) {
  const FileMatches files =
      matched({file("a", ids(0, 5)), file("b", ids(5, 9))}, {file("b", ids(0, 5)), file("a", {})});
  EXPECT_TRUE(files.by_label_alone());
  EXPECT_EQ(files.matches, (std::vector<FileMatch>{{"a", "a"}, {"b", "b"}}));
  EXPECT_EQ(file_matches_text(files), "");
}

TEST(FileMatch, ARenamedFileIsFoundByItsIds) {
  const FileMatches files = matched({file("hull", ids(0, 9)), file("ship.glb", ids(100, 1300))},
                                    {file("hull", ids(0, 9)), file("tues.glb", ids(100, 1300))});
  EXPECT_EQ(files.matches,
            (std::vector<FileMatch>{{"hull", "hull"},
                                    {"ship.glb", "tues.glb", FileRelation::renamed, 1200, 1200}}));
  EXPECT_FALSE(files.by_label_alone());
  EXPECT_EQ(file_matches_text(files),
            "files are taken as renamed: ship.glb -> tues.glb (1,200 of 1,200 ids in common)\n");
}

TEST(FileMatch, MoreThanHalfOfEitherMustBeInTheOther) {
  const auto renamed = [](int shared) {
    return !matched({file("a", both(ids(0, shared), ids(50, 60 - shared)))},
                    {file("b", both(ids(0, shared), ids(80, 90 - shared)))})
                .matches.empty();
  };
  EXPECT_TRUE(renamed(6));
  EXPECT_FALSE(renamed(5));
  EXPECT_FALSE(renamed(0));
}

TEST(FileMatch, OneOrTwoIdsNeedPlacesBesides) {
  EXPECT_TRUE(
      matched({file("a", {"cube", "wall"})}, {file("b", {"cube", "wall"})}).matches.empty());
  EXPECT_TRUE(matched({file("a", {"cube"}, {1})}, {file("b", {"cube"}, {2})}).matches.empty());
  EXPECT_EQ(matched({file("a", {"cube"}, {1})}, {file("b", {"cube"}, {1})}).matches,
            (std::vector<FileMatch>{{"a", "b", FileRelation::renamed, 1, 1}}));
}

TEST(FileMatch, AHandfulOfIdsElsewhereMayBeChance) {
  const auto renamed = [](int count, const Places& before, const Places& after) {
    return !matched({file("a", ids(0, count), before)}, {file("b", ids(0, count), after)})
                .matches.empty();
  };
  EXPECT_FALSE(renamed(19, {1, 2}, {3, 4}));
  EXPECT_TRUE(renamed(20, {1, 2}, {3, 4})) << "a model that moved";
  EXPECT_TRUE(renamed(3, {1, 2}, {2, 4}));
  EXPECT_TRUE(renamed(3, {1, 2}, {})) << "all of it was mended";
}

TEST(FileMatch, PlacesDecideWhereNeitherHasLastingIds) {
  const FileMatches files =
      matched({file("a", {}, {1, 2, 3}), file("b", {}, {4, 5, 6})},
              {file("c", {}, {4, 5, 7}), file("d", {}, {1, 2, 3}), file("e", {}, {})});
  EXPECT_EQ(files.matches, (std::vector<FileMatch>{{"b", "c", FileRelation::renamed, 2, 4, true},
                                                   {"a", "d", FileRelation::renamed, 3, 3, true}}));
  EXPECT_EQ(files.only_after, Ids{"e"});
  EXPECT_EQ(
      file_matches_text(files),
      "files are taken as renamed: b -> c (2 of 4 places in common), a -> d (3 of 3 places in "
      "common)\n");
}

TEST(FileMatch, PlacesDecideWhereOneHasNoLastingIds) {
  // Somebody adds objects with names to a file in which nothing has one.
  const FileMatches files =
      matched({file("a", {}, {1, 2, 3})}, {file("b", ids(0, 5), {1, 2, 3, 4, 5})});
  EXPECT_EQ(files.matches, (std::vector<FileMatch>{{"a", "b", FileRelation::renamed, 3, 5, true}}));
  EXPECT_TRUE(
      matched({file("a", {}, {1, 2, 3})}, {file("b", ids(0, 5), {3, 4, 5, 6})}).matches.empty());
}

TEST(FileMatch, PlacesDecideBetweenFilesOfTheSameIds) {
  const FileMatches files =
      matched({file("port", ids(0, 9), {1, 2, 3}), file("starboard", ids(0, 9), {4, 5, 6})},
              {file("one", ids(0, 9), {4, 5, 6}), file("two", ids(0, 9), {1, 2, 3})});
  ASSERT_EQ(files.matches.size(), 2U);
  EXPECT_EQ(files.matches[0].before, "starboard");
  EXPECT_EQ(files.matches[1].before, "port");
}

TEST(FileMatch, EquallyLikeFilesAreReportedAndNotGuessed) {
  const FileMatches one =
      matched({file("port", ids(0, 9)), file("starboard", ids(0, 9))}, {file("new", ids(0, 9))});
  EXPECT_TRUE(one.matches.empty());
  EXPECT_EQ(one.ambiguous, (std::vector<AmbiguousFile>{{"new", true, {"port", "starboard"}}}));
  EXPECT_TRUE(one.only_before.empty() && one.only_after.empty());
  EXPECT_EQ(file_matches_text(one),
            "new of the new run is equally like port and starboard and is matched with none "
            "(--match-files OLD=NEW says which it is)\n");
  const FileMatches nearly = matched({file("port", ids(0, 100)), file("starboard", ids(5, 105))},
                                     {file("new", ids(0, 100))});
  EXPECT_EQ(nearly.ambiguous.size(), 1U) << "95 of 100 are no less by chance";
  const FileMatches clear = matched({file("port", ids(0, 100)), file("starboard", ids(15, 115))},
                                    {file("new", ids(0, 100))});
  EXPECT_EQ(clear.matches,
            (std::vector<FileMatch>{{"port", "new", FileRelation::renamed, 100, 100}}));
  EXPECT_EQ(clear.only_before, Ids{"starboard"});
}

TEST(FileMatch, TheOrderOfFilesMakesNoDifference) {
  const std::vector<FileContents> before{file("a", ids(0, 9)), file("b", ids(0, 9)),
                                         file("c", ids(20, 30)), file("d", ids(30, 40))};
  std::vector<FileContents> after{file("x", ids(30, 40)), file("y", ids(20, 30)),
                                  file("z", ids(0, 9))};
  const FileMatches first = matched(before, after);
  EXPECT_EQ(first.matches.size(), 2U);
  std::ranges::sort(after, std::greater<>(), &FileContents::label);
  EXPECT_EQ(matched(before, after).matches, first.matches);
}

TEST(FileMatch, AFileSplitInTwo) {
  const FileMatches files =
      matched({file("ship", ids(0, 100))}, {file("fore", ids(0, 50)), file("aft", ids(50, 100))});
  EXPECT_EQ(files.matches, (std::vector<FileMatch>{{"ship", "aft", FileRelation::split, 50, 50},
                                                   {"ship", "fore", FileRelation::split, 50, 50}}));
  EXPECT_EQ(
      file_matches_text(files),
      "files are taken as split or merged: ship -> aft (50 of 50 ids of the new file), ship -> "
      "fore (50 of 50 ids of the new file)\n");
}

TEST(FileMatch, TwoFilesMergedIntoOne) {
  const FileMatches files =
      matched({file("fore", ids(0, 50)), file("aft", ids(50, 100))}, {file("ship", ids(0, 100))});
  EXPECT_EQ(files.matches,
            (std::vector<FileMatch>{{"aft", "ship", FileRelation::merged, 50, 50},
                                    {"fore", "ship", FileRelation::merged, 50, 50}}));
}

TEST(FileMatch, APartLeavesAFileThatKeepsItsName) {
  const FileMatches split = matched({file("ship", ids(0, 100))},
                                    {file("ship", ids(0, 70)), file("outfit", ids(70, 100))});
  EXPECT_EQ(split.matches, (std::vector<FileMatch>{{"ship", "outfit", FileRelation::split, 30, 30},
                                                   {"ship", "ship"}}));
  const FileMatches copied =
      matched({file("ship", ids(0, 100))}, {file("ship", ids(0, 100)), file("copy", ids(0, 100))});
  EXPECT_EQ(copied.matches, (std::vector<FileMatch>{{"ship", "ship"}}));
  EXPECT_EQ(copied.only_after, Ids{"copy"}) << "nothing left the ship";
}

TEST(FileMatch, RequestedPairsComeFirst) {
  const std::vector<FileContents> before{file("a", ids(0, 9)), file("b", ids(10, 19))};
  const std::vector<FileContents> after{file("a", ids(10, 19)), file("b", ids(0, 9))};
  const FileMatches swapped = matched(before, after, {{"a", "b"}});
  EXPECT_EQ(swapped.matches, (std::vector<FileMatch>{{"b", "a", FileRelation::renamed, 9, 9},
                                                     {"a", "b", FileRelation::requested, 9, 9}}));
  const FileMatches reported =
      matched({file("x", ids(0, 2))}, {file("y", ids(5, 7))}, {{"x", "y"}});
  EXPECT_EQ(file_matches_text(reported),
            "files are taken as renamed: x -> y (as asked for, 0 of 4 ids in common)\n");
}

TEST(FileMatch, NonsenseIsRefused) {
  EXPECT_EQ(faults_of({{"a", "c"}}), "");
  EXPECT_EQ(faults_of({{"x", "c"}}), "--match-files: the old run has no file 'x' (it has a, b)");
  EXPECT_EQ(faults_of({{"a", "a"}}), "--match-files: the new run has no file 'a' (it has b, c)");
  EXPECT_NE(faults_of({{"a", "c"}, {"a", "b"}}).find("'a' of the old run is given twice"),
            std::string::npos);
  EXPECT_NE(faults_of({{"a", "c"}, {"b", "c"}}).find("'c' of the new run is given twice"),
            std::string::npos);
}

TEST(FileMatch, APairAsItIsWritten) {
  const RunFiles before{{file("a=1", {}), file("a", {})}, {}}, after{{file("b", {})}, {}};
  const auto read = [&](const std::string& text) {
    const std::vector<std::string> texts{text};
    const auto pairs = parse_file_pairs(texts, before, after);
    return pairs ? pairs->front().before + "|" + pairs->front().after : pairs.error().text();
  };
  EXPECT_EQ(read("a=b"), "a|b");
  EXPECT_EQ(read("a=1=b"), "a=1|b");
  EXPECT_EQ(read("x=y=z"), "x|y=z");
  for (const char* const text : {"a", "=b", "a=", "="})
    EXPECT_NE(read(text).find("names no two files"), std::string::npos) << text;
}

TEST(FileMatch, WhatIsLeftOverInBothRunsIsReported) {
  const FileMatches files = matched({file("a", ids(0, 9))}, {file("b", ids(20, 29))});
  EXPECT_EQ(
      file_matches_text(files),
      "files without a counterpart: a in the old run, b in the new one (--match-files OLD=NEW "
      "matches them)\n");
  EXPECT_EQ(file_matches_text(matched({file("a", ids(0, 9))}, {})), "")
      << "a file that is no longer read is no riddle";
}

TEST(FileMatch, ObjectsThatTheResultDoesNotNameCount) {
  const auto in = [](std::map<std::string, Ids, std::less<>> all) {
    return [all = std::move(all)](std::string_view label, std::string_view id) {
      const auto at = all.find(label);
      return at != all.end() && std::ranges::find(at->second, id) != at->second.end();
    };
  };
  // The old run has clashes of p0 to p4, the new one of p5 to p9; all are in both files.
  const auto files = match_files({{file("a", ids(0, 5))}, in({{"a", ids(0, 10)}})},
                                 {{file("b", ids(5, 10))}, in({{"b", ids(0, 10)}})});
  ASSERT_TRUE(files);
  EXPECT_EQ(files->matches, (std::vector<FileMatch>{{"a", "b", FileRelation::renamed, 10, 10}}));
}

/// A map of files whose objects are those given.
FileMap map_of(const FileMatches& files, const std::vector<FileContents>& before,
               const std::vector<FileContents>& after) {
  const auto has = [](const std::vector<FileContents>& all) {
    return [all](std::string_view label, std::string_view id) {
      const auto at = std::ranges::find(all, label, &FileContents::label);
      return at != all.end() && std::ranges::find(at->ids, id) != at->ids.end();
    };
  };
  return {files, has(before), has(after)};
}

TEST(FileMap, ObjectsGoByTheFileThatHasThem) {
  const std::vector<FileContents> before{file("ship", ids(0, 10)), file("dock", ids(20, 25))};
  const std::vector<FileContents> after{file("fore", ids(0, 6)), file("aft", ids(6, 10)),
                                        file("dock", ids(20, 25))};
  const FileMatches files = matched(before, after);
  const FileMap map = map_of(files, before, after);
  EXPECT_FALSE(map.is_identity());
  EXPECT_EQ(map.label_in_other(RunSide::before, "ship", "p0"), "fore");
  EXPECT_EQ(map.label_in_other(RunSide::before, "ship", "p9"), "aft");
  EXPECT_EQ(map.label_in_other(RunSide::after, "aft", "p9"), "ship");
  EXPECT_EQ(map.label_in_other(RunSide::before, "dock", "p20"), "dock");
  for (const char* const label : {"fore", "aft", "dock", "ship"})
    EXPECT_NE(map.label_in_other(RunSide::before, "ship", "p99"), label);
  EXPECT_EQ(map.group_of(RunSide::before, "ship"), map.group_of(RunSide::after, "aft"));
  EXPECT_EQ(map.group_of(RunSide::before, "ship"), map.group_of(RunSide::after, "fore"));
  EXPECT_NE(map.group_of(RunSide::before, "ship"), map.group_of(RunSide::after, "dock"));
}

TEST(FileMap, NoTwoObjectsBecomeOne) {
  const std::vector<FileContents> before{file("one", ids(0, 8)), file("two", ids(7, 12))};
  const std::vector<FileContents> after{file("all", ids(0, 12))};
  const FileMatches files = matched(before, after);
  ASSERT_EQ(files.matches.size(), 2U);
  const FileMap map = map_of(files, before, after);
  EXPECT_EQ(map.label_in_other(RunSide::before, "one", "p7"), "all");
  EXPECT_NE(map.label_in_other(RunSide::before, "two", "p7"), "all") << "that is the one of 'one'";
  EXPECT_EQ(map.label_in_other(RunSide::before, "two", "p8"), "all");
}

TEST(FileMap, AFileWithoutCounterpartIsNowhere) {
  const std::vector<FileContents> before{file("a", ids(0, 9)), file("b", ids(10, 19))};
  const std::vector<FileContents> after{file("b", ids(0, 9)), file("c", ids(30, 39))};
  const FileMatches files = matched(before, after, {{"a", "b"}});
  const FileMap map = map_of(files, before, after);
  EXPECT_EQ(map.label_in_other(RunSide::before, "a", "p0"), "b");
  EXPECT_NE(map.label_in_other(RunSide::before, "b", "p10"), "b") << "that is what a became";
  EXPECT_EQ(map.label_in_other(RunSide::after, "b", "p0"), "a");
}

TEST(FileMap, LabelsAloneChangeNothing) {
  const FileMap map({}, {}, {});
  EXPECT_TRUE(map.is_identity());
  EXPECT_EQ(map.label_in_other(RunSide::before, "any", "p0"), "any");
  EXPECT_EQ(map.group_of(RunSide::after, "any"), "any");
}

TEST(FileMatch, AnExcerptIsAFileThatHasMostOfIt) {
  RunFiles before{{file("old", ids(0, 5))}, {}, true};
  const RunFiles after{{file("new", ids(0, 100)), file("other", ids(200, 300))}, {}};
  FileMatches files = match_files(before, after).value();
  ASSERT_EQ(files.matches.size(), 1U);
  EXPECT_EQ(files.matches[0].after, "new");
  EXPECT_EQ(files.matches[0].relation, FileRelation::renamed);
  before.is_excerpt = false;
  EXPECT_EQ(match_files(before, after)->matches.at(0).relation, FileRelation::merged);
}

TEST(FileMatch, NoNumbersAreReportedWhereThereIsNothingToCompare) {
  EXPECT_EQ(file_matches_text(matched({file("x", {})}, {file("y", {}, {1, 2})}, {{"x", "y"}})),
            "files are taken as renamed: x -> y\n");
}

}  // namespace
}  // namespace strake::report
