// SPDX-License-Identifier: Apache-2.0
#include "page/geometry/model_blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "core/number.hpp"
#include "core/parting.hpp"
#include "page/blocks/columns.hpp"
#include "page/geometry/shape_book.hpp"
#include "report/text/formatting.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::page {
namespace {

using geometry::Box3l;
using geometry::Vec3d;

/// The box of an object that is shown as one.
struct ObjectBox {
  std::uint32_t object = 0;
  Box3l box;
};

/// How boxes are written: numbers of steps from a corner.
struct BoxLattice {
  Vec3d min_mm;  ///< from the page's origin
  double step_mm = 1;
};

struct SceneBoxes {
  Box3l all = geometry::empty_box<std::int64_t>();
  std::vector<ObjectBox> of_objects;
  /// Of each object that is shown the sum of its box's two corners, axis by axis.
  std::array<std::vector<std::int64_t>, 3> corner_sums;
};

SceneBoxes boxes_of(const model::Scene& scene, const ShownObjects& shown) {
  SceneBoxes boxes;
  for (std::uint32_t o = 0; o < shown.of.size(); ++o) {
    if (shown.of[o] == ShownAs::nothing) continue;
    Box3l box = geometry::empty_box<std::int64_t>();
    for (const model::GridBody& body : scene.bodies_of(model::ObjectId{o}))
      box.include(body.box(scene.shapes[body.grid_shape]));
    boxes.all.include(box);
    if (box.empty()) continue;
    for (int k = 0; k < 3; ++k)
      boxes.corner_sums[static_cast<std::size_t>(k)].push_back(box.lo[k] + box.hi[k]);
    if (shown.of[o] == ShownAs::box) boxes.of_objects.push_back({o, box});
  }
  return boxes;
}

/// Where most objects are, in whole millimetres: the median of their middles. The middle of all of
/// them would lie far from everything where a single object is far off, and 32-bit numbers are
/// coarse there (decision 0104).
Vec3d origin_of(SceneBoxes& boxes) {
  Vec3d origin{};
  for (int k = 0; k < 3; ++k) {
    std::vector<std::int64_t>& sums = boxes.corner_sums[static_cast<std::size_t>(k)];
    if (sums.empty()) return {};
    const std::int64_t middle = nth_value(std::span(sums), sums.size() / 2);
    origin[k] = std::round(static_cast<double>(middle) * geometry::kMmPerGrid / 2);
  }
  return origin;
}

BoxLattice lattice_of(const Box3l& box, const Vec3d& origin_mm) {
  constexpr double kMaxSteps = 65530;  // some are left over for rounding
  const Vec3d size = geometry::to_mm(box.hi) - geometry::to_mm(box.lo);
  return {geometry::to_mm(box.lo) - origin_mm,
          std::max({size.x, size.y, size.z, 1e-3}) / kMaxSteps};
}

void append_list_of(std::string& out, const Vec3d& mm) {
  out += '[';
  report::append_point(out, mm, ", ");
  out += ']';
}

Block shapes_block(const std::shared_ptr<const PageShapes>& shapes) {
  const std::size_t n = shapes->meshes.size();
  std::uint64_t positions = 0, indices = 0;
  for (const PageMesh& mesh : shapes->meshes) {
    positions += mesh.position.size();
    indices += mesh.index.size();
  }
  Columns columns("strake-shapes");
  columns.numbers<std::uint32_t>("vertices", n, [shapes](std::size_t i) {
    return static_cast<std::uint32_t>(shapes->meshes[i].position.size() / 3);
  });
  columns.numbers<std::uint32_t>("triangles", n, [shapes](std::size_t i) {
    return static_cast<std::uint32_t>(shapes->meshes[i].index.size() / 3);
  });
  constexpr std::array<std::string_view, 3> kMin{"min_x", "min_y", "min_z"};
  for (std::size_t k = 0; k < 3; ++k)
    columns.numbers<float>(kMin[k], n,
                           [shapes, k](std::size_t i) { return shapes->meshes[i].min[k]; });
  columns.numbers<float>("step", n, [shapes](std::size_t i) { return shapes->meshes[i].step; });
  columns.rows_of_numbers<std::uint16_t>("position", n, positions,
                                         [shapes](std::size_t i, std::string& out) {
                                           for (const std::uint16_t p : shapes->meshes[i].position)
                                             Columns::append_number(out, p);
                                         });
  columns.rows_of_numbers<std::uint16_t>("index", n, indices,
                                         [shapes](std::size_t i, std::string& out) {
                                           for (const std::uint16_t v : shapes->meshes[i].index)
                                             Columns::append_number(out, v);
                                         });
  return std::move(columns).finish();
}

Block instances_block(const std::shared_ptr<const PageShapes>& shapes,
                      const std::shared_ptr<const std::vector<std::uint32_t>>& numbers) {
  const std::size_t n = shapes->instances.size();
  Columns columns("strake-instances");
  columns.numbers<std::uint32_t>("shape", n,
                                 [shapes](std::size_t i) { return shapes->instances[i].shape; });
  columns.numbers<std::uint32_t>("object", n, [shapes, numbers](std::size_t i) {
    return (*numbers)[shapes->instances[i].object];
  });
  columns.rows_of_numbers<float>("matrix", n, std::uint64_t{n} * 12,
                                 [shapes](std::size_t i, std::string& out) {
                                   for (const float value : shapes->instances[i].matrix)
                                     Columns::append_number(out, value);
                                 });
  columns.numbers<std::uint32_t>("colour", n,
                                 [shapes](std::size_t i) { return shapes->instances[i].colour; });
  return std::move(columns).finish();
}

Block boxes_block(std::vector<ObjectBox> given, const BoxLattice& lattice, const Vec3d& origin_mm,
                  const std::shared_ptr<const std::vector<std::uint32_t>>& numbers) {
  const auto boxes = std::make_shared<const std::vector<ObjectBox>>(std::move(given));
  const std::size_t n = boxes->size();
  Columns columns("strake-boxes");
  columns.numbers<std::uint32_t>(
      "object", n, [boxes, numbers](std::size_t i) { return (*numbers)[(*boxes)[i].object]; });
  columns.rows_of_numbers<std::uint16_t>(
      "box", n, std::uint64_t{n} * 6, [boxes, lattice, origin_mm](std::size_t i, std::string& out) {
        const Vec3d from = origin_mm + lattice.min_mm;
        const Vec3d lo = geometry::to_mm((*boxes)[i].box.lo) - from;
        const Vec3d hi = geometry::to_mm((*boxes)[i].box.hi) - from;
        const auto put = [&](double steps) {
          Columns::append_number(out, static_cast<std::uint16_t>(std::clamp(steps, 0.0, 65535.0)));
        };
        for (int k = 0; k < 3; ++k) put(std::floor(lo[k] / lattice.step_mm));
        for (int k = 0; k < 3; ++k) put(std::ceil(hi[k] / lattice.step_mm));
      });
  return std::move(columns).finish();
}

/// Says in words why not all of it is shown as it is; empty where all is.
std::string note_of(const ShownObjects& shown) {
  if (!shown.is_near_only) return {};
  const std::string metres = std::to_string(static_cast<int>(kReachMm / 1000));
  const std::string near =
      "What clashes, and what is within " + metres + " m of it, is shown as it is";
  return near +
         (shown.is_full ? ", as far as there is room; all else as boxes." : "; all else as boxes.");
}

std::string scene_member(const model::Scene& scene, const ShownObjects& shown,
                         const PageShapes& shapes, const SceneBoxes& boxes, const Vec3d& origin_mm,
                         const BoxLattice& lattice) {
  std::uint64_t triangles = 0;
  for (const PageInstance& instance : shapes.instances)
    triangles += shapes.meshes[instance.shape].index.size() / 3;
  std::uint64_t as_shapes = 0;
  for (std::size_t i = 0; i < shapes.instances.size(); ++i)
    if (i == 0 || shapes.instances[i].object != shapes.instances[i - 1].object) ++as_shapes;
  const std::size_t objects = scene.model->objects.size();
  std::string out = "{\"origin_mm\": ";
  append_list_of(out, origin_mm);
  const Box3l box = boxes.all.empty() ? Box3l{} : boxes.all;
  out += ", \"box_mm\": [";
  append_list_of(out, geometry::to_mm(box.lo));
  out += ", ";
  append_list_of(out, geometry::to_mm(box.hi));
  out +=
      "], \"objects\": " + std::to_string(objects) +
      ", \"objects_as_shapes\": " + std::to_string(as_shapes) +
      ", \"objects_as_boxes\": " + std::to_string(boxes.of_objects.size()) +
      ", \"objects_left_out\": " + std::to_string(objects - as_shapes - boxes.of_objects.size()) +
      ", \"triangles\": " + std::to_string(triangles);
  if (!boxes.of_objects.empty()) {
    out += ", \"boxes\": {\"min\": ";
    append_list_of(out, lattice.min_mm);
    out += ", \"step\": ";
    append_shortest(out, lattice.step_mm);
    out += '}';
  }
  if (const std::string note = note_of(shown); !note.empty()) {
    out += ", \"note\": ";
    report::append_json(out, note);
  }
  out += '}';
  return out;
}

}  // namespace

Result<ModelBlocks> model_blocks(const model::Scene& scene, const ShownObjects& shown,
                                 const std::shared_ptr<const std::vector<std::uint32_t>>& numbers,
                                 const parallel::Context& context) {
  SceneBoxes boxes = boxes_of(scene, shown);
  const Vec3d origin = origin_of(boxes);
  Result<PageShapes> made = page_shapes(scene, shown, origin, context);
  if (!made) return made.error();
  const auto shapes = std::make_shared<const PageShapes>(std::move(*made));
  const BoxLattice lattice = boxes.all.empty() ? BoxLattice{} : lattice_of(boxes.all, origin);
  ModelBlocks blocks;
  blocks.scene = scene_member(scene, shown, *shapes, boxes, origin, lattice);
  blocks.blocks.push_back(shapes_block(shapes));
  blocks.blocks.push_back(instances_block(shapes, numbers));
  if (!boxes.of_objects.empty())
    blocks.blocks.push_back(boxes_block(std::move(boxes.of_objects), lattice, origin, numbers));
  return blocks;
}

}  // namespace strake::page
