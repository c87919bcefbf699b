// SPDX-License-Identifier: Apache-2.0
#include "clash/incremental/range_hashes.hpp"

#include <algorithm>
#include <cstdint>
#include <span>

#include "strake/parallel/transform.hpp"

namespace strake::clash {
namespace {

/// Returns the hash of what concerns all ranges: numbers of shapes mean the same, and so do those
/// that sets and rules have of objects.
Hash128 hash_of_all(const model::Scene& scene, const ShapeSignatures& shapes, const Hash128& inputs,
                    const KnownModel& known) {
  WordHash hash;
  hash.add(known.objects).add(inputs);
  hash.add(hash_bytes(std::as_bytes(std::span(shapes.on_grid))));
  hash.add(hash_bytes(std::as_bytes(std::span(shapes.of_source))));
  for (const model::IncompleteObject& lacking : scene.lacking)
    hash.add(index(lacking.object)).add(lacking.code);
  return hash.value();
}

/// Adds what is known of the bodies [first, last] of a model.
void add_source(WordHash& hash, std::span<const HashedBodies> bodies, std::uint32_t first,
                std::uint32_t last) {
  auto at = std::ranges::upper_bound(bodies, first, {}, &HashedBodies::first);
  if (at != bodies.begin()) --at;
  for (; at != bodies.end() && at->first <= last; ++at) hash.add(at->first).add(at->hash);
}

Hash128 hash_of_range(const model::Scene& scene, std::size_t range, const Hash128& all,
                      const KnownModel& known) {
  const std::size_t objects = scene.model->objects.size();
  const std::size_t from = range * Signatures::kObjectsPerRange;
  const std::size_t to = std::min(objects, from + Signatures::kObjectsPerRange);
  const std::span<const model::GridBody> bodies =
      std::span(scene.bodies)
          .subspan(scene.first_body[from], scene.first_body[to] - scene.first_body[from]);
  WordHash hash;
  hash.add(all);
  if (bodies.empty()) return hash.value();
  std::uint32_t first = bodies[0].body, last = first;
  for (const model::GridBody& body : bodies) {
    hash.add(std::uint64_t{body.grid_shape} << 32U | body.body).add(index(body.object));
    hash.add(body.origin.x).add(body.origin.y).add(body.origin.z);
    first = std::min(first, body.body);
    last = std::max(last, body.body);
  }
  add_source(hash, known.bodies, first, last);
  return hash.value();
}

}  // namespace

Result<std::vector<Hash128>> range_hashes(const model::Scene& scene, const ShapeSignatures& shapes,
                                          const Hash128& inputs, const KnownModel& known,
                                          const parallel::Context& context) {
  const bool is_known = known.objects != Hash128() && !known.bodies.empty() &&
                        known.bodies.front().first == 0 &&
                        known.shapes.size() == scene.model->shapes.size();
  if (!is_known) return std::vector<Hash128>();
  const Hash128 all = hash_of_all(scene, shapes, inputs, known);
  const std::size_t ranges = (scene.model->objects.size() + Signatures::kObjectsPerRange - 1) /
                             Signatures::kObjectsPerRange;
  return parallel::transform(context, {.name = "what signatures are made from", .n = ranges},
                             [&](std::size_t k) { return hash_of_range(scene, k, all, known); });
}

}  // namespace strake::clash
