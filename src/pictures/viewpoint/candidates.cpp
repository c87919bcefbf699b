// SPDX-License-Identifier: Apache-2.0
#include "pictures/viewpoint/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include "pictures/viewpoint/item_buffer.hpp"
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

/// What a window shows of the two.
struct Seen {
  double a = 0, b = 0;  ///< shares of the window
  double at_point = 0;  ///< the share of the two of what lies round the point
};

Seen count(const ItemBuffer& buffer, std::span<const NearTriangle> triangles) {
  constexpr double kMiddle = kPoints * 0.5, kWindow = kMiddle * kMiddle, kPoint = kPoints / 9.0;
  std::uint32_t window = 0, point = 0, of_a = 0, of_b = 0, both_at_point = 0;
  for (std::uint32_t row = 0; row < kPoints; ++row)
    for (std::uint32_t column = 0; column < kPoints; ++column) {
      const double x = column + 0.5 - kMiddle, y = row + 0.5 - kMiddle, square = x * x + y * y;
      if (square > kWindow) continue;
      const std::uint32_t triangle = buffer.at(column, row).triangle;
      const Role role = triangle == ItemBuffer::kNothing ? Role::other : triangles[triangle].role;
      ++window;
      of_a += role == Role::a ? 1 : 0;
      of_b += role == Role::b ? 1 : 0;
      if (square > kPoint * kPoint) continue;
      ++point;
      both_at_point += role != Role::other ? 1 : 0;
    }
  const auto share = [](std::uint32_t part, std::uint32_t whole) {
    return static_cast<double>(part) / static_cast<double>(whole);
  };
  return {share(of_a, window), share(of_b, window), share(both_at_point, point)};
}

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

double visible_share(std::span<const NearTriangle> triangles, const Vec3d& viewer,
                     const Sight& sight) {
  Window window{Axes::towards(viewer),
                sight.half_mm,
                sight.half_mm,
                kPoints,
                kPoints,
                std::min(sight.eye_mm, sight.cut_mm)};
  window.closes_cuts = sight.cut_mm < sight.eye_mm;
  std::vector<NearTriangle> two;
  if (!sight.others) {
    std::ranges::copy_if(triangles, std::back_inserter(two),
                         [](const NearTriangle& t) { return t.role != Role::other; });
    triangles = two;
  }
  const Seen seen = count(ItemBuffer(window, triangles), triangles);
  if (seen.a == 0 || seen.b == 0) return 0;
  constexpr double kWithoutPoint = 0.2;
  return 2 * seen.a * seen.b / (seen.a + seen.b) *
         (kWithoutPoint + (1 - kWithoutPoint) * seen.at_point);
}

double liking(const Vec3d& viewer) {
  constexpr double kPlan = 0.95, kLow = 0.15, kBelow = -0.15;
  const Vec3d to = unit(viewer);
  const bool along_axis = std::max({std::fabs(to.x), std::fabs(to.y), std::fabs(to.z)}) > kPlan;
  const double upright = to.z < kBelow ? 0.8 : to.z < kLow ? 0.92 : 1;
  return upright * (along_axis ? 0.8 : 1);
}

double worth(double share) {
  constexpr double kHalf = 0.1;
  return share / (share + kHalf);
}

Result<std::vector<Candidate>> judge(std::span<const NearTriangle> triangles,
                                     std::span<const Vec3d> directions, const Sight& sight,
                                     const parallel::Context& context) {
  return parallel::transform(
      context, {.name = "viewpoints", .n = directions.size()}, [&](std::size_t i) {
        const double share = visible_share(triangles, directions[i], sight);
        return Candidate{directions[i], share, worth(share) * liking(directions[i])};
      });
}

Result<Candidate> find_best(std::span<const NearTriangle> triangles,
                            std::span<const Vec3d> directions, const Sight& sight,
                            const parallel::Context& context) {
  std::vector<NearTriangle> two;
  std::ranges::copy_if(triangles, std::back_inserter(two),
                       [](const NearTriangle& t) { return t.role != Role::other; });
  const Result<std::vector<Candidate>> bounds = judge(two, directions, sight, context);
  if (!bounds) return bounds.error();
  if (!sight.others) return best_of(*bounds);
  std::vector<std::size_t> order(directions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return std::pair(-(*bounds)[i].rank, i); });
  // Others only take from what is seen, so that no rank is above its bound.
  constexpr std::size_t kAtOnce = 4;
  std::optional<std::pair<Candidate, std::size_t>> best;
  for (std::size_t first = 0; first < order.size(); first += kAtOnce) {
    if (best && (*bounds)[order[first]].rank < best->first.rank) break;
    std::vector<Vec3d> some;
    for (std::size_t k = first; k < std::min(order.size(), first + kAtOnce); ++k)
      some.push_back(directions[order[k]]);
    const Result<std::vector<Candidate>> judged = judge(triangles, some, sight, context);
    if (!judged) return judged.error();
    for (std::size_t k = 0; k < some.size(); ++k) {
      const Candidate& one = (*judged)[k];
      const std::size_t number = order[first + k];
      if (!best || one.rank > best->first.rank ||
          (one.rank == best->first.rank && number < best->second))
        best.emplace(one, number);
    }
  }
  return best->first;
}

const Candidate& best_of(std::span<const Candidate> candidates) {
  return *std::ranges::max_element(candidates, {}, &Candidate::rank);
}

}  // namespace strake::pictures
