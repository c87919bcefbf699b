// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "core/text_encoding.hpp"
#include "io/gltf/writer/glb_file.hpp"
#include "io/gltf/writer/glb_json.hpp"
#include "io/gltf/writer/glb_plan.hpp"
#include "io/gltf/writer/neutral_nodes.hpp"
#include "io/gltf/writer/neutral_plan.hpp"
#include "strake/io/writer.hpp"

namespace strake::io::gltf {
namespace {

/// The JSON chunk of a plan.
class JsonChunk {
 public:
  JsonChunk(const model::Model& model, const GlbPlan& plan) : model_(model), plan_(plan) {}
  std::string text();

 private:
  void asset();
  void nodes();
  void object_node(std::size_t object);
  void extras(const model::Object& object);

  const model::Model& model_;
  const GlbPlan& plan_;
  std::string out_;
};

void JsonChunk::asset() {
  out_ += R"({"asset":{"version":"2.0","generator":"Strake")";
  if (plan_.frame.up == UpAxis::z)
    fmt::format_to(std::back_inserter(out_), R"(,"extras":{{"unit_mm":{},"up_axis":"z"}})",
                   plan_.frame.unit_mm);
  out_ += "}";
}

void JsonChunk::extras(const model::Object& object) {
  out_ += R"(,"extras":{"id":)";
  append_json_string(out_, object.id);
  out_ += R"(,"path":)";
  append_json_string(out_, model_.path(object));
  if (!object.attributes.empty()) {
    out_ += ',';
    append_attributes(out_, object.attributes);
  }
  out_ += "}";
}

void JsonChunk::object_node(std::size_t object) {
  out_ += R"({"name":)";
  append_json_string(out_, model_.objects[object].name);
  const GlbPlan::ObjectNode& node = plan_.objects[object];
  if (node.mesh != kNoMesh) fmt::format_to(std::back_inserter(out_), R"(,"mesh":{})", node.mesh);
  append_matrix(out_, plan_.frame.placement_back(node.placement));
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
  append_nodes(out_, "nodes", roots);
  out_ += "}]";
  if (model_.groups.empty() && model_.objects.empty()) return;
  out_ += R"(,"nodes":[)";
  bool first = true;
  for (std::size_t i = 0; i < model_.groups.size(); ++i) {
    append_separator(out_, first);
    out_ += R"({"name":)";
    const model::Group& group = model_.groups[i];
    append_json_string(out_, group.name);
    append_nodes(out_, "children", children[i]);
    if (group.attributes != model::Group::kNoAttributes) {
      out_ += R"(,"extras":{)";
      append_attributes(out_, model_.group_attributes[group.attributes]);
      out_ += "}";
    }
    out_ += "}";
  }
  for (std::size_t i = 0; i < model_.objects.size(); ++i) {
    append_separator(out_, first);
    object_node(i);
  }
  out_ += "]";
}

std::string JsonChunk::text() {
  asset();
  nodes();
  append_geometry(out_, plan_);
  out_ += "}\n";
  return std::move(out_);
}

}  // namespace
}  // namespace strake::io::gltf

namespace strake::io {

Status write_glb(const model::Model& model, const std::filesystem::path& path,
                 const WriteOptions& options, const parallel::Context& context) {
  if (options.keep_all) {
    const Result<gltf::NeutralPlan> plan = gltf::plan_neutral(model, options);
    if (!plan) return plan.error();
    return gltf::write_glb_file(path, gltf::neutral_json(model, *plan), plan->glb, context.stop);
  }
  const Result<gltf::GlbPlan> plan = gltf::plan_glb(model, options);
  if (!plan) return plan.error();
  return gltf::write_glb_file(path, gltf::JsonChunk(model, *plan).text(), *plan, context.stop);
}

Status put_glb(const model::Model& model, ByteSink sink, const WriteOptions& options,
               const parallel::Context& context) {
  if (options.keep_all) {
    const Result<gltf::NeutralPlan> plan = gltf::plan_neutral(model, options);
    if (!plan) return plan.error();
    return gltf::put_glb(sink, gltf::neutral_json(model, *plan), plan->glb, context.stop);
  }
  const Result<gltf::GlbPlan> plan = gltf::plan_glb(model, options);
  if (!plan) return plan.error();
  return gltf::put_glb(sink, gltf::JsonChunk(model, *plan).text(), *plan, context.stop);
}

}  // namespace strake::io
