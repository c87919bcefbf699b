// SPDX-License-Identifier: Apache-2.0
#include "strake/report/view_diff.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "report/view/line_match.hpp"
#include "strake/parallel/team.hpp"
#include "support/draw.hpp"
#include "support/view_documents.hpp"

namespace strake::report {
namespace {

using drawing::LineState;
using hlr::EdgeKind;

std::uint64_t lines(const ViewDiff& diff, LineChange change) {
  return diff.total.at(static_cast<std::size_t>(change)).lines;
}
double length(const ViewDiff& diff, LineChange change) {
  return diff.total.at(static_cast<std::size_t>(change)).length_mm;
}

ViewDiff compared(const ViewDocument& before, const ViewDocument& after,
                  const ViewDiffOptions& options = {}, const parallel::Context& context = {}) {
  auto diff = compare(before, after, options, context);
  EXPECT_TRUE(diff) << diff.error().text();
  return diff ? std::move(*diff) : ViewDiff{};
}

model::Model crowd(double moved) {
  test::ClashModel m;
  test::Draw draw(3);
  for (int i = 0; i < 12; ++i) {
    const geometry::Vec3d lo{draw.between(0, 300), draw.between(0, 300), draw.between(0, 300)};
    const geometry::Vec3d size{draw.between(20, 90), draw.between(20, 90), draw.between(20, 90)};
    m.box("box" + std::to_string(i), lo, lo + size);
  }
  m.model.bodies[5].placement.translation = {moved, 0, 0};
  return std::move(m.model);
}

/// A document of lines made by hand, of two objects.
ViewDocument drawn(std::vector<ViewPiece> pieces) {
  ViewDocument document;
  document.name = "hand.json";
  document.width_mm = 420;
  document.height_mm = 297;
  document.objects = {{"a", "A", "f"}, {"b", "B", "f"}};
  document.pieces = std::move(pieces);
  return document;
}

ViewPiece line(const geometry::Vec3l& a, const geometry::Vec3l& b, std::uint32_t object = 0,
               LineState state = LineState::visible, EdgeKind kind = EdgeKind::sharp) {
  return {a, b, {}, {}, object, object, kind, state};
}

TEST(ViewDiff, ADrawingIsTheSameAsItself) {
  const ViewDocument document = test::view_document(test::view_file(crowd(0)));
  const ViewDiff diff = compared(document, document);
  EXPECT_EQ(lines(diff, LineChange::same), document.pieces.size());
  EXPECT_FALSE(diff.differs(false));
  EXPECT_TRUE(diff.by_object.empty());
  EXPECT_TRUE(diff.settings.empty());
}

TEST(ViewDiff, ScaleAndPlaceOnPaperChangeNoLine) {
  test::Drawn how;
  const ViewDocument before = test::view_document(test::view_file(crowd(0), how));
  how.layout.scale = 20;
  const ViewDocument after = test::view_document(test::view_file(crowd(0), how));
  EXPECT_FALSE(compared(before, after).differs(false));
}

TEST(ViewDiff, OfABoxThatMovedTheObjectIsReported) {
  const ViewDocument before = test::view_document(test::view_file(crowd(0)));
  const ViewDocument after = test::view_document(test::view_file(crowd(11)));
  const ViewDiff diff = compared(before, after);
  ASSERT_FALSE(diff.by_object.empty());
  bool reported = false;
  for (const auto& [object, counts] : diff.by_object)
    reported = reported || diff.objects[object]->id == "box5";
  EXPECT_TRUE(reported);
  EXPECT_TRUE(diff.differs(true));
  // What is gone and new of it is all of its edges but what still lies along x.
  EXPECT_GT(lines(diff, LineChange::gone), 8U);
  const ViewDiff back = compared(after, before);
  EXPECT_NEAR(length(diff, LineChange::gone), length(back, LineChange::added), 0.1);
  EXPECT_NEAR(length(diff, LineChange::added), length(back, LineChange::gone), 0.1);
  EXPECT_NEAR(length(diff, LineChange::changed), length(back, LineChange::changed), 0.1);
}

TEST(ViewDiff, StageTurnsHiddenLinesIntoVisibleOnes) {
  test::Drawn how;
  how.layout.remove_duplicates = false;
  const ViewDocument before = test::view_document(test::view_file(crowd(0), how));
  how.options.stage = hlr::Stage::none;
  const ViewDocument after = test::view_document(test::view_file(crowd(0), how));
  const ViewDiff diff = compared(before, after);
  EXPECT_EQ(lines(diff, LineChange::added), 0U);
  EXPECT_EQ(lines(diff, LineChange::gone), 0U);
  for (const DiffInterval& s : diff.intervals) {
    if (s.change != LineChange::changed) continue;
    EXPECT_NE(s.was.state, LineState::visible);
    EXPECT_EQ(diff.piece(s).state, LineState::visible);
  }
  ASSERT_EQ(diff.settings.size(), 1U);
  EXPECT_EQ(diff.settings[0].setting, "settings.stage");
}

TEST(ViewDiff, OtherSelectionsThatSectionsLeaveWholeAreReported) {
  const auto document = [](std::vector<std::string> selections) {
    test::Drawn how;
    how.options.uncut.resize(12);
    how.layout.uncut_selections = std::move(selections);
    return test::view_document(test::view_file(crowd(0), how));
  };
  const ViewDocument some = document({"b", "a", "b"});
  EXPECT_TRUE(compared(some, document({"a", "b"})).settings.empty());
  const ViewDiff diff = compared(some, document({"a"}));
  ASSERT_EQ(diff.settings.size(), 1U);
  EXPECT_EQ(diff.settings[0].setting, "settings.uncut");
  EXPECT_EQ(diff.settings[0].before, R"(["a","b"])");
  EXPECT_EQ(diff.settings[0].after, R"(["a"])");
  // A program need not say what it chose by.
  EXPECT_EQ(compared(some, document({})).settings[0].after, "true");
}

/// A document without its last object, which it lists as far from all others.
ViewDocument left_out(const ViewDocument& whole) {
  ViewDocument rest = whole;
  rest.far_objects = {rest.objects.back()};
  rest.objects.pop_back();
  std::erase_if(rest.pieces,
                [&](const ViewPiece& piece) { return piece.object == rest.objects.size(); });
  return rest;
}

TEST(ViewDiff, WhatLimitsLeftOutIsReportedAndCountedApart) {
  const ViewDocument whole =
      drawn({line({0, 0, 0}, {90'000, 0, 0}, 0), line({0, 5, 0}, {0, 70'000, 0}, 1),
             line({0, 9, 9}, {50'000, 9, 9}, 0)});
  ViewDocument without = left_out(whole);
  without.pieces.pop_back();
  const ViewDiff diff = compared(whole, without);
  ASSERT_EQ(diff.settings.size(), 1U);
  EXPECT_EQ(diff.settings[0].setting, "far_objects");
  EXPECT_EQ(diff.settings[0].before, "0");
  EXPECT_EQ(diff.settings[0].after, "1 (B)");
  EXPECT_EQ(lines(diff, LineChange::gone), 2U);
  EXPECT_EQ(diff.gone_left_out.lines, 1U);
  EXPECT_NEAR(diff.gone_left_out.length_mm, 69.995, 1e-3);
  EXPECT_EQ(diff.new_left_out.lines, 0U);
  EXPECT_TRUE(diff.differs(true)) << "a line that is no longer drawn is none that is the same";
  const std::string table = view_diff_table(diff, {});
  EXPECT_TRUE(table.starts_with("far_objects: was 0, is 1 (B)\n")) << table;
  EXPECT_TRUE(
      table.ends_with("\ngone because the newer drawing leaves their objects out as far from all "
                      "others: 1 (0.070 m)\n"))
      << table;
  const ViewDiff back = compared(without, whole);
  EXPECT_EQ(back.new_left_out.lines, 1U);
  EXPECT_EQ(back.gone_left_out.lines, 0U);
  EXPECT_EQ(back.settings[0].before, "1 (B)");
}

TEST(ViewDiff, WhatBothDrawingsLeftOutIsNoDifference) {
  const ViewDocument whole =
      drawn({line({0, 0, 0}, {90'000, 0, 0}, 0), line({0, 5, 0}, {0, 70'000, 0}, 1)});
  ViewDocument before = left_out(whole), after = before;
  EXPECT_TRUE(compared(before, after).settings.empty());
  EXPECT_EQ(view_diff_table(compared(before, after), {}).find("far_objects"), std::string::npos);
  before.far_objects.push_back({"c", "", "f"});
  after.far_objects.push_back({"d", "D", "f"});
  const ViewDiff diff = compared(before, after);
  EXPECT_EQ(diff.settings[0].before, "2 (c)");
  EXPECT_EQ(diff.settings[0].after, "2 (D)");
  // Where the file was renamed, it is the same object.
  ViewDocument renamed = left_out(whole);
  for (ViewObject& object : renamed.objects) object.file = "g";
  renamed.far_objects[0].file = "g";
  ViewDiffOptions options;
  options.files = match_files(whole, renamed, std::vector<std::string>{"f=g"}).value();
  EXPECT_EQ(compared(whole, renamed, options).gone_left_out.lines, 1U);
  EXPECT_TRUE(compared(left_out(whole), renamed, options).settings.empty());
}

TEST(ViewDiff, AFileThatWasRenamedIsTheSameFile) {
  const ViewDocument before = test::view_document(test::view_file(crowd(0)));
  ViewDocument after = before;
  for (ViewObject& object : after.objects) object.file = "tues.obj";
  EXPECT_GT(lines(compared(before, after), LineChange::changed), 0U) << "labels decide by default";
  auto files = match_files(before, after);
  ASSERT_TRUE(files);
  ASSERT_EQ(files->matches.size(), 1U);
  EXPECT_EQ(files->matches[0].relation, FileRelation::renamed);
  EXPECT_EQ(files->matches[0].common, before.objects.size());
  ViewDiffOptions options;
  options.files = *files;
  const ViewDiff diff = compared(before, after, options);
  EXPECT_FALSE(diff.differs(false));
  EXPECT_EQ(diff.objects.size(), after.objects.size());
  for (const ViewObject* const object : diff.objects) EXPECT_EQ(object->file, "tues.obj");
  EXPECT_TRUE(view_diff_table(diff, {}).starts_with("files are taken as renamed: "));
}

TEST(ViewDiff, FewObjectsAreMatchedByTheirLines) {
  const ViewDocument before = drawn(
      {line({0, 0, 0}, {90, 0, 0}), line({0, 5, 0}, {90, 5, 0}), line({0, 9, 0}, {90, 9, 0})});
  ViewDocument after = before, elsewhere = before;
  for (ViewDocument* const document : {&after, &elsewhere})
    for (ViewObject& object : document->objects) object.file = "g";
  std::swap(after.pieces[0].a, after.pieces[0].b);
  for (ViewPiece& piece : elsewhere.pieces) piece.a.z = piece.b.z = 700;
  EXPECT_EQ(match_files(before, after)->matches.size(), 1U)
      << "whichever end of a line comes first";
  EXPECT_TRUE(match_files(before, elsewhere)->matches.empty());
}

TEST(ViewDiff, ALineCutInTwoIsTheSameLine) {
  // The cut is off the line by what rounding to the grid makes.
  const ViewDocument whole = drawn({line({0, 0, 0}, {100'000, 70'001, 30'007})});
  const ViewDocument cut = drawn({line({0, 0, 0}, {33'333, 23'334, 10'002}),
                                  line({33'333, 23'334, 10'002}, {100'000, 70'001, 30'007})});
  EXPECT_FALSE(compared(whole, cut).differs(false));
  EXPECT_FALSE(compared(cut, whole).differs(false));
  // The other way round, and overlapping.
  const ViewDocument turned = drawn({line({100'000, 70'001, 30'007}, {33'333, 23'334, 10'002}),
                                     line({0, 0, 0}, {50'000, 35'000, 15'004})});
  EXPECT_FALSE(compared(whole, turned).differs(false));
}

TEST(ViewDiff, TheGapOfACutLineIsGone) {
  const ViewDocument whole = drawn({line({0, 0, 0}, {100'000, 0, 0})});
  const ViewDocument gap =
      drawn({line({0, 0, 0}, {40'000, 0, 0}), line({60'000, 0, 0}, {100'000, 0, 0})});
  const ViewDiff diff = compared(whole, gap);
  EXPECT_EQ(lines(diff, LineChange::gone), 1U);
  EXPECT_NEAR(length(diff, LineChange::gone), 20, 1e-4);
  EXPECT_EQ(lines(diff, LineChange::added), 0U);
  EXPECT_EQ(lines(diff, LineChange::same), 2U);
  EXPECT_NEAR(length(compared(gap, whole), LineChange::added), 20, 1e-4);
}

TEST(ViewDiff, AnotherStateKindOrObjectIsAChange) {
  const geometry::Vec3l a{0, 0, 0}, b{50'000, 0, 0}, c{100'000, 0, 0};
  const ViewDocument before = drawn({line(a, c)});
  for (const ViewPiece& half : {line(b, c, 0, LineState::hidden_by_other), line(b, c, 1),
                                line(b, c, 0, LineState::visible, EdgeKind::contour)}) {
    const ViewDiff diff = compared(before, drawn({line(a, b), half}));
    EXPECT_EQ(lines(diff, LineChange::changed), 1U);
    EXPECT_NEAR(length(diff, LineChange::changed), 50, 1e-4);
    EXPECT_EQ(lines(diff, LineChange::gone) + lines(diff, LineChange::added), 0U);
  }
}

TEST(ViewDiff, OfTwoLinesAtOnePlaceTheOneThatWentIsGone) {
  const geometry::Vec3l a{0, 0, 0}, c{100'000, 0, 0};
  const ViewDocument two = drawn({line(a, c), line(a, c, 1, LineState::duplicate)});
  const ViewDiff diff = compared(two, drawn({line(a, c)}));
  EXPECT_EQ(lines(diff, LineChange::gone), 1U);
  EXPECT_EQ(lines(diff, LineChange::changed), 0U);
  EXPECT_EQ(lines(diff, LineChange::same), 1U);
  EXPECT_FALSE(diff.differs(true));
}

TEST(ViewDiff, LinesThatCrossOrRunBesideEachOtherAreNotOne) {
  const ViewDocument before = drawn({line({0, 0, 0}, {100'000, 0, 0})});
  for (const ViewPiece& other :
       {line({50'000, -50'000, 0}, {50'000, 50'000, 0}), line({0, 3, 0}, {100'000, 3, 0}),
        line({0, 0, 0}, {100'000, 40, 0}), line({100'000, 0, 0}, {200'000, 0, 0})}) {
    const ViewDiff diff = compared(before, drawn({other}));
    EXPECT_EQ(lines(diff, LineChange::gone), 1U);
    EXPECT_EQ(lines(diff, LineChange::added), 1U);
  }
  // Within the tolerance they are.
  const ViewDocument beside = drawn({line({0, 3, 0}, {100'000, 3, 0})});
  EXPECT_FALSE(compared(before, beside, {.tolerance_mm = 0.01}).differs(false));
}

TEST(ViewDiff, PointsAreCompared) {
  const ViewDocument point = drawn({line({5, 5, 5}, {5, 5, 5})});
  EXPECT_FALSE(compared(point, point).differs(false));
  EXPECT_FALSE(compared(point, drawn({line({5, 5, 5}, {5, 6, 5})})).differs(false));
  EXPECT_EQ(lines(compared(point, drawn({})), LineChange::gone), 1U);
  EXPECT_EQ(lines(compared(point, drawn({line({50, 5, 5}, {50, 5, 5})})), LineChange::added), 1U);
}

// However the lines of a drawing are cut anew, nothing changed; and what is taken away is gone.
TEST(ViewDiff, RandomCutsChangeNothing) {
  const ViewDocument before = test::view_document(test::view_file(crowd(0)));
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    test::Draw draw(seed);
    ViewDocument cut = before;
    cut.pieces.clear();
    double taken = 0;
    for (const ViewPiece& piece : before.pieces) {
      const geometry::Vec3d along = (piece.b - piece.a).as<double>();
      const double t = draw.between(0.3, 0.7);
      const geometry::Vec3d offset = along * t;
      const geometry::Vec3l at{piece.a.x + std::llround(offset.x),
                               piece.a.y + std::llround(offset.y),
                               piece.a.z + std::llround(offset.z)};
      ViewPiece first = piece, second = piece;
      first.b = at;
      second.a = at;
      if (draw.one_in(2)) std::swap(second.a, second.b);
      cut.pieces.push_back(first);
      if (seed % 2 == 0 || !draw.one_in(30) || piece.state == LineState::projecting)
        cut.pieces.push_back(second);
      else
        taken += std::sqrt(dot(along, along)) * (1 - t) / 1000;
    }
    const ViewDiff diff = compared(before, cut);
    EXPECT_NEAR(length(diff, LineChange::gone), taken, 0.05 + taken * 1e-6) << seed;
    EXPECT_EQ(lines(diff, LineChange::added) + lines(diff, LineChange::changed), 0U) << seed;
  }
}

TEST(ViewDiff, IsTheSameForAnyNumberOfThreads) {
  const ViewDocument before = test::view_document(test::view_file(crowd(0)), "a.json");
  const ViewDocument after = test::view_document(test::view_file(crowd(11)), "b.json");
  const auto texts = [&](unsigned threads) {
    parallel::Team team(threads);
    const ViewDiff diff = compared(before, after, {}, {.team = &team});
    std::string all = view_diff_table(diff, {});
    write_view_diff_json(diff, [&](std::string_view piece) { all += piece; });
    write_view_diff_svg(diff, [&](std::string_view piece) { all += piece; });
    return all;
  };
  const std::string one = texts(1);
  for (const unsigned threads : {2U, 3U, 8U}) EXPECT_EQ(texts(threads), one) << threads;
}

TEST(ViewDiff, TheLegendCountsWhatIsPainted) {
  // Half of the lines are clipped away: changed by the tally, gone by the eye.
  const ViewDocument before = test::view_document(test::view_file(crowd(0)));
  ViewDocument after = before;
  std::size_t visible = 0, clipped = 0;
  for (ViewPiece& piece : after.pieces) {
    if (piece.state != LineState::visible) continue;
    if (++visible % 2 != 0) continue;
    piece.state = LineState::clipped;
    ++clipped;
  }
  const ViewDiff diff = compared(before, after);
  EXPECT_GT(lines(diff, LineChange::changed), 0U);
  EXPECT_EQ(lines(diff, LineChange::gone), 0U);
  std::string svg;
  write_view_diff_svg(diff, [&](std::string_view piece) { svg += piece; });
  const std::size_t legend = svg.find("<g id=\"legend\">");
  ASSERT_NE(legend, std::string::npos);
  for (const std::string name : {"same", "changed", "gone", "new"}) {
    std::size_t painted = 0;
    for (const char* const kind : {"visible", "hidden"}) {
      const std::size_t layer = svg.find("id=\"" + name + "-" + kind + "\"");
      if (layer == std::string::npos) continue;
      const std::size_t end = std::min(legend, svg.find("inkscape:groupmode", layer));
      for (std::size_t at = svg.find(" d=\"", layer); at < end; at = svg.find(" d=\"", at + 1))
        painted += static_cast<std::size_t>(
            std::count(svg.begin() + static_cast<std::ptrdiff_t>(at),
                       svg.begin() + static_cast<std::ptrdiff_t>(svg.find("\"/>", at)), 'M'));
    }
    const std::string reported = ">" + name + ": " + std::to_string(painted) + "</text>";
    EXPECT_NE(svg.find(reported, legend), std::string::npos) << reported;
    if (name == "gone") {
      EXPECT_GE(painted, clipped / 2);
    }
  }
}

TEST(ViewDiff, JsonListsWhatChanged) {
  const ViewDocument before = test::view_document(test::view_file(crowd(0)));
  const ViewDocument after = test::view_document(test::view_file(crowd(11)));
  const ViewDiff diff = compared(before, after);
  std::string text;
  write_view_diff_json(diff, [&](std::string_view piece) { text += piece; });
  const auto json = nlohmann::json::parse(text);
  std::uint64_t listed = 0;
  for (const char* const change : {"new", "gone", "changed"})
    listed += json["counts"][change]["lines"].get<std::uint64_t>();
  EXPECT_EQ(json["lines"].size(), listed);
  EXPECT_EQ(json["objects"].size(), diff.by_object.size());
}

TEST(ViewDiff, DrawingsFromDifferentSidesAreRefused) {
  test::Drawn how;
  const ViewDocument before = test::view_document(test::view_file(crowd(0), how));
  how.view.direction = {1, -2, 1};
  const ViewDocument after = test::view_document(test::view_file(crowd(0), how));
  const auto diff = compare(before, after, {}, {});
  ASSERT_FALSE(diff);
  EXPECT_EQ(diff.error().code, ErrorCode::input);
  EXPECT_NE(diff.error().text().find("view.direction"), std::string::npos);
  for (const double tolerance : {-1.0, std::nan(""), 1e300})
    EXPECT_EQ(compare(before, before, {.tolerance_mm = tolerance}, {}).error().code,
              ErrorCode::usage);
}

TEST(ViewDocument, WhatContradictsItselfIsRefused) {
  const std::string sound = test::view_document_seeds()[0].bytes;
  const auto error_of = [](const std::string& text) {
    std::istringstream in(text);
    const auto document = parse_view_document(in, "x.json");
    return document ? std::string() : document.error().text();
  };
  const auto with = [&](const std::string& what, const std::string& by) {
    std::string text = sound;
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), by);
  };
  EXPECT_EQ(error_of(sound), "");
  for (const auto& [text, words] : std::vector<std::pair<std::string, std::string>>{
           {"", "ends too soon"},
           {"{}", "is no drawing"},
           {"[1,2]", "is no drawing"},
           {"<svg/>", "no JSON"},
           {sound.substr(0, sound.size() / 2), "ends too soon"},
           {with("\"schema_version\":1", "\"schema_version\":7"), "version 7"},
           {with("\"a_mm\":[", "\"a_mm\":[1e300,"), "\"a_mm\" is no point"},
           {with("\"a_mm\":[", "\"a_mm\":[NaN,"), "no JSON"},
           {with("\"a_mm\":[", "\"a_mm\":[0,"), "\"a_mm\" is no point"},
           {with("\"object_index\":0", "\"object_index\":7000"), "is of object 7000"},
           {with("\"object_index\":0", "\"object_index\":-1"), "number of an object"},
           {with("\"kind\":\"sharp\"", "\"kind\":\"wavy\""), "kind of line"},
           {with("\"state\":\"visible\"", "\"state\":\"maybe\""), "is no state"},
           {with("\"state\":\"visible\"", "\"state\":\"clipped\""), "counts"},
           {with("\"id\":\"b\"", "\"id\":\"a\""), "twice"},
           {with("\"scale\":", "\"scale\":-"), "positive"},
           {with("\"hash\"", "\"hush\""), "has no \"hash\""}}) {
    EXPECT_NE(error_of(text).find(words), std::string::npos) << words << ": " << error_of(text);
    EXPECT_NE(error_of(text).find("x.json"), std::string::npos) << error_of(text);
  }
}

}  // namespace
}  // namespace strake::report
