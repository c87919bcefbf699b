// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "support/io_seeds.hpp"

namespace strake::test {

/// A template that uses what templates may.
inline constexpr const char* kSheetTemplate =
    R"svg(<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" width="420mm" height="297mm" viewBox="0 0 420 297">
<style>.a { stroke: #000; fill: url(#p) }</style>
<!-- the border --><metadata><x:y z="1"/></metadata>
<g id="b" class="a"><path d="M20 10H410V287H20Z"/></g><use xlink:href="#b"/>
<text x="300" y="280">{{title}} &amp; {{number}} &#65;<tspan>{{scale}}</tspan></text>
</svg>
)svg";

/// Small sheet files and a template that between them use what the language has.
[[nodiscard]] inline std::vector<Seed> sheet_seeds() {
  return {{"arranged.toml", R"toml(# Four views.
[sheet]
size = "A3"
template = "f.svg"
area = ["20mm", "10mm", "410mm", "230mm"]
[fields]
title = "Deck"
number = 17
[sets]
a = "name = 'base'"
[arrangement]
projection = "third-angle"
views = ["top", "iso"]
hidden = "dashed"
[arrangement.top]
select = "set(a)"
[[tag]]
select = "*"
text = "{{name}} {{@DN}}"
once = true
[grid]
x = [["A", "0m"], ["B", "2.5m"]]
[[grid.series]]
axis = "y"
label = "{{n}}"
first = -2
last = 12
spacing = "600mm"
)toml"},
          {"free.toml", R"toml([sheet]
size = ["500mm", "300mm"]
scale = "1:50"
keep_free = [["300mm", "200mm", "490mm", "290mm"]]
[defaults]
sharp_angle = "25deg"
contact_distance = "5um"
limits = { min = ["-1m", 0, 0], max = ["9m", "9m", "9m"] }
[[view]]
name = "detail"
title = "D"
direction = [1, -2.5, 1]
up = "0,0,1"
scale = "1:20"
position = ["200mm", "150mm"]
anchor = ["1m", "2m", "-3m"]
stage = "local"
intersections = "off"
own_polylines = "hidden"
[[tag]]
select = "type = mesh"
text = "{{path}}"
style = "plain"
height = "3.5mm"
[styles]
hidden = { width = "0.2mm", dash = ["2mm", "1mm"], color = "#123ABC" }
)toml"},
          {"eye.toml", R"toml([[view]]
name = "walk"
eye = ["2m", "-9m", "1.7m"]
target = ["2m", 0, "1m"]
near = "50mm"
field_of_view = "70deg"
position = ["120mm", "100mm"]
[[view]]
name = "cut"
direction = "front"
sections = ["y<300mm"]
hatch = [{ select = "type = mesh", angle = "30deg", spacing = "80mm" }, { spacing = 0 }]
position = ["300mm", "100mm"]
)toml"},
          {"notes.toml", R"toml([sheet]
hidden_layers = "two"
[arrangement]
views = ["front", "top"]
centre_lines = "3mm"
[arrangement.front]
sections = "y=1m"
section_mark = "A"
[arrangement.top]
extents_of = ["front"]
[levels]
z = ["0m", ["DECK", "1m"]]
[scale_bar]
position = ["20mm", "250mm"]
[north]
direction = "1,2,0"
view = "top"
[[parts_list]]
title = "PARTS"
select = "*"
columns = [["NAME", "{{name}}"], ["DN", "{{@DN}}"]]
[[revision]]
revision = "A"
date = "2026-01-05"
text = "First"
by = "NN"
[[dimension]]
view = "front"
from = { object = "base", side = "left" }
to = ["4m", 0, 0]
place = "below"
decimals = 1
)toml"},
          {"parts.toml", R"toml([defaults]
match_lines = "on"
break_lines = "on"
[[view]]
name = "aft"
direction = "top"
limits = { min = [0, 0, 0], max = ["2m", "2m", "2m"] }
position = ["100mm", "100mm"]
[[view]]
name = "fore"
direction = "top"
limits = { min = ["2m", 0, 0], max = ["6m", "2m", "2m"] }
match_lines = "off"
position = ["250mm", "100mm"]
[[tag]]
select = "*"
text = "{{name}}"
style = "along"
[[parts_list]]
select = "*"
columns = [["NAME", "{{name}}"]]
balloons = { views = ["fore", "aft"], size = "7mm", side = "top" }
)toml"},
          {"frame.svg", kSheetTemplate}};
}

}  // namespace strake::test
