// SPDX-License-Identifier: Apache-2.0
#include "geometry/interior_depth/bounds/separating_displacement.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "geometry/bvh/pair_local_part.hpp"
#include "geometry/bvh/traversal.hpp"
#include "geometry/distance/triangle_distance.hpp"
#include "geometry/sheet_separation/vertex_displacements.hpp"
#include "strake/geometry/depth.hpp"
#include "strake/geometry/predicates.hpp"
#include "strake/geometry/triangle_contact.hpp"

namespace strake::geometry {
namespace {

/// Maximum numbers of near pairs of triangles and of pairs of nodes per triangle of the two. Within
/// them a bilge strake on a floor, 388 triangles, takes 950 µs; by a search it took 92,000. Flush
/// bodies of some hundred slivers exceed them (decision 0021).
constexpr std::size_t kNearPerTriangle = 2, kNodesPerTriangle = 8;
constexpr std::size_t kAlwaysNear = 128;
/// Number of surface points tried for one that is clear of the other body.
constexpr std::size_t kMaxProbes = 16;
/// Room that displacements may need beyond coordinates that fit the exact arithmetic.
constexpr std::int64_t kRoom = 64;

using ExactCorners = std::array<Vec3l, 3>;

/// The relation of two triangles.
enum class TriangleRelation : std::uint8_t {
  apart,     ///< farther than the reach
  near,      ///< as far as is known
  crossing,  ///< displacements within the reach do not separate them
};

constexpr double kCoplanar = 1 - 1e-4;  ///< squares of cosines
constexpr double kParallel = 1e-12;     ///< squares of sines

/// Tests the normals of possible separating planes of two triangles. Rounding is far below a unit.
class SeparatingAxisTest {
 public:
  SeparatingAxisTest(const DoubleTriangle& a, const DoubleTriangle& b, double reach)
      : a_(a), b_(b), reach_squared_(reach * reach) {}

  TriangleRelation run() {
    if (apart_along(a_.normal) || apart_along(b_.normal)) return TriangleRelation::apart;
    // Beside each other in about one plane, where the edges' common normals say nothing.
    const double cosine = dot(a_.normal, b_.normal);
    if (cosine * cosine > kCoplanar * a_.normal_squared * b_.normal_squared) {
      for (std::size_t i = 0; i < 3; ++i)
        if (apart_along(cross(a_.normal, a_.corner[(i + 1) % 3] - a_.corner[i])) ||
            apart_along(cross(b_.normal, b_.corner[(i + 1) % 3] - b_.corner[i])))
          return TriangleRelation::apart;
      return TriangleRelation::near;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d e = a_.corner[(i + 1) % 3] - a_.corner[i];
      const double squared = dot(e, e);
      for (std::size_t j = 0; j < 3; ++j) {
        const Vec3d f = b_.corner[(j + 1) % 3] - b_.corner[j], way = cross(e, f);
        if (dot(way, way) > kParallel * squared * dot(f, f) && apart_along(way))
          return TriangleRelation::apart;
      }
    }
    if (crossing_) return TriangleRelation::crossing;
    return TriangleRelation::near;
  }

 private:
  bool apart_along(const Vec3d& way) {
    const auto [low_a, high_a] = extent(way, a_);
    const auto [low_b, high_b] = extent(way, b_);
    const double common = std::min(high_a - low_b, high_b - low_a);
    const bool beyond = common * common > reach_squared_ * dot(way, way);
    crossing_ = crossing_ && common > 0 && beyond;
    return common < 0 && beyond;
  }

  static std::array<double, 2> extent(const Vec3d& way, const DoubleTriangle& t) {
    const double x = dot(way, t.corner[0]), y = dot(way, t.corner[1]), z = dot(way, t.corner[2]);
    return {std::min(std::min(x, y), z), std::max(std::max(x, y), z)};
  }

  const DoubleTriangle &a_, &b_;
  double reach_squared_;
  bool crossing_ = true;
};

/// The triangles of one body that come near the other, with their original and displaced vertices.
class MovingSurface {
 public:
  explicit MovingSurface(const PairLocalPart& view) : view_(view) {}

  void add(std::uint32_t triangle) { triangles_.push_back(triangle); }

  /// False where a triangle has no area any more.
  bool shrink(double limit) {
    here_.clear();
    there_.clear();
    moved_.clear();
    longest_ = 0;
    std::ranges::sort(triangles_);
    triangles_.erase(std::ranges::unique(triangles_).begin(), triangles_.end());
    std::vector<MovingTriangle> moving;
    moving.reserve(triangles_.size());
    for (const std::uint32_t t : triangles_) moving.push_back({t, false, false});
    moves_ = vertex_displacements(view_.part(), moving, {}, limit);
    for (const VertexDisplacement& move : moves_) {
      const Vec3d by = move.by.as<double>();
      const double root = std::sqrt(dot(by, by));
      longest_ = std::max(longest_, root == std::floor(root) ? root : root * (1 + 0x1p-50));
    }
    for (const std::uint32_t t : triangles_) {
      ExactCorners corners = view_.corners(t);
      here_.emplace_back(corners);
      const Triangle& v = view_.part().triangles[t];
      for (std::size_t i = 0; i < 3; ++i)
        corners[i] = corners[i] + move_of(v[i]).as<std::int64_t>();
      if (cross_exact(corners[1] - corners[0], corners[2] - corners[0]) == Vec3<Int128>{})
        return false;
      moved_.push_back(corners);
      there_.emplace_back(corners);
    }
    return true;
  }

  [[nodiscard]] double longest_move() const { return longest_; }
  [[nodiscard]] std::size_t place(std::uint32_t triangle) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(triangles_, triangle) -
                                    triangles_.begin());
  }

  /// Whether a triangle that was moved has a point in common with one of the other that was not.
  [[nodiscard]] bool meets_after(std::size_t i, const MovingSurface& other, std::size_t j,
                                 QueryContext& work) const {
    ++work.triangle_pairs;
    if (triangle_distance_bounds(there_[i], other.here_[j], 0).lower > 0) return false;
    ++work.exact_fallbacks;
    return contact(ExactTriangle(moved_[i]), other.view_.triangle(other.triangles_[j])).touch !=
           Touch::none;
  }

  [[nodiscard]] std::vector<std::uint32_t> corners() const {
    std::vector<std::uint32_t> all;
    all.reserve(moves_.size());
    for (const VertexDisplacement& move : moves_) all.push_back(move.vertex);
    return all;
  }

 private:
  [[nodiscard]] const Vec3i& move_of(std::uint32_t vertex) const {
    return std::ranges::lower_bound(moves_, vertex, {}, &VertexDisplacement::vertex)->by;
  }

  const PairLocalPart& view_;
  std::vector<std::uint32_t> triangles_;
  std::vector<VertexDisplacement> moves_;
  std::vector<DoubleTriangle> here_, there_;
  std::vector<ExactCorners> moved_;
  double longest_ = 0;
};

/// Whether some surface point is outside the other body and farther from it than `limit`.
bool is_clear_somewhere(const PairLocalPart& view, const PartWithBvh& other, const Vec3l& shift,
                        double limit, QueryContext& work) {
  const Part& part = view.part();
  const Box3d search_box = other.placed.part->box.as<double>().inflated(limit + 1);
  for (const Vec3i& v : part.vertices) {
    const Vec3d p = (v.as<std::int64_t>() - shift).as<double>();
    if (!search_box.contains({p, p})) return true;
  }
  // The middles of triangles.
  const std::size_t n = part.triangles.size(), step = std::max<std::size_t>(1, n / kMaxProbes);
  for (std::size_t t = 0; t < n; t += step) {
    Vec3l thrice;
    for (const std::uint32_t v : part.triangles[t])
      thrice = thrice + (part.vertices[v].as<std::int64_t>() - shift);
    const Vec3d p = thrice.as<double>() * (1.0 / 3);
    if (distance_to_surface(other, p, limit + 2) > limit + 1 &&
        side_of(other, thrice, 3, work) == PointSide::outside)
      return true;
  }
  return false;
}

class DisplacementSearch {
 public:
  DisplacementSearch(const PartWithBvh& a, const PartWithBvh& b, double limit, QueryContext& work)
      : treed_a_(a),
        treed_b_(b),
        shift_(b.placed.origin - a.placed.origin),
        a_(a, {}),
        b_(b, shift_),
        surface_a_(a_),
        surface_b_(b_),
        limit_(limit),
        work_(work) {}

  std::optional<SeparatingDisplacement> run(double first) {
    if (!applies() || !find_near()) return std::nullopt;
    for (const double limit : {first, limit_}) {
      if (limit > limit_ || !parts(limit)) continue;
      // One point decides for all of a surface that does not meet the other, also after
      // displacements no longer than its distance from the other.
      if (!is_clear_somewhere(a_, treed_b_, shift_, limit, work_) ||
          !is_clear_somewhere(b_, treed_a_, Vec3l{} - shift_, limit, work_))
        return std::nullopt;
      return SeparatingDisplacement{std::max(surface_a_.longest_move(), surface_b_.longest_move()),
                                    surface_a_.corners(), surface_b_.corners()};
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] bool applies() const {
    const Part &x = a_.part(), &y = b_.part();
    if (x.kind != PartKind::solid || y.kind != PartKind::solid) return false;
    if (x.shell_count != 1 || y.shell_count != 1 || !a_.has_bvh() || !b_.has_bvh()) return false;
    const Box3l p = a_.box(x.box), q = b_.box(y.box);
    if (p == q) return false;  // of copies all triangles are near
    for (int k = 0; k < 3; ++k)
      if (std::max(p.hi[k], q.hi[k]) - std::min(p.lo[k], q.lo[k]) >
          std::numeric_limits<std::int32_t>::max() - kRoom)
        return false;
    return true;
  }

  /// Whether displacements are found after which no triangle of one meets any of the other.
  bool parts(double limit) {
    if (!surface_a_.shrink(limit) || !surface_b_.shrink(limit)) return false;
    return std::ranges::none_of(near_, [&](const NodePair& pair) {
      const std::size_t i = surface_a_.place(pair.a), j = surface_b_.place(pair.b);
      return surface_a_.meets_after(i, surface_b_, j, work_) ||
             surface_b_.meets_after(j, surface_a_, i, work_);
    });
  }

  /// False where there are too many, or some that cross as usual.
  bool find_near() {
    const std::size_t triangles = a_.part().triangles.size() + b_.part().triangles.size();
    // Whatever is farther stays apart where one of the two moves.
    const double reach = limit_ + 1;
    const auto margin = static_cast<std::int64_t>(std::ceil(reach));
    const auto near = [&](const TriangleBvh::Node& x, const TriangleBvh::Node& y) {
      ++work_.node_pairs;
      return a_.box(x.box).inflated(margin).meets(b_.box(y.box));
    };
    const auto leaves = [&](const TriangleBvh::Node& x, const TriangleBvh::Node& y) {
      return add_near(x, y, reach) && near_.size() <= kAlwaysNear + kNearPerTriangle * triangles;
    };
    DualTraversal traversal(a_.tree(), b_.tree());
    traversal.start();
    return traversal.run(near, leaves, kNodesPerTriangle * triangles) == TraversalEnd::done;
  }

  /// False where some cross.
  bool add_near(const TriangleBvh::Node& x, const TriangleBvh::Node& y, double reach) {
    std::array<DoubleTriangle, TriangleBvh::kLeafSize> of_x;
    for (std::uint32_t i = 0; i < x.count; ++i)
      of_x[i] = DoubleTriangle(a_.corners(a_.tree().order()[x.first + i]));
    for (std::uint32_t j = 0; j < y.count; ++j) {
      const std::uint32_t u = b_.tree().order()[y.first + j];
      const DoubleTriangle of_y(b_.corners(u));
      const Box3d search_box = of_y.box.inflated(reach);
      for (std::uint32_t i = 0; i < x.count; ++i) {
        if (!of_x[i].box.meets(search_box)) continue;
        ++work_.triangle_pairs;
        const TriangleRelation standing = SeparatingAxisTest(of_x[i], of_y, reach).run();
        if (standing == TriangleRelation::crossing) return false;
        if (standing == TriangleRelation::apart) continue;
        const std::uint32_t t = a_.tree().order()[x.first + i];
        near_.push_back({t, u});
        surface_a_.add(t);
        surface_b_.add(u);
      }
    }
    return true;
  }

  const PartWithBvh &treed_a_, &treed_b_;
  Vec3l shift_;
  PairLocalPart a_, b_;
  MovingSurface surface_a_, surface_b_;
  double limit_;
  QueryContext& work_;
  std::vector<NodePair> near_;  ///< of triangles
};

}  // namespace

std::optional<SeparatingDisplacement> find_separating_displacement(const PartWithBvh& a,
                                                                   const PartWithBvh& b,
                                                                   double first, double limit,
                                                                   QueryContext& work) {
  return DisplacementSearch(a, b, limit, work).run(first);
}

}  // namespace strake::geometry
