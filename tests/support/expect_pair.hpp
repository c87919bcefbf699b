// SPDX-License-Identifier: Apache-2.0
// What a test asks of the only pair of a scene.
#pragma once

#include <gtest/gtest.h>

#include "support/clash_model.hpp"

namespace strake::test {

/// The only pair, or NO_HIT where there is none.
inline clash::Pair only(const ClashModel& m, const clash::Options& options = {}) {
  const clash::Report report = m.detect(options);
  EXPECT_LE(report.pairs.size(), 1U);
  return report.pairs.empty() ? clash::Pair{} : report.pairs.front();
}

inline void expect(const clash::Pair& p, clash::Class cls, clash::Relation relation, double d_mm,
                   double within = 1e-6) {
  EXPECT_EQ(name(p.cls), name(cls));
  EXPECT_EQ(name(p.relation), name(relation));
  EXPECT_NEAR(p.d_mm, d_mm, within);
  EXPECT_LE(p.d_lower_mm, p.d_mm);
  EXPECT_GE(p.d_upper_mm, p.d_mm);
}

}  // namespace strake::test
