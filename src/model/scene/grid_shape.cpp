// SPDX-License-Identifier: Apache-2.0
#include "model/scene/grid_shape.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "geometry/mesh_repair/mesh_repair.hpp"
#include "geometry/mesh_repair/snap_to_grid.hpp"
#include "geometry/primitives/tessellate.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::model {
namespace {

using geometry::Mat3d;
using geometry::Part;

constexpr std::string_view kTooWide = "wider than 2.1 km";

void add_lines(const geometry::Polylines& lines, const Mat3d& linear, GridShapeResult& result) {
  std::optional<geometry::SnappedWire> wire = geometry::snap_to_grid(lines, linear);
  if (!wire) {
    result.fault = kTooWide;
    return;
  }
  result.bad_points = wire->bad_points;
  result.shape.base = wire->base;
  if (wire->part.vertices.empty()) return;
  result.shape.parts.push_back(std::move(wire->part));
}

/// Returns the farthest that the snap moves a vertex, grid units: by so much the body on the grid
/// may lie from the one that its primitive states.
double moved_by_snap(const geometry::TriangleMesh& mesh) {
  double largest = 0;
  for (const geometry::Vec3d& v : mesh.vertices) {
    const auto at = geometry::snap(v);
    if (!at) continue;
    const geometry::Vec3d off = v * geometry::kGridPerMm - at->as<double>();
    largest = std::max(largest, geometry::dot(off, off));
  }
  return std::sqrt(largest);
}

/// Removes the folds of a solid: where a primitive is thinner than the grid, the snap lays its two
/// sides onto each other.
void drop_folds(std::vector<Part>& parts) {
  const auto is_sheet = [](const Part& p) { return p.kind == geometry::PartKind::sheet; };
  if (!std::all_of(parts.begin(), parts.end(), is_sheet)) std::erase_if(parts, is_sheet);
}

}  // namespace

void GridShapeBuilder::add_mesh(const geometry::TriangleMesh& mesh, const Mat3d& linear,
                                const geometry::Seams& seams, GridShapeResult& result) {
  const geometry::SnappedMesh* placed = placer_.snap_to_grid(mesh, linear);
  if (placed == nullptr) {
    result.fault = kTooWide;
    return;
  }
  result.bad_triangles = placed->bad_triangles;
  result.shape.base = placed->base;
  geometry::RepairedMesh analysis = analyser_.repair_mesh(placed->mesh, seams);
  result.findings = analysis.findings;
  result.shape.parts = std::move(analysis.parts);
  for (Part& part : result.shape.parts) {
    part.flags.unknown_sag = !(mesh.sag_mm >= 0);
    part.sag = part.flags.unknown_sag
                   ? 0
                   : mesh.sag_mm * geometry::kGridPerMm * geometry::largest_scale(linear);
    // It is not known for a single part which corners of the source were moved together.
    part.weld = analysis.findings.largest_weld;
    part.sag += part.weld;
  }
}

void GridShapeBuilder::add_primitive(const geometry::Primitive& primitive, const Mat3d& linear,
                                     const GridShapeOptions& options, GridShapeResult& result) {
  const geometry::Tessellation made =
      options.eye ? geometry::tessellate_from(*options.eye, primitive, linear, options.sag_mm)
                  : geometry::tessellate(primitive, linear, options.sag_mm, options.towards);
  result.fault = made.fault;
  if (!made.fault.empty()) return;
  if (!made.mesh.triangles.empty())
    add_mesh(made.mesh, Mat3d{}, {}, result);
  else
    add_lines(made.lines, Mat3d{}, result);
  // A sliver of a primitive may lose triangles to the snap: that is no fault of the source.
  result.findings.degenerate_triangles = result.findings.cut_triangles = 0;
  drop_folds(result.shape.parts);
  const double moved = moved_by_snap(made.mesh);
  for (Part& part : result.shape.parts) {
    part.sag += moved;
    part.primitive = primitive;
    part.flags.unknown_sag = false;
  }
}

GridShapeResult GridShapeBuilder::make(const Shape& shape, const Mat3d& linear,
                                       const GridShapeOptions& options) {
  GridShapeResult result;
  if (const auto* mesh = std::get_if<geometry::TriangleMesh>(&shape))
    add_mesh(*mesh, linear, options.seams, result);
  else if (const auto* lines = std::get_if<geometry::Polylines>(&shape))
    add_lines(*lines, linear, result);
  else
    add_primitive(std::get<geometry::Primitive>(shape), linear, options, result);
  for (const Part& part : result.shape.parts) result.shape.box.include(part.box);
  if (result.shape.parts.empty() && result.fault.empty()) {
    result.vanished = result.bad_triangles == 0 && result.bad_points == 0;
    result.fault = "nothing is left of it on the grid";
  }
  return result;
}

}  // namespace strake::model
