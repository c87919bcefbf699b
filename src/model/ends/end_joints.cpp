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

/// As much as the snap of two ends and of their bodies accounts for, twice, in grid units.
constexpr double kSnapUm = 4;

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
        add(*primitive, grid_body, out);
      else
        for (const MeshEnd& end : mesh_ends(grid_body.grid_shape, body.precision_um))
          add({grid_body.origin + end.centre, end.outward, object, end.reach}, out);
    }
  }

 private:
  void add(const geometry::Primitive& primitive, const GridBody& grid_body,
           std::vector<ObjectEnd>& out) const {
    const geometry::Placement& placement = scene_.model->bodies[grid_body.body].placement;
    const auto origin = geometry::snap(placement.translation);
    for (const PrimitiveEnd& end : ends_of(primitive)) {
      const auto centre = geometry::snap(placement.linear * end.centre);
      const auto outward = mapped_normal(placement.linear, end.outward);
      if (!origin || !centre || !outward) continue;
      const Vec3l at = *origin + *centre;
      double reach = 0;
      for (const geometry::Part& part : scene_.shapes[grid_body.grid_shape].parts)
        reach = std::max(reach, reach_behind(part, at - grid_body.origin, *outward));
      add({at, *outward, static_cast<std::uint32_t>(index(grid_body.object)), reach}, out);
    }
  }

  /// Adds an end, unless nothing is behind it: a flat disc faces both ways and ends nowhere.
  static void add(const ObjectEnd& end, std::vector<ObjectEnd>& out) {
    if (2 * end.reach > kSnapUm) out.push_back(end);
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

/// Whether the one end is no farther behind the plane of the other than half the shorter body.
bool is_in_front(const ObjectEnd& end, const ObjectEnd& other) {
  const double behind = dot((other.at - end.at).as<double>(), other.outward);
  return 2 * behind <= std::min(end.reach, other.reach) + kSnapUm;
}

/// Whether two ends meet. The squares of distances up to 2^30 along each axis do not overflow.
bool ends_meet(const ObjectEnd& x, const ObjectEnd& y, std::int64_t within) {
  constexpr double kCosOf30Degrees = 0.8660254037844386;
  const Vec3l apart = y.at - x.at;
  for (int k = 0; k < 3; ++k)
    if (apart[k] > within || apart[k] < -within) return false;
  return dot(apart, apart) <= within * within && dot(x.outward, y.outward) <= -kCosOf30Degrees &&
         is_in_front(x, y) && is_in_front(y, x);
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

/// Two ends that meet, by their numbers, the lower first.
using Meeting = std::pair<std::size_t, std::size_t>;

/// Returns which ends meet, of one object too. The ends are sorted by their cells.
Result<std::vector<Meeting>> meetings(const std::vector<ObjectEnd>& ends, std::int64_t within,
                                      std::int64_t size, const parallel::Context& context) {
  // Only shares the work out: between 64 and 1024 no difference can be seen (decision 0073).
  constexpr std::size_t kGrain = 256;
  const auto cell = [&](const ObjectEnd& end) { return cell_of(end.at, size); };
  return parallel::collect<Meeting>(
      context, {.name = "joints", .n = ends.size(), .grain = kGrain},
      [&](std::size_t i, std::vector<Meeting>& out) {
        const Cell at = cell(ends[i]);
        for (std::int64_t x = at.x - 1; x <= at.x + 1; ++x)
          for (std::int64_t y = at.y - 1; y <= at.y + 1; ++y) {
            const auto first = std::ranges::lower_bound(ends, Cell{x, y, at.z - 1}, {}, cell);
            for (auto j = static_cast<std::size_t>(first - ends.begin());
                 j < ends.size() && cell(ends[j]) <= Cell{x, y, at.z + 1}; ++j)
              if (i < j && ends_meet(ends[i], ends[j], within)) out.emplace_back(i, j);
          }
      });
}

/// Returns by end the longest reach of the ends of its own object that it meets: how far the object
/// goes on beyond it; less than nothing where it does not.
std::vector<double> reaches_beyond(const std::vector<ObjectEnd>& ends,
                                   const std::vector<Meeting>& met) {
  std::vector<double> own(ends.size(), -1 - kSnapUm);
  for (const auto& [i, j] : met) {
    if (ends[i].object != ends[j].object) continue;
    own[i] = std::max(own[i], ends[j].reach);
    own[j] = std::max(own[j], ends[i].reach);
  }
  return own;
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
  const std::int64_t size = std::max<std::int64_t>(within, 1);
  const auto cell = [&](const ObjectEnd& end) { return cell_of(end.at, size); };
  std::ranges::sort(ends, [&](const ObjectEnd& x, const ObjectEnd& y) {
    return std::tuple(cell(x), x.at, x.object) < std::tuple(cell(y), y.at, y.object);
  });
  const auto met = meetings(ends, within, size, context);
  if (!met) return met.error();
  const std::vector<double> own = reaches_beyond(ends, *met);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> joints;
  for (const auto& [i, j] : *met)
    if (ends[i].object != ends[j].object &&
        !(own[i] + kSnapUm >= ends[j].reach && own[j] + kSnapUm >= ends[i].reach))
      joints.emplace_back(std::minmax(ends[i].object, ends[j].object));
  std::ranges::sort(joints);
  joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
  return joints;
}

}  // namespace strake::model
