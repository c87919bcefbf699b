// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "support/io_seeds.hpp"

namespace strake::test {

/// Small rules files that between them use what the language has.
[[nodiscard]] inline std::vector<Seed> rules_seeds() {
  return {{"tests.toml", R"toml(# Two tests.
[defaults]
clearance = "25mm"
touch_overlap = 0
thickness_cap = false
contact_distance = "5um"
[sets]
steel = "path = '*/HULL/*' and not name ~ '^(a|b)[0-9]?'"
"pipes" = "@DN >= 80mm or set(steel)"
[[test]]
name = "one"
a = "set(steel)"
b = '''*'''
clearance = "@'INSU 1' + 1in"
relations = ["duplicate"]
min_volume = "1l"
[[test]]
name = "\u00fcff"
enabled = false
[[exempt]]
name = "old"
a = "name = 'a'"
b = "name = 'b'"
)toml"},
          {"matrix.toml", R"toml([[discipline]]
name = "steel"
select = "name = 'a'"
[[discipline]]
name = "rest"
select = "*"
[matrix]
name = "m"
missing = "checked"
[matrix.cells.steel]
steel = "not checked"
rest = { clearance = "10mm", touch_gap = 0 }
[obstruction]
attribute = "OBST"
volumes = "soft"
none = "name = 'NOTE*'"
hard = "name = 'a'"
[insulation]
select = "name = 'LAG*'"
against_soft = true
)toml"},
          {"rules.toml", R"toml([[file]]
name = "*.stl"
unit = "m"
up_axis = "y"
[unit_groups]
attribute = "UNIT"
[[unit_groups.group]]
number = 7
select = "name = 'b'"
[[same_assembly]]
name = "item"
level = "assembly"
[[same_assembly]]
name = "one"
level = 3
[[connected]]
name = "joints"
attributes = ["HREF", "TREF"]
inherited = "ends"
by = "partner"
separator = ","
[[connected]]
name = "ends"
ends_within = "5mm"
among = "name = 'b'"
[[same_attribute]]
name = "system"
attribute = "SYSTEM"
[[allowed]]
name = "inside"
a = "*"
b = "*"
relation = ["inside", "THROUGH"]
max_volume = "5cm3"
[[allowed]]
name = "seats"
a = "*"
b = "name = 'b*'"
max_depth = "2mm"
region = { min = ["0m", "0m", "0m"], max = ["40m", "12m", "9m"] }
cavity = [ { point = ["0m", "0m", "3m"], normal = [0, 0, 1] } ]
)toml"}};
}

}  // namespace strake::test
