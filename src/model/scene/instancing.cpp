// SPDX-License-Identifier: Apache-2.0
#include "model/scene/instancing.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace strake::model {
namespace {

using geometry::Part;
using geometry::Triangle;
using geometry::Vec3i;
using geometry::Vec3l;

/// Whether the parts say all there is of a shape.
bool is_mesh(const GridShapeResult& made) {
  return made.fault.empty() && std::ranges::none_of(made.shape.parts, [](const Part& part) {
           return part.primitive.has_value() || part.vertices.empty();
         });
}

Vec3l anchor(const GridShape& shape) { return shape.parts[0].vertices[0].as<std::int64_t>(); }

bool same_flags(const geometry::PartFlags& a, const geometry::PartFlags& b) {
  return a.inverted == b.inverted && a.open == b.open && a.non_manifold == b.non_manifold &&
         a.unknown_sag == b.unknown_sag;
}

// Edges and boxes follow from what is compared.
bool same_part(const Part& a, const Part& b, const Vec3l& moved) {
  const auto same_place = [&](const Vec3i& p, const Vec3i& q) {
    return p.as<std::int64_t>() + moved == q.as<std::int64_t>();
  };
  return a.kind == b.kind && same_flags(a.flags, b.flags) && a.sag == b.sag && a.weld == b.weld &&
         a.volume == b.volume && a.area == b.area && a.shell_count == b.shell_count &&
         a.chain_first == b.chain_first && a.triangles == b.triangles && a.faces == b.faces &&
         a.shells == b.shells && std::ranges::equal(a.vertices, b.vertices, same_place);
}

}  // namespace

Vec3l translation_between(const GridShape& from, const GridShape& to) {
  return anchor(to) - anchor(from);
}

std::uint64_t translation_invariant_hash(const GridShape& shape) {
  const Vec3l from = anchor(shape);
  std::uint64_t hash = parallel::mixed(0, shape.parts.size());
  for (const Part& part : shape.parts) {
    hash = parallel::mixed(hash, std::bit_cast<std::uint64_t>(part.sag + 0.0));
    for (const Vec3i& v : part.vertices) {
      const Vec3l at = v.as<std::int64_t>() - from;
      for (int k = 0; k < 3; ++k) hash = parallel::mixed(hash, static_cast<std::uint64_t>(at[k]));
    }
    // An exporter that splits the faces anew at every place has the same vertices and other
    // triangles.
    for (const Triangle& t : part.triangles)
      hash = parallel::mixed(parallel::mixed(hash, std::uint64_t{t[0]} << 32U | t[1]), t[2]);
  }
  return hash;
}

Result<parallel::Distinct> find_equal_shapes(std::span<const GridShapeResult> shapes,
                                             const parallel::Context& context) {
  return parallel::distinct(
      context, "equal shapes", shapes.size(),
      [&](std::size_t i) {
        return is_mesh(shapes[i]) ? translation_invariant_hash(shapes[i].shape)
                                  : parallel::mixed(1, i);
      },
      [&](std::size_t i, std::size_t j) {
        if (!is_mesh(shapes[i]) || !is_mesh(shapes[j])) return false;
        const GridShape &a = shapes[i].shape, &b = shapes[j].shape;
        const Vec3l moved = translation_between(a, b);
        return std::ranges::equal(
            a.parts, b.parts, [&](const Part& p, const Part& q) { return same_part(p, q, moved); });
      });
}

}  // namespace strake::model
