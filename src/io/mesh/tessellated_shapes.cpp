// SPDX-License-Identifier: Apache-2.0
#include "io/mesh/tessellated_shapes.hpp"

#include <bit>
#include <variant>

#include "geometry/primitives/tessellate.hpp"

namespace strake::io {
namespace {

std::array<std::uint64_t, 9> bits_of(const geometry::Mat3d& m) {
  std::array<std::uint64_t, 9> bits{};
  for (std::size_t i = 0; i < 9; ++i)
    bits[i] = std::bit_cast<std::uint64_t>(m.row[i / 3][static_cast<int>(i % 3)] + 0.0);
  return bits;
}

}  // namespace

TessellatedShape TessellationCache::place(const model::Body& body) {
  const model::Shape& shape = model_->shapes[model::index(body.shape)];
  TessellatedShape placed;
  placed.placement = body.placement;
  placed.mesh = std::get_if<geometry::TriangleMesh>(&shape);
  placed.lines = std::get_if<geometry::Polylines>(&shape);
  const auto* const primitive = std::get_if<geometry::Primitive>(&shape);
  if (primitive == nullptr) return placed;

  const auto [entry, is_new] =
      made_.try_emplace({model::index(body.shape), bits_of(body.placement.linear)});
  if (is_new) {
    geometry::Tessellation made = geometry::tessellate(*primitive, body.placement.linear, sag_mm_);
    if (!made.mesh.triangles.empty())
      entry->second.mesh = &meshes_.emplace_back(std::move(made.mesh));
    else if (!made.lines.points.empty())
      entry->second.lines = &lines_.emplace_back(std::move(made.lines));
  }
  placed.mesh = entry->second.mesh;
  placed.lines = entry->second.lines;
  placed.placement.linear = geometry::Mat3d{};  // already in the triangles
  return placed;
}

void TessellationCache::release(std::deque<geometry::TriangleMesh>& meshes,
                                std::deque<geometry::Polylines>& lines) {
  meshes = std::move(meshes_);
  lines = std::move(lines_);
}

}  // namespace strake::io
