// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/writer/neutral_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "geometry/primitives/tessellate.hpp"
#include "io/gltf/neutral/primitive_lengths.hpp"
#include "io/source/precision.hpp"

namespace strake::io::gltf {
namespace {

using geometry::Vec3d;

static_assert(sizeof(Vec3d) == 3 * sizeof(double));

bool is_float(double number) {
  const double rounded = static_cast<float>(number);
  return std::memcmp(&rounded, &number, sizeof number) == 0;
}

bool are_floats(const std::vector<Vec3d>& points) {
  return std::ranges::all_of(
      points, [](const Vec3d& p) { return is_float(p.x) && is_float(p.y) && is_float(p.z); });
}

std::uint64_t count_segments(const geometry::Polylines& lines) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i + 1 < lines.first.size(); ++i)
    if (lines.first[i + 1] > lines.first[i]) count += lines.first[i + 1] - lines.first[i] - 1;
  return count;
}

class NeutralPlanner {
 public:
  NeutralPlanner(const model::Model& model, const WriteOptions& options)
      : model_(model), options_(options) {
    plan_.glb.frame = {1.0, UpAxis::z};
  }
  Result<NeutralPlan> plan();

 private:
  /// What a viewer is shown of a shape.
  struct Shown {
    std::uint32_t piece = kNoMesh;
    /// What the piece does not say of the shape: blocks by what they hold, and the rest as JSON.
    std::vector<std::pair<std::string_view, std::uint32_t>> blocks;
    std::string rest;
  };

  Status body(const model::Object& object, const model::Body& body);
  Result<Shown> show(model::ShapeId shape, int magnification);
  Result<Shown> show_primitive(const geometry::Primitive& primitive, int magnification);
  Result<std::uint32_t> piece(StoredGeometry piece);
  void add_block(Shown& shown, std::string_view name, std::span<const std::byte> bytes);
  void add_positions(const std::vector<Vec3d>& points, Shown& shown);
  void describe_meshes();
  std::uint32_t material(const model::Color& color);

  const model::Model& model_;
  const WriteOptions& options_;
  NeutralPlan plan_;
  std::map<std::pair<std::uint32_t, int>, Shown> shown_;
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> meshes_;    ///< by piece and material
  std::vector<std::pair<model::ShapeId, const Shown*>> described_;  ///< per mesh
  std::map<std::array<std::uint8_t, 4>, std::uint32_t> materials_;
};

std::uint32_t NeutralPlanner::material(const model::Color& color) {
  std::vector<model::Color>& all = plan_.glb.materials;
  const auto [place, is_new] = materials_.try_emplace(
      {color.red, color.green, color.blue, color.alpha}, static_cast<std::uint32_t>(all.size()));
  if (is_new) all.push_back(color);
  return place->second;
}

Result<std::uint32_t> NeutralPlanner::piece(StoredGeometry piece) {
  GlbPlan& glb = plan_.glb;
  piece.vertex_count = piece.vertices().size();
  piece.index_count =
      piece.mesh != nullptr ? 3 * piece.mesh->triangles.size() : 2 * count_segments(*piece.lines);
  if (const Status measured = glb.measure(piece); !measured) return measured.error();
  glb.append(piece);
  return static_cast<std::uint32_t>(glb.pieces.size() - 1);
}

void NeutralPlanner::add_block(Shown& shown, std::string_view name,
                               std::span<const std::byte> bytes) {
  shown.blocks.emplace_back(name, static_cast<std::uint32_t>(plan_.glb.blocks.size()));
  plan_.glb.blocks.push_back(bytes);
}

/// Keeps the doubles of points that float32 would round.
void NeutralPlanner::add_positions(const std::vector<Vec3d>& points, Shown& shown) {
  if (!are_floats(points)) add_block(shown, "positions", std::as_bytes(std::span(points)));
}

Result<NeutralPlanner::Shown> NeutralPlanner::show_primitive(const geometry::Primitive& primitive,
                                                             int magnification) {
  geometry::Tessellation made = geometry::tessellate(primitive, geometry::Mat3d{},
                                                     std::ldexp(options_.sag_mm, -magnification));
  GlbPlan& glb = plan_.glb;
  StoredGeometry stored;
  if (!made.lines.points.empty()) {
    stored.lines = &glb.made_lines.emplace_back(std::move(made.lines));
  } else {
    // A mesh needs something to show: of what has no extent it is a point.
    if (made.mesh.triangles.empty()) made.mesh = {{Vec3d{}}, {{0, 0, 0}}, {}, -1};
    stored.mesh = &glb.made.emplace_back(std::move(made.mesh));
  }
  const Result<std::uint32_t> added = piece(stored);
  if (!added) return added.error();
  return Shown{*added,
               {},
               fmt::format(R"(,"primitive":{{"kind":"{}","lengths":[{}]}})",
                           geometry::kind_name(primitive), fmt::join(lengths_of(primitive), ","))};
}

Result<NeutralPlanner::Shown> NeutralPlanner::show(model::ShapeId shape, int magnification) {
  const model::Shape& source = model_.shapes[model::index(shape)];
  if (const auto* const primitive = std::get_if<geometry::Primitive>(&source))
    return show_primitive(*primitive, magnification);
  Shown shown;
  StoredGeometry stored;
  stored.mesh = std::get_if<geometry::TriangleMesh>(&source);
  stored.lines = std::get_if<geometry::Polylines>(&source);
  if (stored.mesh != nullptr) {
    const geometry::TriangleMesh& mesh = *stored.mesh;
    if (mesh.triangles.empty()) return shown;
    add_positions(mesh.vertices, shown);
    if (!mesh.faces.empty()) add_block(shown, "faces", std::as_bytes(std::span(mesh.faces)));
    if (mesh.sag_mm >= 0) shown.rest = fmt::format(R"(,"sag_mm":{})", mesh.sag_mm);
  } else {
    if (count_segments(*stored.lines) == 0) return shown;
    add_positions(stored.lines->points, shown);
    add_block(shown, "chains", std::as_bytes(std::span(stored.lines->first)));
  }
  const Result<std::uint32_t> added = piece(stored);
  if (!added) return added.error();
  shown.piece = *added;
  return shown;
}

Status NeutralPlanner::body(const model::Object& object, const model::Body& body) {
  const auto fail = [&](Error error) {
    error.where = object.id;
    return error;
  };
  if (!is_finite(body.placement))
    return fail({ErrorCode::output, "a placement is not finite", "", "mend the model"});
  const bool is_primitive =
      std::holds_alternative<geometry::Primitive>(model_.shapes[model::index(body.shape)]);
  // Curves are as fine as their largest image needs, in steps of two; matrices are rounded.
  const double scale = scale_of(body.placement.linear) / 1.01;
  const int magnification = is_primitive && scale > 0 ? std::ilogb(scale) + 1 : 0;
  const auto [place, is_new] = shown_.try_emplace({model::index(body.shape), magnification});
  if (is_new) {
    Result<Shown> made = show(body.shape, magnification);
    if (!made) return fail(made.error());
    place->second = std::move(*made);
  }
  const Shown& shown = place->second;
  std::uint32_t& mesh = plan_.meshes.emplace_back(kNoMesh);
  if (shown.piece == kNoMesh) return {};
  GlbPlan& glb = plan_.glb;
  const MeshPrimitive primitive{shown.piece, material(body.color)};
  const auto [at, is_new_mesh] = meshes_.try_emplace({primitive.piece, primitive.material},
                                                     static_cast<std::uint32_t>(glb.meshes.size()));
  if (is_new_mesh) {
    glb.meshes.push_back({primitive});
    described_.emplace_back(body.shape, &shown);
  }
  mesh = at->second;
  return {};
}

void NeutralPlanner::describe_meshes() {
  const std::uint32_t before = plan_.glb.core_views();
  for (const auto& [shape, shown] : described_) {
    std::string text = fmt::format(R"({{"strake":{{"shape":{})", model::index(shape));
    for (const auto& [name, block] : shown->blocks)
      fmt::format_to(std::back_inserter(text), R"(,"{}":{})", name, before + block);
    plan_.glb.mesh_extras.push_back(text + shown->rest + "}}");
  }
}

Result<NeutralPlan> NeutralPlanner::plan() {
  plan_.meshes.reserve(model_.bodies.size());
  for (const model::Object& object : model_.objects)
    for (std::uint32_t i = 0; i < object.body_count; ++i)
      if (const Status planned = body(object, model_.bodies[object.first_body + i]); !planned)
        return planned.error();
  describe_meshes();
  return std::move(plan_);
}

}  // namespace

Result<NeutralPlan> plan_neutral(const model::Model& model, const WriteOptions& options) {
  return NeutralPlanner(model, options).plan();
}

}  // namespace strake::io::gltf
