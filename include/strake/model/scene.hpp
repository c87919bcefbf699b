// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/part.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

namespace strake::model {

struct SceneOptions {
  /// The largest distance of a tessellated primitive from the true surface, mm.
  double sag_mm = 0.5;
  /// Bodies of these categories are placed; the others are counted in Scene::left_out.
  bool physical = true, obstruction = false, insulation = false;
  /// Seams of meshes that are no wider are closed, mm up to a metre; 0: only where corners lie on
  /// each other on the grid. If negative: the contact distance of each body.
  double weld_mm = -1;
};

/// Returns the contact distance of a body whose source has this precision (Body::precision_um), in
/// grid units. It is what the source's numbers cannot distinguish: two units in the last place, and
/// what the grid rounds.
[[nodiscard]] double contact_distance(float precision_um);

/// The parts of one (shape, linear part of the placement), shared by every body that has both, and
/// by those of meshes that are equal but for a translation.
struct GridShape {
  std::vector<geometry::Part> parts;
  geometry::Box3i box = geometry::empty_box<std::int32_t>();
  ShapeId shape{};
  /// The origin of the vertices, in grid units from the placed local origin: zero unless the shape
  /// lies far from it (site coordinates baked into the vertices).
  geometry::Vec3l base;
  bool single_line = false;  ///< a pipe that is drawn as its axis: see pipes_as_lines()
};

/// A body on the grid: world coordinate of a vertex = origin + vertex.
struct GridBody {
  std::uint32_t grid_shape = 0;
  std::uint32_t body = 0;  ///< index into Model::bodies
  ObjectId object{};
  /// snap(translation) + GridShape::base, and how far its own mesh is moved from the shape's.
  geometry::Vec3l origin;

  [[nodiscard]] geometry::Box3l box(const GridShape& shape) const {
    return shape.box.as<std::int64_t>().moved(origin);
  }
};

/// The code of the diagnostic for a shape that is too small for the grid, or has no geometry at
/// all.
inline constexpr std::string_view kVanished = "shape-vanished";

/// An object whose geometry is not all in the scene, so that fewer results are found than there
/// are.
struct IncompleteObject {
  ObjectId object{};
  /// The code of the diagnostic that says why, or "object-incomplete", "object-skipped"; a
  /// literal.
  std::string_view code;
  friend auto operator<=>(const IncompleteObject&, const IncompleteObject&) = default;
};

/// A model on the grid, which clash detection and hidden-line removal work on.
///
/// Vertices are snap(linear·v) + snap(translation), so equal shapes with equal linear parts share
/// one GridShape whatever their place, and translation by grid steps changes no decision. Meshes
/// that are each other moved by grid steps share one too.
struct Scene {
  const Model* model = nullptr;  ///< must outlive the scene
  std::vector<GridShape> shapes;
  std::vector<GridBody> bodies;  ///< by object, then in the model's order
  std::vector<std::uint32_t>
      first_body;              ///< per object, with one more at the end; objects may have none
  std::uint64_t left_out = 0;  ///< bodies of categories that were not requested
  Diagnostics diagnostics;     ///< inverted, open, degenerate, unplaceable …
  std::vector<IncompleteObject> lacking = {};  ///< ascending; for the categories requested
  double sag_mm = 0;    ///< the sag of tessellated primitives; 0: not by make_scene()
  double weld_mm = -1;  ///< as SceneOptions::weld_mm

  [[nodiscard]] std::span<const GridBody> bodies_of(ObjectId id) const {
    return std::span(bodies).subspan(first_body[index(id)],
                                     first_body[index(id) + 1] - first_body[index(id)]);
  }
};

/// Tessellates, snaps, welds, splits into shells and orients every shape of the model once per
/// distinct linear part. A body that cannot be placed is skipped with a diagnostic.
[[nodiscard]] Result<Scene> make_scene(const Model& model, const SceneOptions& options,
                                       const parallel::Context& context);

}  // namespace strake::model
