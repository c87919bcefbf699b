// SPDX-License-Identifier: Apache-2.0
#include "hlr/results/edge_curves.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "strake/geometry/ellipse.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/geometry/primitive.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::hlr {
namespace {

constexpr std::uint32_t kNone = 0xffffffffU;
/// The snap moves a vertex by 0.87 µm at most, and the body's origin is snapped too.
constexpr double kToleranceMm = 0.002;

/// The circles of a shape that have edges, and these edges.
struct ShapeCurves {
  std::uint32_t edges = 0;  ///< number of all edges
  std::vector<geometry::Ellipse> circles;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> curved;  ///< edge and circle, ascending
};

/// Returns, for each part of a shape, the circles on which its lines may run.
std::vector<std::vector<geometry::Ellipse>> circles_of_parts(const model::GridShape& shape,
                                                             const geometry::Mat3d& linear,
                                                             const geometry::Vec3d& towards) {
  std::vector<std::vector<geometry::Ellipse>> circles;
  for (const geometry::Part& part : shape.parts)
    circles.push_back(part.primitive ? geometry::circles_of(*part.primitive, linear, towards)
                                     : std::vector<geometry::Ellipse>{});
  return circles;
}

/// Returns whether an edge stands for an arc of a curve: its ends lie on it, and its middle as near
/// to it as triangles lie to their surface. The straight cut through a torus whose tube reaches its
/// axis has its ends on the circle of the tube, too.
bool is_chord(const geometry::Ellipse& curve, const geometry::Vec3d& a, const geometry::Vec3d& b,
              double sag_mm) {
  return curve.passes(a, kToleranceMm) && curve.passes(b, kToleranceMm) &&
         curve.passes((a + b) * 0.5, sag_mm + kToleranceMm);
}

Result<ShapeCurves> curves_of(const ViewJob& job, const SectionedShape& sectioned,
                              const geometry::Mat3d& linear) {
  ShapeCurves result;
  const auto found =
      sectioned_edges(sectioned, {job.viewer, job.cos_sharp, job.options.smooth}, {});
  if (!found) return found.error();
  const std::vector<FeatureEdge>& edges = *found;
  result.edges = static_cast<std::uint32_t>(edges.size());
  const auto circles = circles_of_parts(*sectioned.source, linear, job.direction().as<double>());
  const auto placed = [&](const geometry::Vec3i& v) {
    return geometry::to_mm(v.as<std::int64_t>() + sectioned.source->base);
  };
  std::vector<std::vector<std::uint32_t>> number(circles.size());
  for (std::size_t p = 0; p < circles.size(); ++p) number[p].assign(circles[p].size(), kNone);
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    const auto& all = circles[edges[e].part];
    const geometry::Vec3d a = placed(edges[e].a), b = placed(edges[e].b);
    const double sag_mm = sectioned.source->parts[edges[e].part].sag / geometry::kGridPerMm;
    for (std::size_t c = 0; c < all.size(); ++c) {
      if (!is_chord(all[c], a, b, sag_mm)) continue;
      std::uint32_t& n = number[edges[e].part][c];
      if (n == kNone) {
        n = static_cast<std::uint32_t>(result.circles.size());
        result.circles.push_back(all[c]);
      }
      result.curved.emplace_back(e, n);
      break;
    }
  }
  return result;
}

bool is_round(const SectionedShape& sectioned) {
  return std::ranges::any_of(sectioned.source->parts, [](const geometry::Part& part) {
    return part.primitive && geometry::is_round(*part.primitive);
  });
}

/// Returns, by sectioned shape, the first body drawn with it, where its edges matter: the shape is
/// round, or comes before a round one of its object, whose edges are numbered after its own.
std::vector<std::uint32_t> first_bodies(const ViewJob& job) {
  const model::Scene& scene = *job.scene;
  std::vector<std::uint32_t> first(job.sectioned.all.size(), kNone);
  for (std::size_t o = 0; o + 1 < scene.first_body.size(); ++o) {
    if (!job.drawn[o] || !job.solves(static_cast<std::uint32_t>(o))) continue;
    bool matters = false;
    for (std::uint32_t b = scene.first_body[o + 1]; b-- > scene.first_body[o];) {
      matters = matters || is_round(job.sectioned_shape_of(b));
      if (matters && first[job.sectioned.of[b]] == kNone) first[job.sectioned.of[b]] = b;
    }
  }
  return first;
}

}  // namespace

Result<Curves> find_curves(const ViewJob& job, const parallel::Context& context) {
  Curves curves;
  // Where the view has no meshes of its own there are no curves, nor in perspective, where a circle
  // is not seen as what the plane of the view makes of it.
  if (!job.own || job.view.perspective) return curves;
  const model::Scene& scene = *job.scene;
  const std::vector<std::uint32_t> first = first_bodies(job);
  const auto shapes = parallel::transform(
      context, {.name = "hidden lines: curves", .n = first.size(), .grain = 16},
      [&](std::size_t s) -> Result<ShapeCurves> {
        if (first[s] == kNone) return ShapeCurves{};
        const model::Body& body = scene.model->bodies[scene.bodies[first[s]].body];
        return curves_of(job, job.sectioned.all[s], body.placement.linear);
      });
  if (!shapes) return shapes.error();
  std::uint32_t number = 0;
  for (std::uint32_t b = 0; b < scene.bodies.size(); ++b) {
    const model::GridBody& body = scene.bodies[b];
    if (b == scene.first_body[model::index(body.object)]) number = 0;
    const std::uint32_t object = model::index(body.object);
    if (!job.drawn[object] || !job.solves(object)) continue;
    const ShapeCurves& shape = (*shapes)[job.sectioned.of[b]];
    const auto before = static_cast<std::uint32_t>(curves.all.size());
    const geometry::Vec3l origin = body.origin - job.sectioned_shape_of(b).source->base;
    for (const geometry::Ellipse& circle : shape.circles) curves.all.push_back({origin, circle});
    for (const auto& [edge, circle] : shape.curved)
      curves.edges.push_back({body.object, number + edge, before + circle});
    number += shape.edges;
  }
  return curves;
}

}  // namespace strake::hlr
