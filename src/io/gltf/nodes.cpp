// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "io/source/precision.hpp"
#include "io/source/units_and_axes.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/lowest.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/slots.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::io::gltf {
namespace {

using geometry::Placement;
using geometry::Vec3d;

/// The longest text of an attribute: extras may hold whole tables; what is longer or deeper than
/// this is of no use.
constexpr std::size_t kMaxAttributeBytes = 4096;
constexpr int kMaxAttributeDepth = 4;

bool is_reserved(const JsonValue& key, bool neutral) {
  return key.is_text("id") || key.is_text("path") || key.is_text("instances") ||
         (neutral && key.is_text("strake"));
}

/// Adds the attributes below `prefix`, of a neutral scene or of any other.
struct AttributeCollector {
  bool neutral = false;
  model::Attributes& out;

  void add(const JsonValue& extras, const std::string& prefix, int depth) const;
};

void AttributeCollector::add(const JsonValue& extras, const std::string& prefix, int depth) const {
  extras.members([&](const JsonValue& key, const JsonValue& value) {
    if (depth == 0 && is_reserved(key, neutral)) return;
    if (value.raw().size() > (kMaxAttributeBytes << 4U)) return;
    // The writer's own "attributes" are not a level of the user's.
    const bool own = depth == 0 && value.is_object() && key.is_text("attributes");
    std::string name = prefix;
    if (!own) key.append_text(name);
    if (name.size() > kMaxAttributeBytes) return;
    if (value.is_object()) {
      if (!own) name.push_back('.');
      if (depth < kMaxAttributeDepth) add(value, name, depth + 1);
      return;
    }
    if (value.raw().size() > kMaxAttributeBytes) return;
    out.emplace_back(std::move(name),
                     value.is_string() ? value.text_value() : std::string(value.raw()));
  });
}

std::optional<Placement> matrix_of(const JsonValue& json) {
  std::array<double, 16> m{};
  if (!json.numbers(m.data(), 16)) return std::nullopt;
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) return std::nullopt;
  Placement placement;
  for (std::size_t row = 0; row < 3; ++row)
    placement.linear.row[row] = {m[row], m[4 + row], m[8 + row]};
  placement.translation = {m[12], m[13], m[14]};
  return placement;
}

/// What a node states of its placement; each member may be absent.
struct Transform {
  JsonValue matrix, translation, rotation, scale;
};

/// Returns nothing when it is not a finite affine transform.
std::optional<Placement> parse_transform(const Transform& json) {
  const auto finite = [](const std::optional<Placement>& placement) {
    return placement && is_finite(*placement) ? placement : std::nullopt;
  };
  if (json.matrix.exists()) return finite(matrix_of(json.matrix));
  std::array<double, 3> t{0, 0, 0}, s{1, 1, 1};
  std::array<double, 4> r{0, 0, 0, 1};
  const auto given = [](const JsonValue& value, double* out, std::size_t count) {
    return !value.exists() || value.numbers(out, count);
  };
  if (!given(json.translation, t.data(), 3) || !given(json.scale, s.data(), 3) ||
      !given(json.rotation, r.data(), 4))
    return std::nullopt;
  return finite(placement_of({t[0], t[1], t[2]}, r.data(), {s[0], s[1], s[2]}));
}

}  // namespace

std::optional<Placement> placement_of(const Vec3d& translation, const double* quaternion,
                                      const Vec3d& scale) {
  const double x = quaternion[0], y = quaternion[1], z = quaternion[2], w = quaternion[3];
  const double norm = x * x + y * y + z * z + w * w;
  if (!(norm > 0)) return std::nullopt;
  const double f = 2 / norm;  // exporters round: the rotation is that of the unit quaternion
  Placement result;
  result.linear.row[0] = {(1 - f * (y * y + z * z)) * scale.x, f * (x * y - w * z) * scale.y,
                          f * (x * z + w * y) * scale.z};
  result.linear.row[1] = {f * (x * y + w * z) * scale.x, (1 - f * (x * x + z * z)) * scale.y,
                          f * (y * z - w * x) * scale.z};
  result.linear.row[2] = {f * (x * z - w * y) * scale.x, f * (y * z + w * x) * scale.y,
                          (1 - f * (x * x + y * y)) * scale.z};
  result.translation = translation;
  return result;
}

namespace {

/// Returns what few nodes have, if it is anything.
std::unique_ptr<GltfNode::Unusual> kept_if_any(GltfNode::Unusual unusual) {
  if (!unusual.instancing.exists() && !unusual.instance_extras.exists() &&
      !unusual.features.exists() && !unusual.weights.exists() && !unusual.neutral.exists() &&
      !unusual.fault)
    return nullptr;
  return std::make_unique<GltfNode::Unusual>(std::move(unusual));
}

GltfNode parse_node(const JsonValue& json, std::size_t index, const NodeTable::Before& before) {
  const std::vector<JsonValue>& mesh_names = before.mesh_names;
  const auto [name, mesh, children, matrix, translation, rotation, scale, extras, extensions, skin,
              weights] =
      json.pick<11>({"name", "mesh", "children", "matrix", "translation", "rotation", "scale",
                     "extras", "extensions", "skin", "weights"});
  GltfNode node;
  std::optional<GltfFault> fault;
  node.name = name.text_value();
  if (mesh.exists()) {
    node.mesh = mesh.index().value_or(UINT64_MAX);
    if (*node.mesh >= mesh_names.size())
      fault = GltfFault{fmt::format("/nodes/{}/mesh", index), "does not exist"};
    else if (node.name.empty())
      node.name = mesh_names[*node.mesh].text_value();
  }
  node.counted = node.name.empty();
  if (node.counted) node.name = fmt::format("node {}", index);
  children.elements(
      [&](const JsonValue& child) { node.children.push_back(child.index().value_or(UINT64_MAX)); });
  if (const auto local = parse_transform({matrix, translation, rotation, scale}))
    node.local = *local;
  else
    fault =
        GltfFault{fmt::format("/nodes/{}", index), "its transformation is not a finite affine one"};
  const auto [id, instance_extras, neutral] = extras.pick<3>({"id", "instances", "strake"});
  node.id = id.text_value();
  if (extras.is_object()) {
    constexpr std::size_t kUsual = 4;  // what one allocation holds as well as half of it
    node.attributes.reserve(kUsual);
    AttributeCollector{before.neutral, node.attributes}.add(extras, "", 0);
  }
  node.skinned = skin.exists();
  node.unusual =
      kept_if_any({JsonText(extensions["EXT_mesh_gpu_instancing"]), JsonText(instance_extras),
                   JsonText(extensions["EXT_instance_features"]), JsonText(weights),
                   before.neutral ? JsonText(neutral) : JsonText(), std::move(fault)});
  return node;
}

/// Returns the nodes of a piece; fewer or more than there should be when it is no valid JSON.
std::vector<GltfNode> parse_nodes(const ArrayPiece& piece, const NodeTable::Before& before) {
  std::vector<GltfNode> nodes;
  const std::optional<JsonDocument> document = JsonDocument::parse_items(piece.text, kNodeDepth);
  if (!document) return nodes;
  nodes.reserve(piece.count);
  document->each_item([&](const JsonValue& item) {
    nodes.push_back(parse_node(item, piece.first + nodes.size(), before));
  });
  return nodes;
}

}  // namespace

void NodeTable::enter(std::size_t node, GltfNode& place) {
  at_[node] = &place;
  traits_[node] =
      static_cast<std::uint8_t>((place.children.empty() ? 0 : kInner) | (place.mesh ? kMesh : 0) |
                                (place.skinned || place.unusual ? kUnusual : 0));
  if (place.skinned || place.unusual) unusual_.set(0);
}

Result<std::optional<NodeTable>> NodeTable::read(std::span<const ArrayPiece> pieces,
                                                 const Before& before,
                                                 const parallel::Context& context) {
  NodeTable table;
  const std::size_t count = pieces.empty() ? 0 : pieces.back().first + pieces.back().count;
  Result<std::vector<GltfNode*>> at = parallel::unset_slots<GltfNode*>(count);
  if (!at) return at.error();
  table.at_ = std::move(*at);
  Result<std::vector<std::uint8_t>> traits = parallel::unset_slots<std::uint8_t>(count);
  if (!traits) return traits.error();
  table.traits_ = std::move(*traits);
  Result<std::vector<std::vector<GltfNode>>> read = parallel::transform(
      context, {.name = "read glTF nodes", .n = pieces.size()}, [&](std::size_t k) {
        std::vector<GltfNode> nodes = parse_nodes(pieces[k], before);
        if (nodes.size() == pieces[k].count)
          for (std::size_t i = 0; i < nodes.size(); ++i) table.enter(pieces[k].first + i, nodes[i]);
        return nodes;
      });
  if (!read) return read.error();
  table.pieces_ = std::move(*read);
  for (std::size_t k = 0; k < pieces.size(); ++k)
    if (table.pieces_[k].size() != pieces[k].count) return std::optional<NodeTable>();
  return std::optional<NodeTable>(std::move(table));
}

Status NodeTable::clear(const parallel::Context& context) {
  at_.clear();
  traits_.clear();
  return parallel::for_each(context, {.name = "forget glTF nodes", .n = pieces_.size()},
                            [&](std::size_t k) { std::vector<GltfNode>().swap(pieces_[k]); });
}

std::uint64_t stated_instances(const GltfNode& node, const Accessors& accessors) {
  std::uint64_t maximum = 0;
  const JsonDocument instancing = node.instancing().parse();
  for (const JsonValue& attribute : instancing.root()["attributes"].items())
    maximum = std::max(maximum, accessors.stated_count(attribute.index().value_or(UINT64_MAX)));
  return maximum;
}

namespace {

/// Opens one of the three attributes; absent is fine, anything else of another width or count is
/// not.
std::optional<GltfFault> open_attribute(const JsonValue& attributes, const char* name,
                                        std::size_t width, const Accessors& accessors,
                                        std::optional<Accessor>& out) {
  const JsonValue json = attributes[name];
  if (!json.exists()) return std::nullopt;
  Checked<Accessor> opened = accessors.open(json);
  if (const GltfFault* fault = fault_of(opened)) return *fault;
  auto& accessor = std::get<Accessor>(opened);
  if (accessor.width != width)
    return GltfFault{accessor.pointer, fmt::format("cannot be an instance {}", name)};
  out = std::move(accessor);
  return std::nullopt;
}

/// Names instances as a list with an entry for each does; without one they are counted.
void read_names(const JsonValue& extras, std::size_t count, Instances& out) {
  std::vector<JsonValue> items;
  if (extras.is_array()) items = extras.items();
  if (items.size() != count) items.assign(count, JsonValue());
  for (const JsonValue& item : items) {
    const std::size_t i = out.names.size();
    std::string name = item.is_string() ? item.text_value() : item["name"].text_value();
    std::string id = item["id"].text_value();
    out.counted.push_back(name.empty() && id.empty());
    if (name.empty()) name = id.empty() ? fmt::format("instance {}", i) : id;
    out.names.push_back(std::move(name));
    out.ids.push_back(std::move(id));
  }
}

std::vector<FeatureIds> feature_ids(const GltfNode& node, const JsonValue& attributes,
                                    const Accessors& accessors) {
  if (!node.features().exists()) return {};
  const JsonDocument features = node.features().parse();
  return read_feature_ids(features.root(), attributes, accessors);
}

/// Gives instances what the rows of their features say; a name of the node's extras stays.
void read_rows(const std::vector<FeatureIds>& features, const PropertyTables& tables,
               Instances& out) {
  if (features.empty()) return;
  out.attributes.resize(out.placements.size());
  for (std::size_t i = 0; i < out.placements.size(); ++i) {
    FeatureRow row;
    for (const FeatureIds& set : features)
      if (const auto id = set.of(i)) tables.add_row(set.table, *id, row);
    out.attributes[i] = std::move(row.attributes);
    if (!out.counted[i] || (row.name.empty() && row.id.empty())) continue;
    out.names[i] = row.name.empty() ? row.id : std::move(row.name);
    out.ids[i] = std::move(row.id);
    out.counted[i] = false;
  }
}

}  // namespace

std::uint64_t instance_attribute_bytes(const GltfNode& node, const Accessors& accessors,
                                       const PropertyTables& tables) {
  const JsonDocument instancing = node.instancing().parse();
  const std::uint64_t count = stated_instances(node, accessors);
  std::uint64_t bytes = 0;
  for (const FeatureIds& set : feature_ids(node, instancing.root()["attributes"], accessors)) {
    const std::uint64_t numbered = set.ids ? std::min<std::uint64_t>(count, set.ids->count) : count;
    for (std::size_t i = 0; i < numbered; ++i)
      if (const auto id = set.of(i)) bytes += tables.row_bytes(set.table, *id);
  }
  return bytes;
}

double Instances::half_spacing(std::size_t instance) const {
  const double largest = largest_coordinate(std::array{placements[instance].translation});
  return std::max(float32_half_spacing(largest), translation_step / 2);
}

Instances read_instances(const GltfNode& node, const Accessors& accessors,
                         const PropertyTables& tables) {
  Instances result;
  const JsonDocument instancing = node.instancing().parse();
  const JsonValue attributes = instancing.root()["attributes"];
  std::optional<Accessor> translation, rotation, scale;
  for (auto fault : {open_attribute(attributes, "TRANSLATION", 3, accessors, translation),
                     open_attribute(attributes, "ROTATION", 4, accessors, rotation),
                     open_attribute(attributes, "SCALE", 3, accessors, scale)})
    if (fault) {
      result.fault = std::move(fault);
      return result;
    }
  std::optional<std::size_t> count;
  for (const auto* part : {&translation, &rotation, &scale}) {
    if (!*part) continue;
    if (count && *count != (*part)->count) {
      result.fault = GltfFault{(*part)->pointer, "instance attributes differ in their counts"};
      return result;
    }
    count = (*part)->count;
  }
  if (translation) result.translation_step = translation->step();
  for (std::size_t i = 0; i < count.value_or(0); ++i) {
    std::array<double, 4> t{0, 0, 0, 0}, r{0, 0, 0, 1}, s{1, 1, 1, 0};
    if (translation) translation->element(i, t.data());
    if (rotation) rotation->element(i, r.data());
    if (scale) scale->element(i, s.data());
    const std::optional<Placement> placement =
        placement_of({t[0], t[1], t[2]}, r.data(), {s[0], s[1], s[2]});
    const bool finite = placement && is_finite(*placement);
    result.placements.push_back(finite ? *placement : Placement{});
    result.lost.push_back(!finite);
  }
  const JsonDocument extras = node.instance_extras().parse();
  read_names(extras.root(), result.placements.size(), result);
  read_rows(feature_ids(node, attributes, accessors), tables, result);
  return result;
}

namespace {

Error refused(std::string pointer, std::string message,
              std::string mend = "mend the hierarchy: every node has at most one parent") {
  return {ErrorCode::input, std::move(message), std::move(pointer), std::move(mend)};
}

/// Nodes that a worker takes at once where little is done for each.
constexpr std::size_t kNodesPerRun = 16384;

/// Returns the first fault in document order, where there is one: a child that does not exist, or
/// that has two parents.
Status check_children(const NodeTable& nodes) {
  std::vector<std::uint32_t> parents(nodes.size(), kNoParent);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const std::uint64_t child : nodes.children(i)) {
      const auto pointer = [i] { return fmt::format("/nodes/{}/children", i); };
      if (child >= nodes.size()) return refused(pointer(), "names a node that does not exist");
      if (parents[child] != kNoParent)
        return refused(pointer(),
                       fmt::format("node {} has two parents, {} and {}", child, parents[child], i));
      parents[child] = static_cast<std::uint32_t>(i);
    }
  return {};
}

/// Returns the parent of each node, kNoParent where it has none.
Result<parallel::Lowest> parents_of(const NodeTable& nodes, const parallel::Context& context) {
  parallel::Lowest parents(nodes.size());
  const parallel::Region all{
      .name = "parents of glTF nodes", .n = nodes.size(), .grain = kNodesPerRun};
  const auto sum = [](std::size_t& into, std::size_t more) { into += more; };
  const auto children = parallel::reduce(
      context, all, std::size_t{0},
      [&](std::size_t& count, std::size_t i) {
        for (const std::uint64_t child : nodes.children(i)) {
          ++count;
          if (child < nodes.size()) parents.offer(child, i);
        }
      },
      sum);
  if (!children) return children.error();
  const auto with_parent = parallel::reduce(
      context, all, std::size_t{0},
      [&](std::size_t& count, std::size_t i) { count += parents[i] != kNoParent ? 1U : 0U; }, sum);
  if (!with_parent) return with_parent.error();
  // A child that does not exist has no parent, and one of two parents only one.
  if (*children != *with_parent)
    if (const Status faultless = check_children(nodes); !faultless) return faultless.error();
  return parents;
}

/// Checks for cycles: with one parent at most for each, nodes that no root leads to form a cycle.
Status check_cycles(const NodeTable& nodes, const parallel::Lowest& parents) {
  std::vector<std::uint32_t> open;
  std::vector<bool> reached(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (parents[i] == kNoParent) open.push_back(static_cast<std::uint32_t>(i));
  while (!open.empty()) {
    const std::uint32_t node = open.back();
    open.pop_back();
    reached[node] = true;
    for (const std::uint64_t child : nodes.children(node))
      open.push_back(static_cast<std::uint32_t>(child));
  }
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (!reached[i]) return refused(fmt::format("/nodes/{}", i), "the node is its own ancestor");
  return {};
}

Result<std::vector<std::uint64_t>> roots_of(const JsonValue& root, const NodeTable& nodes,
                                            const parallel::Lowest& parents) {
  std::vector<std::uint64_t> roots;
  const std::vector<JsonValue> scenes = root["scenes"].items();
  if (scenes.empty()) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (parents[i] == kNoParent) roots.push_back(i);
    return roots;
  }
  const JsonValue scene_json = root["scene"];
  const std::uint64_t scene = scene_json.exists() ? scene_json.index().value_or(UINT64_MAX) : 0;
  if (scene >= scenes.size()) return refused("/scene", "names a scene that does not exist");
  const std::string pointer = fmt::format("/scenes/{}/nodes", scene);
  std::vector<bool> listed(nodes.size());
  for (const JsonValue& item : scenes[scene]["nodes"].items()) {
    const std::uint64_t node = item.index().value_or(UINT64_MAX);
    if (node >= nodes.size()) return refused(pointer, "names a node that does not exist");
    if (parents[node] != kNoParent || listed[node])
      return refused(pointer, fmt::format("node {} is listed but is a child of another or is "
                                          "listed twice",
                                          node));
    listed[node] = true;
    roots.push_back(node);
  }
  return roots;
}

/// Visits all that roots lead to. Each node has one parent at most, and a root has none, so that no
/// node is visited twice. Errors: nodes that are nested too deep.
Result<Visits> visits_from(std::span<const std::uint64_t> roots, const NodeTable& nodes) {
  struct Level {
    std::span<const std::uint64_t> siblings;
    std::uint32_t parent = kNoParent;  ///< their visit
    std::size_t next = 0;
  };
  Visits visits;
  visits.all.reserve(nodes.size());
  std::vector<Level> open{{roots}};
  while (!open.empty()) {
    Level& level = open.back();
    if (level.next == level.siblings.size()) {
      open.pop_back();
      continue;
    }
    const std::uint64_t node = level.siblings[level.next++];
    if (open.size() > kMaxNodeDepth)
      return refused(fmt::format("/nodes/{}", node),
                     fmt::format("nodes are nested more than {} deep", kMaxNodeDepth),
                     "export the model with a flatter hierarchy");
    const auto self = static_cast<std::uint32_t>(visits.all.size());
    visits.all.push_back({static_cast<std::uint32_t>(node), level.parent});
    const std::span<const std::uint64_t> children = nodes.children(node);
    if (children.empty()) continue;
    visits.inner.push_back(self);
    open.push_back({children, self});
  }
  return visits;
}

}  // namespace

Result<Visits> visit_order(const JsonValue& root, const NodeTable& nodes,
                           const parallel::Context& context) {
  const Result<parallel::Lowest> parents = parents_of(nodes, context);
  if (!parents) return parents.error();
  const Result<std::vector<std::uint64_t>> roots = roots_of(root, nodes, *parents);
  Result<Visits> visits = roots ? visits_from(*roots, nodes) : Result<Visits>(roots.error());
  // Where all nodes were visited there are no cycles. They are the first fault to tell of.
  if (!visits || visits->all.size() < nodes.size())
    if (const Status acyclic = check_cycles(nodes, *parents); !acyclic) return acyclic.error();
  return visits;
}

}  // namespace strake::io::gltf
