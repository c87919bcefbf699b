// SPDX-License-Identifier: Apache-2.0
#include "hlr/incremental/shape_hash.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include "hlr/incremental/extents.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/primitive.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::hlr {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are hashed as they lie");

/// Gathers numbers to be hashed at once; keeps its memory from shape to shape.
class HashedNumbers {
 public:
  void add(std::uint64_t word) { words_.push_back(word); }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value + 0.0)); }
  template <class Range>
  void add_all(const Range& values) {
    const Hash128 hash = hash_bytes(std::as_bytes(std::span(values.data(), values.size())));
    words_.insert(words_.end(), {values.size(), hash.high, hash.low});
  }
  [[nodiscard]] Hash128 take() {
    const Hash128 hash = hash_bytes(std::as_bytes(std::span(words_)));
    words_.clear();
    return hash;
  }

 private:
  std::vector<std::uint64_t> words_;
};

void add(HashedNumbers& words, const geometry::Primitive& primitive) {
  words.add(std::uint64_t{primitive.index()});
  std::visit(
      [&](const auto& kind) {
        using Numbers = std::array<double, sizeof(kind) / sizeof(double)>;
        for (const double number : std::bit_cast<Numbers>(kind)) words.add(number);
      },
      primitive);
}

void add(HashedNumbers& words, const geometry::Part& part, const geometry::Vec3i& from) {
  const std::uint64_t flags = (part.flags.inverted ? 1U : 0U) | (part.flags.open ? 2U : 0U) |
                              (part.flags.non_manifold ? 4U : 0U) |
                              (part.flags.unknown_sag ? 8U : 0U);
  words.add(std::uint64_t{static_cast<std::uint8_t>(part.kind)} << 8U | flags);
  words.add(part.sag);
  words.add(part.weld);
  words.add(std::uint64_t{part.primitive.has_value()});
  if (part.primitive) add(words, *part.primitive);
  words.add(std::uint64_t{part.vertices.size()});
  for (const geometry::Vec3i& vertex : part.vertices)
    for (int k = 0; k < 3; ++k)
      words.add(static_cast<std::uint64_t>(std::int64_t{vertex[k]} - std::int64_t{from[k]}));
  words.add_all(part.triangles);
  words.add_all(part.faces);
  words.add_all(part.shells);
  words.add_all(part.chain_first);
}

}  // namespace

Result<std::vector<HashedShape>> hash_shapes(const model::Scene& scene,
                                             const parallel::Context& context) {
  return parallel::transform_with(
      context, {.name = "signatures: shapes", .n = scene.shapes.size(), .grain = 64},
      [] { return HashedNumbers(); },
      [&](HashedNumbers& words, std::size_t s) {
        const model::GridShape& shape = scene.shapes[s];
        words.add(std::uint64_t{shape.parts.size()});
        if (shape.single_line) words.add(std::uint64_t{1});
        for (const geometry::Part& part : shape.parts) add(words, part, shape.box.lo);
        HashedShape hashed{.hash = words.take(), .corner = {}};
        if (!shape.box.empty()) hashed.corner = shape.box.lo.as<std::int64_t>();
        hashed.made_for_views = is_made_for_views(shape);
        return hashed;
      });
}

}  // namespace strake::hlr
