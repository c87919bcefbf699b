// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/writer/glb_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <compare>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <variant>

#include "geometry/mesh_repair/snap_to_grid.hpp"
#include "io/mesh/tessellated_shapes.hpp"

namespace strake::io::gltf {
namespace {

using geometry::Placement;
using geometry::Vec3d;

/// A placement by the bits of its numbers: an order for tables, equal only to itself.
using PlacementKey = std::array<std::uint64_t, 12>;

PlacementKey key_of(const Placement& p) {
  PlacementKey key{};
  std::size_t at = 0;
  for (const Vec3d& row : {p.linear.row[0], p.linear.row[1], p.linear.row[2], p.translation})
    for (const double number : {row.x, row.y, row.z})
      key[at++] = std::bit_cast<std::uint64_t>(number + 0.0);
  return key;
}

/// Returns the placement that undoes p; nothing when p flattens space.
std::optional<Placement> inverse(const Placement& p) {
  const double determinant = p.linear.determinant();
  if (determinant == 0 || !std::isfinite(1 / determinant)) return std::nullopt;
  const Vec3d &a = p.linear.row[0], &b = p.linear.row[1], &c = p.linear.row[2];
  const std::array<Vec3d, 3> columns{cross(b, c), cross(c, a), cross(a, b)};
  Placement result;
  for (int row = 0; row < 3; ++row)
    for (int k = 0; k < 3; ++k)
      result.linear.row[static_cast<std::size_t>(row)][k] =
          columns[static_cast<std::size_t>(k)][row] / determinant;
  result.translation = -(result.linear * p.translation);
  return result;
}

std::uint64_t index_count(const geometry::Polylines& lines) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i + 1 < lines.first.size(); ++i)
    if (lines.first[i + 1] > lines.first[i])
      count += 2ULL * (lines.first[i + 1] - lines.first[i] - 1);
  return count;
}

class GlbPlanner {
 public:
  GlbPlanner(const model::Model& model, const WriteOptions& options)
      : model_(model), shapes_(model, options.sag_mm) {
    plan_.frame =
        options.millimetres_z_up ? SourceFrame{1.0, UpAxis::z} : SourceFrame{1000.0, UpAxis::y};
  }
  Result<GlbPlan> plan();

 private:
  Status object(const model::Object& object);
  Status body(const model::Object& object, const model::Body& body,
              const std::optional<Placement>& to_mesh, std::vector<MeshPrimitive>& mesh);
  Result<std::uint32_t> piece(const TessellatedShape& shape, const Placement& relative,
                              double sag_mm);
  void state_sags();
  std::uint32_t material(const model::Color& color);

  const model::Model& model_;
  TessellationCache shapes_;
  GlbPlan plan_;
  std::map<std::pair<const void*, PlacementKey>, std::uint32_t> pieces_;
  std::map<std::vector<MeshPrimitive>, std::uint32_t> meshes_;
  std::map<std::array<std::uint8_t, 4>, std::uint32_t> materials_;
};

std::uint32_t GlbPlanner::material(const model::Color& color) {
  const auto [place, is_new] =
      materials_.try_emplace({color.red, color.green, color.blue, color.alpha},
                             static_cast<std::uint32_t>(plan_.materials.size()));
  if (is_new) plan_.materials.push_back(color);
  return place->second;
}

Result<std::uint32_t> GlbPlanner::piece(const TessellatedShape& shape, const Placement& relative,
                                        double sag_mm) {
  const void* const source = shape.mesh != nullptr ? static_cast<const void*>(shape.mesh)
                                                   : static_cast<const void*>(shape.lines);
  const auto next = static_cast<std::uint32_t>(plan_.pieces.size());
  const auto [place, is_new] = pieces_.try_emplace({source, key_of(relative)}, next);
  if (!is_new) return place->second;
  StoredGeometry piece;
  piece.mesh = shape.mesh;
  piece.lines = shape.lines;
  piece.relative = relative;
  piece.sag_mm = relative.linear == geometry::Mat3d{}
                     ? sag_mm
                     : sag_mm * geometry::largest_scale(relative.linear);
  piece.vertex_count = piece.vertices().size();
  piece.index_count =
      piece.mesh != nullptr ? 3 * piece.mesh->triangles.size() : index_count(*piece.lines);
  if (const Status measured = plan_.measure(piece); !measured) return measured.error();
  plan_.append(piece);
  return next;
}

Status GlbPlanner::body(const model::Object& object, const model::Body& body,
                        const std::optional<Placement>& to_mesh, std::vector<MeshPrimitive>& mesh) {
  const TessellatedShape shape = shapes_.place(body);
  if (!is_finite(shape.placement))
    return Error{ErrorCode::output, "a placement is not finite", object.id, "mend the model"};
  const bool has_content = (shape.mesh != nullptr && !shape.mesh->triangles.empty()) ||
                           (shape.lines != nullptr && index_count(*shape.lines) != 0);
  if (!has_content) return {};
  const Placement relative = to_mesh ? *to_mesh * shape.placement : Placement{};
  const auto* const mesh_of_model =
      std::get_if<geometry::TriangleMesh>(&model_.shapes[model::index(body.shape)]);
  const Result<std::uint32_t> made =
      piece(shape, relative, mesh_of_model != nullptr ? mesh_of_model->sag_mm : -1);
  if (!made) {
    Error error = made.error();
    error.where = object.id;
    return error;
  }
  mesh.push_back({*made, material(body.color)});
  return {};
}

Status GlbPlanner::object(const model::Object& object) {
  GlbPlan::ObjectNode node;
  std::vector<MeshPrimitive> mesh;
  std::optional<Placement> first;
  for (std::uint32_t i = 0; i < object.body_count; ++i) {
    const model::Body& part = model_.bodies[object.first_body + i];
    const Placement placement = shapes_.place(part).placement;
    if (!first) {
      first = placement;
      node.placement = placement;
    }
    const bool same = key_of(placement) == key_of(node.placement);
    std::optional<Placement> to_mesh;
    if (!same) {
      to_mesh = inverse(node.placement);
      if (!to_mesh)
        return Error{ErrorCode::output,
                     "its first body is placed flat, so the others cannot be "
                     "written in its frame",
                     object.id, "mend the placement"};
    }
    if (const Status added = body(object, part, to_mesh, mesh); !added) return added.error();
  }
  if (!mesh.empty()) {
    const auto next = static_cast<std::uint32_t>(plan_.meshes.size());
    const auto [place, is_new] = meshes_.try_emplace(mesh, next);
    if (is_new) plan_.meshes.push_back(std::move(mesh));
    node.mesh = place->second;
  }
  plan_.objects.push_back(node);
  return {};
}

/// Has each mesh say how far its triangles lie from the true surface, where all of them say so.
void GlbPlanner::state_sags() {
  plan_.mesh_extras.resize(plan_.meshes.size());
  for (std::size_t m = 0; m < plan_.meshes.size(); ++m) {
    std::optional<double> largest;
    for (const MeshPrimitive& primitive : plan_.meshes[m]) {
      const StoredGeometry& piece = plan_.pieces[primitive.piece];
      if (piece.mesh == nullptr) continue;
      if (!(piece.sag_mm >= 0 && std::isfinite(piece.sag_mm))) {
        largest.reset();
        break;
      }
      largest = std::max(largest.value_or(0), piece.sag_mm);
    }
    if (largest) plan_.mesh_extras[m] = fmt::format(R"({{"sag_mm":{}}})", *largest);
  }
}

Result<GlbPlan> GlbPlanner::plan() {
  for (const model::Object& one : model_.objects)
    if (const Status planned = object(one); !planned) return planned.error();
  state_sags();
  shapes_.release(plan_.made, plan_.made_lines);
  return std::move(plan_);
}

}  // namespace

Status GlbPlan::measure(StoredGeometry& piece) const {
  const auto& vertices = piece.vertices();
  bool first = true;
  for (const Vec3d& vertex : vertices) {
    const std::array<float, 3> v = written(piece, vertex);
    for (std::size_t k = 0; k < 3; ++k) {
      if (!std::isfinite(v[k]))
        return Error{ErrorCode::output, "a coordinate is not finite or too large for float32", "",
                     "mend the model"};
      piece.lo[k] = first ? v[k] : std::min(piece.lo[k], v[k]);
      piece.hi[k] = first ? v[k] : std::max(piece.hi[k], v[k]);
    }
    first = false;
  }
  return {};
}

void GlbPlan::append(StoredGeometry piece) {
  constexpr std::uint64_t kNarrowVertices = 65535;  // index 65535 itself is reserved
  piece.wide = piece.vertex_count > kNarrowVertices;
  std::uint64_t& used = piece.wide ? wide_count : narrow_count;
  piece.first_vertex = vertex_count;
  piece.first_index = used;
  vertex_count += piece.vertex_count;
  used += piece.index_count;
  pieces.push_back(piece);
}

std::array<float, 3> GlbPlan::written(const StoredGeometry& piece, const Vec3d& v) const {
  const Vec3d turned = frame.turn_back(piece.relative * v);
  return {static_cast<float>(turned.x / frame.unit_mm),
          static_cast<float>(turned.y / frame.unit_mm),
          static_cast<float>(turned.z / frame.unit_mm)};
}

Result<GlbPlan> plan_glb(const model::Model& model, const WriteOptions& options) {
  return GlbPlanner(model, options).plan();
}

}  // namespace strake::io::gltf
