// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "io/gltf/srgb.hpp"
#include "io/mesh/mesh_building.hpp"
#include "io/mesh/transparent_shells.hpp"

namespace strake::io::gltf {
namespace {

using geometry::Vec3d;

enum class Mode { points, lines, line_loop, line_strip, triangles, triangle_strip, triangle_fan };

bool is_line(Mode mode) {
  return mode == Mode::lines || mode == Mode::line_loop || mode == Mode::line_strip;
}

/// Returns the corners of a strip, loop or fan one triangle or segment after the other.
std::vector<std::uint32_t> spelled_out(Mode mode, const std::vector<std::uint32_t>& corners) {
  const std::size_t n = corners.size();
  std::vector<std::uint32_t> out;
  if (n < 2) return out;
  out.reserve((is_line(mode) ? 2 : 3) * n);
  const auto add = [&](std::initializer_list<std::size_t> at) {
    for (const std::size_t i : at) out.push_back(corners[i]);
  };
  if (mode == Mode::triangle_strip)
    for (std::size_t i = 0; i + 2 < n; ++i) add({i, i + 1 + i % 2, i + 2 - i % 2});
  if (mode == Mode::triangle_fan)
    for (std::size_t i = 1; i + 1 < n; ++i) add({i, i + 1, 0});
  if (is_line(mode))
    for (std::size_t i = 0; i + 1 < n; ++i) add({i, i + 1});
  if (mode == Mode::line_loop) add({n - 1, 0});
  return out;
}

/// The number of triangles or segments of each colour that went into a shape.
using ColorTally = std::map<std::array<std::uint8_t, 4>, std::size_t>;

model::Color main_color(const ColorTally& tally) {
  model::Color color;
  std::size_t largest = 0;
  for (const auto& [key, count] : tally)
    if (count > largest) {
      color = {key[0], key[1], key[2], key[3]};
      largest = count;
    }
  return color;
}

class MeshLoader {
 public:
  MeshLoader(const MeshInput& input, std::string pointer)
      : input_(input), pointer_(std::move(pointer)) {}
  LoadedMesh load(const JsonValue& mesh);

 private:
  bool primitive(const JsonValue& json, const std::string& pointer);
  bool corners(const JsonValue& json, std::uint64_t vertices, std::vector<std::uint32_t>& out);
  std::vector<Vec3d> vertices(const Accessor& positions, const std::string& pointer,
                              std::size_t corners_each, std::vector<std::uint32_t>& indices);
  std::vector<bool> without_place(const Accessor& positions, const std::string& pointer,
                                  const std::vector<std::uint32_t>& used);
  void triangles(const std::vector<std::uint32_t>& indices, const std::vector<Vec3d>& points,
                 const model::Color& color);
  void chains(const std::vector<std::uint32_t>& indices, const std::vector<Vec3d>& points);
  [[nodiscard]] model::Color color_of(const JsonValue& json) const;
  bool fail(GltfFault fault) {
    result_.fault = std::move(fault);
    return false;
  }

  const MeshInput& input_;
  std::string pointer_;
  LoadedMesh result_;
  ColorTally opaque_, transparent_, lines_;
};

model::Color MeshLoader::color_of(const JsonValue& json) const {
  const std::optional<std::uint64_t> material = json["material"].index();
  if (!material || *material >= input_.materials->size()) return {};
  return (*input_.materials)[*material];
}

/// Reads the vertices of the primitive's corners in their order.
bool MeshLoader::corners(const JsonValue& json, std::uint64_t vertices,
                         std::vector<std::uint32_t>& out) {
  const JsonValue indices_json = json["indices"];
  if (!indices_json.exists()) {
    out.resize(vertices);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<std::uint32_t>(i);
    return true;
  }
  const Checked<Accessor> opened = input_.accessors->open(indices_json);
  if (const GltfFault* fault = fault_of(opened)) return fail(*fault);
  const auto& indices = std::get<Accessor>(opened);
  const bool whole = indices.component == Component::uint8 ||
                     indices.component == Component::uint16 ||
                     indices.component == Component::uint32;
  if (!whole || indices.width != 1)
    return fail({indices.pointer, "indices must be unsigned integers"});
  out.resize(indices.count);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = indices.integer(i);
  return true;
}

/// Returns which of the vertices have no position, or do not exist.
std::vector<bool> MeshLoader::without_place(const Accessor& positions, const std::string& pointer,
                                            const std::vector<std::uint32_t>& used) {
  std::vector<bool> bad(used.size());
  for (std::size_t i = 0; i < used.size(); ++i) {
    const bool exists = used[i] < positions.count;
    std::array<double, 4> xyz{};
    if (exists) positions.element(used[i], xyz.data());
    bad[i] = !exists || !std::ranges::all_of(xyz, [](double x) { return std::isfinite(x); });
    if (!bad[i] || result_.first_left_out) continue;
    result_.first_left_out =
        exists
            ? GltfFault{positions.pointer, fmt::format("vertex {} is not finite", used[i])}
            : GltfFault{pointer + "/indices", fmt::format("there is no vertex {}, only {} of them",
                                                          used[i], positions.count)};
  }
  return bad;
}

/// Returns the vertices in use, which `indices` count from 0 then; they have `corners_each` for
/// each triangle or segment, of which those that need a vertex without a position are removed.
std::vector<Vec3d> MeshLoader::vertices(const Accessor& positions, const std::string& pointer,
                                        std::size_t corners_each,
                                        std::vector<std::uint32_t>& indices) {
  std::vector<std::uint32_t> used = renumber_indices(indices);
  const std::vector<bool> bad = without_place(positions, pointer, used);
  if (std::ranges::find(bad, true) != bad.end()) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < indices.size(); i += corners_each) {
      const std::span corners = std::span(indices).subspan(i, corners_each);
      if (std::ranges::any_of(corners, [&](std::uint32_t c) { return bad[c]; })) continue;
      for (const std::uint32_t c : corners) indices[kept++] = used[c];
    }
    (corners_each == 3 ? result_.faces_left_out : result_.lines_left_out) +=
        (indices.size() - kept) / corners_each;
    indices.resize(kept);
    used = renumber_indices(indices);
  }
  std::vector<Vec3d> points;
  points.reserve(used.size());
  for (const std::uint32_t vertex : used) {
    std::array<double, 4> xyz{};
    positions.element(vertex, xyz.data());
    points.push_back(input_.frame.point({xyz[0], xyz[1], xyz[2]}));
  }
  return points;
}

void MeshLoader::triangles(const std::vector<std::uint32_t>& indices,
                           const std::vector<Vec3d>& points, const model::Color& color) {
  geometry::TriangleMesh& mesh = color.alpha == 255 ? result_.opaque : result_.transparent;
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), points.begin(), points.end());
  for (std::size_t i = 0; i < indices.size(); i += 3)
    mesh.triangles.push_back({base + indices[i], base + indices[i + 1], base + indices[i + 2]});
  ColorTally& tally = color.alpha == 255 ? opaque_ : transparent_;
  tally[{color.red, color.green, color.blue, color.alpha}] += indices.size() / 3;
}

/// Joins segments that continue where the last one ended into one chain.
void MeshLoader::chains(const std::vector<std::uint32_t>& indices,
                        const std::vector<Vec3d>& points) {
  geometry::Polylines& lines = result_.lines;
  const auto end_chain = [&] {
    const auto end = static_cast<std::uint32_t>(lines.points.size());
    if (end != lines.first.back()) lines.first.push_back(end);
  };
  for (std::size_t i = 0; i < indices.size(); i += 2) {
    if (i == 0 || indices[i] != indices[i - 1]) {
      end_chain();
      lines.points.push_back(points[indices[i]]);
    }
    lines.points.push_back(points[indices[i + 1]]);
  }
  end_chain();
}

bool MeshLoader::primitive(const JsonValue& json, const std::string& pointer) {
  const JsonValue mode_json = json["mode"];
  const std::optional<std::uint64_t> mode_index =
      mode_json.exists() ? mode_json.index() : std::optional<std::uint64_t>(4);
  if (!mode_index || *mode_index > 6) return fail({pointer + "/mode", "is none of 0 to 6"});
  const auto mode = static_cast<Mode>(*mode_index);
  if (mode == Mode::points) {
    ++result_.points;
    return true;
  }
  const JsonValue position = json["attributes"]["POSITION"];
  if (!position.exists()) return fail({pointer, "has no POSITION"});
  // A packed primitive may come with plain data as well; without, its accessor would read as zeros.
  if (json["extensions"]["KHR_draco_mesh_compression"].exists() &&
      !input_.accessors->has_data(position.index().value_or(UINT64_MAX)))
    return fail({pointer, "is packed by KHR_draco_mesh_compression, which is not read"});
  const Checked<Accessor> opened = input_.accessors->open(position);
  if (const GltfFault* fault = fault_of(opened)) return fail(*fault);
  const auto& positions = std::get<Accessor>(opened);
  if (positions.width != 3) return fail({positions.pointer, "positions must be VEC3"});
  if (positions.count > std::numeric_limits<std::uint32_t>::max())
    return fail({positions.pointer, "has too many vertices"});

  std::vector<std::uint32_t> indices;
  if (!corners(json, positions.count, indices)) return false;
  const std::size_t each = is_line(mode) ? 2 : 3;
  const bool in_order = mode == Mode::lines || mode == Mode::triangles;
  if (in_order && indices.size() % each != 0) ++result_.odd;
  if (!in_order) indices = spelled_out(mode, indices);
  indices.resize(indices.size() / each * each);
  const std::vector<Vec3d> points = vertices(positions, pointer, each, indices);
  result_.step = std::max(result_.step, positions.step());
  const model::Color color = color_of(json);
  if (is_line(mode)) {
    chains(indices, points);
    lines_[{color.red, color.green, color.blue, color.alpha}] += indices.size() / 2;
  } else {
    triangles(indices, points, color);
  }
  return true;
}

LoadedMesh MeshLoader::load(const JsonValue& mesh) {
  std::size_t index = 0;
  bool good = true;
  mesh["primitives"].elements([&](const JsonValue& json) {
    if (good) good = primitive(json, fmt::format("{}/primitives/{}", pointer_, index++));
  });
  const bool empty = result_.opaque.triangles.empty() && result_.transparent.triangles.empty() &&
                     result_.lines.points.empty();
  if (good && empty) result_.fault = std::move(result_.first_left_out);
  if (result_.fault) {
    LoadedMesh broken;
    broken.fault = std::move(result_.fault);
    return broken;
  }
  result_.part_transparent = merge_transparent_shells(result_.opaque, result_.transparent);
  result_.opaque_color = main_color(opaque_);
  result_.transparent_color = main_color(transparent_);
  result_.line_color = main_color(lines_);
  return std::move(result_);
}

std::uint8_t to_byte(double share) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0, 1.0) * 255));
}

model::Color color_of_material(const JsonValue& material) {
  std::array<double, 4> factor{1, 1, 1, 1};
  const JsonValue glossiness =
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

LoadedMesh load_mesh(const MeshInput& input, const JsonValue& mesh, std::size_t index) {
  return MeshLoader(input, fmt::format("/meshes/{}", index)).load(mesh);
}

std::uint64_t stated_corners(const Accessors& accessors, const JsonValue& mesh) {
  constexpr std::uint64_t kMax = std::uint64_t{1} << 60U;  // sums of these must not wrap
  std::uint64_t sum = 0;
  mesh["primitives"].elements([&](const JsonValue& json) {
    const JsonValue indices = json["indices"], position = json["attributes"]["POSITION"];
    const std::uint64_t vertices = position.index().value_or(UINT64_MAX);
    const std::uint64_t counted =
        indices.exists() ? indices.index().value_or(UINT64_MAX) : vertices;
    sum = std::min(sum + accessors.stated_count(counted), kMax);
    if (indices.exists()) sum = std::min(sum + accessors.copied_count(vertices), kMax);
  });
  return sum;
}

std::vector<model::Color> material_colors(const JsonValue& root) {
  std::vector<model::Color> colors;
  root["materials"].elements(
      [&](const JsonValue& material) { colors.push_back(color_of_material(material)); });
  return colors;
}

}  // namespace strake::io::gltf
