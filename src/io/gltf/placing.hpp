// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/gltf/accessor.hpp"
#include "io/gltf/features/property_tables.hpp"
#include "io/gltf/nodes.hpp"
#include "io/source/reader_support.hpp"
#include "io/source/units_and_axes.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

/// Turns the visited nodes of a glTF document into objects.
namespace strake::io::gltf {

/// What placing a mesh needs to know of it once its shapes belong to the model.
struct MeshShapes {
  struct ColoredShape {
    model::ShapeId shape{};
    model::Color color;
  };
  std::vector<ColoredShape> parts;
  geometry::Box3d box = geometry::empty_box<double>();
  double half_spacing_mm = 0;  ///< half the spacing of its vertices' numbers
  std::vector<std::pair<std::uint64_t, std::uint64_t>> features;  ///< tables and rows
  LeftOut left_out;
  std::optional<GltfFault> fault;  ///< if set, it cannot be used
};

struct PlacingInput {
  const std::vector<VisitedNode>& visits;
  const std::vector<std::uint32_t>& inner;  ///< visits of nodes with children, ascending
  NodeTable& nodes;                         ///< names and attributes of the visited ones are taken
  const std::vector<MeshShapes>& meshes;
  const Accessors& accessors;
  const PropertyTables& tables;
  const SourceFrame& frame;
  std::string file;  ///< for messages
  const parallel::Context& context;
};

/// Whether the corners of a placed box are finite.
[[nodiscard]] bool is_finite_at(const geometry::Box3d& box, const geometry::Placement& placement);

/// Gives a model that has none its groups, objects and bodies, in the order of the visits, and says
/// what is skipped. Errors: cancelled, out of memory, more bodies than can be numbered.
[[nodiscard]] Status place_nodes(const PlacingInput& input, model::Model& model);

}  // namespace strake::io::gltf
