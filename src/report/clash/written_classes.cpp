// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "strake/report/clash.hpp"

namespace strake::report {

void leave_out_others(clash::Findings& findings, const WrittenClasses& classes) {
  for (clash::Report& test : findings.tests)
    std::erase_if(test.pairs, [&](const clash::Pair& pair) {
      return !classes.has(pair.cls) && !classes.has(pair.severest);
    });
}

}  // namespace strake::report
