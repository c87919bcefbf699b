// SPDX-License-Identifier: Apache-2.0
#include "drawing/layout/expected_extent.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "hlr/prepare/drawn_objects.hpp"
#include "hlr/sections/section_planes.hpp"
#include "hlr/view/view_frustum.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::drawing {
namespace {

using geometry::Box3l;
using geometry::Vec3l;

/// The scale of models larger than this is so small that boxes give it well enough.
constexpr double kLargeMm = 20'000;

enum class ExtentMethod : std::uint8_t { boxes, corners };

/// Returns what a section at right angles to an axis leaves of a box; other sections leave it
/// whole.
Box3l cut_along_axis(Box3l box, const hlr::Section& section) {
  const Vec3l& n = section.normal;
  for (int k = 0; k < 3; ++k) {
    if (n[(k + 1) % 3] != 0 || n[(k + 2) % 3] != 0) continue;
    if (n[k] > 0) box.hi[k] = std::min(box.hi[k], section.point[k]);
    if (n[k] < 0) box.lo[k] = std::max(box.lo[k], section.point[k]);
  }
  return box;
}

class PaperExtent {
 public:
  /// Returns what measures a view about a point of the model; nothing for an invalid view, whose
  /// fault hlr::draw reports.
  static std::optional<PaperExtent> of(const model::Scene& scene, const std::vector<bool>& drawn,
                                       const hlr::View& view, const Vec3l& origin) {
    const auto axes = paper_axes(view);
    const auto sections = hlr::section_planes(view.sections);
    if (!axes || !sections || !hlr::check_perspective(view)) return std::nullopt;
    return PaperExtent(scene, drawn, view, {view, *sections}, {*axes, origin});
  }

  [[nodiscard]] Result<PlaneBox> of_all(ExtentMethod by, const parallel::Context& context) const {
    return parallel::reduce(
        context, {.name = "expected extent", .n = scene_.bodies.size(), .grain = 1024}, kNoPlaneBox,
        [&](PlaneBox& part, std::size_t b) { include(part, scene_.bodies[b], by); },
        [](PlaneBox& into, const PlaneBox& part) { into.include(part); });
  }

  [[nodiscard]] Result<std::vector<PlaneBox>> of_objects(const parallel::Context& context) const {
    const auto of_bodies = parallel::transform(
        context, {.name = "expected extents", .n = scene_.bodies.size(), .grain = 1024},
        [&](std::size_t b) {
          PlaneBox box = kNoPlaneBox;
          include(box, scene_.bodies[b], ExtentMethod::boxes);
          return box;
        });
    if (!of_bodies) return of_bodies.error();
    std::vector<PlaneBox> boxes(scene_.model->objects.size(), kNoPlaneBox);
    for (std::size_t b = 0; b < of_bodies->size(); ++b)
      boxes[model::index(scene_.bodies[b].object)].include((*of_bodies)[b]);
    return boxes;
  }

 private:
  PaperExtent(const model::Scene& scene, const std::vector<bool>& drawn, const hlr::View& view,
              hlr::ViewVolume shown, const ViewPlane& plane)
      : scene_(scene), drawn_(drawn), view_(view), shown_(std::move(shown)), plane_(plane) {}

  void include(PlaneBox& extent, const model::GridBody& body, ExtentMethod by) const {
    const model::GridShape& shape = scene_.shapes[body.grid_shape];
    if (shape.box.empty() || (!drawn_.empty() && !drawn_[model::index(body.object)])) return;
    const Box3l whole = body.box(shape);
    if (!shown_.meets(whole)) return;
    Box3l box = view_.limits ? whole.common(*view_.limits) : whole;
    for (const hlr::Section& section : view_.sections) box = cut_along_axis(box, section);
    if (box.empty()) return;
    if (by == ExtentMethod::corners && box == whole) {
      for (const geometry::Part& part : shape.parts)
        for (const geometry::Vec3i& v : part.vertices)
          include(extent, body.origin + v.as<std::int64_t>());
      return;
    }
    for (const std::int64_t x : {box.lo.x, box.hi.x})
      for (const std::int64_t y : {box.lo.y, box.hi.y})
        for (const std::int64_t z : {box.lo.z, box.hi.z}) include(extent, {x, y, z});
  }

  void include(PlaneBox& extent, const Vec3l& point) const {
    const PlanePoint p = plane_(point);
    extent.include({p.x, p.x, p.y, p.y});
  }

  const model::Scene& scene_;
  const std::vector<bool>& drawn_;
  const hlr::View& view_;
  hlr::ViewVolume shown_;
  ViewPlane plane_;
};

}  // namespace

Result<PlaneBox> expected_extent(const model::Scene& scene, const std::vector<bool>& drawn,
                                 const hlr::View& view, const Vec3l& origin,
                                 const parallel::Context& context) {
  if (const Status status = hlr::check_drawn(scene, drawn); !status) return status.error();
  const auto measure = PaperExtent::of(scene, drawn, view, origin);
  if (!measure) return PlaneBox{};
  Result<PlaneBox> extent = measure->of_all(ExtentMethod::boxes, context);
  if (extent && std::max(extent->width(), extent->height()) < kLargeMm)
    extent = measure->of_all(ExtentMethod::corners, context);
  if (!extent) return extent;
  if (const auto field = field_of_view(view, origin))
    *extent = {std::max(extent->left, field->left), std::min(extent->right, field->right),
               std::max(extent->bottom, field->bottom), std::min(extent->top, field->top)};
  if (extent->left > extent->right || extent->bottom > extent->top) *extent = {};
  return extent;
}

Result<std::vector<PlaneBox>> expected_boxes(const model::Scene& scene,
                                             const std::vector<bool>& drawn, const hlr::View& view,
                                             const parallel::Context& context) {
  if (const Status status = hlr::check_drawn(scene, drawn); !status) return status.error();
  const auto measure = PaperExtent::of(scene, drawn, view, {});
  if (!measure) return std::vector<PlaneBox>(scene.model->objects.size(), kNoPlaneBox);
  return measure->of_objects(context);
}

double unseen_sag_mm(const PlaneBox& extent, double scale) {
  constexpr double kPerMm = 20, kFinestMm = 0.001, kLargestSheetMm = 1189;
  const double longest = std::max(extent.width(), extent.height());
  if (!(longest > 0)) return 0;
  return std::max({scale / kPerMm, longest / kLargestSheetMm / kPerMm, kFinestMm});
}

Result<double> sag_for_paper(const model::Scene& scene, const std::vector<bool>& drawn,
                             const hlr::View& view, const LayoutOptions& options,
                             const parallel::Context& context) {
  const Result<PlaneBox> extent = expected_extent(scene, drawn, view, {}, context);
  if (!extent) return extent.error();
  return unseen_sag_mm(*extent, options.placement ? options.placement->sheet.scale
                                                  : choose_sheet(*extent, options).scale);
}

}  // namespace strake::drawing
