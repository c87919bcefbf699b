// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/gltf/accessor.hpp"
#include "io/gltf/features/mesh_features.hpp"
#include "io/gltf/features/property_tables.hpp"
#include "io/gltf/mesh.hpp"
#include "io/gltf/neutral/neutral_import.hpp"
#include "io/gltf/nodes.hpp"
#include "io/gltf/placing.hpp"
#include "io/mesh/transparent_shells.hpp"
#include "io/source/precision.hpp"
#include "io/source/reader_support.hpp"
#include "io/source/units_and_axes.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/marks.hpp"

namespace strake::io::gltf {
namespace {

using geometry::Placement;
using geometry::Vec3d;

double largest_coordinate_of(const geometry::Box3d& box) {
  return box.empty() ? 0 : largest_coordinate(std::array{box.lo, box.hi});
}

/// Whether the weights of morph targets move a mesh away from its own positions.
bool any_weight(const JsonValue& weights) {
  bool any = false;
  weights.elements([&](const JsonValue& weight) { any = any || weight.number().value_or(0) != 0; });
  return any;
}

/// Returns how far at most triangles are from the surfaces that they stand for, as extras state it.
double stated_sag(const JsonValue& extras, double otherwise) {
  constexpr double kMax = 1e12;
  const std::optional<double> sag = extras["sag_mm"].number();
  return sag && *sag >= 0 && *sag < kMax ? *sag : otherwise;
}

/// The fewest bytes of the file per node beyond a number of nodes that hurts nobody. A node takes
/// half a kilobyte of memory, and {"mesh":1,"translation":[1,2,3]} is 36 bytes.
constexpr std::size_t kMinNodeBytes = 24, kFreeNodes = std::size_t{1} << 20U;

class Importer {
 public:
  Importer(const ImportInput& input, const Container& container, const Document& document)
      : input_(input),
        document_(document),
        root_(document.root()),
        neutral_(neutral_scene(root_)),
        default_(stated_frame(root_)),
        frame_(choose_frame(input.options, default_)),
        buffers_(root_, container, input.file.path),
        accessors_(root_, buffers_),
        tables_(root_, buffers_),
        meshes_(root_["meshes"].items()),
        materials_(material_colors(root_)),
        model_(start_model(input.file, container.binary_file ? "GLB" : "glTF", input.options,
                           default_)) {}
  Result<model::Model> run();

 private:
  Status read_nodes();
  Status visit_nodes();
  Status check_amount() const;
  Status load_meshes();
  void note_meshes();
  void note_nodes();
  [[nodiscard]] std::size_t meshes_outside() const;
  void adopt_meshes();
  Status adopt_features();
  [[nodiscard]] Error refusal(std::string message) const {
    return {ErrorCode::input, std::move(message), input_.file.path.string(),
            "export the model again"};
  }
  [[nodiscard]] std::string place_text(const std::string& pointer) const {
    return fmt::format("{}, {}", input_.file.path.string(), pointer);
  }

  ImportInput input_;
  const Document& document_;
  JsonValue root_;
  JsonValue neutral_;  ///< what the asset says of a neutral scene, if it is one
  FrameDefault default_;
  SourceFrame frame_;
  Buffers buffers_;
  Accessors accessors_;
  PropertyTables tables_;
  std::vector<JsonValue> meshes_;
  std::vector<model::Color> materials_;
  NodeTable nodes_;
  std::vector<VisitedNode> visits_;
  std::vector<std::uint32_t> inner_;  ///< visits of nodes with children
  std::vector<std::uint32_t> used_;   ///< meshes that a visited node has, ascending
  std::vector<LoadedMesh> loaded_;    ///< one per used mesh
  std::vector<MeshShapes> shapes_;    ///< per mesh of the document
  model::Model model_;
};

Status Importer::read_nodes() {
  const std::size_t count = document_.node_count();
  if (count > input_.file.bytes.size() / kMinNodeBytes + kFreeNodes)
    return refusal("has more nodes than it has anything to say about them");
  std::vector<JsonValue> mesh_names;
  mesh_names.reserve(meshes_.size());
  for (const JsonValue& mesh : meshes_) mesh_names.push_back(mesh["name"]);
  Result<std::optional<NodeTable>> nodes =
      NodeTable::read(document_.node_pieces(), {mesh_names, neutral_.exists()}, input_.context);
  if (!nodes) return nodes.error();
  if (!*nodes) return error_in_json(input_.file, document_.fault(input_.context));
  nodes_ = std::move(**nodes);
  return {};
}

/// Determines which nodes the scene shows, and their meshes.
Status Importer::visit_nodes() {
  Result<Visits> order = visit_order(root_, nodes_, input_.context);
  if (!order) {
    Error error = order.error();
    if (error.code == ErrorCode::cancelled) return cancelled(input_.file);
    if (error.code != ErrorCode::memory) error.where = place_text(error.where);
    return error;
  }
  visits_ = std::move(order->all);
  inner_ = std::move(order->inner);
  constexpr std::size_t kGrain = 4096;
  parallel::Marks used(meshes_.size());
  const Status marked = parallel::for_each(
      input_.context, {.name = "meshes of glTF nodes", .n = visits_.size(), .grain = kGrain},
      [&](std::size_t i) {
        const GltfNode& node = nodes_[visits_[i].node];
        if (node.mesh && *node.mesh < meshes_.size()) used.set(*node.mesh);
      });
  if (!marked) return marked;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used.is_set(i)) used_.push_back(static_cast<std::uint32_t>(i));
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
  // Shapes of a neutral scene are read once, in however many colours meshes show them.
  const std::span<const std::uint32_t> read_as_often =
      neutral_.exists() ? std::span<const std::uint32_t>() : used_;
  for (const std::uint32_t mesh : read_as_often) {
    corners += stated_corners(accessors_, meshes_[mesh]);
    if (corners > 64 * bytes + (1U << 20U)) return refuse("vertices");
  }
  if (nodes_.all_usual()) return {};
  for (const VisitedNode& visit : visits_) {
    if (nodes_.is_usual(visit.node)) continue;
    const GltfNode& node = nodes_[visit.node];
    if (!node.mesh || !node.instancing().exists()) continue;
    instances += stated_instances(node, accessors_);
    if (instances > bytes / 4 + (1U << 20U)) return refuse("instances");
    copied += instance_attribute_bytes(node, accessors_, tables_);
    if (copied > 16 * bytes + (1U << 28U)) return refuse("attributes");
  }
  return {};
}

Status Importer::load_meshes() {
  const MeshInput input{&accessors_, &materials_, frame_};
  const double of_all = stated_sag(root_["asset"]["extras"], geometry::TriangleMesh().sag_mm);
  // A file that is read in another unit than it states is larger all over.
  const double scale = frame_.unit_mm / default_.unit_mm;
  loaded_.resize(used_.size());
  return parallel::for_each(input_.context, {.name = "load glTF meshes", .n = used_.size()},
                            [&](std::size_t i) {
                              const JsonValue& mesh = meshes_[used_[i]];
                              LoadedMesh& loaded = loaded_[i];
                              loaded = load_mesh(input, mesh, used_[i]);
                              loaded.opaque.sag_mm = scale * stated_sag(mesh["extras"], of_all);
                              loaded.transparent.sag_mm = loaded.opaque.sag_mm;
                            });
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
  std::vector<bool> displaced(meshes_.size());
  for (const std::uint32_t mesh : used_) displaced[mesh] = any_weight(meshes_[mesh]["weights"]);
  const bool any_displaced = std::ranges::count(displaced, true) != 0;
  bool skinned = false, morphed = false;
  const bool all_plain = !any_displaced && nodes_.all_usual();
  for (const VisitedNode& visit : all_plain ? std::span<const VisitedNode>() : visits_) {
    if (!any_displaced && nodes_.is_usual(visit.node)) continue;
    const GltfNode& node = nodes_[visit.node];
    skinned = skinned || node.skinned;
    if (node.mesh && *node.mesh < meshes_.size())
      morphed = morphed || (node.weights().exists() ? any_weight(node.weights().parse().root())
                                                    : displaced[*node.mesh]);
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
  const std::size_t outside = meshes_outside();
  if (outside != 0)
    model_.diagnostics.add(
        Severity::warning, "gltf-other-scene",
        fmt::format("nodes with a mesh outside the scene that the file shows are not read: {}",
                    outside),
        place_text("/scenes"));
}

/// Returns how many nodes with a mesh the scene does not show.
std::size_t Importer::meshes_outside() const {
  if (visits_.size() == nodes_.size()) return 0;
  std::vector<bool> visited(nodes_.size());
  for (const VisitedNode& visit : visits_) visited[visit.node] = true;
  std::size_t outside = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    if (!visited[i] && nodes_.has_mesh(i)) ++outside;
  return outside;
}

void Importer::adopt_meshes() {
  shapes_.resize(meshes_.size());
  for (std::size_t i = 0; i < used_.size(); ++i) {
    LoadedMesh& loaded = loaded_[i];
    MeshShapes& shapes = shapes_[used_[i]];
    shapes.fault = std::move(loaded.fault);
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

/// Gives meshes the rows of tables that say what they are. Each object copies them.
Status Importer::adopt_features() {
  for (const GltfFault& fault : tables_.faults())
    model_.diagnostics.add(Severity::warning, "gltf-metadata",
                           fmt::format("attributes are not read: it {}", fault.message),
                           place_text(fault.pointer));
  if (!root_["extensions"]["EXT_structural_metadata"].exists()) return {};
  std::vector<std::uint64_t> bytes_of_mesh(meshes_.size());
  std::uint64_t vertices = 64 * (input_.file.bytes.size() + buffers_.total_bytes());
  for (const std::uint32_t mesh : used_) {
    MeshFeatures features = features_of(meshes_[mesh], accessors_, vertices);
    if (features.several)
      model_.diagnostics.add(Severity::warning, "gltf-features",
                             "parts of a mesh are features of their own, which are not told apart: "
                             "it is one object, with the attributes of what all of it is alone",
                             place_text(fmt::format("/meshes/{}", mesh)));
    for (const auto& [table, row] : features.rows)
      bytes_of_mesh[mesh] += tables_.row_bytes(table, row);
    shapes_[mesh].features = std::move(features.rows);
  }
  std::uint64_t copied = 0;
  const std::uint64_t maximum =
      16 * (input_.file.bytes.size() + buffers_.total_bytes()) + (1U << 28U);
  for (const VisitedNode& visit : visits_) {
    if (!nodes_.has_mesh(visit.node)) continue;
    const GltfNode& node = nodes_[visit.node];
    if (*node.mesh >= meshes_.size()) continue;
    const std::uint64_t times = node.instancing().exists() ? stated_instances(node, accessors_) : 1;
    copied += times * bytes_of_mesh[*node.mesh];
    if (copied > maximum)
      return refusal(
          "repeats the attributes of its meshes so often that they would not fit into the "
          "memory");
  }
  return {};
}

Result<model::Model> Importer::run() {
  if (const Status read = read_nodes(); !read) return read.error();
  if (const Status visited = visit_nodes(); !visited) return visited.error();
  if (const Status bounded = check_amount(); !bounded) return bounded.error();
  if (neutral_.exists()) {
    const NeutralInput neutral{visits_, nodes_,      neutral_,      meshes_,
                               used_,   buffers_,    accessors_,    materials_,
                               frame_,  input_.file, input_.context};
    return import_neutral(neutral, std::move(model_));
  }
  if (const Status loaded = load_meshes(); !loaded) return loaded.error();
  note_meshes();
  note_nodes();
  adopt_meshes();
  if (const Status bounded = adopt_features(); !bounded) return bounded.error();
  const PlacingInput placing{visits_,       inner_,  nodes_, shapes_,
                             accessors_,    tables_, frame_, input_.file.path.string(),
                             input_.context};
  if (const Status placed = place_nodes(placing, model_); !placed) return placed.error();
  if (const Status cleared = nodes_.clear(input_.context); !cleared) return cleared.error();
  return end_model(input_.file, std::move(model_), input_.context);
}

}  // namespace

FrameDefault stated_frame(const JsonValue& root) {
  if (neutral_scene(root).exists()) return {1.0, UpAxis::z, true};
  FrameDefault frame{1000.0, UpAxis::y, true};
  const JsonValue extras = root["asset"]["extras"];
  if (const auto unit = extras["unit_mm"].number(); unit && *unit > 0 && *unit < 1e12)
    frame.unit_mm = *unit;
  const std::string up = extras["up_axis"].text_value();
  if (up == "z") frame.up = UpAxis::z;
  if (up == "x") frame.up = UpAxis::x;
  return frame;
}

Error error_in_json(const FileBytes& file, Error error) {
  if (error.code == ErrorCode::cancelled) return cancelled(file);
  if (error.code != ErrorCode::memory)
    error.where = fmt::format("{}, {} of its JSON", file.path.string(), error.where);
  return error;
}

Result<model::Model> import_document(const ImportInput& input, const Container& container,
                                     const Document& document) {
  return Importer(input, container, document).run();
}

}  // namespace strake::io::gltf
