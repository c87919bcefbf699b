// SPDX-License-Identifier: Apache-2.0
#include "hlr/prepare/uncut_lines.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "strake/geometry/vec.hpp"
#include "strake/model/scene.hpp"

namespace strake::hlr {
namespace {

using geometry::Box3l;

/// Returns, by body, its box; empty where it is not drawn or cut away.
std::vector<Box3l> boxes_of_what_is_left(const ViewJob& job) {
  const model::Scene& scene = *job.scene;
  std::vector<Box3l> boxes(scene.bodies.size(), geometry::empty_box<std::int64_t>());
  for (std::uint32_t b = 0; b < boxes.size(); ++b) {
    const SectionedShape& sectioned = job.sectioned_shape_of(b);
    if (job.drawn[model::index(scene.bodies[b].object)] && !sectioned.away &&
        !sectioned.source->box.empty())
      boxes[b] = scene.bodies[b].box(*sectioned.source);
  }
  return boxes;
}

/// Returns which objects are left whole, or meet the box of all that is.
std::vector<bool> objects_near_uncut(const ViewJob& job) {
  const std::vector<Box3l> boxes = boxes_of_what_is_left(job);
  Box3l of_uncut = geometry::empty_box<std::int64_t>();
  for (std::uint32_t b = 0; b < boxes.size(); ++b)
    if (job.is_uncut(b) && !boxes[b].empty()) of_uncut.include(boxes[b]);
  std::vector<bool> near(job.drawn.size());
  for (std::uint32_t b = 0; b < boxes.size(); ++b)
    if (!boxes[b].empty() && boxes[b].meets(of_uncut))
      near[model::index(job.scene->bodies[b].object)] = true;
  return near;
}

/// Returns the scene as sections leave it: the bodies of some objects with their cut shapes.
model::Scene scene_of_what_is_left(const ViewJob& job, const std::vector<bool>& objects) {
  constexpr std::uint32_t kNone = 0xffffffffU;
  model::Scene left;
  left.model = job.scene->model;
  left.first_body = job.scene->first_body;
  left.bodies = job.scene->bodies;
  left.shapes.emplace_back();  // of the bodies that do not matter
  std::vector<std::uint32_t> number(job.sectioned.all.size(), kNone);
  for (std::uint32_t b = 0; b < left.bodies.size(); ++b) {
    std::uint32_t& shape = number[job.sectioned.of[b]];
    const bool matters = objects[model::index(left.bodies[b].object)];
    if (matters && shape == kNone) {
      shape = static_cast<std::uint32_t>(left.shapes.size());
      left.shapes.push_back(job.sectioned_shape_of(b).shape());
    }
    left.bodies[b].grid_shape = matters ? shape : 0;
  }
  return left;
}

}  // namespace

Result<std::vector<IntersectionLine>> lines_with_uncut(const ViewJob& job,
                                                       const parallel::Context& context) {
  if (job.options.intersections == Intersections::off ||
      std::ranges::find(job.uncut, true) == job.uncut.end())
    return std::vector<IntersectionLine>{};
  const std::vector<bool> objects = objects_near_uncut(job);
  const model::Scene left = scene_of_what_is_left(job, objects);
  auto found = find_intersection_lines(left, objects, job.contact,
                                       {Intersections::objects, 1, {}, job.shows_lines}, context);
  if (!found) return found.error();
  std::erase_if(found->all, [&](const IntersectionLine& line) {
    return job.is_uncut(line.body_a) == job.is_uncut(line.body_b);
  });
  return std::move(found->all);
}

}  // namespace strake::hlr
