// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <bit>
#include <iterator>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/text_encoding.hpp"
#include "io/gltf/glb_plan.hpp"
#include "io/gltf/srgb.hpp"
#include "strake/core/atomic_file.hpp"
#include "strake/io/writer.hpp"

namespace strake::io::gltf {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie");

constexpr std::uint32_t kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
constexpr std::uint32_t kLines = 1, kTriangles = 4;

std::uint64_t padded(std::uint64_t bytes) { return (bytes + 3) / 4 * 4; }

/// The JSON chunk of a plan. Buffer view 0 holds positions, then come the 32-bit and the 16-bit
/// indices, as far as there are any.
class JsonChunk {
 public:
  JsonChunk(const model::Model& model, const GlbPlan& plan) : model_(model), plan_(plan) {}
  std::string text();

 private:
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
  }
  void separator(bool& first) {
    if (!first) out_.push_back(',');
    first = false;
    out_.push_back('\n');
  }
  void asset();
  void nodes();
  void object_node(std::size_t object);
  void matrix(const geometry::Placement& placement);
  void extras(const model::Object& object);
  void attributes(const model::Attributes& attributes);
  void child_list(const char* name, const std::vector<std::uint32_t>& children);
  void meshes();
  void materials();
  void accessors();
  void buffer_views();

  const model::Model& model_;
  const GlbPlan& plan_;
  std::string out_;
};

void JsonChunk::asset() {
  out_ += R"({"asset":{"version":"2.0","generator":"Strake")";
  if (plan_.frame.up == UpAxis::z)
    add(R"(,"extras":{{"unit_mm":{},"up_axis":"z"}})", plan_.frame.unit_mm);
  out_ += "}";
}

void JsonChunk::matrix(const geometry::Placement& placement) {
  if (placement.linear == geometry::Mat3d{} && placement.translation == geometry::Vec3d{}) return;
  const geometry::Placement file = plan_.frame.placement_back(placement);
  out_ += R"(,"matrix":[)";
  for (int column = 0; column < 3; ++column)
    add("{},{},{},0,", file.linear.row[0][column], file.linear.row[1][column],
        file.linear.row[2][column]);
  add("{},{},{},1]", file.translation.x, file.translation.y, file.translation.z);
}

void JsonChunk::extras(const model::Object& object) {
  out_ += R"(,"extras":{"id":)";
  append_json_string(out_, object.id);
  out_ += R"(,"path":)";
  append_json_string(out_, model_.path(object));
  if (!object.attributes.empty()) {
    out_ += ',';
    attributes(object.attributes);
  }
  out_ += "}";
}

void JsonChunk::attributes(const model::Attributes& attributes) {
  out_ += R"("attributes":{)";
  std::set<std::string> used;
  for (const auto& [key, value] : attributes) {
    std::string name = key;
    for (int i = 2; !used.insert(name).second; ++i) name = fmt::format("{}#{}", key, i);
    if (used.size() > 1) out_.push_back(',');
    append_json_string(out_, name);
    out_.push_back(':');
    append_json_string(out_, value);
  }
  out_ += "}";
}

void JsonChunk::child_list(const char* name, const std::vector<std::uint32_t>& children) {
  if (children.empty()) return;
  add(R"(,"{}":[)", name);
  for (std::size_t i = 0; i < children.size(); ++i) add("{}{}", i == 0 ? "" : ",", children[i]);
  out_ += "]";
}

void JsonChunk::object_node(std::size_t object) {
  out_ += R"({"name":)";
  append_json_string(out_, model_.objects[object].name);
  const GlbPlan::ObjectNode& node = plan_.objects[object];
  if (node.mesh != kNoMesh) add(R"(,"mesh":{})", node.mesh);
  matrix(node.placement);
  extras(model_.objects[object]);
  out_ += "}";
}

/// Writes groups first, then objects, so that the number of an object's node is groups + object.
void JsonChunk::nodes() {
  std::vector<std::vector<std::uint32_t>> children(model_.groups.size());
  std::vector<std::uint32_t> roots;
  const auto attach = [&](model::GroupId parent, std::size_t node) {
    auto& list = parent == model::GroupId::none ? roots : children[model::index(parent)];
    list.push_back(static_cast<std::uint32_t>(node));
  };
  for (std::size_t i = 0; i < model_.groups.size(); ++i) attach(model_.groups[i].parent, i);
  for (std::size_t i = 0; i < model_.objects.size(); ++i)
    attach(model_.objects[i].parent, model_.groups.size() + i);

  out_ += R"(,"scene":0,"scenes":[{"name":"model")";
  child_list("nodes", roots);
  out_ += "}]";
  if (model_.groups.empty() && model_.objects.empty()) return;
  out_ += R"(,"nodes":[)";
  bool first = true;
  for (std::size_t i = 0; i < model_.groups.size(); ++i) {
    separator(first);
    out_ += R"({"name":)";
    const model::Group& group = model_.groups[i];
    append_json_string(out_, group.name);
    child_list("children", children[i]);
    if (group.attributes != model::Group::kNoAttributes) {
      out_ += R"(,"extras":{)";
      attributes(model_.group_attributes[group.attributes]);
      out_ += "}";
    }
    out_ += "}";
  }
  for (std::size_t i = 0; i < model_.objects.size(); ++i) {
    separator(first);
    object_node(i);
  }
  out_ += "]";
}

void JsonChunk::meshes() {
  if (plan_.meshes.empty()) return;
  out_ += R"(,"meshes":[)";
  bool first = true;
  for (const std::vector<MeshPrimitive>& mesh : plan_.meshes) {
    separator(first);
    out_ += R"({"primitives":[)";
    for (std::size_t i = 0; i < mesh.size(); ++i)
      add(R"({}{{"attributes":{{"POSITION":{}}},"indices":{},"mode":{},"material":{}}})",
          i == 0 ? "" : ",", 2 * mesh[i].piece, 2 * mesh[i].piece + 1,
          plan_.pieces[mesh[i].piece].mesh != nullptr ? kTriangles : kLines, mesh[i].material);
    out_ += "]}";
  }
  out_ += "]";
}

void JsonChunk::materials() {
  if (plan_.materials.empty()) return;
  out_ += R"(,"materials":[)";
  bool first = true;
  for (const model::Color& c : plan_.materials) {
    separator(first);
    add(R"({{"pbrMetallicRoughness":{{"baseColorFactor":[{},{},{},{}],)"
        R"("metallicFactor":0,"roughnessFactor":0.8}},"doubleSided":true)",
        linear_of_srgb(c.red), linear_of_srgb(c.green), linear_of_srgb(c.blue), c.alpha / 255.0);
    out_ += c.alpha < 255 ? R"(,"alphaMode":"BLEND"})" : "}";
  }
  out_ += "]";
}

void JsonChunk::accessors() {
  if (plan_.pieces.empty()) return;
  const std::uint32_t narrow_view = plan_.wide_count != 0 ? 2 : 1;
  out_ += R"(,"accessors":[)";
  bool first = true;
  for (const StoredGeometry& p : plan_.pieces) {
    separator(first);
    add(R"({{"bufferView":0,"byteOffset":{},"componentType":{},"count":{},"type":"VEC3",)"
        R"("min":[{},{},{}],"max":[{},{},{}]}},)",
        12 * p.first_vertex, kFloat, p.vertex_count, p.lo[0], p.lo[1], p.lo[2], p.hi[0], p.hi[1],
        p.hi[2]);
    add(R"({{"bufferView":{},"byteOffset":{},"componentType":{},"count":{},"type":"SCALAR"}})",
        p.wide ? 1U : narrow_view, (p.wide ? 4 : 2) * p.first_index,
        p.wide ? kUnsignedInt : kUnsignedShort, p.index_count);
  }
  out_ += "]";
}

void JsonChunk::buffer_views() {
  if (plan_.pieces.empty()) return;
  const std::uint64_t positions = 12 * plan_.vertex_count, wide = 4 * plan_.wide_count,
                      narrow = 2 * plan_.narrow_count;
  add(R"(,"bufferViews":[{{"buffer":0,"byteLength":{},"byteStride":12,"target":34962}})",
      positions);
  if (wide != 0)
    add(R"(,{{"buffer":0,"byteOffset":{},"byteLength":{},"target":34963}})", positions, wide);
  if (narrow != 0)
    add(R"(,{{"buffer":0,"byteOffset":{},"byteLength":{},"target":34963}})", positions + wide,
        narrow);
  add(R"(],"buffers":[{{"byteLength":{}}}])", padded(positions + wide + narrow));
}

std::string JsonChunk::text() {
  asset();
  nodes();
  meshes();
  materials();
  accessors();
  buffer_views();
  out_ += "}\n";
  out_.resize(padded(out_.size()), ' ');
  return std::move(out_);
}

template <class T>
void put(AtomicFile& file, const T* numbers, std::size_t count) {
  file.write({reinterpret_cast<const char*>(numbers), count * sizeof(T)});
}

template <class Index>
void put_indices(AtomicFile& file, const StoredGeometry& piece) {
  if (piece.mesh != nullptr) {
    const bool mirrored = piece.relative.linear.determinant() < 0;
    for (const geometry::Triangle& t : piece.mesh->triangles) {
      const std::array<Index, 3> row{static_cast<Index>(t[0]),
                                     static_cast<Index>(mirrored ? t[2] : t[1]),
                                     static_cast<Index>(mirrored ? t[1] : t[2])};
      put(file, row.data(), 3);
    }
    return;
  }
  const std::vector<std::uint32_t>& first = piece.lines->first;
  for (std::size_t chain = 0; chain + 1 < first.size(); ++chain)
    for (std::uint32_t i = first[chain]; i + 1 < first[chain + 1]; ++i) {
      const std::array<Index, 2> row{static_cast<Index>(i), static_cast<Index>(i + 1)};
      put(file, row.data(), 2);
    }
}

bool put_binary(AtomicFile& file, const GlbPlan& plan, const std::stop_token& stop) {
  for (const StoredGeometry& piece : plan.pieces) {
    if (stop.stop_requested()) return false;
    for (const geometry::Vec3d& vertex : piece.vertices()) {
      const std::array<float, 3> row = plan.written(piece, vertex);
      put(file, row.data(), 3);
    }
  }
  for (const bool wide : {true, false})
    for (const StoredGeometry& piece : plan.pieces) {
      if (piece.wide != wide) continue;
      if (stop.stop_requested()) return false;
      if (wide)
        put_indices<std::uint32_t>(file, piece);
      else
        put_indices<std::uint16_t>(file, piece);
    }
  return true;
}

void put_chunk_header(AtomicFile& file, std::uint64_t length, std::uint32_t type) {
  const std::array<std::uint32_t, 2> header{static_cast<std::uint32_t>(length), type};
  put(file, header.data(), header.size());
}

Status write_planned(const model::Model& model, const GlbPlan& plan,
                     const std::filesystem::path& path, const std::stop_token& stop) {
  constexpr std::uint32_t kMagic = 0x46546C67, kJson = 0x4E4F534A, kBinary = 0x004E4942;
  const std::string json = JsonChunk(model, plan).text();
  const std::uint64_t content =
      12 * plan.vertex_count + 4 * plan.wide_count + 2 * plan.narrow_count;
  const std::uint64_t binary = padded(content);
  const std::uint64_t total = 12 + 8 + json.size() + (binary == 0 ? 0 : 8 + binary);
  if (total > std::numeric_limits<std::uint32_t>::max())
    return Error{ErrorCode::output, "would be larger than the 4 GiB that a GLB may have",
                 path.string(), "write the model in parts"};
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return file.error();
  const std::array<std::uint32_t, 3> header{kMagic, 2, static_cast<std::uint32_t>(total)};
  put(*file, header.data(), header.size());
  put_chunk_header(*file, json.size(), kJson);
  file->write(json);
  if (binary != 0) {
    put_chunk_header(*file, binary, kBinary);
    if (!put_binary(*file, plan, stop))
      return Error{ErrorCode::cancelled, "writing was cancelled", path.string(), ""};
    constexpr std::array<char, 4> kZeros{};
    put(*file, kZeros.data(), static_cast<std::size_t>(binary - content));
  }
  return file->commit();
}

}  // namespace
}  // namespace strake::io::gltf

namespace strake::io {

Status write_glb(const model::Model& model, const std::filesystem::path& path,
                 const WriteOptions& options, const parallel::Context& context) {
  const Result<gltf::GlbPlan> plan = gltf::plan_glb(model, options);
  if (!plan) return plan.error();
  return gltf::write_planned(model, *plan, path, context.stop);
}

}  // namespace strake::io
