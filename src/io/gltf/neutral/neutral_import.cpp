// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/neutral/neutral_import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "io/gltf/neutral/kept_diagnostics.hpp"
#include "io/gltf/neutral/neutral_shape.hpp"
#include "io/gltf/placing.hpp"
#include "io/source/precision.hpp"
#include "io/source/reader_support.hpp"
#include "strake/parallel/for_each.hpp"

namespace strake::io::gltf {
namespace {

using geometry::Placement;

enum class Role : std::uint8_t { group, frame, object, body };

/// What a node says of itself.
struct NeutralFacts {
  Role role = Role::group;
  model::Category category = model::Category::physical;
  bool positional_id = false, incomplete = false;
  float precision_um = 0;
  std::optional<model::Attributes> attributes;  ///< in place of those of the usual form
};

Role role_of(const JsonValue& word) {
  if (word.is_text("object")) return Role::object;
  if (word.is_text("body")) return Role::body;
  return word.is_text("frame") ? Role::frame : Role::group;
}

NeutralFacts facts_of(const JsonText& text) {
  NeutralFacts facts;
  if (!text.exists()) return facts;
  const JsonDocument document = text.parse();
  const auto [is, category, positional, incomplete, precision, attributes] =
      document.root().pick<6>(
          {"is", "category", "positional_id", "incomplete", "precision_um", "attributes"});
  facts.role = role_of(is);
  if (category.is_text("obstruction")) facts.category = model::Category::obstruction;
  if (category.is_text("insulation")) facts.category = model::Category::insulation;
  facts.positional_id = positional.boolean().value_or(false);
  facts.incomplete = incomplete.boolean().value_or(false);
  // What is no precision counts as the worst, as precision_um() has it.
  const double um = precision.exists() ? precision.number().value_or(-1) : 0;
  constexpr double kMaxUm = 1e9;
  facts.precision_um = um >= 0 && um < kMaxUm
                           ? static_cast<float>(um)
                           : precision_um(std::numeric_limits<double>::infinity());
  if (!attributes.is_array()) return facts;
  facts.attributes.emplace();
  attributes.elements([&](const JsonValue& pair) {
    const std::vector<JsonValue> items = pair.items();
    if (items.size() == 2)
      facts.attributes->emplace_back(items[0].text_value(), items[1].text_value());
  });
  return facts;
}

class NeutralImporter {
 public:
  NeutralImporter(const NeutralInput& input, model::Model&& model)
      : input_(input), model_(std::move(model)) {}
  Result<model::Model> run();

 private:
  /// A mesh of the document: its shape, whose number in the model it has once a body needs it.
  struct Mesh {
    std::size_t loaded = 0;  ///< of shapes_
    model::Color color;
  };

  /// `shown` are meshes, one per shape.
  [[nodiscard]] Status check_amount(std::span<const std::uint32_t> shown) const;
  Status load_shapes();
  Status read_facts();
  void place(std::size_t visit);
  void add_group(std::size_t visit);
  void add_object(std::size_t visit);
  void add_body(std::size_t visit);
  void skip(const std::string& name, const GltfFault& fault);
  [[nodiscard]] Placement world_of(std::size_t visit) const;
  [[nodiscard]] Placement whole_frame() const;
  /// Returns the object that a body of this node belongs to, if it is the last one.
  [[nodiscard]] model::Object* object_of(std::size_t visit);
  [[nodiscard]] const Mesh& mesh_of(std::uint64_t mesh) const {
    const auto at = std::ranges::lower_bound(input_.used, mesh);
    return meshes_[static_cast<std::size_t>(at - input_.used.begin())];
  }

  const NeutralInput& input_;
  model::Model model_;
  std::vector<Mesh> meshes_;  ///< per used mesh
  std::vector<NeutralShape> shapes_;
  std::vector<std::optional<model::ShapeId>> shape_ids_;  ///< per loaded shape
  std::vector<NeutralFacts> facts_;                       ///< per visit
  std::vector<Placement> worlds_;                         ///< per visit
  std::vector<const GltfFault*> faults_;                  ///< per visit: its own or one's above
  std::vector<model::GroupId> groups_;                    ///< per visit: that of what is below it
  std::size_t object_visit_ = 0;                          ///< of the last object
};

/// Few bytes of JSON could have shapes that name the same numbers again and again.
Status NeutralImporter::check_amount(std::span<const std::uint32_t> shown) const {
  const std::uint64_t largest =
      64 * (input_.file.bytes.size() + input_.buffers.total_bytes()) + (1U << 20U);
  std::uint64_t numbers = 0;
  for (const std::uint32_t mesh : shown) {
    numbers += std::min(stated_numbers(input_.accessors, input_.meshes[mesh]), largest);
    if (numbers > largest)
      return Error{ErrorCode::input,
                   "refers to the same vertices so often that they would not fit into the memory",
                   input_.file.path.string(), "export the model again"};
  }
  return {};
}

/// Loads each shape once, however many meshes show it.
Status NeutralImporter::load_shapes() {
  std::map<std::uint64_t, std::size_t> known;
  std::vector<std::uint32_t> first;  // per shape a mesh that shows it
  for (const std::uint32_t mesh : input_.used) {
    const JsonValue& json = input_.meshes[mesh];
    const std::optional<std::uint64_t> number = json["extras"]["strake"]["shape"].index();
    Mesh added;
    added.loaded = first.size();
    if (number) added.loaded = known.try_emplace(*number, first.size()).first->second;
    if (added.loaded == first.size()) first.push_back(mesh);
    const std::vector<JsonValue> primitives = json["primitives"].items();
    const std::optional<std::uint64_t> material =
        primitives.empty() ? std::nullopt : primitives[0]["material"].index();
    if (material && *material < input_.materials.size()) added.color = input_.materials[*material];
    meshes_.push_back(added);
  }
  if (const Status bounded = check_amount(first); !bounded) return bounded.error();
  shapes_.resize(first.size());
  shape_ids_.resize(first.size());
  return parallel::for_each(
      input_.context, {.name = "load neutral shapes", .n = first.size()}, [&](std::size_t i) {
        shapes_[i] =
            load_neutral_shape(input_.buffers, input_.accessors, input_.meshes[first[i]], first[i]);
      });
}

Status NeutralImporter::read_facts() {
  constexpr std::size_t kGrain = 1024;
  facts_.resize(input_.visits.size());
  return parallel::for_each(
      input_.context, {.name = "read neutral nodes", .n = facts_.size(), .grain = kGrain},
      [&](std::size_t i) { facts_[i] = facts_of(input_.nodes[input_.visits[i].node].neutral()); });
}

/// The frame is for viewers: what is below it is in millimetres with z up already.
Placement NeutralImporter::world_of(std::size_t visit) const {
  const auto [node, parent] = input_.visits[visit];
  if (facts_[visit].role == Role::frame) return {};
  const Placement& local = input_.nodes[node].local;
  if (parent == kNoParent) return local;
  const Placement& above = worlds_[parent];
  const bool moved =
      !(above.linear == geometry::Mat3d{}) || !(above.translation == geometry::Vec3d{});
  return moved ? above * local : local;
}

void NeutralImporter::skip(const std::string& name, const GltfFault& fault) {
  model_.diagnostics.add(Severity::skipped, "gltf-damaged-object",
                         fmt::format("object '{}' is skipped: {}", name, fault.message),
                         fmt::format("{}, {}", input_.file.path.string(), fault.pointer));
}

void NeutralImporter::add_group(std::size_t visit) {
  GltfNode& node = input_.nodes[input_.visits[visit].node];
  const auto group = static_cast<model::GroupId>(model_.groups.size());
  model_.groups.push_back({node.counted ? std::string() : node.name, groups_[visit]});
  groups_[visit] = group;
  std::optional<model::Attributes>& listed = facts_[visit].attributes;
  model_.set_attributes(group, listed ? std::move(*listed) : std::move(node.attributes));
  if (node.mesh)
    skip(node.name, {fmt::format("/nodes/{}", input_.visits[visit].node),
                     "its mesh belongs to no object of the scene"});
}

void NeutralImporter::add_object(std::size_t visit) {
  GltfNode& node = input_.nodes[input_.visits[visit].node];
  NeutralFacts& facts = facts_[visit];
  model::Object object;
  const bool named = !node.id.empty();
  object.id = named ? std::move(node.id) : fmt::format("node {}", input_.visits[visit].node);
  if (!node.counted) object.name = node.name;
  object.attributes = facts.attributes ? std::move(*facts.attributes) : std::move(node.attributes);
  object.parent = groups_[visit];
  object.first_body = static_cast<std::uint32_t>(model_.bodies.size());
  object.incomplete = facts.incomplete;
  object.positional_id = facts.positional_id || !named;
  model_.objects.push_back(std::move(object));
  object_visit_ = visit;
  if (node.mesh) add_body(visit);
}

model::Object* NeutralImporter::object_of(std::size_t visit) {
  const std::size_t at = facts_[visit].role == Role::object ? visit : input_.visits[visit].parent;
  const bool last =
      !model_.objects.empty() && at == object_visit_ && facts_[object_visit_].role == Role::object;
  return last ? &model_.objects.back() : nullptr;
}

/// Returns the unit and axes that somebody says the file has as one placement.
Placement NeutralImporter::whole_frame() const {
  Placement whole;
  for (int k = 0; k < 3; ++k) {
    geometry::Vec3d axis;
    axis[k] = 1;
    const geometry::Vec3d column = input_.frame.point(axis);
    for (int row = 0; row < 3; ++row)
      whole.linear.row[static_cast<std::size_t>(row)][k] = column[row];
  }
  return whole;
}

void NeutralImporter::add_body(std::size_t visit) {
  const std::uint32_t number = input_.visits[visit].node;
  const GltfNode& node = input_.nodes[number];
  model::Object* const object = object_of(visit);
  const auto lose = [&](const GltfFault& fault) {
    if (object != nullptr) object->incomplete = true;
    skip(object != nullptr ? object->name : node.name, fault);
  };
  if (object == nullptr)
    return lose({fmt::format("/nodes/{}", number), "it is a body of no object"});
  if (const GltfFault* const fault = faults_[visit]) return lose(*fault);
  if (!node.mesh) return lose({fmt::format("/nodes/{}", number), "it has no mesh"});
  const Mesh& mesh = mesh_of(*node.mesh);
  NeutralShape& shape = shapes_[mesh.loaded];
  if (shape.fault) return lose(*shape.fault);
  model::Body body;
  body.placement = worlds_[visit];
  const SourceFrame& frame = input_.frame;
  if (frame.unit_mm != 1 || frame.up != UpAxis::z) body.placement = whole_frame() * body.placement;
  const bool finite =
      is_finite(body.placement) && (shape.box.empty() || is_finite_at(shape.box, body.placement));
  if (!finite) return lose({fmt::format("/nodes/{}", number), "it is placed beyond all bounds"});
  std::optional<model::ShapeId>& id = shape_ids_[mesh.loaded];
  if (!id) {
    id = static_cast<model::ShapeId>(model_.shapes.size());
    model_.shapes.push_back(std::move(shape.shape));
  }
  body.shape = *id;
  body.color = mesh.color;
  body.category = facts_[visit].category;
  body.precision_um = facts_[visit].precision_um * static_cast<float>(frame.unit_mm);
  model_.bodies.push_back(body);
  ++object->body_count;
}

void NeutralImporter::place(std::size_t visit) {
  const std::uint32_t parent = input_.visits[visit].parent;
  groups_[visit] = parent == kNoParent ? model::GroupId::none : groups_[parent];
  worlds_[visit] = world_of(visit);
  faults_[visit] = input_.nodes[input_.visits[visit].node].fault();
  if (faults_[visit] == nullptr && parent != kNoParent) faults_[visit] = faults_[parent];
  switch (facts_[visit].role) {
    case Role::frame:
      break;
    case Role::group:
      return add_group(visit);
    case Role::object:
      return add_object(visit);
    case Role::body:
      return add_body(visit);
  }
}

Result<model::Model> NeutralImporter::run() {
  if (const Status loaded = load_shapes(); !loaded) return loaded.error();
  if (const Status read = read_facts(); !read) return read.error();
  worlds_.resize(input_.visits.size());
  faults_.resize(input_.visits.size());
  groups_.resize(input_.visits.size());
  model_.diagnostics.append(diagnostics_of(input_.scene));
  for (std::size_t visit = 0; visit < input_.visits.size(); ++visit) place(visit);
  // What has no bodies lost them, here or before.
  for (model::Object& object : model_.objects)
    object.incomplete = object.incomplete || object.body_count == 0;
  model_.files.front().ends_early = input_.scene["ends_early"].boolean().value_or(false);
  return end_model(input_.file, std::move(model_), input_.context);
}

}  // namespace

JsonValue neutral_scene(const JsonValue& root) {
  const JsonValue scene = root["asset"]["extras"]["strake"];
  return scene["scene"].index() == 1U ? scene : JsonValue();
}

Result<model::Model> import_neutral(const NeutralInput& input, model::Model&& model) {
  return NeutralImporter(input, std::move(model)).run();
}

}  // namespace strake::io::gltf
