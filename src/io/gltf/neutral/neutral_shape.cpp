// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/neutral/neutral_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "io/gltf/neutral/primitive_lengths.hpp"

namespace strake::io::gltf {
namespace {

using geometry::Vec3d;

constexpr std::size_t kMaxVertices = 0xffffffffU;

class NeutralShapeLoader {
 public:
  NeutralShapeLoader(const Buffers& buffers, const Accessors& accessors, const JsonValue& mesh,
                     std::size_t index)
      : buffers_(buffers),
        accessors_(accessors),
        extras_(mesh["extras"]["strake"]),
        pointer_(fmt::format("/meshes/{}", index)) {
    const std::vector<JsonValue> primitives = mesh["primitives"].items();
    if (!primitives.empty()) primitive_ = primitives[0];
  }
  NeutralShape load();

 private:
  bool fail(std::string message) { return fail({pointer_, std::move(message)}); }
  bool fail(GltfFault fault) {
    result_.fault = std::move(fault);
    return false;
  }
  bool analytic(const JsonValue& stated);
  bool mesh();
  bool lines();
  bool points(std::vector<Vec3d>& out);
  template <class T>
  bool block(const char* name, std::size_t count, std::vector<T>& out);
  bool triangles(std::size_t vertices, std::vector<geometry::Triangle>& out);

  const Buffers& buffers_;
  const Accessors& accessors_;
  JsonValue extras_, primitive_;
  std::string pointer_;
  NeutralShape result_;
};

bool NeutralShapeLoader::analytic(const JsonValue& stated) {
  std::vector<double> lengths;
  bool numbers = true;
  stated["lengths"].elements([&](const JsonValue& item) {
    const std::optional<double> number = item.number();
    numbers = numbers && number && std::isfinite(*number);
    lengths.push_back(number.value_or(0));
  });
  const auto made = primitive_of(stated["kind"].text_value(), lengths);
  if (!numbers || !made) return fail("its primitive is of no known kind");
  result_.shape = *made;
  return true;
}

/// Reads the numbers of a buffer view that extras name; there are `count` of them.
template <class T>
bool NeutralShapeLoader::block(const char* name, std::size_t count, std::vector<T>& out) {
  const Checked<Buffers::BufferView> view = buffers_.view(extras_[name]);
  if (const GltfFault* const fault = fault_of(view)) return fail(*fault);
  const std::span<const std::byte> bytes = std::get<Buffers::BufferView>(view).bytes;
  if (bytes.size() / sizeof(T) != count || bytes.size() % sizeof(T) != 0)
    return fail(fmt::format("its {} are not as many as there should be", name));
  out.resize(count);
  if (count > 0) std::memcpy(out.data(), bytes.data(), bytes.size());
  return true;
}

bool NeutralShapeLoader::points(std::vector<Vec3d>& out) {
  const Checked<Accessor> opened = accessors_.open(primitive_["attributes"]["POSITION"]);
  if (const GltfFault* const fault = fault_of(opened)) return fail(*fault);
  const auto& positions = std::get<Accessor>(opened);
  if (positions.width != 3 || positions.count > kMaxVertices)
    return fail({positions.pointer, "positions must be VEC3"});
  if (extras_["positions"].exists()) {
    if (!block("positions", positions.count, out)) return false;
  } else {
    out.reserve(positions.count);
    for (std::size_t i = 0; i < positions.count; ++i) {
      std::array<double, 4> xyz{};
      positions.element(i, xyz.data());
      out.push_back({xyz[0], xyz[1], xyz[2]});
    }
  }
  for (const Vec3d& point : out) {
    if (!geometry::is_finite(point)) return fail({positions.pointer, "a vertex is not finite"});
    result_.box.include(point);
  }
  return true;
}

bool NeutralShapeLoader::triangles(std::size_t vertices, std::vector<geometry::Triangle>& out) {
  const Checked<Accessor> opened = accessors_.open(primitive_["indices"]);
  if (const GltfFault* const fault = fault_of(opened)) return fail(*fault);
  const auto& indices = std::get<Accessor>(opened);
  const bool whole =
      indices.component == Component::uint16 || indices.component == Component::uint32;
  if (!whole || indices.width != 1 || indices.count % 3 != 0)
    return fail({indices.pointer, "indices must be unsigned integers, three for each triangle"});
  out.resize(indices.count / 3);
  for (std::size_t i = 0; i < indices.count; ++i) {
    const std::uint32_t corner = indices.integer(i);
    if (corner >= vertices)
      return fail({indices.pointer, fmt::format("there is no vertex {}", corner)});
    out[i / 3][i % 3] = corner;
  }
  return true;
}

bool NeutralShapeLoader::mesh() {
  geometry::TriangleMesh mesh;
  if (!points(mesh.vertices) || !triangles(mesh.vertices.size(), mesh.triangles)) return false;
  if (mesh.triangles.empty()) return fail("it has no triangles");
  if (extras_["faces"].exists() && !block("faces", mesh.triangles.size(), mesh.faces)) return false;
  mesh.sag_mm = extras_["sag_mm"].number().value_or(-1);
  result_.shape = std::move(mesh);
  return true;
}

bool NeutralShapeLoader::lines() {
  geometry::Polylines lines;
  if (!points(lines.points)) return false;
  const Checked<Buffers::BufferView> view = buffers_.view(extras_["chains"]);
  if (const GltfFault* const fault = fault_of(view)) return fail(*fault);
  const std::size_t entries =
      std::get<Buffers::BufferView>(view).bytes.size() / sizeof(lines.first[0]);
  if (entries > lines.points.size() + 1) return fail("it has more chains than points");
  if (!block("chains", entries, lines.first)) return false;
  if (lines.first.empty() || lines.first.front() != 0 ||
      lines.first.back() != lines.points.size() ||
      std::ranges::adjacent_find(lines.first, std::greater_equal<>()) != lines.first.end())
    return fail("its chains are not those of its points");
  result_.shape = std::move(lines);
  return true;
}

NeutralShape NeutralShapeLoader::load() {
  const auto [analytic_json, chains] = extras_.pick<2>({"primitive", "chains"});
  const bool good = analytic_json.exists() ? analytic(analytic_json)
                    : chains.exists()      ? lines()
                                           : mesh();
  if (!good) result_.shape = {};
  return std::move(result_);
}

}  // namespace

NeutralShape load_neutral_shape(const Buffers& buffers, const Accessors& accessors,
                                const JsonValue& mesh, std::size_t index) {
  return NeutralShapeLoader(buffers, accessors, mesh, index).load();
}

std::uint64_t stated_numbers(const Accessors& accessors, const JsonValue& mesh) {
  const std::vector<JsonValue> primitives = mesh["primitives"].items();
  if (primitives.empty() || mesh["extras"]["strake"]["primitive"].exists()) return 0;
  const auto [attributes, indices] = primitives[0].pick<2>({"attributes", "indices"});
  const auto count = [&](const JsonValue& accessor) {
    constexpr std::uint64_t kMax = std::uint64_t{1} << 60U;  // sums of these must not wrap
    return std::min(accessors.stated_count(accessor.index().value_or(UINT64_MAX)), kMax);
  };
  return count(attributes["POSITION"]) + count(indices);
}

}  // namespace strake::io::gltf
