// SPDX-License-Identifier: Apache-2.0
// What sheet files say, and what they must not.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "support/sheet_models.hpp"

namespace strake::sheets {
namespace {

using test::fault_of;

constexpr const char* kView = "[[view]]\nname = \"v\"\n";

TEST(SheetFileText, AWholeFileIsUnderstood) {
  EXPECT_EQ(fault_of(R"toml(
[sheet]
size = "A1"
orientation = "portrait"
scale = "1:50"
area = ["20mm", "10mm", "580mm", "700mm"]
keep_free = [["400mm", "700mm", "580mm", "830mm"]]
[fields]
title = "Deck"
number = 17
[sets]
a = "name = 'a*'"
[defaults]
hidden = "dashed"
sharp_angle = "25deg"
contact_distance = "5um"
[arrangement]
projection = "third-angle"
direction = "left"
up = [0, 0, 1]
gap = "20mm"
views = ["front", "top", "bottom", "left", "right", "back", "iso"]
select = ["set(a)", "type = box"]
limits = { min = ["-1m", 0, 0], max = ["9m", "9m", "9m"] }
[arrangement.top]
title = "PLAN"
hidden = "all"
stage = "local"
intersections = "parts"
own_polylines = "hidden"
uncut = ["set(a)", "name = 'BOLT*'"]
flush_seams = "off"
[[view]]
name = "detail"
title = ""
direction = [1, -2.5, 1]
up = "0,0,1"
scale = "2:1"
position = ["100mm", "150mm"]
anchor = ["1m", "2m", "-3m"]
stage = "none"
[[tag]]
select = "set(a)"
text = "{{name}} DN {{@DN}}"
views = ["detail"]
style = "plain"
once = true
height = "3.5mm"
[grid]
x = [["A", "0m"], ["B", "2.5m"]]
views = ["top", "front"]
[[grid.series]]
axis = "y"
label = "FR {{n}}"
first = -2
last = 12
at = "-1.2m"
spacing = "600mm"
[styles]
hidden = { width = "0.2mm", dash = ["2mm", "1mm"], color = "#123ABC" }
outline = { dash = [] }
)toml"),
            "");
  EXPECT_EQ(fault_of("arrangement = \"first-angle\""), "");
  EXPECT_EQ(fault_of(kView), "");
}

TEST(SheetFileText, FaultsNamePlaceAndMend) {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"a = = 1", "s.toml, line 1, column 5: "},
      {"", "s.toml, line 1, column 1: the sheet has no views (write arrangement = "},
      {"x = 1\n", "the file has no key 'x' (its keys are sets, sheet, fields"},
      {"arrangement = \"second-angle\"", "'arrangement' is 'second-angle' (write \"first-angle\""},
      {"arrangement = 3", "[arrangement] is a whole number, not a table"},
      {"[sheet]\nsize = [\"400in\", \"1000in\"]",
       "a sheet of 10160 x 25400 mm (take 100mm to 20m)"},
      {"[sheet]\nsize = [\"12in\", \"1in\"]", "a sheet of 304.8 x 25.4 mm"},
      {"[sheet]\nsize = \"A5\"", "line 2, column 8: no sheet is called 'A5' (write size = \"A4\""},
      {"[sheet]\nsize = 420", "no list of 2"},
      {"[sheet]\nsize = [\"1km\", \"300mm\"]", "a sheet of 1e+06 x 300 mm (take 100mm to 20m)"},
      {"[sheet]\nsize = [\"1mm\", \"300mm\"]", "take 100mm to 20m"},
      {"[sheet]\nsize = [\"-400mm\", \"300mm\"]", "take 100mm to 20m"},
      {"[sheet]\nsize = [nan, \"300mm\"]", "is a number, not a length with its unit"},
      {"[sheet]\nsize = [\"400mm\", \"300mm\"]\norientation = \"portrait\"",
       "'orientation' of [sheet] goes with the sizes A4 to A0"},
      {"[sheet]\nscale = \"0:1\"", "'scale' of [sheet]"},
      {"[sheet]\nscale = \"1:0\"", "'scale' of [sheet]"},
      {"[sheet]\nscale = \"1:nan\"", "'scale' of [sheet]"},
      {"[sheet]\nscale = 50", "is a whole number, not a scale in quotes"},
      {"[sheet]\nframe = \"no\"", "not true or false"},
      {"[sheet]\narea = [\"9mm\", \"9mm\", \"5mm\", \"99mm\"]",
       "'area' of [sheet] is no box of paper"},
      {"[sheet]\nkeep_free = [3]", "line 2, column 14: 'keep_free' of [sheet] has something that"},
      {"[sheet]\ntemplate = \"no.svg\"",
       "s.toml, line 2, column 12: the template 'no.svg' cannot be read: there is no such file "
       "(check the path)"},
      {"[fields]\ntitle = 1.5", "the field 'title' is no text"},
      {"[sets]\na = \"set(a)\"\n" + std::string(kView), "the set 'a' needs itself"},
      {"[defaults]\ndirection = \"top\"\n" + std::string(kView),
       "[defaults] has no key 'direction'"},
      {"[arrangement]\nviews = [\"above\"]",
       "'views' of [arrangement] names 'above' (its views are"},
      {"[arrangement]\nviews = [\"top\", \"top\"]", "the name 'top' is given to two views"},
      {"[arrangement]\ndirection = \"iso\"", "does not look along an axis"},
      {"[arrangement]\ndirection = \"top\"\nup = [1, 1, 0]", "does not look along an axis"},
      {"[arrangement]\ngap = \"2m\"", "wider than any sheet"},
      {"[arrangement]\nviews = [\"top\"]\n[arrangement.left]\ntitle = \"x\"",
       "[arrangement.left] is about a view that is not arranged"},
      {"[arrangement.top]\nscale = \"1:2\"", "[arrangement.top] has no key 'scale'"},
      {"[[view]]\n", "[[view]] has no 'name'"},
      {std::string(kView) + kView, "line 3, column 1: the name 'v' is given to two views"},
      {std::string(kView) + "[[view]]\nname = \"w\"\nposition = [0, 0]",
       "line 1, column 1: the view 'v' has no place on the sheet"},
      {std::string(kView) + "direction = \"sideways\"",
       "'direction' of [[view]] 'v' is no direction"},
      {std::string(kView) + "direction = [0, 0, 0]", "is no direction"},
      {std::string(kView) + "direction = [nan, 0, 1]", "is no direction"},
      {std::string(kView) + "direction = [0, 0, 1]\nup = [0, 0, 2]", "parallel to its direction"},
      {std::string(kView) + "eye = [0, 0, 0]\ntarget = [\"1m\", 0, 0]\ndirection = \"top\"",
       "line 5, column 13: 'direction' of [[view]] 'v' stands beside an eye"},
      {std::string(kView) + "target = [0, 0, 0]", "'target' of [[view]] 'v' goes with an eye"},
      {std::string(kView) + "near = \"1m\"", "'near' of [[view]] 'v' goes with an eye"},
      {std::string(kView) + "eye = [0, 0, 0]", "the eye of [[view]] 'v' has no target"},
      {std::string(kView) + "eye = [0, 0, 0]\ntarget = [0, 0, 0]",
       "the eye and the target are the same point (give a target"},
      {std::string(kView) + "eye = [0, 0, \"1e30m\"]\ntarget = [0, 0, 0]",
       "'eye' of [[view]] 'v' lies outside what can be placed"},
      {std::string(kView) + "eye = [0, 0, 0]\ntarget = [\"1m\", 0, 0]\nanchor = [\"-1m\", 0, 0]",
       "line 5, column 10: 'anchor' of [[view]] 'v' lies behind the eye"},
      {std::string(kView) + "eye = [0, 0, 0]\ntarget = [\"1m\", 0, 0]\nanchor = [\"20mm\", 0, 0]",
       "or nearer to it than what is drawn"},
      {std::string(kView) + "eye = [0, 0, 0]\ntarget = [\"1m\", 0, 0]\nnear = 0",
       "line 3, column 7: of [[view]] 'v' the near distance is not between"},
      {std::string(kView) + "eye = [0, 0, 0]\ntarget = [\"1m\", 0, 0]\nnear = \"2m\"",
       "the target lies nearer to the eye than what is drawn"},
      {std::string(kView) + "eye = [0, 0, 0]\ntarget = [\"1m\", 0, 0]\nfield_of_view = \"180deg\"",
       "the field of view is not between 1 and 160 degrees"},
      {std::string(kView) + "hatch = { foo = 1 }", "(its keys are select, angle, spacing"},
      {std::string(kView) + "eye = [0, 0, 0]\ntarget = [\"1m\", 0, 0]\nup = [1, 0, 0]",
       "parallel to its direction"},
      {std::string(kView) + "eye = [0, 0, 0]\ntarget = [\"1m\", 0, 0]\nfield_of_view = 90",
       "not an angle in quotes"},
      {"[arrangement]\neye = [0, 0, 0]", "[arrangement] has no key 'eye'"},
      {std::string(kView) + "uncut = 3", "'v', uncut"},
      {std::string(kView) + "flush_seams = \"hidden\"", "'flush_seams' of [[view]] 'v'"},
      {std::string(kView) + "hatch = 3", "'hatch' of [[view]] 'v' is a whole number, not a table"},
      {std::string(kView) + "hatch = { angel = \"9deg\" }",
       "'hatch' of [[view]] 'v' has no key 'angel'"},
      {std::string(kView) + "hatch = { angle = \"200deg\" }", "is no way of lines"},
      {std::string(kView) + "hatch = [{ select = [] }]",
       "'select' of 'hatch' of [[view]] 'v' picks nothing"},
      {std::string(kView) + "limits = 3", "'limits' of [[view]] 'v' is neither a box nor \"auto\""},
      {std::string(kView) + "limits = { min = [0, 0, 0] }", "wants both corners"},
      {std::string(kView) + "limits = { min = [\"1m\", 0, 0], max = [0, 0, 0] }", "ends before"},
      {std::string(kView) + "limits = { min = [0, 0, 0], max = [\"1e30m\", 0, 0] }",
       "outside what can be placed"},
      {std::string(kView) + "hidden = \"dotted\"", "write one of \"off\", \"dashed\", \"all\""},
      {std::string(kView) + "select = \"type =\"", "[[view]] 'v', select, selection, column 7"},
      {std::string(kView) + "select = []", "'select' of [[view]] 'v' picks nothing"},
      {std::string(kView) + "select = \"set(x)\"", "no set is called 'x'"},
      {std::string(kView) + "sharp_angle = \"200deg\"", "no angle between two faces"},
      {std::string(kView) + "scale = \"-1:5\"", "'scale' of [[view]] 'v'"},
      {std::string(kView) + "position = [\"1mm\"]", "no list of 2"},
      {std::string(kView) + "position = [\"1e300mm\", 0]", "far off any sheet"},
      {std::string(kView) + "sections = \"w=3m\"",
       "'sections' of [[view]] 'v' has what is no section"},
      {std::string(kView) + "sections = [\"z>3m\", \"z>y=3m\"]", "has what is no section plane"},
      {std::string(kView) + "direction = \"top\"\nsections = [\"x=3m\"]",
       "line 4, column 13: in the view 'v' the plane \"x=3m\" is seen edge-on"},
      {"[arrangement]\nsections = [\"y=3m\"]\n", "line 2, column 13: in the view 'top' the plane"},
      {"[defaults]\nsections = [\"x=3m\"]\n" + std::string(kView) +
           "direction = \"top\"\nsections = []\n" + "[[tag]]",
       "[[tag]] has no 'select'"},
      {std::string(kView) + "section = 3", "[[view]] 'v' has no key 'section'"},
      {std::string(kView) + "[[tag]]\ntext = \"x\"", "[[tag]] has no 'select'"},
      {std::string(kView) + "[[tag]]\nselect = \"*\"", "[[tag]] has no 'text'"},
      {std::string(kView) + "[[tag]]\nselect = \"*\"\ntext = \"{{name\"", "a '{{' is not closed"},
      {std::string(kView) + "[[tag]]\nselect = \"*\"\ntext = \"{{DN}}\"",
       "has {{DN}} (write {{name}}"},
      {std::string(kView) + "[[tag]]\nselect = \"*\"\ntext = \"x\"\nviews = [\"w\"]",
       "'views' of [[tag]] names 'w', but the sheet has no view 'w' (its views are v)"},
      {"[[tag]]\nselect = \"*\"\ntext = \"x\"\nviews = [\"w\"]",
       "the sheet has no view 'w' (no views are defined: add [[view]] with name = \"w\")"},
      {std::string(kView) + "[[tag]]\nselect = \"*\"\ntext = \"x\"\nheight = \"1m\"",
       "letters of this height"},
      {std::string(kView) + "[grid]\nx = [[\"A\"]]", "a line without label or place"},
      {std::string(kView) + "[grid]\nx = [[\"A\", 5]]", "not a length with its unit"},
      {std::string(kView) + "[[grid.series]]\naxis = \"x\"\nlabel = \"FR\"",
       "where the number goes"},
      {std::string(kView) +
           "[[grid.series]]\naxis = \"x\"\nlabel = \"{{n}}\"\nfirst = 0\nlast = 99999999\n"
           "spacing = \"1m\"",
       "10000 lines at most"},
      {std::string(kView) + "[styles]\nthick = { width = \"1mm\" }",
       "no lines are called 'thick' (the classes are outline, edge, boundary"},
      {std::string(kView) + "[styles]\nedge = { width = 0 }", "no pen is so wide"},
      {std::string(kView) + "[styles]\nedge = { dash = [\"1mm\"] }", "no list of dashes and gaps"},
      {std::string(kView) + "[styles]\nedge = { dash = [\"1mm\", 0] }", "a length out of bounds"},
      {std::string(kView) + "[styles]\nedge = { color = \"red\" }", "'red' is no colour"},
  };
  for (const auto& [text, want] : faults) {
    const std::string fault = fault_of(text);
    EXPECT_NE(fault.find(want), std::string::npos) << text << "\n-> " << fault;
    EXPECT_TRUE(fault.starts_with("s.toml")) << fault;
  }
}

TEST(SheetFileText, ATemplateOfAnotherSizeIsRefused) {
  const test::Templates templates{{"f.svg",
                                   "<svg xmlns='http://www.w3.org/2000/svg' width='297mm' "
                                   "height='210mm' viewBox='0 0 297 210'/>"}};
  const std::string view = kView;
  EXPECT_EQ(fault_of("[sheet]\ntemplate = \"f.svg\"\n" + view, templates), "");
  EXPECT_EQ(fault_of("[sheet]\nsize = \"A4\"\ntemplate = \"f.svg\"\n" + view, templates), "");
  EXPECT_NE(fault_of("[sheet]\nsize = \"A3\"\ntemplate = \"f.svg\"\n" + view, templates)
                .find("the template is 297 x 210 mm, the sheet 420 x 297"),
            std::string::npos);
}

TEST(SheetFileText, TheExampleIsUnderstood) {
  std::ifstream file(STRAKE_SOURCE_DIR "/examples/ship_sheet.toml");
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  EXPECT_FALSE(text.empty());
  EXPECT_EQ(fault_of(text), "");
}

}  // namespace
}  // namespace strake::sheets
