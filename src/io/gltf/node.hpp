// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/gltf/accessor.hpp"
#include "io/gltf/fault.hpp"
#include "io/gltf/json.hpp"
#include "strake/model/model.hpp"

namespace strake::io::gltf {

/// A node as it stands in the document, in the file's own frame.
struct Node {
  std::string name;              ///< its own, else its mesh's, else "node 12"
  bool counted = false;          ///< it is "node 12"
  std::string id;                ///< extras.id, where it is a string
  model::Attributes attributes;  ///< the rest of its extras, nested keys joined by '.'
  std::optional<std::uint64_t> mesh;
  std::vector<std::uint64_t> children;
  geometry::Placement local;
  Json instancing;       ///< EXT_mesh_gpu_instancing
  Json instance_extras;  ///< extras.instances
  bool skinned = false;
  Json weights;                ///< of its mesh's morph targets, in place of the mesh's own
  std::optional<Fault> fault;  ///< set: it and what is below it cannot be placed
};

/// `mesh_names` are the names that the meshes of the document state.
[[nodiscard]] Node parse_node(const Json& json, std::size_t index,
                              const std::vector<Json>& mesh_names);

/// The instances of a node, in the node's frame.
struct Instances {
  std::vector<geometry::Placement> placements;
  double translation_step = 0;  ///< spacing of quantised translations; 0: float32
  /// One each per instance, or none at all; what has neither name nor id is "instance 12".
  std::vector<std::string> names, ids;
  std::vector<bool> counted;  ///< it is
  std::optional<Fault> fault;

  /// Half the spacing of the numbers that say where an instance is.
  [[nodiscard]] double half_spacing(std::size_t instance) const;
};

[[nodiscard]] Instances read_instances(const Node& node, const Accessors& accessors);

/// How many instances the node's accessors state.
[[nodiscard]] std::uint64_t stated_instances(const Node& node, const Accessors& accessors);

/// Translation, rotation quaternion (x, y, z, w; of any length) and scale as a placement; nothing
/// when the quaternion is zero.
[[nodiscard]] std::optional<geometry::Placement> placement_of(const geometry::Vec3d& translation,
                                                              const double* quaternion,
                                                              const geometry::Vec3d& scale);

}  // namespace strake::io::gltf
