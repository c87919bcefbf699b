// SPDX-License-Identifier: Apache-2.0
#include "io/obj/object_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

#include "core/seeded_hash.hpp"
#include "io/mesh/mesh_building.hpp"
#include "io/mesh/transparent_shells.hpp"
#include "io/source/precision.hpp"
#include "io/source/text_decoder.hpp"

namespace strake::io::obj {
namespace {

constexpr std::uint32_t kNoEntry = 0xffffffffU;

class Assembler {
 public:
  void chunk(std::uint32_t number, const ObjChunk& chunk);
  ObjAssembly take() { return std::move(result_); }

 private:
  void apply(const Statement& statement);
  void segment(GeometryRun run);
  std::uint32_t entry();
  std::uint32_t material_index(const std::string& name);

  ObjAssembly result_;
  std::unordered_map<std::string, std::uint32_t, SeededHash>
      groups_;  ///< entry of each g under this o
  std::unordered_map<std::string, std::uint32_t, SeededHash> materials_;  ///< index of each name
  std::string object_name_, group_name_;
  std::uint32_t object_ = 0;
  std::uint32_t entry_ = kNoEntry;  ///< made with the first face, so that empty groups are none
  std::uint32_t material_ = kNoMaterial;
};

std::uint32_t Assembler::material_index(const std::string& name) {
  const auto next = static_cast<std::uint32_t>(result_.material_names.size());
  const auto [place, is_new] = materials_.try_emplace(name, next);
  if (is_new) result_.material_names.push_back(name);
  return place->second;
}

void Assembler::apply(const Statement& statement) {
  switch (statement.kind) {
    case StatementKind::object:
      object_name_ = TextDecoder()(statement.text);
      group_name_.clear();
      groups_.clear();
      ++object_;
      entry_ = kNoEntry;
      break;
    case StatementKind::group:
      group_name_ = TextDecoder()(statement.text);
      entry_ = kNoEntry;
      break;
    case StatementKind::material:
      material_ = material_index(statement.text);
      break;
    case StatementKind::library:
      result_.libraries.push_back(statement.text);
      break;
    case StatementKind::unread:
      result_.entries[entry()].incomplete = true;
      break;
  }
}

std::uint32_t Assembler::entry() {
  if (entry_ != kNoEntry) return entry_;
  const auto next = static_cast<std::uint32_t>(result_.entries.size());
  const auto [place, is_new] = groups_.try_emplace(group_name_, next);
  if (is_new) result_.entries.push_back({object_name_, group_name_, object_, {}, false});
  return entry_ = place->second;
}

void Assembler::segment(GeometryRun run) {
  if (run.face_begin == run.face_end && run.polyline_begin == run.polyline_end) return;
  run.material = material_;
  result_.entries[entry()].segments.push_back(run);
}

void Assembler::chunk(std::uint32_t number, const ObjChunk& chunk) {
  std::uint32_t face = 0, polyline = 0;
  for (const Statement& statement : chunk.statements) {
    segment({number, face, statement.face, polyline, statement.polyline, kNoMaterial});
    face = statement.face;
    polyline = statement.polyline;
    apply(statement);
  }
  segment({number, face, chunk.faces.size(), polyline, chunk.polylines.size(), kNoMaterial});
}

}  // namespace

ObjAssembly assemble(const std::vector<ObjChunk>& chunks) {
  Assembler assembler;
  std::vector<std::uint64_t> vertex_base{0}, line_base{0};
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    assembler.chunk(static_cast<std::uint32_t>(i), chunks[i]);
    vertex_base.push_back(vertex_base.back() + chunks[i].vertices.size());
    line_base.push_back(line_base.back() + chunks[i].lines);
  }
  ObjAssembly result = assembler.take();
  result.vertex_base = std::move(vertex_base);
  result.line_base = std::move(line_base);
  return result;
}

namespace {

using geometry::Vec3d;

/// The rows of an entry that go into one shape, with vertices as absolute indices of the file.
struct FlatFaces {
  std::vector<std::uint32_t> corners;
  std::vector<std::size_t> end;
  std::map<std::uint32_t, std::size_t> rows_by_material;
};

class ObjectBuilder {
 public:
  ObjectBuilder(const BuildInput& input, const ObjElement& entry) : input_(input), entry_(entry) {}
  BuiltObject build();

 private:
  void flatten(const GeometryRun& segment, bool faces, FlatFaces& flat);
  bool row(const GeometryRun& segment, const CornerRows& rows, std::uint32_t row, FlatFaces& flat);
  bool corner(const GeometryRun& segment, const VertexReference& corner, std::uint32_t line,
              FlatFaces& flat);
  void damaged(const GeometryRun& segment, std::uint32_t line, std::string message);
  [[nodiscard]] model::Color color(std::uint32_t material) const;
  [[nodiscard]] model::Color main_color(const FlatFaces& flat) const;
  std::vector<Vec3d> take(std::span<const std::uint32_t> vertices);
  geometry::TriangleMesh mesh(FlatFaces flat);
  geometry::Polylines polylines(const FlatFaces& flat);

  const BuildInput& input_;
  const ObjElement& entry_;
  BuiltObject result_;
};

model::Color ObjectBuilder::color(std::uint32_t material) const {
  return material == kNoMaterial ? model::Color{} : input_.colors[material];
}

model::Color ObjectBuilder::main_color(const FlatFaces& flat) const {
  std::uint32_t largest = kNoMaterial;
  std::size_t rows = 0;
  for (const auto& [material, count] : flat.rows_by_material)
    if (count > rows) {
      largest = material;
      rows = count;
    }
  return color(largest);
}

void ObjectBuilder::damaged(const GeometryRun& segment, std::uint32_t line, std::string message) {
  const std::uint64_t number = input_.assembly->line_base[segment.chunk] + line + 1;
  if (!result_.damage) result_.damage = BuiltObject::Damage{std::move(message), number};
}

bool ObjectBuilder::corner(const GeometryRun& segment, const VertexReference& corner,
                           std::uint32_t line, FlatFaces& flat) {
  const auto base = static_cast<std::int64_t>(input_.assembly->vertex_base[segment.chunk]);
  const std::int64_t vertex = corner.vertex + (corner.chunk_relative ? base : 0);
  if (vertex < 0 || vertex >= static_cast<std::int64_t>(input_.vertices.size())) {
    damaged(segment, line,
            corner.chunk_relative
                ? fmt::format("refers back to vertex {}, before the first", vertex + 1)
                : fmt::format("refers to vertex {}, but the file has {}", vertex + 1,
                              input_.vertices.size()));
    return false;
  }
  const auto index = static_cast<std::uint32_t>(vertex);
  if (!std::isfinite(input_.vertices[index].x)) {
    damaged(segment, line, fmt::format("uses vertex {}, which has no readable place", vertex + 1));
    return false;
  }
  flat.corners.push_back(index);
  return true;
}

/// Appends the corners of a row; returns false when one of them has no position.
bool ObjectBuilder::row(const GeometryRun& segment, const CornerRows& rows, std::uint32_t row,
                        FlatFaces& flat) {
  if (rows.begin_of(row) == rows.end[row]) {
    damaged(segment, rows.line[row], "has a corner that is no vertex index");
    return false;
  }
  for (std::uint32_t i = rows.begin_of(row); i != rows.end[row]; ++i)
    if (!corner(segment, rows.corners[i], rows.line[row], flat)) return false;
  return true;
}

void ObjectBuilder::flatten(const GeometryRun& segment, bool faces, FlatFaces& flat) {
  const ObjChunk& chunk = input_.chunks[segment.chunk];
  const CornerRows& rows = faces ? chunk.faces : chunk.polylines;
  const std::uint32_t begin = faces ? segment.face_begin : segment.polyline_begin;
  const std::uint32_t end = faces ? segment.face_end : segment.polyline_end;
  const std::size_t before = flat.end.size();
  for (std::uint32_t r = begin; r != end; ++r) {
    const std::size_t corners = flat.corners.size();
    if (row(segment, rows, r, flat))
      flat.end.push_back(flat.corners.size());
    else
      flat.corners.resize(corners);
  }
  const std::size_t good = flat.end.size() - before;
  if (good != 0) flat.rows_by_material[segment.material] += good;
  (faces ? result_.bad_faces : result_.bad_lines) += end - begin - good;
}

/// Returns vertices of the file for the object, and records how large they are and how finely
/// written.
std::vector<Vec3d> ObjectBuilder::take(std::span<const std::uint32_t> vertices) {
  std::vector<Vec3d> taken;
  for (const std::uint32_t vertex : vertices) {
    taken.push_back(input_.vertices[vertex]);
    result_.digits.merge(input_.digits[vertex]);
  }
  result_.largest_mm = std::max(result_.largest_mm, largest_coordinate(taken));
  return taken;
}

geometry::TriangleMesh ObjectBuilder::mesh(FlatFaces flat) {
  geometry::TriangleMesh mesh;
  mesh.vertices = take(renumber_indices(flat.corners));
  mesh.triangles.reserve(flat.corners.size() - 2 * flat.end.size());
  const bool polygons = flat.corners.size() != 3 * flat.end.size();
  std::size_t begin = 0;
  for (std::size_t face = 0; face < flat.end.size(); ++face) {
    const std::span corners = std::span(flat.corners).subspan(begin, flat.end[face] - begin);
    if (!append_polygon(mesh, corners)) ++result_.crossing_faces;
    if (polygons) mesh.faces.resize(mesh.triangles.size(), static_cast<std::uint32_t>(face));
    begin = flat.end[face];
  }
  return mesh;
}

geometry::Polylines ObjectBuilder::polylines(const FlatFaces& flat) {
  geometry::Polylines lines;
  lines.points = take(flat.corners);
  for (const std::size_t end : flat.end) lines.first.push_back(static_cast<std::uint32_t>(end));
  return lines;
}

BuiltObject ObjectBuilder::build() {
  FlatFaces opaque, transparent, lines;
  for (const GeometryRun& segment : entry_.segments) {
    FlatFaces& faces = color(segment.material).alpha == 255 ? opaque : transparent;
    flatten(segment, true, faces);
    flatten(segment, false, lines);
  }
  result_.opaque_color = main_color(opaque);
  result_.transparent_color = main_color(transparent);
  result_.line_color = main_color(lines);
  if (!opaque.end.empty()) result_.opaque = mesh(std::move(opaque));
  if (!transparent.end.empty()) result_.transparent = mesh(std::move(transparent));
  result_.part_transparent = merge_transparent_shells(result_.opaque, result_.transparent);
  if (!lines.end.empty()) result_.lines = polylines(lines);
  return std::move(result_);
}

}  // namespace

BuiltObject build_object(const BuildInput& input, const ObjElement& entry) {
  return ObjectBuilder(input, entry).build();
}

}  // namespace strake::io::obj
