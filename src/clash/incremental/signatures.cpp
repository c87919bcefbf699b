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
#include "strake/parallel/transform.hpp"

namespace strake::clash {
namespace {

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
                              std::span<const Hash128> shape_hashes) {
  // Only shares the work out: between 256 and 4096 no difference can be seen (decision 0073).
  constexpr std::size_t kGrain = 1024;
  if (const Status s = check_inputs(scene, sets, options, policy); !s) return s.error();
  if (!shape_hashes.empty() && shape_hashes.size() != scene.model->shapes.size())
    return Error{ErrorCode::usage, "there are not as many hashes as shapes", {}, {}};
  const auto shapes = shape_signatures(scene, shape_hashes, context);
  if (!shapes) return shapes.error();
  const ElementHashes elements(*scene.model);
  const RuleSignatures rules(sets, options, policy, elements);
  const ObjectSignatures of_objects(scene, *shapes, rules);
  auto objects = parallel::transform(
      context, {.name = "signatures of objects", .n = scene.model->objects.size(), .grain = kGrain},
      [&](std::size_t o) { return of_objects.of(static_cast<std::uint32_t>(o)); });
  if (!objects) return objects.error();
  return Signatures{settings_signature(scene, sets, options, policy), std::move(*objects)};
}

}  // namespace strake::clash
