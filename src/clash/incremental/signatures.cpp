// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "clash/detect.hpp"
#include "clash/incremental/rule_signatures.hpp"
#include "clash/incremental/shape_signatures.hpp"
#include "strake/clash/incremental.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/slots.hpp"
#include "strake/parallel/transform.hpp"

// Decision 0106 says what may be known of objects without looking at them.

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

/// Returns hashes of ranges of objects: of what their signatures are made from, without looking at
/// the model's objects and bodies. `inputs` is hash_of_inputs(). Nothing where too little is known.
/// Errors: cancelled.
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

/// Hashes what a scene and a test have about single objects.
class ObjectSignatures {
 public:
  ObjectSignatures(const model::Scene& scene, const ShapeSignatures& shapes,
                   const RuleSignatures& rules)
      : scene_(scene), shapes_(shapes), rules_(rules) {}

  [[nodiscard]] Hash128 of(std::uint32_t o) const {
    WordHash hash;
    if (scene_.model->objects[o].incomplete) hash.add(std::string_view("incomplete"));
    for (const model::GridBody& body : scene_.bodies_of(model::ObjectId{o})) add_body(body, hash);
    for (auto at = std::ranges::lower_bound(scene_.lacking, model::ObjectId{o}, {},
                                            &model::IncompleteObject::object);
         at != scene_.lacking.end() && at->object == model::ObjectId{o}; ++at)
      hash.add(at->code);
    rules_.add(o, hash);
    return hash.value();
  }

 private:
  void add_body(const model::GridBody& placed, WordHash& hash) const {
    const model::Body& body = scene_.model->bodies[placed.body];
    // What the snap moved follows from the source's numbers.
    hash.add(shapes_.on_grid[placed.grid_shape]).add(shapes_.of_source[index(body.shape)]);
    for (int k = 0; k < 3; ++k) hash.add(placed.origin[k]).add(body.placement.translation[k]);
    // Most are not turned: so few words take half the time.
    const bool turned = !(body.placement.linear == geometry::Mat3d{});
    hash.add(std::uint64_t{std::bit_cast<std::uint32_t>(body.precision_um)} << 32U |
             static_cast<std::uint64_t>(body.category) << 1U | (turned ? 1U : 0U));
    if (!turned) return;
    for (const geometry::Vec3d& row : body.placement.linear.row)
      hash.add(row.x).add(row.y).add(row.z);
  }

  const model::Scene& scene_;
  const ShapeSignatures& shapes_;
  const RuleSignatures& rules_;
};

}  // namespace

Result<Signatures> signatures(const model::Scene& scene, const Sets& sets, const Options& options,
                              const Policy& policy, const parallel::Context& context,
                              const KnownModel& known, const EarlierSignatures& earlier) {
  if (const Status s = check_inputs(scene, sets, options, policy); !s) return s.error();
  if (!known.shapes.empty() && known.shapes.size() != scene.model->shapes.size())
    return Error{ErrorCode::usage, "there are not as many hashes as shapes", {}, {}};
  const auto shapes = shape_signatures(scene, known.shapes, context);
  if (!shapes) return shapes.error();
  const Hash128 inputs = hash_of_inputs(scene, sets, options, policy);
  auto ranges = range_hashes(scene, *shapes, inputs, known, context);
  if (!ranges) return ranges.error();
  const std::size_t objects = scene.model->objects.size();
  auto signed_objects = parallel::slots<Hash128>(objects, context);
  if (!signed_objects) return signed_objects.error();
  const ElementHashes elements(*scene.model);
  const RuleSignatures rules(sets, options, policy, elements);
  const ObjectSignatures of_objects(scene, *shapes, rules);
  const bool fits = earlier.objects.size() == objects && earlier.ranges.size() == ranges->size();
  const std::size_t count =
      (objects + Signatures::kObjectsPerRange - 1) / Signatures::kObjectsPerRange;
  const Status done = parallel::for_each(
      context, {.name = "signatures of objects", .n = count}, [&](std::size_t k) {
        const std::size_t from = k * Signatures::kObjectsPerRange;
        const std::size_t to = std::min(objects, from + Signatures::kObjectsPerRange);
        if (fits && k < ranges->size() && earlier.ranges[k] == (*ranges)[k]) {
          const auto known_ones = earlier.objects.subspan(from, to - from);
          std::ranges::copy(known_ones,
                            signed_objects->begin() + static_cast<std::ptrdiff_t>(from));
          return;
        }
        for (std::size_t o = from; o < to; ++o)
          (*signed_objects)[o] = of_objects.of(static_cast<std::uint32_t>(o));
      });
  if (!done) return done.error();
  return Signatures{settings_signature(scene, sets, options, policy), std::move(*signed_objects),
                    std::move(*ranges)};
}

}  // namespace strake::clash
