// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "strake/hlr/hlr.hpp"
#include "support/clash_model.hpp"

namespace strake::test {

/// What a drawing shows of each kind in each state.
struct DrawnLengths {
  std::map<std::pair<hlr::EdgeKind, hlr::State>, double> lengths;     ///< grid units
  std::map<std::pair<hlr::EdgeKind, hlr::State>, std::size_t> edges;  ///< of a millimetre and more
};

/// A mesh alone, its seams closed up to `weld_mm`.
inline DrawnLengths drawn_lengths(const geometry::TriangleMesh& mesh, double weld_mm,
                                  const geometry::Vec3l& direction) {
  ClashModel m;
  m.object("a").body(mesh);
  const model::Scene scene = make_scene(m.model, {.weld_mm = weld_mm}, {}).value();
  const auto drawing = hlr::draw(scene, {}, {.direction = direction, .limits = {}}, {}, {});
  EXPECT_TRUE(drawing.has_value());
  DrawnLengths found;
  if (!drawing) return found;
  for (const hlr::EdgePiece& p : drawing->pieces) {
    const auto way = (p.b - p.a).as<double>();
    const double length = std::sqrt(dot(way, way));
    found.lengths[{p.kind, p.state}] += length;
    if (length > 1000) ++found.edges[{p.kind, p.state}];
  }
  return found;
}

}  // namespace strake::test
