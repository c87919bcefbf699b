// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/writer/glb_json.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

#include "core/text_encoding.hpp"
#include "io/gltf/srgb.hpp"

namespace strake::io::gltf {
namespace {

constexpr std::uint32_t kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
constexpr std::uint32_t kLines = 1, kTriangles = 4;

template <class... Args>
void add(std::string& out, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Args>(args)...);
}

void append_meshes(std::string& out, const GlbPlan& plan) {
  if (plan.meshes.empty()) return;
  out += R"(,"meshes":[)";
  bool first = true;
  for (std::size_t m = 0; m < plan.meshes.size(); ++m) {
    append_separator(out, first);
    out += R"({"primitives":[)";
    const std::vector<MeshPrimitive>& mesh = plan.meshes[m];
    for (std::size_t i = 0; i < mesh.size(); ++i)
      add(out, R"({}{{"attributes":{{"POSITION":{}}},"indices":{},"mode":{},"material":{}}})",
          i == 0 ? "" : ",", 2 * mesh[i].piece, 2 * mesh[i].piece + 1,
          plan.pieces[mesh[i].piece].mesh != nullptr ? kTriangles : kLines, mesh[i].material);
    out += ']';
    if (!plan.mesh_extras[m].empty()) add(out, R"(,"extras":{})", plan.mesh_extras[m]);
    out += '}';
  }
  out += ']';
}

void append_materials(std::string& out, const GlbPlan& plan) {
  if (plan.materials.empty()) return;
  out += R"(,"materials":[)";
  bool first = true;
  for (const model::Color& c : plan.materials) {
    append_separator(out, first);
    add(out,
        R"({{"pbrMetallicRoughness":{{"baseColorFactor":[{},{},{},{}],)"
        R"("metallicFactor":0,"roughnessFactor":0.8}},"doubleSided":true)",
        linear_of_srgb(c.red), linear_of_srgb(c.green), linear_of_srgb(c.blue), c.alpha / 255.0);
    out += c.alpha < 255 ? R"(,"alphaMode":"BLEND"})" : "}";
  }
  out += ']';
}

void append_accessors(std::string& out, const GlbPlan& plan) {
  if (plan.pieces.empty()) return;
  const std::uint32_t narrow_view = plan.wide_count != 0 ? 2 : 1;
  out += R"(,"accessors":[)";
  bool first = true;
  for (const StoredGeometry& p : plan.pieces) {
    append_separator(out, first);
    add(out,
        R"({{"bufferView":0,"byteOffset":{},"componentType":{},"count":{},"type":"VEC3",)"
        R"("min":[{},{},{}],"max":[{},{},{}]}},)",
        12 * p.first_vertex, kFloat, p.vertex_count, p.lo[0], p.lo[1], p.lo[2], p.hi[0], p.hi[1],
        p.hi[2]);
    add(out, R"({{"bufferView":{},"byteOffset":{},"componentType":{},"count":{},"type":"SCALAR"}})",
        p.wide ? 1U : narrow_view, (p.wide ? 4 : 2) * p.first_index,
        p.wide ? kUnsignedInt : kUnsignedShort, p.index_count);
  }
  out += ']';
}

void append_buffer_views(std::string& out, const GlbPlan& plan) {
  if (plan.pieces.empty()) return;
  const std::uint64_t positions = 12 * plan.vertex_count, wide = 4 * plan.wide_count,
                      narrow = 2 * plan.narrow_count;
  add(out, R"(,"bufferViews":[{{"buffer":0,"byteLength":{},"byteStride":12,"target":34962}})",
      positions);
  if (wide != 0)
    add(out, R"(,{{"buffer":0,"byteOffset":{},"byteLength":{},"target":34963}})", positions, wide);
  if (narrow != 0)
    add(out, R"(,{{"buffer":0,"byteOffset":{},"byteLength":{},"target":34963}})", positions + wide,
        narrow);
  std::uint64_t at = plan.blocks_begin();
  for (const std::span<const std::byte> block : plan.blocks) {
    add(out, R"(,{{"buffer":0,"byteOffset":{},"byteLength":{}}})", at, block.size());
    at += padded(block.size(), kBlockAlignment);
  }
  add(out, R"(],"buffers":[{{"byteLength":{}}}])", plan.binary_bytes());
}

}  // namespace

void append_attributes(std::string& out, const model::Attributes& attributes) {
  out += R"("attributes":{)";
  std::set<std::string> used;
  for (const auto& [key, value] : attributes) {
    std::string name = key;
    for (int i = 2; !used.insert(name).second; ++i) name = fmt::format("{}#{}", key, i);
    if (used.size() > 1) out.push_back(',');
    append_json_string(out, name);
    out.push_back(':');
    append_json_string(out, value);
  }
  out += '}';
}

void append_matrix(std::string& out, const geometry::Placement& placement) {
  if (placement.linear == geometry::Mat3d{} && placement.translation == geometry::Vec3d{}) return;
  out += R"(,"matrix":[)";
  for (int column = 0; column < 3; ++column)
    add(out, "{},{},{},0,", placement.linear.row[0][column], placement.linear.row[1][column],
        placement.linear.row[2][column]);
  add(out, "{},{},{},1]", placement.translation.x, placement.translation.y,
      placement.translation.z);
}

void append_nodes(std::string& out, std::string_view name, std::span<const std::uint32_t> nodes) {
  if (nodes.empty()) return;
  add(out, R"(,"{}":[)", name);
  for (std::size_t i = 0; i < nodes.size(); ++i) add(out, "{}{}", i == 0 ? "" : ",", nodes[i]);
  out += ']';
}

void append_separator(std::string& out, bool& first) {
  if (!first) out.push_back(',');
  first = false;
  out.push_back('\n');
}

void append_geometry(std::string& out, const GlbPlan& plan) {
  append_meshes(out, plan);
  append_materials(out, plan);
  append_accessors(out, plan);
  append_buffer_views(out, plan);
}

}  // namespace strake::io::gltf
