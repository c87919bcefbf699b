// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "io/gltf/accessor.hpp"
#include "io/gltf/nodes.hpp"
#include "io/source/units_and_axes.hpp"
#include "strake/core/result.hpp"
#include "strake/io/reader.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

/// Reads neutral scenes (docs/formats/gltf.md): models as they were when they were written.
namespace strake::io::gltf {

/// Returns what the asset of a neutral scene says of it; absent for any other document, as for one
/// of a kind that is not known.
[[nodiscard]] JsonValue neutral_scene(const JsonValue& root);

struct NeutralInput {
  const std::vector<VisitedNode>& visits;
  NodeTable& nodes;  ///< names and attributes of the visited ones are taken
  const JsonValue& scene;
  const std::vector<JsonValue>& meshes;
  const std::vector<std::uint32_t>& used;  ///< meshes that a visited node has, ascending
  const Buffers& buffers;
  const Accessors& accessors;
  const std::vector<model::Color>& materials;
  const SourceFrame& frame;  ///< of the millimetres with z up that it has, unless somebody says
                             ///< otherwise
  const FileBytes& file;
  const parallel::Context& context;
};

/// Gives a model that has none its groups, shapes, objects and bodies. Errors: cancelled, and where
/// nothing is left.
[[nodiscard]] Result<model::Model> import_neutral(const NeutralInput& input, model::Model&& model);

}  // namespace strake::io::gltf
