// SPDX-License-Identifier: Apache-2.0
#include "clash/narrow_phase/source_errors.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "clash/rules/options.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/lowest.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::clash {
namespace {

using geometry::Vec3d;

/// Grid units: the most that the snap moves a point by, and the most where the source's unit and
/// precision alone keep it off the grid, as whole millimetres written in metres.
constexpr float kMaxMoved = 0.8661F, kMinMoved = 1.0F / 64;

/// Returns the grid units from a coordinate to the next one on the grid; 0 for the double that is
/// nearest to one.
double off_grid(double mm) {
  // Sums of this size have no digits behind the point.
  constexpr double kNoFraction = 0x1.8p52;
  constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
  const double units = mm * geometry::kGridPerMm;
  const double off = std::fabs(units - ((units + kNoFraction) - kNoFraction));
  return off > kRounding * std::fabs(units) ? off : 0;
}

float moved(const Vec3d& mm) {
  const double largest = std::max({off_grid(mm.x), off_grid(mm.y), off_grid(mm.z)});
  // Along three axes a point is off by no more than twice as far.
  constexpr double kMin = static_cast<double>(kMinMoved) / 2;
  return !(largest > 0) ? 0 : largest > kMin ? kMaxMoved : kMinMoved;
}

float max_displacement(std::span<const Vec3d> points, const geometry::Mat3d& linear) {
  float largest = 0;
  for (const Vec3d& p : points) {
    largest = std::max(largest, moved(linear * p));
    if (largest == kMaxMoved) break;
  }
  return largest;
}

float vertices_moved(const model::Shape& shape, const geometry::Mat3d& linear) {
  if (const auto* mesh = std::get_if<geometry::TriangleMesh>(&shape))
    return max_displacement(mesh->vertices, linear);
  if (const auto* lines = std::get_if<geometry::Polylines>(&shape))
    return max_displacement(lines->points, linear);
  return 0;
}

constexpr std::uint32_t kNoBody = std::numeric_limits<std::uint32_t>::max();

}  // namespace

Result<SourceErrors> SourceErrors::measure(const model::Model& model,
                                           std::span<const std::uint32_t> bodies,
                                           const parallel::Context& context) {
  // Only shares the work out: between 1024 and 16'384 no difference can be seen (decision 0073).
  constexpr std::size_t kBodiesPerBlock = 4096;
  SourceErrors errors(model);
  parallel::Lowest lowest(model.shapes.size());
  const Status found = parallel::for_each(
      context, {.name = "first bodies", .n = bodies.size(), .grain = kBodiesPerBlock},
      [&](std::size_t i) {
        const std::size_t shape = index(model.bodies[bodies[i]].shape);
        if (shape < lowest.size()) lowest.offer(shape, i);
      });
  if (!found) return found.error();
  std::vector<std::uint32_t>& first = errors.first_;
  first.assign(model.shapes.size(), kNoBody);
  for (std::size_t s = 0; s < first.size(); ++s)
    if (lowest[s] != parallel::Lowest::kNone) first[s] = bodies[lowest[s]];
  // Only shares the work out: between 16 and 256 no difference can be seen (decision 0073).
  constexpr std::size_t kGrain = 64;
  auto all = parallel::transform(
      context, {.name = "vertices off the grid", .n = first.size(), .grain = kGrain},
      [&](std::size_t s) {
        return first[s] == kNoBody
                   ? 0
                   : vertices_moved(model.shapes[s], model.bodies[first[s]].placement.linear);
      });
  if (!all) return all.error();
  errors.moved_ = std::move(*all);
  return errors;
}

float SourceErrors::moved_by_snap(const model::Body& body) const {
  const std::size_t shape = index(body.shape);
  const float of_place = moved(body.placement.translation);
  // Most bodies of a shape are placed alike.
  return of_place + (body.placement.linear == model_->bodies[first_[shape]].placement.linear
                         ? moved_[shape]
                         : vertices_moved(model_->shapes[shape], body.placement.linear));
}

Status set_source_errors(const model::Scene& scene, const Options& options, ScenePartList& list,
                         const parallel::Context& context) {
  // Only shares the work out: between 256 and 4096 no difference can be seen (decision 0073).
  constexpr std::size_t kGrain = 1024;
  const auto bodies = parallel::transform(
      context, {.name = "bodies of parts", .n = list.parts.size(), .grain = kGrain},
      [&](std::size_t i) { return list.parts[i].body; });
  if (!bodies) return bodies.error();
  const auto errors = SourceErrors::measure(*scene.model, *bodies, context);
  if (!errors) return errors.error();
  return parallel::for_each(context,
                            {.name = "errors of sources", .n = list.parts.size(), .grain = kGrain},
                            [&](std::size_t i) {
                              ScenePart& part = list.parts[i];
                              const model::Body& body = scene.model->bodies[part.body];
                              part.snap = errors->moved_by_snap(body);
                              part.step = coarse_step(options, body.precision_um);
                            });
}

}  // namespace strake::clash
