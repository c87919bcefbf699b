// SPDX-License-Identifier: Apache-2.0
#include "geometry/point_placer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/corners.hpp"
#include "geometry/directions.hpp"
#include "geometry/point_distance.hpp"
#include "geometry/segment_box.hpp"
#include "geometry/tree_walk.hpp"
#include "strake/geometry/part_edges.hpp"
#include "strake/geometry/part_frame.hpp"

namespace strake::geometry {
namespace {

/// Triangles that are walked over from one that had a point near, in search of the next point's.
constexpr int kSteps = 64;

}  // namespace

std::optional<TurnedFrame> frame_along_faces(const TreedPart& part,
                                             const parallel::Context& context) {
  const Axes axes = square_axes(*part.placed.part);
  auto turned = turned_part(PartView(part, {}), axes, context);
  if (!turned) return std::nullopt;
  return TurnedFrame{axes, std::move(*turned)};
}

PointPlacer::PointPlacer(const TreedPart& part, double band, const TurnedFrame* frame)
    : part_(part),
      view_(part, {}),
      band_(band),
      frame_(frame),
      boxes_(frame == nullptr ? BoxedTree(view_) : BoxedTree(frame->part)) {}

PointPlace PointPlacer::place(const Vec3l& at, PairWork& work) {
  const Vec3d p = at.as<double>();
  const Vec3d in_frame = frame_ == nullptr ? p : turned(frame_->axes, p);
  if (near_skin(p, in_frame, work)) return PointPlace::near_skin;
  const Sided* known = frame_ == nullptr ? nullptr : same_side(in_frame, work);
  const bool outside = known != nullptr ? known->side == PointPlace::outside
                                        : side_of(part_, at, 1, work) == PointSide::outside;
  const PointPlace side = outside ? PointPlace::outside : PointPlace::inside;
  sided_[sided_count_++ % kRemembered] = {in_frame, side};
  return side;
}

bool PointPlacer::is_near(const Vec3d& p, std::uint32_t triangle) const {
  return std::sqrt(squared_distance(p, corners_of(view_.part(), triangle))) <= band_;
}

/// At the last triangles that had a point near, or round them.
bool PointPlacer::is_near_known(const Vec3d& p, PairWork& work) {
  const std::size_t known = std::min(near_count_, kRemembered);
  for (std::size_t i = 1; i <= known; ++i) {
    std::uint32_t t = near_[(near_count_ - i) % kRemembered];
    for (int step = 0; step < kSteps && t != kNoFace; ++step) {
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

/// The neighbour of a triangle over the side that a point lies farthest beyond; none over the rim
/// of a sheet, or where it lies beyond no side.
std::uint32_t PointPlacer::towards(const Vec3d& p, std::uint32_t triangle) const {
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
  if (side < 0 || part.edges.empty()) return kNoFace;
  const Triangle& t = part.triangles[triangle];
  const auto at = [&](int i) { return t[static_cast<std::size_t>(i % 3)]; };
  const std::uint32_t edge = edge_between(part, at(side), at(side + 1));
  if (edge == kNoFace) return kNoFace;
  for (const std::uint32_t other : triangles_round(part, edge))
    if (other != triangle) return other;
  return kNoFace;
}

/// Calls visit(triangle) for triangles that may be near a point until it returns false.
template <class Visit>
bool PointPlacer::candidates(const Vec3d& in_frame, PairWork& work, const Visit& visit) const {
  const double reach = band_ + 1;
  const auto may_be_near = [&](const Box3d& box) {
    return squared_gap(in_frame, box) <= reach * reach;
  };
  return walk_tree(
      boxes_.tree(),
      [&](const PartTree::Node& node) {
        ++work.node_pairs;
        return may_be_near(boxes_.box(node));
      },
      [&](std::uint32_t t) {
        return (frame_ != nullptr && !may_be_near(boxes_.turned_box(t))) || visit(t);
      });
}

bool PointPlacer::near_skin(const Vec3d& p, const Vec3d& in_frame, PairWork& work) {
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

/// The nearest of the last points, if there is certainly no skin between.
const PointPlacer::Sided* PointPlacer::same_side(const Vec3d& in_frame, PairWork& work) const {
  const auto last =
      sided_.begin() + static_cast<std::ptrdiff_t>(std::min(sided_count_, kRemembered));
  const auto squared = [&](const Sided& s) { return dot(s.at - in_frame, s.at - in_frame); };
  const auto nearest = std::min_element(sided_.begin(), last, [&](const Sided& x, const Sided& y) {
    return squared(x) < squared(y);
  });
  if (nearest == last) return nullptr;
  const bool apart = walk_tree(
      boxes_.tree(),
      [&](const PartTree::Node& node) {
        ++work.node_pairs;
        return may_meet(in_frame, nearest->at, boxes_.box(node).inflated(kFrameRounding));
      },
      [&](std::uint32_t t) {
        return !may_meet(in_frame, nearest->at, boxes_.turned_box(t).inflated(kFrameRounding));
      });
  return apart ? &*nearest : nullptr;
}

void PointPlacer::remember(std::uint32_t triangle) {
  near_[near_count_++ % kRemembered] = triangle;
}

}  // namespace strake::geometry
