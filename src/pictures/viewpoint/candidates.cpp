// SPDX-License-Identifier: Apache-2.0
#include "pictures/viewpoint/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>

#include "pictures/viewpoint/visibility_buffer.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::pictures {
namespace {

using geometry::Vec3d;

/// Points of the square window, each way.
constexpr std::uint32_t kPoints = 30;

/// Adds directions square to `away` and those a third of a right angle beside it.
void add_about(const Vec3d& away, std::vector<Vec3d>& out) {
  const Vec3d n = unit(away);
  const Vec3d least = std::fabs(n.z) < 0.9 ? Vec3d{0, 0, 1} : Vec3d{1, 0, 0};
  const Vec3d u = unit(cross(n, least)), v = cross(n, u);
  for (const double side : {1.0, -1.0})
    for (const Vec3d& beside : {u, v, -u, -v}) out.push_back(unit(n * side + beside * 0.6));
  for (const Vec3d& square : {u + v * 0.3, v - u * 0.3, -u - v * 0.3, u * 0.3 - v})
    out.push_back(unit(square));
}

Window window_of(const Vec3d& viewer, const Sight& sight) {
  Window window{Axes::towards(viewer),
                sight.half_mm,
                sight.half_mm,
                kPoints,
                kPoints,
                std::min(sight.eye_mm, sight.cut_mm)};
  window.closes_cuts = sight.cut_mm < sight.eye_mm;
  return window;
}

/// Returns how well the two are seen in what a window shows.
double visibility(const VisibleShares& projected) {
  if (projected.a == 0 || projected.b == 0) return 0;
  constexpr double kWithoutPoint = 0.2;
  return 2 * projected.a * projected.b / (projected.a + projected.b) *
         (kWithoutPoint + (1 - kWithoutPoint) * projected.at_point);
}

ViewCandidate candidate_of(const Vec3d& viewer, double share) {
  return {viewer, share, share_score(share) * direction_preference(viewer)};
}

/// A direction and what it shows of the two where nothing else stands before them.
struct ScoreBound {
  VisibilityBuffer sight;
  ViewCandidate alone;
};

}  // namespace

std::vector<Vec3d> candidate_directions(const Vec3d& away) {
  std::vector<Vec3d> out;
  for (const double z : {3.0, -3.0})
    for (const double x : {1.0, -1.0})
      for (const double y : {-1.0, 1.0}) {
        out.push_back(unit({4 * x, 5 * y, z * 1.2}));
        out.push_back(unit({5 * x, 3 * y, z * 0.8}));
      }
  for (const double side : {1.0, -1.0}) {
    out.push_back(unit({0.3, -0.4, 4 * side}));
    out.push_back(unit({4 * side, -0.6, 0.9}));
    out.push_back(unit({0.6, -4 * side, 0.9}));
  }
  for (const Vec3d& axis : {Vec3d{0, 0, 1}, Vec3d{0, -1, 0}, Vec3d{1, 0, 0}, Vec3d{-1, 0, 0},
                            Vec3d{0, 1, 0}, Vec3d{0, 0, -1}})
    out.push_back(axis);
  if (dot(away, away) > 0.5) add_about(away, out);
  return out;
}

double visible_share(const NearTriangles& triangles, const Vec3d& viewer, const Sight& sight) {
  const Window window = window_of(viewer, sight);
  VisibilityBuffer buffer(window, triangles);
  buffer.cover(window, triangles);
  return visibility(buffer.shares());
}

double direction_preference(const Vec3d& viewer) {
  constexpr double kPlan = 0.95, kLow = 0.15, kBelow = -0.15;
  const Vec3d to = unit(viewer);
  const bool along_axis = std::max({std::fabs(to.x), std::fabs(to.y), std::fabs(to.z)}) > kPlan;
  const double upright = to.z < kBelow ? 0.8 : to.z < kLow ? 0.92 : 1;
  return upright * (along_axis ? 0.8 : 1);
}

double share_score(double share) {
  constexpr double kHalf = 0.1;
  return share / (share + kHalf);
}

Result<std::vector<ViewCandidate>> evaluate_candidates(const NearTriangles& triangles,
                                                       std::span<const Vec3d> directions,
                                                       const Sight& sight,
                                                       const parallel::Context& context) {
  return parallel::transform(
      context, {.name = "viewpoints", .n = directions.size()}, [&](std::size_t i) {
        return candidate_of(directions[i], visible_share(triangles, directions[i], sight));
      });
}

Result<BestCandidates> find_best(const NearTriangles& triangles, std::span<const Vec3d> directions,
                                 const Sight& sight, const parallel::Context& context) {
  Result<std::vector<ScoreBound>> bounds = parallel::transform(
      context, {.name = "viewpoints", .n = directions.size()}, [&](std::size_t i) {
        VisibilityBuffer alone(window_of(directions[i], sight), triangles);
        const double share = visibility(alone.shares());
        return ScoreBound{std::move(alone), candidate_of(directions[i], share)};
      });
  if (!bounds) return bounds.error();
  const auto before = [&](std::size_t i) { return std::pair(-(*bounds)[i].alone.rank, i); };
  std::vector<std::size_t> order(directions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, before);
  // Others only take from what is seen, so that no rank is above its bound.
  std::optional<std::pair<ViewCandidate, std::size_t>> best;
  for (const std::size_t number : order) {
    ScoreBound& bound = (*bounds)[number];
    if (best && bound.alone.rank < best->first.rank) break;
    if (context.stop.stop_requested()) return Error{ErrorCode::cancelled, "cancelled", {}, {}};
    bound.sight.cover(window_of(directions[number], sight), triangles);
    const ViewCandidate one = candidate_of(directions[number], visibility(bound.sight.shares()));
    if (!best || one.rank > best->first.rank ||
        (one.rank == best->first.rank && number < best->second))
      best.emplace(one, number);
  }
  return BestCandidates{best->first, (*bounds)[order.front()].alone};
}

const ViewCandidate& best_of(std::span<const ViewCandidate> candidates) {
  return *std::ranges::max_element(candidates, {}, &ViewCandidate::rank);
}

}  // namespace strake::pictures
