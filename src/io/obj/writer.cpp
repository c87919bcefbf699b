// SPDX-License-Identifier: Apache-2.0
#include "strake/io/writer.hpp"

#include <fmt/format.h>

#include <iterator>
#include <string>

#include "io/mesh/tessellated_shapes.hpp"
#include "strake/core/atomic_file.hpp"

namespace strake::io {
namespace {

/// Returns a name on one line: control characters would end it or hide in it.
std::string one_line(std::string_view name) {
  std::string line(name);
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  if (!line.empty() && line.back() == '\\') line.push_back(' ');  // would continue the line
  return line;
}

class ObjText {
 public:
  ObjText(const model::Model& model, double sag_mm) : model_(model), shapes_(model, sag_mm) {}

  /// Writes the text of one object; returns false when a coordinate is not finite.
  [[nodiscard]] bool object(const model::Object& object, std::string& out);

 private:
  bool vertices(const std::vector<geometry::Vec3d>& points, const geometry::Placement& placement,
                std::string& out);
  void faces(const geometry::TriangleMesh& mesh, bool mirrored, std::string& out) const;
  void chains(const geometry::Polylines& lines, std::string& out) const;

  const model::Model& model_;
  TessellationCache shapes_;
  std::uint64_t written_ = 0;  ///< vertices of the whole file before those of the current body
};

bool ObjText::vertices(const std::vector<geometry::Vec3d>& points,
                       const geometry::Placement& placement, std::string& out) {
  for (const geometry::Vec3d& point : points) {
    const geometry::Vec3d v = placement * point;
    if (!geometry::is_finite(v)) return false;
    fmt::format_to(std::back_inserter(out), "v {} {} {}\n", v.x, v.y, v.z);
  }
  return true;
}

void ObjText::faces(const geometry::TriangleMesh& mesh, bool mirrored, std::string& out) const {
  const std::uint64_t base = written_ + 1;
  for (const geometry::Triangle& t : mesh.triangles)
    fmt::format_to(std::back_inserter(out), "f {} {} {}\n", base + t[0],
                   base + (mirrored ? t[2] : t[1]), base + (mirrored ? t[1] : t[2]));
}

void ObjText::chains(const geometry::Polylines& lines, std::string& out) const {
  for (std::size_t i = 0; i + 1 < lines.first.size(); ++i) {
    if (lines.first[i + 1] < lines.first[i] + 2) continue;
    out.push_back('l');
    for (std::uint32_t p = lines.first[i]; p < lines.first[i + 1]; ++p)
      fmt::format_to(std::back_inserter(out), " {}", written_ + 1 + p);
    out.push_back('\n');
  }
}

bool ObjText::object(const model::Object& object, std::string& out) {
  fmt::format_to(std::back_inserter(out), "o {}\n", one_line(object.id));
  for (std::uint32_t i = 0; i < object.body_count; ++i) {
    const TessellatedShape shape = shapes_.place(model_.bodies[object.first_body + i]);
    if (shape.mesh != nullptr) {
      if (!vertices(shape.mesh->vertices, shape.placement, out)) return false;
      faces(*shape.mesh, shape.placement.linear.determinant() < 0, out);
      written_ += shape.mesh->vertices.size();
    } else if (shape.lines != nullptr) {
      if (!vertices(shape.lines->points, shape.placement, out)) return false;
      chains(*shape.lines, out);
      written_ += shape.lines->points.size();
    }
  }
  return true;
}

}  // namespace

Status write_obj(const model::Model& model, const std::filesystem::path& path,
                 const WriteOptions& options, const parallel::Context& context) {
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return file.error();
  file->write("# Strake: millimetres, z up\n");
  ObjText text(model, options.sag_mm);
  std::string out;
  for (const model::Object& object : model.objects) {
    if (context.stop.stop_requested())
      return Error{ErrorCode::cancelled, "writing was cancelled", path.string(), ""};
    out.clear();
    if (!text.object(object, out))
      return Error{ErrorCode::output, "a coordinate is not finite", object.id, "mend the model"};
    file->write(out);
  }
  return file->commit();
}

}  // namespace strake::io
