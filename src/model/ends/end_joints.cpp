// SPDX-License-Identifier: Apache-2.0
#include "model/ends/end_joints.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <tuple>
#include <variant>

#include "geometry/numeric/vector_math.hpp"
#include "model/ends/mesh_ends.hpp"
#include "model/ends/primitive_ends.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/collect.hpp"

namespace strake::model {
namespace {

using geometry::Vec3d;
using geometry::Vec3l;

/// Returns the unit normal of a plane after a linear map; nothing where the map flattens it.
std::optional<Vec3d> mapped_normal(const geometry::Mat3d& linear, const Vec3d& normal) {
  const auto& [x, y, z] = linear.row;
  const double sign = linear.determinant() < 0 ? -1 : 1;
  const Vec3d mapped{sign * dot(cross(y, z), normal), sign * dot(cross(z, x), normal),
                     sign * dot(cross(x, y), normal)};
  const double size = length(mapped);
  if (!(size > 0) || !std::isfinite(size)) return std::nullopt;
  return mapped * (1 / size);
}

/// Finds the ends of the bodies of a scene; of meshes in several places once.
class SceneEnds {
 public:
  explicit SceneEnds(const Scene& scene) : scene_(scene) {}

  void append(std::uint32_t object, std::vector<ObjectEnd>& out) {
    for (const GridBody& grid_body : scene_.bodies_of(ObjectId{object})) {
      const Body& body = scene_.model->bodies[grid_body.body];
      if (body.category != Category::physical) continue;
      const Shape& shape = scene_.model->shapes[index(body.shape)];
      if (const auto* const primitive = std::get_if<geometry::Primitive>(&shape))
        add(*primitive, body.placement, object, out);
      else
        for (const MeshEnd& end : mesh_ends(grid_body.grid_shape, body.precision_um))
          out.push_back({grid_body.origin + end.centre, end.outward, object});
    }
  }

 private:
  static void add(const geometry::Primitive& primitive, const geometry::Placement& placement,
                  std::uint32_t object, std::vector<ObjectEnd>& out) {
    const auto origin = geometry::snap(placement.translation);
    for (const PrimitiveEnd& end : ends_of(primitive)) {
      const auto centre = geometry::snap(placement.linear * end.centre);
      const auto outward = mapped_normal(placement.linear, end.outward);
      if (origin && centre && outward) out.push_back({*origin + *centre, *outward, object});
    }
  }

  const std::vector<MeshEnd>& mesh_ends(std::uint32_t grid_shape, float precision_um) {
    const auto [at, made] = mesh_ends_.try_emplace({grid_shape, precision_um});
    if (made)
      for (const geometry::Part& part : scene_.shapes[grid_shape].parts) {
        const std::vector<MeshEnd> ends = ends_of(part, contact_distance(precision_um));
        at->second.insert(at->second.end(), ends.begin(), ends.end());
      }
    return at->second;
  }

  const Scene& scene_;
  std::map<std::pair<std::uint32_t, float>, std::vector<MeshEnd>> mesh_ends_;
};

/// Whether two ends meet. The squares of distances up to 2^30 along each axis do not overflow.
bool ends_meet(const ObjectEnd& x, const ObjectEnd& y, std::int64_t within) {
  constexpr double kCosOf30Degrees = 0.8660254037844386;
  const Vec3l apart = y.at - x.at;
  for (int k = 0; k < 3; ++k)
    if (apart[k] > within || apart[k] < -within) return false;
  return dot(apart, apart) <= within * within && dot(x.outward, y.outward) <= -kCosOf30Degrees;
}

/// A cell of space, by which ends are sorted.
struct Cell {
  std::int64_t x = 0, y = 0, z = 0;
  friend auto operator<=>(const Cell&, const Cell&) = default;
};

Cell cell_of(const Vec3l& at, std::int64_t size) {
  const auto floor = [&](std::int64_t v) { return v / size - (v % size < 0 ? 1 : 0); };
  return {floor(at.x), floor(at.y), floor(at.z)};
}

}  // namespace

std::vector<ObjectEnd> ends_of(const Scene& scene, const std::vector<bool>& among) {
  SceneEnds all(scene);
  std::vector<ObjectEnd> ends;
  for (std::uint32_t o = 0; o < among.size(); ++o)
    if (among[o]) all.append(o, ends);
  return ends;
}

Result<std::vector<std::pair<std::uint32_t, std::uint32_t>>> joints_of(
    std::vector<ObjectEnd> ends, std::int64_t within, const parallel::Context& context) {
  using Joint = std::pair<std::uint32_t, std::uint32_t>;
  constexpr std::size_t kGrain = 256;
  const std::int64_t size = std::max<std::int64_t>(within, 1);
  const auto cell = [&](const ObjectEnd& end) { return cell_of(end.at, size); };
  std::ranges::sort(ends, [&](const ObjectEnd& x, const ObjectEnd& y) {
    return std::tuple(cell(x), x.at, x.object) < std::tuple(cell(y), y.at, y.object);
  });
  auto found = parallel::collect<Joint>(
      context, {.name = "joints", .n = ends.size(), .grain = kGrain},
      [&](std::size_t i, std::vector<Joint>& out) {
        const Cell at = cell(ends[i]);
        for (std::int64_t x = at.x - 1; x <= at.x + 1; ++x)
          for (std::int64_t y = at.y - 1; y <= at.y + 1; ++y) {
            const auto first = std::ranges::lower_bound(ends, Cell{x, y, at.z - 1}, {}, cell);
            for (auto other = first; other != ends.end() && cell(*other) <= Cell{x, y, at.z + 1};
                 ++other)
              if (ends[i].object < other->object && ends_meet(ends[i], *other, within))
                out.push_back({ends[i].object, other->object});
          }
      });
  if (!found) return found.error();
  std::ranges::sort(*found);
  found->erase(std::unique(found->begin(), found->end()), found->end());
  return found;
}

}  // namespace strake::model
