// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "strake/geometry/analyse.hpp"
#include "strake/model/scene.hpp"

namespace strake::model {

/// A shape under one linear map, with what was noticed on the way.
struct GridShapeResult {
  GridShape shape;
  geometry::MeshFindings findings;
  std::uint64_t bad_triangles = 0;
  std::uint64_t bad_points = 0;
  std::string_view fault;  ///< why the shape has no parts; empty when it has some
};

[[nodiscard]] GridShapeResult make_grid_shape(const Shape& shape, const geometry::Mat3d& linear,
                                              double sag_mm);

}  // namespace strake::model
