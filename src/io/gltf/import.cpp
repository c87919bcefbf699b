// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/gltf/accessor.hpp"
#include "io/gltf/mesh.hpp"
#include "io/gltf/nodes.hpp"
#include "io/mesh/transparent_shells.hpp"
#include "io/source/precision.hpp"
#include "io/source/reader_support.hpp"
#include "io/source/units_and_axes.hpp"
#include "strake/core/hash.hpp"
#include "strake/parallel/for_each.hpp"

namespace strake::io::gltf {
namespace {

using geometry::Placement;
using geometry::Vec3d;

/// Returns the standard's metres with y up, unless the file says otherwise as our own writer does.
FrameDefault stated_frame(const JsonValue& root) {
  FrameDefault frame{1000.0, UpAxis::y, true};
  const JsonValue extras = root["asset"]["extras"];
  if (const auto unit = extras["unit_mm"].number(); unit && *unit > 0 && *unit < 1e12)
    frame.unit_mm = *unit;
  const std::string up = extras["up_axis"].text_value();
  if (up == "z") frame.up = UpAxis::z;
  if (up == "x") frame.up = UpAxis::x;
  return frame;
}

/// What placing a mesh needs to know of it once its shapes belong to the model.
struct MeshShapes {
  struct ColoredShape {
    model::ShapeId shape{};
    model::Color color;
  };
  std::vector<ColoredShape> parts;
  geometry::Box3d box = geometry::empty_box<double>();
  double half_spacing_mm = 0;  ///< half the spacing of its vertices' numbers
  LeftOut left_out;
};

/// The placement of a mesh.
struct MeshPlacement {
  Placement world;             ///< in the file's frame
  double half_spacing_mm = 0;  ///< of the numbers of the placement; 0: doubles
};

/// Returns half the spacing of the numbers of a node, in the unit of the file. They are decimals,
/// but many writers write such as float32 has.
double half_spacing_of(const Placement& local) {
  if (!came_through_float32(local.translation)) return 0;
  return float32_half_spacing(largest_coordinate(std::array{local.translation}));
}

double largest_coordinate_of(const geometry::Box3d& box) {
  return box.empty() ? 0 : largest_coordinate(std::array{box.lo, box.hi});
}

/// Returns how many bytes naming each instance of a node copies for it.
std::uint64_t attribute_bytes(const GltfNode& node) {
  std::uint64_t bytes = 0;
  for (const auto& [key, value] : node.attributes)
    bytes += sizeof(node.attributes[0]) + key.size() + value.size();
  return bytes;
}

/// Whether the weights of morph targets move a mesh away from its own positions.
bool any_weight(const JsonValue& weights) {
  bool any = false;
  weights.elements([&](const JsonValue& weight) { any = any || weight.number().value_or(0) != 0; });
  return any;
}

/// Returns a path that is not too long, else a hash of it and the end of its last name.
std::string shortened(std::string path, std::string_view name) {
  constexpr std::size_t kMost = 256;
  if (path.size() <= kMost) return path;
  if (name.size() > kMost / 2) name = name.substr(name.size() - kMost / 2);
  return fmt::format("{}/{}", Hasher().add(std::string_view(path)).value().text(), name);
}

/// The fewest bytes of the file per node beyond a number of nodes that hurts nobody. A node takes
/// half a kilobyte of memory, and {"mesh":1,"translation":[1,2,3]} is 36 bytes.
constexpr std::size_t kLeastNodeBytes = 24, kFreeNodes = std::size_t{1} << 20U;

class Importer {
 public:
  Importer(const ImportInput& input, const Container& container, const JsonValue& root)
      : input_(input),
        root_(root),
        default_(stated_frame(root)),
        frame_(choose_frame(input.options, default_)),
        buffers_(root, container, input.file.path),
        accessors_(root, buffers_),
        meshes_(root["meshes"].items()),
        materials_(material_colors(root)),
        model_(start_model(input.file, container.binary_file ? "GLB" : "glTF", input.options,
                           default_)) {}
  Result<model::Model> run();

 private:
  Status parse_nodes();
  Status check_amount() const;
  Status load_meshes();
  void note_meshes();
  void note_nodes();
  void adopt_meshes();
  void place_all();
  void place(const VisitedNode& visit, std::size_t self);
  void place_instances(const GltfNode& node, model::GroupId parent, const MeshPlacement& here,
                       bool counted);
  struct ObjectIdentity {
    std::string name, id;
    model::Attributes attributes;
    bool counted = false;  ///< its name, or one above it, is only a number
  };
  void add_object(const GltfNode& node, ObjectIdentity element, model::GroupId parent,
                  std::span<const MeshPlacement> places);
  model::Object& new_object(ObjectIdentity element, model::GroupId parent);
  bool add_bodies(const MeshShapes& mesh, const MeshPlacement& place);
  [[nodiscard]] std::string path_id(model::GroupId parent, const std::string& name);
  void skip(ObjectIdentity element, model::GroupId parent, const GltfFault& fault);
  [[nodiscard]] Error refusal(std::string message) const {
    return {ErrorCode::input, std::move(message), input_.file.path.string(),
            "export the model again"};
  }
  [[nodiscard]] std::string place_text(const std::string& pointer) const {
    return fmt::format("{}, {}", input_.file.path.string(), pointer);
  }

  struct PlacedNode {
    Placement world;                              ///< in the file's frame
    double half_spacing_mm = 0;                   ///< as of a MeshPlacement
    model::GroupId group = model::GroupId::none;  ///< the group of its children
    const GltfFault* fault = nullptr;             ///< its own fault or an ancestor's
    bool counted = false;                         ///< its name or an ancestor's is only a number
  };
  [[nodiscard]] std::optional<GltfFault> damage_of(const GltfNode& node,
                                                   const PlacedNode& here) const;

  ImportInput input_;
  const JsonValue& root_;
  FrameDefault default_;
  SourceFrame frame_;
  Buffers buffers_;
  Accessors accessors_;
  std::vector<JsonValue> meshes_;
  std::vector<model::Color> materials_;
  std::vector<GltfNode> nodes_;
  std::vector<VisitedNode> visits_;
  std::vector<std::uint32_t> used_;  ///< meshes that a visited node has, ascending
  std::vector<LoadedMesh> loaded_;   ///< one per used mesh
  std::vector<MeshShapes> shapes_;   ///< per mesh of the document
  std::vector<std::optional<GltfFault>> mesh_faults_;
  std::vector<PlacedNode> placed_;  ///< per visit
  std::vector<std::string> paths_;  ///< per group, '/' at the end; empty: not made yet
  model::Model model_;
};

Status Importer::parse_nodes() {
  const std::vector<JsonValue> items = root_["nodes"].items();
  if (items.size() > input_.file.bytes.size() / kLeastNodeBytes + kFreeNodes)
    return refusal("has more nodes than it has anything to say about them");
  std::vector<JsonValue> mesh_names;
  mesh_names.reserve(meshes_.size());
  for (const JsonValue& mesh : meshes_) mesh_names.push_back(mesh["name"]);
  nodes_.resize(items.size());
  const Status parsed = parallel::for_each(
      input_.context, {.name = "read glTF nodes", .n = items.size(), .grain = 256},
      [&](std::size_t i) { nodes_[i] = parse_node(items[i], i, mesh_names); });
  if (!parsed) return parsed;
  Result<std::vector<VisitedNode>> order = visit_order(root_, nodes_);
  if (!order) {
    Error error = order.error();
    error.where = place_text(error.where);
    return error;
  }
  visits_ = std::move(*order);
  std::vector<bool> used(meshes_.size());
  for (const VisitedNode& visit : visits_) {
    const GltfNode& node = nodes_[visit.node];
    if (node.mesh && *node.mesh < meshes_.size()) used[*node.mesh] = true;
  }
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) used_.push_back(static_cast<std::uint32_t>(i));
  return {};
}

/// Checks the amount of data: a few bytes of JSON can refer to the same data again and again, so
/// what that would become in memory is bounded by the file's size before anything is loaded.
Status Importer::check_amount() const {
  const std::uint64_t bytes = input_.file.bytes.size() + buffers_.total_bytes();
  const auto refuse = [&](const char* what) {
    return refusal(
        fmt::format("refers to the same {} so often that they would not fit into the "
                    "memory",
                    what));
  };
  std::uint64_t corners = 0, instances = 0, copied = 0;
  for (const std::uint32_t mesh : used_) {
    corners += stated_corners(accessors_, meshes_[mesh]);
    if (corners > 64 * bytes + (1U << 20U)) return refuse("vertices");
  }
  for (const VisitedNode& visit : visits_) {
    const GltfNode& node = nodes_[visit.node];
    if (!node.mesh || !node.instancing.exists()) continue;
    const std::uint64_t more = stated_instances(node, accessors_);
    instances += more;
    if (instances > bytes / 4 + (1U << 20U)) return refuse("instances");
    if (node.instance_extras.is_array()) copied += more * attribute_bytes(node);
    if (copied > 16 * bytes + (1U << 28U)) return refuse("attributes");
  }
  return {};
}

Status Importer::load_meshes() {
  const MeshInput input{&accessors_, &materials_, frame_};
  loaded_.resize(used_.size());
  return parallel::for_each(
      input_.context, {.name = "load glTF meshes", .n = used_.size()},
      [&](std::size_t i) { loaded_[i] = load_mesh(input, meshes_[used_[i]], used_[i]); });
}

void Importer::note_meshes() {
  for (std::size_t i = 0; i < used_.size(); ++i) {
    const std::string pointer = fmt::format("/meshes/{}", used_[i]);
    if (loaded_[i].points != 0)
      model_.diagnostics.add(Severity::skipped, "gltf-points", "points are not read",
                             place_text(pointer));
    if (loaded_[i].part_transparent) note_merged_shell(model_, place_text(pointer));
    if (loaded_[i].odd != 0)
      model_.diagnostics.add(Severity::warning, "gltf-odd-indices",
                             "indices are left over behind the last triangle or line",
                             place_text(pointer));
  }
}

/// Notes what of the nodes is not read, though it affects what there is or where.
void Importer::note_nodes() {
  std::vector<bool> visited(nodes_.size()), displaced(meshes_.size());
  for (const std::uint32_t mesh : used_) displaced[mesh] = any_weight(meshes_[mesh]["weights"]);
  bool skinned = false, morphed = false;
  for (const VisitedNode& visit : visits_) {
    const GltfNode& node = nodes_[visit.node];
    visited[visit.node] = true;
    skinned = skinned || node.skinned;
    if (node.mesh && *node.mesh < meshes_.size())
      morphed =
          morphed || (node.weights.exists() ? any_weight(node.weights) : displaced[*node.mesh]);
  }
  if (skinned)
    model_.diagnostics.add(Severity::warning, "gltf-skin",
                           "skinned meshes are read as they stand, without their bones",
                           place_text("/skins"));
  if (morphed)
    model_.diagnostics.add(Severity::warning, "gltf-morph",
                           "meshes with morph targets are read as they stand, whatever their "
                           "weights are",
                           place_text("/meshes"));
  std::size_t outside = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    if (!visited[i] && nodes_[i].mesh) ++outside;
  if (outside != 0)
    model_.diagnostics.add(
        Severity::warning, "gltf-other-scene",
        fmt::format("nodes with a mesh outside the scene that the file shows are not read: {}",
                    outside),
        place_text("/scenes"));
}

void Importer::adopt_meshes() {
  shapes_.resize(meshes_.size());
  mesh_faults_.resize(meshes_.size());
  for (std::size_t i = 0; i < used_.size(); ++i) {
    LoadedMesh& loaded = loaded_[i];
    MeshShapes& shapes = shapes_[used_[i]];
    mesh_faults_[used_[i]] = std::move(loaded.fault);
    if (loaded.first_left_out)
      shapes.left_out = {loaded.faces_left_out, loaded.lines_left_out,
                         loaded.first_left_out->message,
                         place_text(loaded.first_left_out->pointer)};
    const auto adopt = [&](auto&& geometry, const std::vector<Vec3d>& points,
                           const model::Color& color) {
      for (const Vec3d& point : points) shapes.box.include(point);
      shapes.parts.push_back({static_cast<model::ShapeId>(model_.shapes.size()), color});
      model_.shapes.emplace_back(std::forward<decltype(geometry)>(geometry));
    };
    if (!loaded.opaque.triangles.empty())
      adopt(std::move(loaded.opaque), loaded.opaque.vertices, loaded.opaque_color);
    if (!loaded.transparent.triangles.empty())
      adopt(std::move(loaded.transparent), loaded.transparent.vertices, loaded.transparent_color);
    if (!loaded.lines.points.empty())
      adopt(std::move(loaded.lines), loaded.lines.points, loaded.line_color);
    const double largest = largest_coordinate_of(shapes.box) / frame_.unit_mm;
    shapes.half_spacing_mm =
        frame_.unit_mm * std::max(float32_half_spacing(largest), loaded.step / 2);
  }
  loaded_.clear();
}

/// Returns names from the root, joined by '/'. A path that is too long for the many objects of a
/// deep tree keeps its end behind a hash of the whole.
std::string Importer::path_id(model::GroupId parent, const std::string& name) {
  if (parent == model::GroupId::none) return shortened(name, name);
  paths_.resize(model_.groups.size());
  std::vector<std::uint32_t> unknown;
  for (auto g = parent; g != model::GroupId::none && paths_[model::index(g)].empty();
       g = model_.groups[model::index(g)].parent)
    unknown.push_back(model::index(g));
  for (auto g = unknown.rbegin(); g != unknown.rend(); ++g) {
    const model::Group& group = model_.groups[*g];
    const std::string above =
        group.parent == model::GroupId::none ? "" : paths_[model::index(group.parent)];
    paths_[*g] = shortened(above + group.name, group.name) + "/";
  }
  return shortened(paths_[model::index(parent)] + name, name);
}

/// Adds an object without bodies at the end of the model.
model::Object& Importer::new_object(ObjectIdentity element, model::GroupId parent) {
  model::Object object;
  object.positional_id = element.id.empty() && element.counted;
  object.id = element.id.empty() ? path_id(parent, element.name) : std::move(element.id);
  object.name = std::move(element.name);
  object.parent = parent;
  object.first_body = static_cast<std::uint32_t>(model_.bodies.size());
  object.attributes = std::move(element.attributes);
  return model_.objects.emplace_back(std::move(object));
}

/// Keeps the object in the model, so that what lacks it is reported.
void Importer::skip(ObjectIdentity element, model::GroupId parent, const GltfFault& fault) {
  model_.diagnostics.add(Severity::skipped, "gltf-damaged-object",
                         fmt::format("object '{}' is skipped: {}", element.name, fault.message),
                         place_text(fault.pointer));
  new_object(std::move(element), parent).incomplete = true;
}

bool Importer::add_bodies(const MeshShapes& mesh, const MeshPlacement& place) {
  const Placement placement = frame_.placement(place.world);
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vec3d p = placement * Vec3d{(corner & 1U) != 0 ? mesh.box.hi.x : mesh.box.lo.x,
                                      (corner & 2U) != 0 ? mesh.box.hi.y : mesh.box.lo.y,
                                      (corner & 4U) != 0 ? mesh.box.hi.z : mesh.box.lo.z};
    if (!geometry::is_finite(p)) return false;
  }
  const float precision = precision_um(
      std::max(mesh.half_spacing_mm * scale_of(placement.linear), place.half_spacing_mm));
  for (const MeshShapes::ColoredShape& part : mesh.parts)
    model_.bodies.push_back(
        {part.shape, precision, placement, part.color, model::Category::physical});
  return true;
}

void Importer::add_object(const GltfNode& node, ObjectIdentity element, model::GroupId parent,
                          std::span<const MeshPlacement> places) {
  const MeshShapes& mesh = shapes_[*node.mesh];
  const std::size_t first = model_.bodies.size();
  for (const MeshPlacement& place : places)
    if (!add_bodies(mesh, place)) {
      model_.bodies.resize(first);
      return skip(std::move(element), parent,
                  {fmt::format("/meshes/{}", *node.mesh), "it is placed beyond all bounds"});
    }
  model::Object& object = new_object(std::move(element), parent);
  object.first_body = static_cast<std::uint32_t>(first);
  object.body_count = static_cast<std::uint32_t>(model_.bodies.size() - first);
  note_left_out(model_, object, mesh.left_out);
}

void Importer::place_instances(const GltfNode& node, model::GroupId parent,
                               const MeshPlacement& here, bool counted) {
  Instances instances = read_instances(node, accessors_);
  const auto whole = [&] { return ObjectIdentity{node.name, node.id, node.attributes, counted}; };
  if (instances.fault) return skip(whole(), parent, *instances.fault);
  const double scale_mm = frame_.unit_mm * scale_of(here.world.linear);
  std::vector<MeshPlacement> places;
  places.reserve(instances.placements.size());
  for (std::size_t i = 0; i < instances.placements.size(); ++i)
    places.push_back({here.world * instances.placements[i],
                      std::max(here.half_spacing_mm, scale_mm * instances.half_spacing(i))});
  if (places.empty())
    return skip(whole(), parent, {fmt::format("/meshes/{}", *node.mesh), "it has no instances"});
  if (instances.names.empty()) return add_object(node, whole(), parent, places);
  // Named instances are elements of their own below the node.
  const auto group = static_cast<model::GroupId>(model_.groups.size());
  model_.groups.push_back({node.name, parent});
  for (std::size_t i = 0; i < places.size(); ++i)
    add_object(node,
               {std::move(instances.names[i]), std::move(instances.ids[i]), node.attributes,
                counted || instances.counted[i]},
               group, std::span(places).subspan(i, 1));
}

/// Returns why a node with a mesh is no usable object, if so.
std::optional<GltfFault> Importer::damage_of(const GltfNode& node, const PlacedNode& here) const {
  if (here.fault != nullptr) return *here.fault;
  if (const auto& fault = mesh_faults_[*node.mesh]) return fault;
  if (shapes_[*node.mesh].parts.empty())
    return GltfFault{fmt::format("/meshes/{}", *node.mesh), "it has no triangles and no lines"};
  return std::nullopt;
}

void Importer::place(const VisitedNode& visit, std::size_t self) {
  GltfNode& node = nodes_[visit.node];
  const PlacedNode above = visit.parent == kNoParent ? PlacedNode{} : placed_[visit.parent];
  PlacedNode& here = placed_[self];
  here.world = visit.parent == kNoParent ? node.local : above.world * node.local;
  here.half_spacing_mm =
      std::max(above.half_spacing_mm,
               frame_.unit_mm * scale_of(above.world.linear) * half_spacing_of(node.local));
  here.group = above.group;
  here.counted = above.counted || node.counted;
  here.fault = above.fault != nullptr ? above.fault : node.fault ? &*node.fault : nullptr;
  if (!node.children.empty()) {
    here.group = static_cast<model::GroupId>(model_.groups.size());
    model_.groups.push_back({node.name, above.group});
    model_.set_attributes(here.group, node.mesh ? node.attributes : std::move(node.attributes));
  }
  if (!node.mesh) return;
  const MeshPlacement at{here.world, here.half_spacing_mm};
  const std::optional<GltfFault> fault = damage_of(node, here);
  if (!fault && node.instancing.exists())
    return place_instances(node, above.group, at, here.counted);
  // These are not needed again: a node is visited once.
  ObjectIdentity element{node.name, std::move(node.id), std::move(node.attributes), here.counted};
  if (fault) return skip(std::move(element), above.group, *fault);
  add_object(node, std::move(element), above.group, std::span(&at, 1));
}

void Importer::place_all() {
  placed_.resize(visits_.size());
  model_.objects.reserve(visits_.size());
  model_.bodies.reserve(visits_.size());
  for (std::size_t i = 0; i < visits_.size(); ++i) place(visits_[i], i);
}

Result<model::Model> Importer::run() {
  if (const Status parsed = parse_nodes(); !parsed) return parsed.error();
  if (const Status bounded = check_amount(); !bounded) return bounded.error();
  if (const Status loaded = load_meshes(); !loaded) return loaded.error();
  note_meshes();
  note_nodes();
  adopt_meshes();
  place_all();
  return end_model(input_.file, std::move(model_));
}

}  // namespace

Result<model::Model> import_document(const ImportInput& input, const Container& container,
                                     const JsonValue& root) {
  return Importer(input, container, root).run();
}

}  // namespace strake::io::gltf
