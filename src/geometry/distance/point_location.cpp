// SPDX-License-Identifier: Apache-2.0
#include "geometry/distance/point_location.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/bvh/pair_local_part.hpp"
#include "geometry/bvh/parallel_traversal.hpp"
#include "geometry/bvh/traversal.hpp"
#include "geometry/distance/bvh_in_frame.hpp"
#include "geometry/distance/elementary_distance.hpp"
#include "geometry/numeric/morton_order.hpp"
#include "geometry/numeric/triangle_math.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "geometry/obb/oriented_box.hpp"
#include "geometry/predicates/ray_crossing.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/part_pair.hpp"
#include "strake/parallel/find.hpp"

namespace strake::geometry {
namespace {

/// The axis direction with the shortest way from a point out of a box.
struct Ray {
  int axis = 0;
  bool upward = true;
  std::int64_t length = INT64_MAX;  ///< as the point's numerators
};

Ray shortest_ray(const Box3i& box, const ScaledPoint& p) {
  Ray best;
  for (int k = 0; k < 3; ++k) {
    const std::int64_t up = box.hi[k] * p.denominator - p.numerator[k];
    const std::int64_t down = p.numerator[k] - box.lo[k] * p.denominator;
    if (up < best.length) best = {k, true, up};
    if (down < best.length) best = {k, false, down};
  }
  return best;
}

/// Counts the crossings of a ray with a part, visiting every triangle where there is no tree; false
/// where the point is on the surface.
bool pass_all(const PairLocalPart& view, RayCrossings& ray, QueryContext& work) {
  const auto pass = [&](std::uint32_t triangle) { return ray.pass(view.corners(triangle)); };
  if (!view.has_bvh()) {
    const auto n = static_cast<std::uint32_t>(view.part().triangles.size());
    std::uint32_t t = 0;
    while (t < n && pass(t)) ++t;
    return t == n;
  }
  const auto meets = [&](const TriangleBvh::Node& node) {
    const bool met = ray.may_meet(node.box.lo, node.box.hi);
    if (met) ++work.node_pairs;
    return met;
  };
  return traverse_bvh(view.tree(), meets, pass);
}

/// Does the same by the boxes of a rotated frame, up to the end of the ray.
bool pass_in_frame(const PairLocalPart& view, const RotatedFrame& frame, const Ray& way,
                   const ScaledPoint& p, RayCrossings& ray, QueryContext& work) {
  const double scale = 1 / static_cast<double>(p.denominator);
  Vec3d along;
  along[way.axis] = static_cast<double>(way.length) * scale * (way.upward ? 1 : -1);
  const Vec3d from = turned(frame.axes, p.numerator.as<double>() * scale);
  const Vec3d to = from + turned(frame.axes, along);
  const BvhInFrame boxes(frame.part);
  const auto meets = [&](const Box3d& box) {
    return may_meet(from, to, box.inflated(kFrameRounding));
  };
  return traverse_bvh(
      boxes.tree(),
      [&](const TriangleBvh::Node& node) {
        const bool met = meets(boxes.box(node));
        if (met) ++work.node_pairs;
        return met;
      },
      [&](std::uint32_t t) { return !meets(boxes.turned_box(t)) || ray.pass(view.corners(t)); });
}

const Box3i& box_of_all(const PairLocalPart& view) {
  return view.has_bvh() ? view.tree().nodes().front().box : view.part().box;
}

}  // namespace

PointSide side_of(const PartWithBvh& part, const Vec3l& numerator, std::int64_t denominator,
                  QueryContext& work, const RotatedFrame* frame) {
  const PairLocalPart view(part, {});
  const Box3i& box = box_of_all(view);
  for (int k = 0; k < 3; ++k)
    if (numerator[k] < box.lo[k] * denominator || numerator[k] > box.hi[k] * denominator)
      return PointSide::outside;
  const ScaledPoint p{numerator, denominator};
  const Ray way = shortest_ray(box, p);
  RayCrossings ray(p, way.axis, way.upward);
  const bool beside =
      frame == nullptr ? pass_all(view, ray, work) : pass_in_frame(view, *frame, way, p, ray, work);
  if (!beside) return PointSide::on_boundary;
  return view.solid() && ray.number() >= 1 ? PointSide::inside : PointSide::outside;
}

PointSide side_of(const PartWithBvh& part, const Vec3l& numerator, std::int64_t denominator,
                  QueryContext& work) {
  return side_of(part, numerator, denominator, work, nullptr);
}

namespace {

/// Maximum number of steps from triangle to triangle, from one that had a point near, towards the
/// next point.
constexpr int kSteps = 64;

}  // namespace

std::optional<RotatedFrame> frame_along_faces(const PartWithBvh& part,
                                              const parallel::Context& context) {
  const Axes axes = orthonormal_axes(*part.placed.part);
  auto turned = rotate_part(PairLocalPart(part, {}), axes, context);
  if (!turned) return std::nullopt;
  return RotatedFrame{axes, std::move(*turned)};
}

PointLocator::PointLocator(const PartWithBvh& part, double band, const RotatedFrame* frame)
    : part_(part),
      view_(part, {}),
      band_(band),
      frame_(frame),
      boxes_(frame == nullptr ? BvhInFrame(view_) : BvhInFrame(frame->part)) {}

BandLocation PointLocator::location(const Vec3l& at, QueryContext& work) {
  const Vec3d p = at.as<double>();
  const Vec3d in_frame = frame_ == nullptr ? p : turned(frame_->axes, p);
  if (near_surface(p, in_frame, work)) return BandLocation::near_surface;
  const Sided* known = frame_ == nullptr ? nullptr : same_side(in_frame, work);
  const bool outside = known != nullptr ? known->side == BandLocation::outside
                                        : side_of(part_, at, 1, work) == PointSide::outside;
  const BandLocation side = outside ? BandLocation::outside : BandLocation::inside;
  sided_[sided_count_++ % kRemembered] = {in_frame, side};
  return side;
}

bool PointLocator::is_near(const Vec3d& p, std::uint32_t triangle) const {
  return std::sqrt(squared_distance(p, corners_of(view_.part(), triangle))) <= band_;
}

/// Whether a point is near the last triangles that had one near, or those round them.
bool PointLocator::is_near_known(const Vec3d& p, QueryContext& work) {
  const std::size_t known = std::min(near_count_, kRemembered);
  for (std::size_t i = 1; i <= known; ++i) {
    std::uint32_t t = near_[(near_count_ - i) % kRemembered];
    for (int step = 0; step < kSteps && t != kNoIndex; ++step) {
      ++work.node_pairs;
      if (is_near(p, t)) {
        if (i > 1 || step > 0) remember(t);
        return true;
      }
      t = towards(p, t);
    }
  }
  return false;
}

/// Returns the neighbour of a triangle over the edge that a point lies farthest beyond; none over
/// the boundary of a sheet, or where the point lies beyond no edge.
std::uint32_t PointLocator::towards(const Vec3d& p, std::uint32_t triangle) const {
  const Part& part = view_.part();
  const Corners c = corners_of(part, triangle);
  const Vec3d n = normal_of(c);
  int side = -1;
  double farthest = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3d& from = c[static_cast<std::size_t>(i)];
    const Vec3d e = c[static_cast<std::size_t>((i + 1) % 3)] - from;
    const double beyond = dot(cross(p - from, e), n) / length(e);
    if (beyond > farthest) {
      farthest = beyond;
      side = i;
    }
  }
  if (side < 0 || part.edges.empty()) return kNoIndex;
  const Triangle& t = part.triangles[triangle];
  const auto at = [&](int i) { return t[static_cast<std::size_t>(i % 3)]; };
  const std::uint32_t edge = edge_between(part, at(side), at(side + 1));
  if (edge == kNoIndex) return kNoIndex;
  for (const std::uint32_t other : incident_triangles(part, edge))
    if (other != triangle) return other;
  return kNoIndex;
}

/// Calls visit(triangle) for triangles that may be near a point until it returns false.
template <class Visit>
bool PointLocator::candidates(const Vec3d& in_frame, QueryContext& work, const Visit& visit) const {
  const double reach = band_ + 1;
  const auto may_be_near = [&](const Box3d& box) {
    return squared_gap(in_frame, box) <= reach * reach;
  };
  return traverse_bvh(
      boxes_.tree(),
      [&](const TriangleBvh::Node& node) {
        ++work.node_pairs;
        return may_be_near(boxes_.box(node));
      },
      [&](std::uint32_t t) {
        return (frame_ != nullptr && !may_be_near(boxes_.turned_box(t))) || visit(t);
      });
}

bool PointLocator::near_surface(const Vec3d& p, const Vec3d& in_frame, QueryContext& work) {
  if (frame_ != nullptr) {
    if (candidates(in_frame, work, [](std::uint32_t) { return false; })) return false;
    if (is_near_known(p, work)) return true;
  }
  return !candidates(in_frame, work, [&](std::uint32_t t) {
    if (!is_near(p, t)) return true;
    remember(t);
    return false;
  });
}

/// Returns the nearest of the last points, if there is certainly no surface between.
const PointLocator::Sided* PointLocator::same_side(const Vec3d& in_frame,
                                                   QueryContext& work) const {
  const auto last =
      sided_.begin() + static_cast<std::ptrdiff_t>(std::min(sided_count_, kRemembered));
  const auto squared = [&](const Sided& s) { return dot(s.at - in_frame, s.at - in_frame); };
  const auto nearest = std::min_element(sided_.begin(), last, [&](const Sided& x, const Sided& y) {
    return squared(x) < squared(y);
  });
  if (nearest == last) return nullptr;
  const bool apart = traverse_bvh(
      boxes_.tree(),
      [&](const TriangleBvh::Node& node) {
        ++work.node_pairs;
        return may_meet(in_frame, nearest->at, boxes_.box(node).inflated(kFrameRounding));
      },
      [&](std::uint32_t t) {
        return !may_meet(in_frame, nearest->at, boxes_.turned_box(t).inflated(kFrameRounding));
      });
  return apart ? &*nearest : nullptr;
}

void PointLocator::remember(std::uint32_t triangle) {
  near_[near_count_++ % kRemembered] = triangle;
}

namespace {

/// Number of vertices sampled for the cost of one, and nodes of the tree per vertex from which on a
/// rotated frame pays. A fan flush inside a fan, askew, takes 0.04 CPU s with 20,000 triangles and
/// 0.50 with 200,000; vertex by vertex it took 0.17 and 17.7 (decision 0026).
constexpr std::size_t kSamplePoints = 32, kManyNodes = 256;
/// Fewer vertices are not worth a frame. Between 256 and 4096 ships show no difference (decision
/// 0073).
constexpr std::size_t kWorthAFrame = 1024;

/// The locations of some vertices, up to the first that is outside.
struct Vertices {
  ToleranceContainment cover{.within = true, .on_surface = true};
  QueryStats cost;

  /// Adds a location; returns whether to go on.
  bool add(BandLocation location) {
    cover.on_surface = cover.on_surface && location == BandLocation::near_surface;
    cover.within = location != BandLocation::outside;
    return cover.within;
  }
};

class CoverSearch {
 public:
  CoverSearch(const PartWithBvh& a, const PartWithBvh& b, double band)
      : vertices_(a.placed.part->vertices),
        b_(b),
        shift_(a.placed.origin - b.placed.origin),
        band_(band) {}

  ToleranceContainment run(QueryContext& work) {
    if (vertices_.size() >= kWorthAFrame) {
      const Vertices some = locate_samples();
      work += some.cost;
      if (!some.cover.within) return some.cover;
      if (some.cost.node_pairs > kSamplePoints * kManyNodes) prepare(work.context());
    }
    if (vertices_.size() < kParallelThreshold) {
      const Vertices all = locate_vertices(0, vertices_.size());
      work += all.cost;
      return all.cover;
    }
    return locate_blocks(work);
  }

 private:
  [[nodiscard]] std::size_t blocks() const {
    return (vertices_.size() + kParallelGrain - 1) / kParallelGrain;
  }
  [[nodiscard]] Vec3l at(std::size_t vertex) const {
    return vertices_[vertex].as<std::int64_t>() + shift_;
  }

  /// Prepares the locator for points that cost too much one by one.
  void prepare(const parallel::Context& context) {
    frame_ = frame_along_faces(b_, context);
    if (!frame_) return;
    order_ = morton_order(vertices_.size(),
                          [&](std::size_t v) { return turned(frame_->axes, at(v).as<double>()); });
  }

  ToleranceContainment locate_blocks(QueryContext& work) const {
    // Stops at the first that lies outside, so that the cost is the same for any team.
    const auto blocks_located = parallel::transform_until(
        work.context(), {.name = "vertices in a band", .n = blocks()},
        [&](std::size_t block) {
          return locate_vertices(block * kParallelGrain,
                                 std::min(vertices_.size(), (block + 1) * kParallelGrain));
        },
        [](const Vertices& located) { return !located.cover.within; });
    ToleranceContainment cover{.within = true, .on_surface = true};
    if (!blocks_located) return {};
    for (const Vertices& located : *blocks_located) {
      work += located.cost;
      cover.within = located.cover.within;
      cover.on_surface = cover.on_surface && located.cover.on_surface;
    }
    return cover;
  }

  [[nodiscard]] Vertices locate_samples() const {
    Vertices located;
    QueryContext work;
    PointLocator locator(b_, band_, nullptr);
    for (std::size_t i = 0; i < kSamplePoints; ++i)
      if (!located.add(locator.location(at(i * vertices_.size() / kSamplePoints), work))) break;
    located.cost = work;
    return located;
  }

  [[nodiscard]] Vertices locate_vertices(std::size_t first, std::size_t end) const {
    Vertices located;
    QueryContext work;
    PointLocator locator(b_, band_, frame_ ? &*frame_ : nullptr);
    for (std::size_t i = first; i < end; ++i)
      if (!located.add(locator.location(at(order_.empty() ? i : order_[i]), work))) break;
    located.cost = work;
    return located;
  }

  const std::vector<Vec3i>& vertices_;
  const PartWithBvh& b_;
  Vec3l shift_;
  double band_;
  std::optional<RotatedFrame> frame_;
  std::vector<std::uint32_t>
      order_;  ///< of the vertices, near ones after each other; empty: theirs
};

}  // namespace

ToleranceContainment containment_within(const PartWithBvh& a, const PartWithBvh& b, double band,
                                        QueryContext& work) {
  return CoverSearch(a, b, band).run(work);
}

}  // namespace strake::geometry
