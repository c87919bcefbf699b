// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/gltf/accessor.hpp"
#include "io/gltf/json/json.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"

/// The nodes of a glTF document, their instances and the order in which they are visited.
namespace strake::io::gltf {

/// A node as the document has it, in the file's own frame.
struct GltfNode {
  std::string name;              ///< its own, else its mesh's, else "node 12"
  bool counted = false;          ///< the name is "node 12"
  std::string id;                ///< extras.id, where it is a string
  model::Attributes attributes;  ///< the rest of its extras, nested keys joined by '.'
  std::optional<std::uint64_t> mesh;
  std::vector<std::uint64_t> children;
  geometry::Placement local;
  JsonValue instancing;       ///< EXT_mesh_gpu_instancing
  JsonValue instance_extras;  ///< extras.instances
  bool skinned = false;
  JsonValue weights;               ///< weights of morph targets, in place of the mesh's own
  std::optional<GltfFault> fault;  ///< if set, it and what is below it cannot be placed
};

/// Parses a node; `mesh_names` are the names that the meshes of the document state.
[[nodiscard]] GltfNode parse_node(const JsonValue& json, std::size_t index,
                                  const std::vector<JsonValue>& mesh_names);

/// The instances of a node, in the node's frame.
struct Instances {
  std::vector<geometry::Placement> placements;
  double translation_step = 0;  ///< spacing of quantised translations; 0: float32
  /// One entry per instance, or none at all; what has neither name nor id is "instance 12".
  std::vector<std::string> names, ids;
  std::vector<bool> counted;  ///< the name is "instance 12"
  std::optional<GltfFault> fault;

  /// Returns half the spacing of the numbers that say where an instance is.
  [[nodiscard]] double half_spacing(std::size_t instance) const;
};

[[nodiscard]] Instances read_instances(const GltfNode& node, const Accessors& accessors);

/// Returns how many instances the node's accessors state.
[[nodiscard]] std::uint64_t stated_instances(const GltfNode& node, const Accessors& accessors);

/// Returns translation, rotation quaternion (x, y, z, w; of any length) and scale as a placement;
/// nothing when the quaternion is zero.
[[nodiscard]] std::optional<geometry::Placement> placement_of(const geometry::Vec3d& translation,
                                                              const double* quaternion,
                                                              const geometry::Vec3d& scale);

/// A visited node: parents come before their children.
struct VisitedNode {
  std::uint32_t node = 0;
  std::uint32_t parent = 0;  ///< index of a visit; kNoParent for roots
};

inline constexpr std::uint32_t kNoParent = 0xffffffffU;

/// The deepest nesting of nodes.
inline constexpr std::uint32_t kMaxNodeDepth = 1000;

/// Returns the nodes of the default scene, else of the first one, else all, in document order depth
/// first. Nodes with two parents, cycles, and references to nodes that do not exist are errors,
/// whose `where` is the JSON pointer alone.
[[nodiscard]] Result<std::vector<VisitedNode>> visit_order(const JsonValue& root,
                                                           const std::vector<GltfNode>& nodes);

}  // namespace strake::io::gltf
