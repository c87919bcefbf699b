// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/triangulate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace strake::geometry {
namespace {

using Engine = std::mt19937;
using First = std::vector<std::uint32_t>;
using Lattice = std::pair<std::int64_t, std::int64_t>;

struct Face {
  std::vector<Lattice> points;
  First first{0};
};

std::vector<Vec3d> lift(const std::vector<Lattice>& points) {
  std::vector<Vec3d> lifted;
  for (const auto& [x, y] : points)
    lifted.push_back({static_cast<double>(x), static_cast<double>(y), 0});
  return lifted;
}

std::int64_t doubled_area(const Lattice& a, const Lattice& b, const Lattice& c) {
  return (b.first - a.first) * (c.second - a.second) - (b.second - a.second) * (c.first - a.first);
}

/// Exact, and checks that every triangle has the sense of the first contour.
std::int64_t doubled_area(const Face& face, const FaceTriangles& t, int sense = 1) {
  std::int64_t sum = 0;
  for (const Triangle& w : t.triangles) {
    const std::int64_t area =
        doubled_area(face.points[w[0]], face.points[w[1]], face.points[w[2]]) * sense;
    EXPECT_GT(area, 0);
    sum += area;
  }
  return sum;
}

/// The contours round a random set of lattice cells, inside on the left, a vertex at every lattice
/// point: touching corners, holes, islands and collinear points galore.
struct Cells {
  int size = 0;
  std::vector<std::uint8_t> filled;

  [[nodiscard]] bool at(int x, int y) const {
    return x >= 0 && y >= 0 && x < size && y < size &&
           filled[static_cast<std::size_t>(y * size + x)] != 0;
  }
};

Cells random_cells(Engine& random, int size) {
  Cells cells{size, std::vector<std::uint8_t>(static_cast<std::size_t>(size * size))};
  const auto density = 2 + random() % 7;
  for (auto& c : cells.filled) c = random() % 10 < density ? 1 : 0;
  return cells;
}

Face contours_of(const Cells& cells) {
  std::multimap<Lattice, Lattice> edges;
  for (int y = 0; y < cells.size; ++y)
    for (int x = 0; x < cells.size; ++x) {
      if (!cells.at(x, y)) continue;
      if (!cells.at(x, y - 1)) edges.insert({{x, y}, {x + 1, y}});
      if (!cells.at(x + 1, y)) edges.insert({{x + 1, y}, {x + 1, y + 1}});
      if (!cells.at(x, y + 1)) edges.insert({{x + 1, y + 1}, {x, y + 1}});
      if (!cells.at(x - 1, y)) edges.insert({{x, y + 1}, {x, y}});
    }
  Face face;
  while (!edges.empty()) {
    const Lattice start = edges.begin()->first;
    Lattice here = start;
    do {
      face.points.push_back(here);
      const auto edge = edges.find(here);
      here = edge->second;
      edges.erase(edge);
    } while (here != start);
    face.first.push_back(static_cast<std::uint32_t>(face.points.size()));
  }
  return face;
}

std::set<std::pair<Lattice, Lattice>> boundary_of(const Face& face, const FaceTriangles& t) {
  std::set<std::pair<Lattice, Lattice>> edges;
  for (const Triangle& w : t.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Lattice a = face.points[w[k]], b = face.points[w[(k + 1) % 3]];
      if (edges.erase({b, a}) == 0) edges.insert({a, b});
    }
  return edges;
}

std::set<std::pair<Lattice, Lattice>> contour_edges(const Face& face) {
  std::set<std::pair<Lattice, Lattice>> edges;
  for (std::size_t c = 0; c + 1 < face.first.size(); ++c)
    for (std::uint32_t i = face.first[c]; i < face.first[c + 1]; ++i)
      edges.insert(
          {face.points[i], face.points[i + 1 == face.first[c + 1] ? face.first[c] : i + 1]});
  return edges;
}

TEST(Triangulate, CellsGiveTheExactAreaAndKeepEveryEdge) {
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    Engine random(seed);
    const Cells cells = random_cells(random, 1 + static_cast<int>(random() % 12));
    const Face face = contours_of(cells);
    if (face.points.empty()) continue;
    const FaceTriangles t = triangulate_face(lift(face.points), face.first);
    ASSERT_EQ(t.fault, FaceFault::none);
    EXPECT_EQ(doubled_area(face, t),
              2 * std::count(cells.filled.begin(), cells.filled.end(), std::uint8_t{1}));
    EXPECT_EQ(boundary_of(face, t), contour_edges(face));
  }
}

/// Drops most points in the middle of straight runs, so that corners of other contours come to
/// lie inside edges.
Face thinned(const Face& face, Engine& random) {
  Face thin;
  for (std::size_t c = 0; c + 1 < face.first.size(); ++c) {
    const std::uint32_t begin = face.first[c], end = face.first[c + 1];
    for (std::uint32_t i = begin; i < end; ++i) {
      const Lattice &p = face.points[i == begin ? end - 1 : i - 1], &q = face.points[i],
                    &r = face.points[i + 1 == end ? begin : i + 1];
      if (doubled_area(p, q, r) != 0 || random() % 4 == 0) thin.points.push_back(q);
    }
    thin.first.push_back(static_cast<std::uint32_t>(thin.points.size()));
  }
  return thin;
}

TEST(Triangulate, TouchingContoursWithLongEdgesKeepTheArea) {
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    Engine random(seed + 1000);
    const Cells cells = random_cells(random, 2 + static_cast<int>(random() % 10));
    if (std::count(cells.filled.begin(), cells.filled.end(), std::uint8_t{1}) == 0) continue;
    const Face face = thinned(contours_of(cells), random);
    const FaceTriangles t = triangulate_face(lift(face.points), face.first);
    ASSERT_EQ(t.fault, FaceFault::none);
    EXPECT_EQ(doubled_area(face, t),
              2 * std::count(cells.filled.begin(), cells.filled.end(), std::uint8_t{1}));
  }
}

TEST(Triangulate, SenseOfTheFirstContourIsKeptAndThatOfHolesIgnored) {
  Face face;
  face.points = {{0, 0}, {0, 9}, {9, 9}, {9, 0}, {3, 3}, {6, 3}, {6, 6}, {3, 6}};
  face.first = {0, 4, 8};
  for (int turn = 0; turn < 2; ++turn) {
    const FaceTriangles t = triangulate_face(lift(face.points), face.first);
    ASSERT_EQ(t.fault, FaceFault::none);
    EXPECT_EQ(doubled_area(face, t, -1), 2 * 72);
    std::reverse(face.points.begin() + 4, face.points.end());
  }
}

TEST(Triangulate, AnyPlaneAnyPlaceAnyScale) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    Engine random(seed);
    const Cells cells = random_cells(random, 8);
    const Face face = contours_of(cells);
    if (face.points.empty()) continue;
    std::uniform_real_distribution<double> value(-1, 1);
    const Vec3d u{value(random), value(random), value(random)},
        v{value(random), value(random), value(random)};
    const double scale = std::ldexp(1.0, static_cast<int>(random() % 40) - 20);
    const Vec3d origin = Vec3d{value(random), value(random), value(random)} * (1000 * scale);
    std::vector<Vec3d> points;
    for (const auto& [x, y] : face.points)
      points.push_back(origin + (u * static_cast<double>(x) + v * static_cast<double>(y)) * scale);
    const FaceTriangles t = triangulate_face(points, face.first);
    ASSERT_EQ(t.fault, FaceFault::none);
    // Rounding may fold slivers at collinear points; the area must still be right.
    Vec3d sum{};
    for (const Triangle& w : t.triangles)
      sum = sum + cross(points[w[1]] - points[w[0]], points[w[2]] - points[w[0]]);
    const auto count = std::count(cells.filled.begin(), cells.filled.end(), std::uint8_t{1});
    const Vec3d want = cross(u, v) * (2.0 * static_cast<double>(count) * scale * scale);
    const Vec3d gap = sum - want;
    EXPECT_LT(std::sqrt(dot(gap, gap)), 1e-5 * std::sqrt(dot(want, want)));
  }
}

/// Even-odd rule for a point at odd eighths, which no lattice edge passes through... unless it
/// does: then the caller picks another.
int parity(const Face& face, const Lattice& p, bool& on_edge) {
  int crossings = 0;
  for (std::size_t c = 0; c + 1 < face.first.size(); ++c)
    for (std::uint32_t i = face.first[c]; i < face.first[c + 1]; ++i) {
      const Lattice& a = face.points[i];
      const Lattice& b = face.points[i + 1 == face.first[c + 1] ? face.first[c] : i + 1];
      const std::int64_t side = doubled_area(a, b, p);
      on_edge = on_edge || (side == 0 && a != b);
      if ((a.second > p.second) == (b.second > p.second)) continue;
      if ((side > 0) == (b.second > a.second)) ++crossings;
    }
  return crossings % 2;
}

// Contours of random lattice points: nearly always nonsense. Never a crash, and what is not a
// fault is right at sampled points.
TEST(Triangulate, NonsenseIsEitherAFaultOrRight) {
  int good = 0, crossing = 0;
  for (std::uint32_t seed = 0; seed < 6000; ++seed) {
    SCOPED_TRACE(seed);
    Engine random(seed);
    const auto span = 2 + random() % 5;
    Face face;
    const auto contours = 1 + random() % 3;
    for (std::uint32_t c = 0; c < contours; ++c) {
      const auto count = 1 + random() % 7;
      for (std::uint32_t i = 0; i < count; ++i)
        face.points.emplace_back(static_cast<std::int64_t>(random() % span) * 16,
                                 static_cast<std::int64_t>(random() % span) * 16);
      face.first.push_back(static_cast<std::uint32_t>(face.points.size()));
    }
    const FaceTriangles t = triangulate_face(lift(face.points), face.first);
    crossing += t.fault == FaceFault::crossing ? 1 : 0;
    if (t.fault != FaceFault::none) continue;
    ++good;
    std::int64_t outer = 0;
    for (std::uint32_t i = 1; i + 1 < face.first[1]; ++i)
      outer += doubled_area(face.points[0], face.points[i], face.points[i + 1]);
    const int sense = outer > 0 ? 1 : -1;
    (void)doubled_area(face, t, sense);
    for (int sample = 0; sample < 20; ++sample) {
      const Lattice p{static_cast<std::int64_t>(random() % (span * 16)),
                      static_cast<std::int64_t>(random() % (span * 16))};
      bool on_edge = false;
      const int wanted = parity(face, p, on_edge);
      if (on_edge) continue;
      int covered = 0, on_side = 0;
      for (const Triangle& w : t.triangles) {
        std::array<std::int64_t, 3> s{};
        for (std::size_t k = 0; k < 3; ++k)
          s[k] = doubled_area(face.points[w[k]], face.points[w[(k + 1) % 3]], p) * sense;
        covered += s[0] > 0 && s[1] > 0 && s[2] > 0 ? 1 : 0;
        on_side += s[0] >= 0 && s[1] >= 0 && s[2] >= 0 ? 1 : 0;
      }
      if (on_side == covered) {
        EXPECT_EQ(covered, wanted);
      }
    }
  }
  EXPECT_GT(good, 500);
  EXPECT_GT(crossing, 500);
}

TEST(Triangulate, CollinearPointsOnOneSideStayVertices) {
  Face face;
  face.points = {{0, 0}, {1, 0}, {2, 0}, {5, 0}, {5, 3}, {0, 3}};
  face.first = {0, 6};
  const FaceTriangles t = triangulate_face(lift(face.points), face.first);
  EXPECT_EQ(t.triangles.size(), 4U);
  EXPECT_EQ(boundary_of(face, t), contour_edges(face));
}

TEST(Triangulate, BridgedHoleIsUnderstood) {
  // One contour that runs to its hole and back along the same line.
  Face face;
  face.points = {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 3}, {3, 6}, {6, 6}, {6, 3}, {3, 3}};
  face.first = {0, 10};
  const FaceTriangles t = triangulate_face(lift(face.points), face.first);
  ASSERT_EQ(t.fault, FaceFault::none);
  EXPECT_EQ(doubled_area(face, t), 2 * 72);
}

TEST(Triangulate, NearlyPlanarFaceWorks) {
  Engine random(5);
  std::uniform_real_distribution<double> noise(-0.01, 0.01);
  std::vector<Vec3d> points;
  for (int i = 0; i < 40; ++i) {
    const double a = 2 * 3.14159265358979 * i / 40, r = i % 2 == 0 ? 10 : 4;
    points.push_back({r * std::cos(a), r * std::sin(a), noise(random)});
  }
  const FaceTriangles t = triangulate_face(points);
  ASSERT_EQ(t.fault, FaceFault::none);
  EXPECT_EQ(t.triangles.size(), 38U);
}

TEST(Triangulate, FaultsAreNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double huge = std::numeric_limits<double>::max();
  EXPECT_EQ(triangulate_face(std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, nan, 0}}).fault,
            FaceFault::not_finite);
  EXPECT_EQ(triangulate_face(std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}).fault,
            FaceFault::no_area);
  EXPECT_EQ(triangulate_face(std::vector<Vec3d>{}).fault, FaceFault::no_area);
  EXPECT_EQ(triangulate_face(std::vector<Vec3d>{{0, 0, 0}}).fault, FaceFault::no_area);
  EXPECT_EQ(triangulate_face(std::vector<Vec3d>{{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {0, 3, 0}}).fault,
            FaceFault::crossing);
  EXPECT_EQ(triangulate_face(std::vector<Vec3d>{{-huge, 0, 0}, {huge, 0, 0}, {0, huge, 0}}).fault,
            FaceFault::none);
  EXPECT_EQ(describe(FaceFault::crossing), "contours cross");
}

TEST(Triangulate, ThousandsOfVerticesAreQuick) {
  // A comb: long thin parts, many collinear points.
  Face comb;
  constexpr std::int64_t kTeeth = 1000;
  for (std::int64_t i = 0; i < kTeeth; ++i) {
    comb.points.emplace_back(4 * i, 0);
    comb.points.emplace_back(4 * i + 2, 0);
    comb.points.emplace_back(4 * i + 2, 1000);
    comb.points.emplace_back(4 * i + 4, 1000);
  }
  comb.points.emplace_back(4 * kTeeth, -10);
  comb.points.emplace_back(0, -10);
  comb.first = {0, static_cast<std::uint32_t>(comb.points.size())};
  const FaceTriangles t = triangulate_face(lift(comb.points), comb.first);
  ASSERT_EQ(t.fault, FaceFault::none);
  EXPECT_EQ(doubled_area(comb, t, -1), 2 * (kTeeth * 2 * 1000 + kTeeth * 4 * 10));
}

std::int64_t doubled_area_of(const std::vector<Lattice>& outline) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < outline.size(); ++i)
    sum += doubled_area({0, 0}, outline[i], outline[i + 1 == outline.size() ? 0 : i + 1]);
  return sum;
}

/// The outline's area to the last unit, n - 2 triangles, and every edge of the outline among them.
void expect_whole(const std::vector<Lattice>& outline) {
  Face face{outline, {0, static_cast<std::uint32_t>(outline.size())}};
  const FaceTriangles t = triangulate_face(lift(outline), face.first);
  ASSERT_EQ(t.fault, FaceFault::none);
  EXPECT_EQ(t.triangles.size(), outline.size() - 2);
  const std::int64_t whole = doubled_area_of(outline);
  // Triangles have the sense of the contour.
  EXPECT_EQ(doubled_area(face, t, whole > 0 ? 1 : -1), std::abs(whole));
}

/// The teeth of a comb lie along x or along y: a sweep along them has the whole comb as its front.
TEST(Triangulate, ACombOfFiftyThousandVerticesIsQuick) {
  for (const bool turned : {false, true}) {
    std::vector<Lattice> comb{{0, 0}};
    for (std::int64_t i = 0; i < 25'000; ++i) {
      comb.emplace_back(2 * i, 1000);
      comb.emplace_back(2 * i + 1, 10);
    }
    comb.emplace_back(50'000, 0);
    if (turned)
      for (auto& [x, y] : comb) std::swap(x, y);
    expect_whole(comb);
  }
}

TEST(Triangulate, ASpikyWheelOfTwentyThousandVerticesIsQuick) {
  // Round a square: corners on its sides, and points of a small square within.
  constexpr std::int64_t kSide = 2'500, kFarAway = 400'000;
  std::vector<Lattice> rim, hub;
  for (std::int64_t s = 0; s < 4; ++s)
    for (std::int64_t i = 0; i < kSide; ++i) {
      const auto turn = [&](std::int64_t x, std::int64_t y) {
        for (std::int64_t k = 0; k < s; ++k) std::tie(x, y) = std::pair(-y, x);
        return Lattice{x, y};
      };
      rim.push_back(turn(kFarAway, (2 * i - kSide) * (kFarAway / kSide)));
      hub.push_back(turn(2 * kSide, 2 * (2 * i - kSide) + 2));
    }
  std::vector<Lattice> wheel;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    wheel.push_back(rim[i]);
    wheel.push_back(hub[i]);
  }
  expect_whole(wheel);
}

/// Slanted teeth: every edge of the outline crosses a fan of Delaunay edges.
TEST(Triangulate, SlantedTeethAreQuick) {
  constexpr std::int64_t kTeeth = 1'500;
  std::vector<Lattice> saw;
  for (std::int64_t i = 0; i < kTeeth; ++i) {
    saw.emplace_back(0, 8 * i);
    saw.emplace_back(100'000, 8 * (kTeeth + i));
  }
  for (const Lattice& corner :
       {Lattice{0, 8 * kTeeth}, Lattice{-100, 8 * kTeeth}, Lattice{-100, -5}, Lattice{50'000, -6}})
    saw.push_back(corner);
  expect_whole(saw);
}

TEST(Triangulate, ThousandsOfHolesAreQuick) {
  constexpr std::int64_t kAcross = 70;
  Face plate{{{-1, -1}, {4 * kAcross, -1}, {4 * kAcross, 4 * kAcross}, {-1, 4 * kAcross}}, {0, 4}};
  for (std::int64_t i = 0; i < kAcross * kAcross; ++i) {
    const std::int64_t x = 4 * (i % kAcross), y = 4 * (i / kAcross);
    for (const Lattice& corner :
         {Lattice{x, y}, Lattice{x + 2, y + 1}, Lattice{x + 2, y + 2}, Lattice{x, y + 2}})
      plate.points.push_back(corner);
    plate.first.push_back(static_cast<std::uint32_t>(plate.points.size()));
  }
  const FaceTriangles t = triangulate_face(lift(plate.points), plate.first);
  ASSERT_EQ(t.fault, FaceFault::none);
  const std::int64_t side = 4 * kAcross + 1;
  EXPECT_EQ(doubled_area(plate, t), 2 * side * side - 6 * kAcross * kAcross);
}

}  // namespace
}  // namespace strake::geometry
