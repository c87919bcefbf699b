// SPDX-License-Identifier: Apache-2.0
#include "geometry/turned_part.hpp"

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace strake::geometry {
namespace {

/// Turned coordinates may not be larger: they are kept in 32 bits.
constexpr double kFarthest = 2147483000;

}  // namespace

std::optional<TurnedPart> turned_part(const PartView& view, const Axes& axes,
                                      const parallel::Context& context) {
  Part part;
  part.triangles = view.part().triangles;
  part.vertices.resize(view.part().vertices.size());
  for (std::uint32_t v = 0; v < part.vertices.size(); ++v) {
    const Vec3d at = turned(axes, view.vertex(v).as<double>());
    for (int k = 0; k < 3; ++k) {
      if (!(std::fabs(at[k]) < kFarthest)) return std::nullopt;
      part.vertices[v][k] = static_cast<std::int32_t>(std::llround(at[k]));
    }
  }
  const std::vector<std::uint32_t>& some = view.tree().order();
  PartTree tree =
      some.size() == part.triangles.size() ? PartTree(part, context) : PartTree(part, some);
  if (tree.nodes().empty()) return std::nullopt;
  return TurnedPart{std::move(part), std::move(tree)};
}

}  // namespace strake::geometry
