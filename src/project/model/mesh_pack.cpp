// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <utility>
#include <variant>

#include "project/codec/blob.hpp"
#include "project/model/columns.hpp"
#include "project/model/shape_block.hpp"

namespace strake::project {
namespace {

using geometry::Polylines;
using geometry::TriangleMesh;

enum class PackedKind : std::uint8_t { mesh, polylines, gone };

/// The columns of a pack, in the order in which they are stored.
struct PackColumns {
  std::vector<std::uint8_t> kinds;
  std::vector<std::uint32_t> points;    ///< of each shape in use
  std::vector<std::uint32_t> elements;  ///< triangles of a mesh; of polylines entries of `first`
  std::vector<std::uint32_t> faces;     ///< of each mesh
  std::vector<double> sags;             ///< of each mesh
  std::array<std::vector<double>, 3> coordinates;
  std::vector<std::uint32_t> corners, face_numbers, chains;

  void add(const TriangleMesh& mesh) {
    kinds.push_back(static_cast<std::uint8_t>(PackedKind::mesh));
    elements.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
    faces.push_back(static_cast<std::uint32_t>(mesh.faces.size()));
    sags.push_back(mesh.sag_mm);
    add_points(mesh.vertices);
    for (const geometry::Triangle& triangle : mesh.triangles)
      corners.insert(corners.end(), triangle.begin(), triangle.end());
    face_numbers.insert(face_numbers.end(), mesh.faces.begin(), mesh.faces.end());
  }
  void add(const Polylines& lines) {
    kinds.push_back(static_cast<std::uint8_t>(PackedKind::polylines));
    elements.push_back(static_cast<std::uint32_t>(lines.first.size()));
    add_points(lines.points);
    chains.insert(chains.end(), lines.first.begin(), lines.first.end());
  }
  void add_points(std::span<const geometry::Vec3d> all) {
    points.push_back(static_cast<std::uint32_t>(all.size()));
    for (const geometry::Vec3d& point : all)
      for (int k = 0; k < 3; ++k) coordinates[static_cast<std::size_t>(k)].push_back(point[k]);
  }
};

/// Takes shapes out of the columns of a pack.
class PackReader {
 public:
  explicit PackReader(BlobReader& in) : in_(in) {
    columns_.kinds = in.column<std::uint8_t>();
    columns_.points = in.planes<std::uint32_t>();
    columns_.elements = in.planes<std::uint32_t>();
    columns_.faces = in.planes<std::uint32_t>();
    columns_.sags = in.planes<double>();
    for (std::vector<double>& column : columns_.coordinates) {
      column = in.planes<double>();
      if (column.size() != columns_.coordinates[0].size()) in.refuse("coordinates lack");
    }
    columns_.corners = read_steps(in);
    columns_.face_numbers = read_steps(in);
    columns_.chains = read_steps(in);
  }

  std::vector<model::Shape> run() {
    if (in_.failed()) return {};
    std::vector<model::Shape> shapes(columns_.kinds.size());
    for (std::size_t i = 0; i < shapes.size() && !in_.failed(); ++i) {
      const auto kind = static_cast<PackedKind>(columns_.kinds[i]);
      if (kind == PackedKind::mesh) {
        shapes[i] = mesh();
      } else if (kind == PackedKind::polylines) {
        shapes[i] = polylines();
      } else if (kind != PackedKind::gone) {
        in_.refuse("it has shapes of no kind");
      }
      if (!is_sound(shapes[i])) in_.refuse("a shape numbers what is not there");
    }
    const bool all = point_ == columns_.coordinates[0].size() &&
                     corner_ == columns_.corners.size() && face_ == columns_.face_numbers.size() &&
                     chain_ == columns_.chains.size();
    if (!all) in_.refuse("it holds more than its shapes");
    return shapes;
  }

 private:
  /// Returns the next value of a column; 0 behind its end.
  std::uint32_t next(const std::vector<std::uint32_t>& column, std::size_t& at) {
    if (at < column.size()) return column[at++];
    in_.refuse("shapes lack");
    return 0;
  }
  /// Returns so many values of a column from `at` on; none where there are not so many.
  template <class T>
  std::span<const T> take(const std::vector<T>& column, std::size_t& at, std::size_t count) {
    if (count > column.size() - at) {
      in_.refuse("shapes lack");
      return {};
    }
    at += count;
    return std::span(column).subspan(at - count, count);
  }
  std::vector<geometry::Vec3d> points() {
    const std::size_t count = next(columns_.points, shape_);
    const auto& [x, y, z] = columns_.coordinates;
    const std::size_t begin = point_;
    const std::size_t taken = take(x, point_, count).size();
    std::vector<geometry::Vec3d> points(taken);
    for (std::size_t i = 0; i < taken; ++i) points[i] = {x[begin + i], y[begin + i], z[begin + i]};
    return points;
  }
  TriangleMesh mesh() {
    TriangleMesh mesh;
    mesh.vertices = points();
    const std::size_t triangles = next(columns_.elements, element_);
    const std::span<const std::uint32_t> corners = take(columns_.corners, corner_, triangles * 3);
    mesh.triangles.resize(corners.size() / 3);
    for (std::size_t c = 0; c < corners.size(); ++c) mesh.triangles[c / 3][c % 3] = corners[c];
    const std::size_t number = mesh_;
    const std::span<const std::uint32_t> faces =
        take(columns_.face_numbers, face_, next(columns_.faces, mesh_));
    mesh.faces.assign(faces.begin(), faces.end());
    if (number < columns_.sags.size())
      mesh.sag_mm = columns_.sags[number];
    else
      in_.refuse("shapes lack");
    return mesh;
  }
  Polylines polylines() {
    Polylines lines;
    lines.points = points();
    const std::span<const std::uint32_t> first =
        take(columns_.chains, chain_, next(columns_.elements, element_));
    lines.first.assign(first.begin(), first.end());
    return lines;
  }

  BlobReader& in_;
  PackColumns columns_;
  std::size_t shape_ = 0, element_ = 0, mesh_ = 0, point_ = 0, corner_ = 0, face_ = 0, chain_ = 0;
};

template <class T>
std::span<const std::byte> bytes_of_all(const std::vector<T>& values) {
  return std::as_bytes(std::span(values));
}

bool is_sound_mesh(const TriangleMesh& mesh) {
  const std::size_t vertices = mesh.vertices.size();
  return (mesh.faces.empty() || mesh.faces.size() == mesh.triangles.size()) &&
         std::ranges::all_of(mesh.triangles, [&](const geometry::Triangle& t) {
           return t[0] < vertices && t[1] < vertices && t[2] < vertices;
         });
}

}  // namespace

Hash128 shape_hash(const model::Shape& shape) {
  Hasher hasher;
  if (const auto* const mesh = std::get_if<TriangleMesh>(&shape)) {
    hasher.add(std::uint64_t{0}).add(std::bit_cast<std::uint64_t>(mesh->sag_mm));
    hasher.add(bytes_of_all(mesh->vertices));
    hasher.add(bytes_of_all(mesh->triangles)).add(bytes_of_all(mesh->faces));
  } else if (const auto* const lines = std::get_if<Polylines>(&shape)) {
    hasher.add(std::uint64_t{1}).add(bytes_of_all(lines->points)).add(bytes_of_all(lines->first));
  }
  return hasher.value();
}

std::uint64_t shape_bytes(const model::Shape& shape) {
  if (const auto* const mesh = std::get_if<TriangleMesh>(&shape))
    return bytes_of_all(mesh->vertices).size() + bytes_of_all(mesh->triangles).size() +
           bytes_of_all(mesh->faces).size();
  const auto* const lines = std::get_if<Polylines>(&shape);
  return lines == nullptr ? 0
                          : bytes_of_all(lines->points).size() + bytes_of_all(lines->first).size();
}

bool is_sound(const model::Shape& shape) {
  if (const auto* const mesh = std::get_if<TriangleMesh>(&shape)) return is_sound_mesh(*mesh);
  const auto* const lines = std::get_if<Polylines>(&shape);
  return lines == nullptr ||
         (!lines->first.empty() && lines->first.front() == 0 &&
          std::ranges::is_sorted(lines->first) && lines->first.back() == lines->points.size());
}

Result<Blob> pack_meshes(std::span<const model::Shape* const> shapes,
                         std::span<const Hash128> hashes) {
  PackColumns columns;
  for (const model::Shape* const shape : shapes) {
    if (shape == nullptr)
      columns.kinds.push_back(static_cast<std::uint8_t>(PackedKind::gone));
    else if (const auto* const mesh = std::get_if<TriangleMesh>(shape))
      columns.add(*mesh);
    else if (const auto* const lines = std::get_if<Polylines>(shape))
      columns.add(*lines);
  }
  BlobWriter out;
  out.hash(hash_bytes(std::as_bytes(hashes)));
  out.column<std::uint8_t>(columns.kinds);
  out.planes(columns.points);
  out.planes(columns.elements);
  out.planes(columns.faces);
  out.planes(columns.sags);
  for (const std::vector<double>& column : columns.coordinates) out.planes(column);
  write_steps(out, columns.corners);
  write_steps(out, columns.face_numbers);
  write_steps(out, columns.chains);
  return out.finish();
}

Result<std::vector<model::Shape>> unpack_meshes(std::span<const std::byte> blob,
                                                std::span<const Hash128> hashes, std::string what) {
  Result<BlobReader> in = BlobReader::open(blob, std::move(what));
  if (!in) return in.error();
  const Hash128 seal = in->hash();
  std::vector<model::Shape> shapes = PackReader(*in).run();
  if (shapes.size() != hashes.size() || seal != hash_bytes(std::as_bytes(hashes)))
    in->refuse("the hashes beside it are not those of its shapes");
  if (const Status status = in->finish(); !status) return status.error();
  return shapes;
}

}  // namespace strake::project
