// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/gltf/accessor.hpp"
#include "io/gltf/document.hpp"
#include "io/gltf/features/property_tables.hpp"
#include "io/gltf/json/json.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/lowest.hpp"
#include "strake/parallel/marks.hpp"

/// The nodes of a glTF document, their instances and the order in which they are visited.
namespace strake::io::gltf {

/// A node as the document has it, in the file's own frame.
struct GltfNode {
  /// What few nodes have.
  struct Unusual {
    JsonText instancing;       ///< EXT_mesh_gpu_instancing
    JsonText instance_extras;  ///< extras.instances
    JsonText features;         ///< EXT_instance_features
    JsonText weights;          ///< weights of morph targets, in place of the mesh's own
    JsonText neutral;          ///< extras.strake, of a neutral scene
    std::optional<GltfFault> fault;
  };

  std::string name;              ///< its own, else its mesh's, else "node 12"
  std::string id;                ///< extras.id, where it is a string
  model::Attributes attributes;  ///< the rest of its extras, nested keys joined by '.'
  std::vector<std::uint64_t> children;
  geometry::Placement local;
  std::optional<std::uint64_t> mesh;
  bool counted = false;  ///< the name is "node 12"
  bool skinned = false;
  std::unique_ptr<Unusual> unusual;

  [[nodiscard]] JsonText instancing() const { return unusual ? unusual->instancing : JsonText(); }
  [[nodiscard]] JsonText instance_extras() const {
    return unusual ? unusual->instance_extras : JsonText();
  }
  [[nodiscard]] JsonText features() const { return unusual ? unusual->features : JsonText(); }
  [[nodiscard]] JsonText weights() const { return unusual ? unusual->weights : JsonText(); }
  [[nodiscard]] JsonText neutral() const { return unusual ? unusual->neutral : JsonText(); }
  /// If there is one, the node and what is below it cannot be placed.
  [[nodiscard]] const GltfFault* fault() const {
    return unusual && unusual->fault ? &*unusual->fault : nullptr;
  }
};

/// The nodes of a document, each piece in memory of its own: it is provided and given back by the
/// team, which for one block of hundreds of megabytes took as long as reading the nodes.
class NodeTable {
 public:
  NodeTable() = default;
  NodeTable(const NodeTable&) = delete;
  NodeTable& operator=(const NodeTable&) = delete;
  NodeTable(NodeTable&&) = default;
  NodeTable& operator=(NodeTable&&) = default;
  ~NodeTable() = default;

  /// What is known before nodes are read.
  struct Before {
    const std::vector<JsonValue>& mesh_names;  ///< that the meshes of the document state
    bool neutral = false;                      ///< extras.strake is ours and no attribute
  };

  /// Parses all nodes of the pieces. Nothing when a piece is not valid JSON. Errors: cancelled, out
  /// of memory.
  [[nodiscard]] static Result<std::optional<NodeTable>> read(std::span<const ArrayPiece> pieces,
                                                             const Before& before,
                                                             const parallel::Context& context);

  [[nodiscard]] std::size_t size() const { return at_.size(); }
  [[nodiscard]] std::span<const std::uint64_t> children(std::size_t node) const {
    if ((traits_[node] & kInner) == 0) return {};
    return at_[node]->children;
  }
  [[nodiscard]] bool has_mesh(std::size_t node) const { return (traits_[node] & kMesh) != 0; }
  /// Whether the node has neither a skin nor anything unusual.
  [[nodiscard]] bool is_usual(std::size_t node) const { return (traits_[node] & kUnusual) == 0; }
  /// Whether that holds for all nodes.
  [[nodiscard]] bool all_usual() const { return unusual_.count() == 0; }
  [[nodiscard]] const GltfNode& operator[](std::size_t node) const { return *at_[node]; }
  [[nodiscard]] GltfNode& operator[](std::size_t node) { return *at_[node]; }

  /// Forgets the nodes.
  [[nodiscard]] Status clear(const parallel::Context& context);

 private:
  static constexpr std::uint8_t kInner = 1, kMesh = 2, kUnusual = 4;

  void enter(std::size_t node, GltfNode& place);

  std::vector<std::vector<GltfNode>> pieces_;
  std::vector<GltfNode*> at_;
  /// What loops over all nodes ask of each: the nodes themselves are hundreds of megabytes.
  std::vector<std::uint8_t> traits_;
  parallel::Marks unusual_{1};  ///< set where any node is
};

/// The instances of a node, in the node's frame.
struct Instances {
  std::vector<geometry::Placement> placements;
  std::vector<bool> lost;       ///< its numbers make no finite transformation: it has no placement
  double translation_step = 0;  ///< spacing of quantised translations; 0: float32
  /// One entry per instance; what has neither name nor id is "instance 12".
  std::vector<std::string> names, ids;
  std::vector<bool> counted;                  ///< the name is "instance 12"
  std::vector<model::Attributes> attributes;  ///< those of their features; or none at all
  std::optional<GltfFault> fault;             ///< of all of them

  /// Returns half the spacing of the numbers that say where an instance is.
  [[nodiscard]] double half_spacing(std::size_t instance) const;
};

[[nodiscard]] Instances read_instances(const GltfNode& node, const Accessors& accessors,
                                       const PropertyTables& tables);

/// Returns at most how many bytes the attributes of a node's instances take.
[[nodiscard]] std::uint64_t instance_attribute_bytes(const GltfNode& node,
                                                     const Accessors& accessors,
                                                     const PropertyTables& tables);

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

inline constexpr std::uint32_t kNoParent = parallel::Lowest::kNone;

/// The deepest nesting of nodes.
inline constexpr std::uint32_t kMaxNodeDepth = 1000;

/// The nodes that a scene shows, in document order depth first.
struct Visits {
  std::vector<VisitedNode> all;
  std::vector<std::uint32_t> inner;  ///< of those that have children: indices of `all`, ascending
};

/// Returns the nodes of the default scene, else of the first one, else all. Nodes with two parents,
/// cycles, and references to nodes that do not exist are errors, whose `where` is the JSON pointer
/// alone. Other errors: cancelled, out of memory.
[[nodiscard]] Result<Visits> visit_order(const JsonValue& root, const NodeTable& nodes,
                                         const parallel::Context& context);

}  // namespace strake::io::gltf
