// SPDX-License-Identifier: Apache-2.0
#include "io/obj/builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "io/compact.hpp"
#include "io/face_triangles.hpp"
#include "io/precision.hpp"
#include "io/whole_solids.hpp"

namespace strake::io::obj {
namespace {

using geometry::Vec3d;

/// The rows of an entry that go into one shape, with vertices as absolute indices of the file.
struct Flat {
  std::vector<std::uint32_t> corners;
  std::vector<std::size_t> end;
  std::map<std::uint32_t, std::size_t> rows_by_material;
};

class Builder {
 public:
  Builder(const BuildInput& input, const Entry& entry) : input_(input), entry_(entry) {}
  BuiltObject build();

 private:
  void flatten(const Segment& segment, bool faces, Flat& flat);
  bool row(const Segment& segment, const Rows& rows, std::uint32_t row, Flat& flat);
  bool corner(const Segment& segment, const Corner& corner, std::uint32_t line, Flat& flat);
  void damaged(const Segment& segment, std::uint32_t line, std::string message);
  [[nodiscard]] model::Color color(std::uint32_t material) const;
  [[nodiscard]] model::Color main_color(const Flat& flat) const;
  std::vector<Vec3d> take(std::span<const std::uint32_t> vertices);
  geometry::TriangleMesh mesh(Flat flat);
  geometry::Polylines polylines(const Flat& flat);

  const BuildInput& input_;
  const Entry& entry_;
  BuiltObject result_;
};

model::Color Builder::color(std::uint32_t material) const {
  return material == kNoMaterial ? model::Color{} : input_.colors[material];
}

model::Color Builder::main_color(const Flat& flat) const {
  std::uint32_t most = kNoMaterial;
  std::size_t rows = 0;
  for (const auto& [material, count] : flat.rows_by_material)
    if (count > rows) {
      most = material;
      rows = count;
    }
  return color(most);
}

void Builder::damaged(const Segment& segment, std::uint32_t line, std::string message) {
  const std::uint64_t number = input_.assembly->line_base[segment.chunk] + line + 1;
  if (!result_.damage) result_.damage = BuiltObject::Damage{std::move(message), number};
}

bool Builder::corner(const Segment& segment, const Corner& corner, std::uint32_t line, Flat& flat) {
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

/// Appends the corners of a row; false when one of them has no place.
bool Builder::row(const Segment& segment, const Rows& rows, std::uint32_t row, Flat& flat) {
  if (rows.begin_of(row) == rows.end[row]) {
    damaged(segment, rows.line[row], "has a corner that is no vertex index");
    return false;
  }
  for (std::uint32_t i = rows.begin_of(row); i != rows.end[row]; ++i)
    if (!corner(segment, rows.corners[i], rows.line[row], flat)) return false;
  return true;
}

void Builder::flatten(const Segment& segment, bool faces, Flat& flat) {
  const Chunk& chunk = input_.chunks[segment.chunk];
  const Rows& rows = faces ? chunk.faces : chunk.polylines;
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

/// Vertices of the file for the object, which learns how large they are and how finely written.
std::vector<Vec3d> Builder::take(std::span<const std::uint32_t> vertices) {
  std::vector<Vec3d> taken;
  for (const std::uint32_t vertex : vertices) {
    taken.push_back(input_.vertices[vertex]);
    result_.digits.merge(input_.digits[vertex]);
  }
  result_.largest_mm = std::max(result_.largest_mm, largest_coordinate(taken));
  return taken;
}

geometry::TriangleMesh Builder::mesh(Flat flat) {
  geometry::TriangleMesh mesh;
  mesh.vertices = take(compact_indices(flat.corners));
  mesh.triangles.reserve(flat.corners.size() - 2 * flat.end.size());
  const bool polygons = flat.corners.size() != 3 * flat.end.size();
  std::size_t begin = 0;
  for (std::size_t face = 0; face < flat.end.size(); ++face) {
    const std::span corners = std::span(flat.corners).subspan(begin, flat.end[face] - begin);
    if (!append_face(mesh, corners)) ++result_.crossing_faces;
    if (polygons) mesh.faces.resize(mesh.triangles.size(), static_cast<std::uint32_t>(face));
    begin = flat.end[face];
  }
  return mesh;
}

geometry::Polylines Builder::polylines(const Flat& flat) {
  geometry::Polylines lines;
  lines.points = take(flat.corners);
  for (const std::size_t end : flat.end) lines.first.push_back(static_cast<std::uint32_t>(end));
  return lines;
}

BuiltObject Builder::build() {
  Flat opaque, transparent, lines;
  for (const Segment& segment : entry_.segments) {
    Flat& faces = color(segment.material).alpha == 255 ? opaque : transparent;
    flatten(segment, true, faces);
    flatten(segment, false, lines);
  }
  result_.opaque_color = main_color(opaque);
  result_.transparent_color = main_color(transparent);
  result_.line_color = main_color(lines);
  if (!opaque.end.empty()) result_.opaque = mesh(std::move(opaque));
  if (!transparent.end.empty()) result_.transparent = mesh(std::move(transparent));
  result_.part_transparent = keep_solids_whole(result_.opaque, result_.transparent);
  if (!lines.end.empty()) result_.lines = polylines(lines);
  return std::move(result_);
}

}  // namespace

BuiltObject build_object(const BuildInput& input, const Entry& entry) {
  return Builder(input, entry).build();
}

}  // namespace strake::io::obj
