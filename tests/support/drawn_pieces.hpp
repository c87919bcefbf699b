// SPDX-License-Identifier: Apache-2.0
// What laws speak of: the pieces of a view.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "strake/hlr/hlr.hpp"

namespace strake::test {

inline std::vector<hlr::EdgePiece> pieces(const model::Scene& scene, const hlr::View& view,
                                          const hlr::Options& options = {},
                                          const parallel::Context& context = {}) {
  const auto drawing = hlr::draw(scene, {}, view, options, context);
  EXPECT_TRUE(drawing.has_value()) << drawing.error().text();
  return drawing ? drawing->pieces : std::vector<hlr::EdgePiece>{};
}

}  // namespace strake::test
