// SPDX-License-Identifier: Apache-2.0
// Boxes in a row with a result of each class, as outputs are tried with them.
#pragma once

#include "support/clash_model.hpp"

namespace strake::test {

/// Boxes that hit by 20.5 mm, touch and stand 10 mm apart.
inline ClashModel row_of_boxes() {
  ClashModel m;
  m.box("a", {0, 0, 0}, {100, 100, 100}).box("b", {79.5, 0, 0}, {200, 100, 100});
  m.box("c", {200, 0, 0}, {300, 100, 100}).box("d", {310, 0, 0}, {400, 100, 100});
  return m;
}

/// What is found in it, up to 25 mm apart.
inline clash::Findings findings_up_to_25_mm(const ClashModel& m) {
  return {{m.detect({.tolerances = {.clearance_mm = 25}})}, {}};
}

}  // namespace strake::test
