// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "geometry/primitives/lengths.hpp"
#include "hlr/incremental/extents.hpp"
#include "hlr/prepare/drawn_objects.hpp"
#include "hlr/prepare/view_job.hpp"
#include "hlr/view/projection.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/primitive.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/incremental.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::hlr {
namespace {

using geometry::Vec3l;

/// A shape as signatures see it.
struct HashedShape {
  Hash128 hash;                 ///< of its parts, from the corner
  geometry::Vec3l corner;       ///< the lowest of its box, in the coordinates of its bodies
  bool made_for_views = false;  ///< views tessellate it anew
};

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
        for (const double length : geometry::lengths_of(kind)) words.add(length);
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

/// Hashes the shapes of a scene. A hash does not show in which of several equal meshes, which lie
/// in other places, the scene found a shape first. Errors: cancelled.
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

// Only shares the work out: between 256 and 4096 no difference can be seen (decision 0073).
constexpr std::size_t kObjectsPerBlock = 1024;
/// To be raised when the same scene and view give another drawing than before; the first where
/// clipped edges are kept, in a parallel view, and the second else.
constexpr std::uint32_t kRulesOfDrawing = 5, kRulesOfOthers = 6;

void add(Hasher& hasher, const Vec3l& v) { hasher.add(v.x).add(v.y).add(v.z); }

void add(Hasher& hasher, const View& view) {
  add(hasher, view.direction);
  add(hasher, view.up);
  hasher.add(view.limits ? 1U : 0U);
  if (view.limits) {
    add(hasher, view.limits->lo);
    add(hasher, view.limits->hi);
  }
  hasher.add(std::uint64_t{view.sections.size()});
  for (const Section& section : view.sections) {
    add(hasher, section.normal);
    add(hasher, section.point);
  }
  hasher.add(view.perspective ? 1U : 0U);
  if (!view.perspective) return;
  add(hasher, view.perspective->eye);
  add(hasher, view.perspective->target);
  hasher.add(view.perspective->near_mm).add(view.perspective->field_of_view_deg);
}

/// Takes all options apart, so that a new one is thought of here. Solver, culling and bucketing
/// change the work and no line; hatches and what is left uncut stand in the words of each object.
void add(Hasher& hasher, const Options& options) {
  const auto& [stage, solver, sharp_angle, smooth, contact_distance, intersections, own_polylines,
               flush_seams, sag, culling, bucketing, hidden, clipped, keep_specks, hatch_spacing,
               hatches, uncut] = options;
  hasher.add(static_cast<std::uint32_t>(stage))
      .add(sharp_angle)
      .add(static_cast<std::uint32_t>(smooth))
      .add(contact_distance)
      .add(static_cast<std::uint32_t>(intersections))
      .add(static_cast<std::uint32_t>(own_polylines))
      .add(flush_seams ? 1U : 0U)
      .add(sag)
      .add((hidden ? 1U : 0U) | (clipped ? 0U : 2U))
      .add(keep_specks ? 1U : 0U)
      .add(hatch_spacing);
}

/// What a drawing sees of objects, as words that are hashed.
class ObjectHasher {
 public:
  ObjectHasher(const model::Scene& scene, const View& view, const Options& options,
               std::span<const HashedShape> shapes, const model::ViewTessellation& plan)
      : scene_(scene),
        options_(options),
        shapes_(shapes),
        plan_(plan),
        uses_colours_(!options.flush_seams || !view.sections.empty()) {}

  void add(std::vector<std::uint64_t>& words, std::uint32_t object) const {
    const model::ObjectId id{object};
    words.push_back(scene_.model->object(id).body_count > 0 ? 1 : 0);
    add_lacking(words, id);
    add_section_rules(words, object);
    for (const model::GridBody& body : scene_.bodies_of(id)) add(words, body);
  }

 private:
  void add_lacking(std::vector<std::uint64_t>& words, model::ObjectId id) const {
    const auto lacking =
        std::ranges::equal_range(scene_.lacking, id, {}, &model::IncompleteObject::object);
    words.push_back(lacking.size());
    for (const model::IncompleteObject& one : lacking) {
      add(words, one.code);
    }
  }

  static void add(std::vector<std::uint64_t>& words, std::string_view text) {
    const Hash128 hash = hash_bytes(std::as_bytes(std::span(text)));
    words.insert(words.end(), {hash.high, hash.low});
  }

  void add_section_rules(std::vector<std::uint64_t>& words, std::uint32_t object) const {
    words.push_back(!options_.uncut.empty() && options_.uncut[object] ? 1 : 0);
    const Hatch hatch = object < options_.hatches.size() ? options_.hatches[object] : Hatch();
    words.push_back(std::bit_cast<std::uint64_t>(hatch.angle_deg));
    words.push_back(std::bit_cast<std::uint64_t>(hatch.spacing_mm));
  }

  void add(std::vector<std::uint64_t>& words, const model::GridBody& body) const {
    const model::Body& placed = scene_.model->bodies[body.body];
    const HashedShape& shape = shapes_[body.grid_shape];
    const Vec3l at = body.origin + shape.corner;
    const model::Color& color = placed.color;
    const std::uint64_t ink =
        uses_colours_ ? std::uint64_t{color.red} << 16U | std::uint64_t{color.green} << 8U |
                            std::uint64_t{color.blue} | std::uint64_t{color.alpha} << 24U
                      : std::uint64_t{color.alpha == 255};
    words.insert(words.end(), {shape.hash.high, shape.hash.low, static_cast<std::uint64_t>(at.x),
                               static_cast<std::uint64_t>(at.y), static_cast<std::uint64_t>(at.z),
                               static_cast<std::uint64_t>(contact_of(placed, options_)), ink});
    if (shape.made_for_views) add_tessellation(words, body, placed);
  }

  /// The view makes the mesh from the primitive, as fine as the other bodies of the shape request.
  void add_tessellation(std::vector<std::uint64_t>& words, const model::GridBody& body,
                        const model::Body& placed) const {
    words.push_back((plan_.is_finer(body.grid_shape) ? 1U : 0U) | (plan_.any ? 2U : 0U));
    const Vec3l& base = scene_.shapes[body.grid_shape].base;
    words.insert(words.end(),
                 {static_cast<std::uint64_t>(base.x), static_cast<std::uint64_t>(base.y),
                  static_cast<std::uint64_t>(base.z)});
    for (const geometry::Vec3d& row : placed.placement.linear.row)
      for (int k = 0; k < 3; ++k) words.push_back(std::bit_cast<std::uint64_t>(row[k] + 0.0));
  }

  const model::Scene& scene_;
  const Options& options_;
  std::span<const HashedShape> shapes_;
  const model::ViewTessellation& plan_;
  bool uses_colours_;
};

}  // namespace

Result<Signatures> signatures(const model::Scene& scene, const std::vector<bool>& drawn,
                              const View& view, const Options& options,
                              const parallel::Context& context) {
  if (const Status status = check_drawn(scene, drawn); !status) return status.error();
  if (const Status status = check_drawn(scene, options.uncut); !status) return status.error();
  const auto tessellation_options = tessellation_of(view, options);
  if (!tessellation_options) return tessellation_options.error();
  Signatures result;
  Hasher hasher;
  hasher.add(options.clipped && !view.perspective ? kRulesOfDrawing : kRulesOfOthers)
      .add(scene.sag_mm)
      .add(scene.weld_mm);
  add(hasher, view);
  add(hasher, options);
  result.view = hasher.value();
  const auto plan = plan_view_tessellation(scene, drawn, *tessellation_options, context);
  if (!plan) return plan.error();
  const auto extents = shape_extents(scene, context);
  if (!extents) return extents.error();
  auto boxes = object_extents(scene, drawn, view, *extents, context);
  if (!boxes) return boxes.error();
  result.boxes = std::move(*boxes);
  const auto shapes = hash_shapes(scene, context);
  if (!shapes) return shapes.error();
  const ObjectHasher all(scene, view, options, *shapes, *plan);
  auto objects = parallel::transform_with(
      context,
      {.name = "signatures: objects", .n = scene.model->objects.size(), .grain = kObjectsPerBlock},
      [] { return std::vector<std::uint64_t>(); },
      [&](std::vector<std::uint64_t>& words, std::size_t o) {
        words.clear();
        if (drawn.empty() || drawn[o]) all.add(words, static_cast<std::uint32_t>(o));
        return hash_bytes(std::as_bytes(std::span(words)));
      });
  if (!objects) return objects.error();
  result.objects = std::move(*objects);
  return result;
}

}  // namespace strake::hlr
