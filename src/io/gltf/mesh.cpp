// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "io/compact.hpp"
#include "io/gltf/srgb.hpp"
#include "io/whole_solids.hpp"

namespace strake::io::gltf {
namespace {

using geometry::Vec3d;

enum class Mode { points, lines, line_loop, line_strip, triangles, triangle_strip, triangle_fan };

/// How many triangles or segments of which colour went into a shape.
using Tally = std::map<std::array<std::uint8_t, 4>, std::size_t>;

model::Color main_color(const Tally& tally) {
  model::Color color;
  std::size_t most = 0;
  for (const auto& [key, count] : tally)
    if (count > most) {
      color = {key[0], key[1], key[2], key[3]};
      most = count;
    }
  return color;
}

class MeshLoader {
 public:
  MeshLoader(const MeshInput& input, std::string pointer)
      : input_(input), pointer_(std::move(pointer)) {}
  LoadedMesh load(const Json& mesh);

 private:
  bool primitive(const Json& json, const std::string& pointer);
  bool corners(const Json& json, std::uint64_t vertices, const std::string& pointer,
               std::vector<std::uint32_t>& out);
  bool vertices(const Accessor& positions, std::vector<std::uint32_t>& indices,
                std::vector<Vec3d>& out);
  void triangles(Mode mode, const std::vector<std::uint32_t>& indices,
                 const std::vector<Vec3d>& points, const model::Color& color);
  void chains(Mode mode, const std::vector<std::uint32_t>& indices,
              const std::vector<Vec3d>& points);
  [[nodiscard]] model::Color color_of(const Json& json) const;
  bool fail(Fault fault) {
    result_.fault = std::move(fault);
    return false;
  }

  const MeshInput& input_;
  std::string pointer_;
  LoadedMesh result_;
  Tally opaque_, transparent_, lines_;
};

model::Color MeshLoader::color_of(const Json& json) const {
  const std::optional<std::uint64_t> material = json["material"].index();
  if (!material || *material >= input_.materials->size()) return {};
  return (*input_.materials)[*material];
}

/// The vertices of the primitive's corners in their order.
bool MeshLoader::corners(const Json& json, std::uint64_t vertices, const std::string& pointer,
                         std::vector<std::uint32_t>& out) {
  const Json indices_json = json["indices"];
  if (!indices_json.exists()) {
    out.resize(vertices);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<std::uint32_t>(i);
    return true;
  }
  const Checked<Accessor> opened =
      input_.accessors->open(indices_json.index().value_or(UINT64_MAX));
  if (const Fault* fault = fault_of(opened)) return fail(*fault);
  const auto& indices = std::get<Accessor>(opened);
  const bool whole = indices.component == Component::uint8 ||
                     indices.component == Component::uint16 ||
                     indices.component == Component::uint32;
  if (!whole || indices.width != 1)
    return fail({indices.pointer, "indices must be unsigned integers"});
  out.resize(indices.count);
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = indices.integer(i);
    if (out[i] >= vertices)
      return fail({pointer + "/indices",
                   fmt::format("index {} is {}, but there are {} vertices", i, out[i], vertices)});
  }
  return true;
}

bool MeshLoader::vertices(const Accessor& positions, std::vector<std::uint32_t>& indices,
                          std::vector<Vec3d>& out) {
  const std::vector<std::uint32_t> used = compact_indices(indices);
  out.reserve(used.size());
  for (const std::uint32_t vertex : used) {
    std::array<double, 4> xyz{};
    positions.element(vertex, xyz.data());
    if (!std::isfinite(xyz[0]) || !std::isfinite(xyz[1]) || !std::isfinite(xyz[2]))
      return fail({positions.pointer, fmt::format("vertex {} is not finite", vertex)});
    out.push_back(input_.frame.point({xyz[0], xyz[1], xyz[2]}));
  }
  return true;
}

void MeshLoader::triangles(Mode mode, const std::vector<std::uint32_t>& indices,
                           const std::vector<Vec3d>& points, const model::Color& color) {
  geometry::TriangleMesh& mesh = color.alpha == 255 ? result_.opaque : result_.transparent;
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  const std::size_t before = mesh.triangles.size();
  mesh.vertices.insert(mesh.vertices.end(), points.begin(), points.end());
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    mesh.triangles.push_back({base + indices[a], base + indices[b], base + indices[c]});
  };
  const std::size_t n = indices.size();
  if (mode == Mode::triangles)
    for (std::size_t i = 0; i + 2 < n; i += 3) add(i, i + 1, i + 2);
  if (mode == Mode::triangle_strip)
    for (std::size_t i = 0; i + 2 < n; ++i) add(i, i + 1 + i % 2, i + 2 - i % 2);
  if (mode == Mode::triangle_fan)
    for (std::size_t i = 1; i + 1 < n; ++i) add(i, i + 1, 0);
  Tally& tally = color.alpha == 255 ? opaque_ : transparent_;
  tally[{color.red, color.green, color.blue, color.alpha}] += mesh.triangles.size() - before;
}

void MeshLoader::chains(Mode mode, const std::vector<std::uint32_t>& indices,
                        const std::vector<Vec3d>& points) {
  geometry::Polylines& lines = result_.lines;
  const auto end_chain = [&] {
    const auto end = static_cast<std::uint32_t>(lines.points.size());
    if (end != lines.first.back()) lines.first.push_back(end);
  };
  if (indices.size() < 2) return;
  if (mode == Mode::lines) {
    // Segments that go on where the last one ended are one chain.
    for (std::size_t i = 0; i + 1 < indices.size(); i += 2) {
      if (i == 0 || indices[i] != indices[i - 1]) {
        end_chain();
        lines.points.push_back(points[indices[i]]);
      }
      lines.points.push_back(points[indices[i + 1]]);
    }
  } else {
    for (const std::uint32_t index : indices) lines.points.push_back(points[index]);
    if (mode == Mode::line_loop) lines.points.push_back(points[indices.front()]);
  }
  end_chain();
}

bool MeshLoader::primitive(const Json& json, const std::string& pointer) {
  const Json mode_json = json["mode"];
  const std::optional<std::uint64_t> mode_index =
      mode_json.exists() ? mode_json.index() : std::optional<std::uint64_t>(4);
  if (!mode_index || *mode_index > 6) return fail({pointer + "/mode", "is none of 0 to 6"});
  const auto mode = static_cast<Mode>(*mode_index);
  if (mode == Mode::points) {
    ++result_.points;
    return true;
  }
  const Json position = json["attributes"]["POSITION"];
  if (!position.exists()) return fail({pointer, "has no POSITION"});
  // A packed primitive may come with plain data as well; without, its accessor would read as zeros.
  if (json["extensions"]["KHR_draco_mesh_compression"].exists() &&
      !input_.accessors->has_data(position.index().value_or(UINT64_MAX)))
    return fail({pointer, "is packed by KHR_draco_mesh_compression, which is not read"});
  const Checked<Accessor> opened = input_.accessors->open(position.index().value_or(UINT64_MAX));
  if (const Fault* fault = fault_of(opened)) return fail(*fault);
  const auto& positions = std::get<Accessor>(opened);
  if (positions.width != 3) return fail({positions.pointer, "positions must be VEC3"});
  if (positions.count > std::numeric_limits<std::uint32_t>::max())
    return fail({positions.pointer, "has too many vertices"});

  std::vector<std::uint32_t> indices;
  std::vector<Vec3d> points;
  if (!corners(json, positions.count, pointer, indices)) return false;
  if (!vertices(positions, indices, points)) return false;
  result_.step = std::max(result_.step, positions.step());
  const model::Color color = color_of(json);
  if (mode == Mode::lines || mode == Mode::line_loop || mode == Mode::line_strip) {
    if (mode == Mode::lines && indices.size() % 2 != 0) ++result_.odd;
    chains(mode, indices, points);
    lines_[{color.red, color.green, color.blue, color.alpha}] += indices.size();
  } else {
    if (mode == Mode::triangles && indices.size() % 3 != 0) ++result_.odd;
    triangles(mode, indices, points, color);
  }
  return true;
}

LoadedMesh MeshLoader::load(const Json& mesh) {
  std::size_t index = 0;
  bool good = true;
  mesh["primitives"].elements([&](const Json& json) {
    if (good) good = primitive(json, fmt::format("{}/primitives/{}", pointer_, index++));
  });
  if (!good) {
    LoadedMesh broken;
    broken.fault = std::move(result_.fault);
    return broken;
  }
  result_.part_transparent = keep_solids_whole(result_.opaque, result_.transparent);
  result_.opaque_color = main_color(opaque_);
  result_.transparent_color = main_color(transparent_);
  result_.line_color = main_color(lines_);
  return std::move(result_);
}

std::uint8_t to_byte(double share) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0, 1.0) * 255));
}

model::Color color_of_material(const Json& material) {
  std::array<double, 4> factor{1, 1, 1, 1};
  const Json glossiness =
      material["extensions"]["KHR_materials_pbrSpecularGlossiness"]["diffuseFactor"];
  if (!material["pbrMetallicRoughness"]["baseColorFactor"].numbers(factor.data(), 4) &&
      !glossiness.numbers(factor.data(), 4))
    factor = {1, 1, 1, 1};
  model::Color color{srgb_of_linear(factor[0]), srgb_of_linear(factor[1]),
                     srgb_of_linear(factor[2]), 255};
  // Alpha means nothing unless the material is to be blended.
  if (material["alphaMode"].raw() == "BLEND") color.alpha = to_byte(factor[3]);
  return color;
}

}  // namespace

LoadedMesh load_mesh(const MeshInput& input, const Json& mesh, std::size_t index) {
  return MeshLoader(input, fmt::format("/meshes/{}", index)).load(mesh);
}

std::uint64_t stated_corners(const Accessors& accessors, const Json& mesh) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 60U;  // sums of these must not wrap
  std::uint64_t sum = 0;
  mesh["primitives"].elements([&](const Json& json) {
    const Json indices = json["indices"], position = json["attributes"]["POSITION"];
    const std::uint64_t vertices = position.index().value_or(UINT64_MAX);
    const std::uint64_t counted =
        indices.exists() ? indices.index().value_or(UINT64_MAX) : vertices;
    sum = std::min(sum + accessors.stated_count(counted), kMost);
    if (indices.exists()) sum = std::min(sum + accessors.copied_count(vertices), kMost);
  });
  return sum;
}

std::vector<model::Color> material_colors(const Json& root) {
  std::vector<model::Color> colors;
  root["materials"].elements(
      [&](const Json& material) { colors.push_back(color_of_material(material)); });
  return colors;
}

}  // namespace strake::io::gltf
