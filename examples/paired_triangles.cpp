// SPDX-License-Identifier: Apache-2.0
// Triangles of a mesh paired to quadrilaterals, the squarest first: each pair changes what the next
// ones may do, so the order counts. The same pairs as a plain loop makes, for any team.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <vector>

#include "strake/parallel/reservations.hpp"
#include "strake/parallel/team.hpp"

namespace {

using Triangle = std::array<std::uint32_t, 3>;
struct Point {
  double x, y;
};

/// A plate of kSide x kSide cells, each cut along one of its diagonals, its nodes a little astray.
constexpr std::uint32_t kSide = 150;

struct Plate {
  std::vector<Point> nodes;
  std::vector<Triangle> triangles;
};

Plate make_plate() {
  Plate plate;
  std::uint64_t state = 7;
  const auto random = [&state] {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state >> 40U) / static_cast<double>(1U << 24U);
  };
  for (std::uint32_t y = 0; y <= kSide; ++y)
    for (std::uint32_t x = 0; x <= kSide; ++x)
      plate.nodes.push_back({x + 0.8 * random(), y + 0.8 * random()});
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const std::uint32_t a = y * (kSide + 1) + x, b = a + 1, c = a + kSide + 1, d = c + 1;
      if (random() < 0.5) {
        plate.triangles.push_back({a, b, d});
        plate.triangles.push_back({a, d, c});
      } else {
        plate.triangles.push_back({a, b, c});
        plate.triangles.push_back({b, d, c});
      }
    }
  return plate;
}

/// Two triangles with a common edge, and how far their quadrilateral is from a rectangle, radians.
struct Pair {
  std::array<std::uint32_t, 2> triangles;
  double skew;
};

double angle(const Point& before, const Point& at, const Point& after) {
  const double ux = before.x - at.x, uy = before.y - at.y;
  const double vx = after.x - at.x, vy = after.y - at.y;
  return std::acos((ux * vx + uy * vy) / (std::hypot(ux, uy) * std::hypot(vx, vy)));
}

std::vector<Pair> pairs_squarest_first(const Plate& plate) {
  struct Side {
    std::uint32_t low, high, triangle, opposite;
  };
  std::vector<Side> sides;
  for (std::uint32_t t = 0; t < plate.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Triangle& corner = plate.triangles[t];
      const auto [low, high] = std::minmax(corner[k], corner[(k + 1) % 3]);
      sides.push_back({low, high, t, corner[(k + 2) % 3]});
    }
  std::ranges::sort(
      sides, {}, [](const Side& side) { return std::array{side.low, side.high, side.triangle}; });
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const Side &one = sides[i], &two = sides[i + 1];
    if (one.low != two.low || one.high != two.high) continue;
    const std::array<Point, 4> corner = {plate.nodes[one.low], plate.nodes[one.opposite],
                                         plate.nodes[one.high], plate.nodes[two.opposite]};
    double skew = 0;
    for (std::size_t k = 0; k < 4; ++k)
      skew = std::max(skew, std::abs(angle(corner[k], corner[(k + 1) % 4], corner[(k + 2) % 4]) -
                                     std::numbers::pi / 2));
    pairs.push_back({{one.triangle, two.triangle}, skew});
  }
  std::ranges::sort(pairs, [](const Pair& a, const Pair& b) {
    return a.skew != b.skew ? a.skew < b.skew : a.triangles < b.triangles;
  });
  return pairs;
}

}  // namespace

int main() {
  using namespace strake;
  using namespace strake::parallel;
  const Plate plate = make_plate();
  const std::vector<Pair> pairs = pairs_squarest_first(plate);
  constexpr std::uint32_t kAlone = 0;  // otherwise a pair's number and one

  std::vector<std::uint32_t> expected(plate.triangles.size(), kAlone);
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    const auto [left, right] = pairs[i].triangles;
    if (expected[left] == kAlone && expected[right] == kAlone)
      expected[left] = expected[right] = i + 1;
  }

  for (const unsigned workers : {1U, 2U, 3U, 8U, 64U}) {
    Team team(workers);
    std::vector<std::uint32_t> pair_of(plate.triangles.size(), kAlone);
    const Result<ReservedRun> run = for_each_reserved(
        {.team = &team}, {.name = "pairs", .n = pairs.size(), .grain = 256}, pair_of.size(),
        [&](std::size_t i, Claims& claims) {
          const auto [left, right] = pairs[i].triangles;
          claims(left);
          claims(right);
          return pair_of[left] == kAlone && pair_of[right] == kAlone;
        },
        [&](std::size_t i) {
          for (const std::uint32_t triangle : pairs[i].triangles)
            pair_of[triangle] = static_cast<std::uint32_t>(i) + 1;
        });
    if (!run || pair_of != expected) return 1;
    if (workers == 1)
      std::printf("%zu possible pairs, asked for %.2f times each in %llu rounds\n", pairs.size(),
                  static_cast<double>(run->claims) / static_cast<double>(pairs.size()),
                  static_cast<unsigned long long>(run->rounds));
  }
  const auto alone = static_cast<std::size_t>(std::ranges::count(expected, kAlone));
  std::printf("%zu triangles: %zu quadrilaterals and %zu triangles left\n", plate.triangles.size(),
              (plate.triangles.size() - alone) / 2, alone);
  return 0;
}
