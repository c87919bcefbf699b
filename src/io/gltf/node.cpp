// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "io/precision.hpp"
#include "io/source_frame.hpp"

namespace strake::io::gltf {
namespace {

using geometry::Placement;
using geometry::Vec3d;

/// Extras may hold whole tables; what is longer or deeper than this is of no use as an attribute.
constexpr std::size_t kMostAttributeBytes = 4096;
constexpr int kMostAttributeDepth = 4;

bool is_reserved(const Json& key) {
  return key.is_text("id") || key.is_text("path") || key.is_text("instances");
}

void add_attributes(const Json& extras, const std::string& prefix, int depth,
                    model::Attributes& out) {
  extras.members([&](const Json& key, const Json& value) {
    if (depth == 0 && is_reserved(key)) return;
    if (value.raw().size() > (kMostAttributeBytes << 4U)) return;
    // The writer's own "attributes" are not a level of the user's.
    const bool own = depth == 0 && value.is_object() && key.is_text("attributes");
    std::string name = prefix;
    if (!own) key.append_text(name);
    if (name.size() > kMostAttributeBytes) return;
    if (value.is_object()) {
      if (!own) name.push_back('.');
      if (depth < kMostAttributeDepth) add_attributes(value, name, depth + 1, out);
      return;
    }
    if (value.raw().size() > kMostAttributeBytes) return;
    out.emplace_back(std::move(name),
                     value.is_string() ? value.text_value() : std::string(value.raw()));
  });
}

std::optional<Placement> matrix_of(const Json& json) {
  std::array<double, 16> m{};
  if (!json.numbers(m.data(), 16)) return std::nullopt;
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) return std::nullopt;
  Placement placement;
  for (std::size_t row = 0; row < 3; ++row)
    placement.linear.row[row] = {m[row], m[4 + row], m[8 + row]};
  placement.translation = {m[12], m[13], m[14]};
  return placement;
}

bool is_finite(const Placement& p) {
  for (const Vec3d& row : {p.linear.row[0], p.linear.row[1], p.linear.row[2], p.translation})
    if (!std::isfinite(row.x) || !std::isfinite(row.y) || !std::isfinite(row.z)) return false;
  return true;
}

/// What a node says of its place; each may be absent.
struct Transform {
  Json matrix, translation, rotation, scale;
};

/// Nothing when it is not a finite affine one.
std::optional<Placement> parse_transform(const Transform& json) {
  const auto finite = [](const std::optional<Placement>& placement) {
    return placement && is_finite(*placement) ? placement : std::nullopt;
  };
  if (json.matrix.exists()) return finite(matrix_of(json.matrix));
  std::array<double, 3> t{0, 0, 0}, s{1, 1, 1};
  std::array<double, 4> r{0, 0, 0, 1};
  const auto given = [](const Json& value, double* out, std::size_t count) {
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

Node parse_node(const Json& json, std::size_t index, const std::vector<Json>& mesh_names) {
  const auto [name, mesh, children, matrix, translation, rotation, scale, extras, extensions, skin,
              weights] =
      json.pick<11>({"name", "mesh", "children", "matrix", "translation", "rotation", "scale",
                     "extras", "extensions", "skin", "weights"});
  Node node;
  node.name = name.text_value();
  if (mesh.exists()) {
    node.mesh = mesh.index().value_or(UINT64_MAX);
    if (*node.mesh >= mesh_names.size())
      node.fault = Fault{fmt::format("/nodes/{}/mesh", index), "does not exist"};
    else if (node.name.empty())
      node.name = mesh_names[*node.mesh].text_value();
  }
  node.counted = node.name.empty();
  if (node.counted) node.name = fmt::format("node {}", index);
  children.elements(
      [&](const Json& child) { node.children.push_back(child.index().value_or(UINT64_MAX)); });
  if (const auto local = parse_transform({matrix, translation, rotation, scale}))
    node.local = *local;
  else
    node.fault =
        Fault{fmt::format("/nodes/{}", index), "its transformation is not a finite affine one"};
  if (extras.is_object()) {
    constexpr std::size_t kUsual = 4;  // what one allocation holds as well as half of it
    node.attributes.reserve(kUsual);
    node.id = extras["id"].text_value();
    node.instance_extras = extras["instances"];
    add_attributes(extras, "", 0, node.attributes);
  }
  node.instancing = extensions["EXT_mesh_gpu_instancing"];
  node.skinned = skin.exists();
  node.weights = weights;
  return node;
}

std::uint64_t stated_instances(const Node& node, const Accessors& accessors) {
  std::uint64_t most = 0;
  for (const Json& attribute : node.instancing["attributes"].items())
    most = std::max(most, accessors.stated_count(attribute.index().value_or(UINT64_MAX)));
  return most;
}

namespace {

/// One of the three attributes; absent is fine, anything else of another width or count is not.
std::optional<Fault> open_attribute(const Json& attributes, const char* name, std::size_t width,
                                    const Accessors& accessors, std::optional<Accessor>& out) {
  const Json json = attributes[name];
  if (!json.exists()) return std::nullopt;
  Checked<Accessor> opened = accessors.open(json.index().value_or(UINT64_MAX));
  if (const Fault* fault = fault_of(opened)) return *fault;
  auto& accessor = std::get<Accessor>(opened);
  if (accessor.width != width)
    return Fault{accessor.pointer, fmt::format("cannot be an instance {}", name)};
  out = std::move(accessor);
  return std::nullopt;
}

void read_names(const Json& extras, std::size_t count, Instances& out) {
  const std::vector<Json> items = extras.items();
  if (!extras.is_array() || items.size() != count) return;
  for (std::size_t i = 0; i < count; ++i) {
    const Json& item = items[i];
    std::string name = item.is_string() ? item.text_value() : item["name"].text_value();
    std::string id = item["id"].text_value();
    out.counted.push_back(name.empty() && id.empty());
    if (name.empty()) name = id.empty() ? fmt::format("instance {}", i) : id;
    out.names.push_back(std::move(name));
    out.ids.push_back(std::move(id));
  }
}

}  // namespace

double Instances::half_spacing(std::size_t instance) const {
  const double largest = largest_coordinate(std::array{placements[instance].translation});
  return std::max(float32_half_spacing(largest), translation_step / 2);
}

Instances read_instances(const Node& node, const Accessors& accessors) {
  Instances result;
  const Json attributes = node.instancing["attributes"];
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
      result.fault = Fault{(*part)->pointer, "instance attributes differ in their counts"};
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
    if (!placement || !is_finite(*placement)) {
      result.fault = Fault{"EXT_mesh_gpu_instancing",
                           fmt::format("instance {} has no finite transformation", i)};
      return result;
    }
    result.placements.push_back(*placement);
  }
  read_names(node.instance_extras, result.placements.size(), result);
  return result;
}

}  // namespace strake::io::gltf
