// SPDX-License-Identifier: Apache-2.0
// Turned bodies whose faces fan out from one axis, often flush with each other: meet() against the
// cells of their profiles.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "geometry/intersect/coplanar_faces.hpp"
#include "strake/geometry/part_pair.hpp"
#include "support/draw.hpp"
#include "support/part_builder.hpp"
#include "support/rounds.hpp"

namespace strake::geometry {
namespace {

using test::Draw;
using testing::IndexedMesh;
using testing::Subject;

constexpr std::uint64_t kRounds = test::rounds(250U, 20'000U);
constexpr int kSize = 4;
constexpr std::int32_t kRing = 7000, kStorey = 9000;

/// Cells of a half-plane beside the axis: by ring and storey.
using Cell = std::pair<int, int>;
using Profile = std::set<Cell>;

/// A profile turned round the axis: n flat sides in place of each circle.
class TurnedBody {
 public:
  TurnedBody(const Profile& profile, int sides, int axis) : sides_(sides), axis_(axis) {
    const auto has = [&](int ring, int storey) {
      return ring >= 0 && profile.contains({ring, storey});
    };
    for (int i = 0; i <= kSize; ++i)
      for (int j = 0; j <= kSize; ++j) {
        if (i > 0 && has(i - 1, j) != has(i, j)) wall(i, j, has(i - 1, j));
        if (has(i, j - 1) != has(i, j)) ring(i, j, has(i, j - 1));
      }
  }

  [[nodiscard]] const IndexedMesh& mesh() const { return mesh_; }

 private:
  std::uint32_t vertex(int ring, int storey, int side) {
    side = ring == 0 ? 0 : side % sides_;
    const auto [it, fresh] = numbers_.try_emplace(
        {ring, storey, side}, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (!fresh) return it->second;
    const double angle = 2 * std::numbers::pi * side / sides_, r = kRing * ring;
    Vec3i p;
    p[(axis_ + 1) % 3] = static_cast<std::int32_t>(std::lround(r * std::cos(angle)));
    p[(axis_ + 2) % 3] = static_cast<std::int32_t>(std::lround(r * std::sin(angle)));
    p[axis_] = kStorey * storey;
    mesh_.vertices.push_back(p);
    return it->second;
  }
  void add(std::uint32_t p, std::uint32_t q, std::uint32_t r, bool turned) {
    if (p == q || q == r || r == p) return;
    if (turned) std::swap(q, r);
    mesh_.triangles.push_back({p, q, r});
  }
  void wall(int ring, int storey, bool outward) {
    for (int k = 0; k < sides_; ++k) {
      const auto p = vertex(ring, storey, k), q = vertex(ring, storey, k + 1);
      const auto r = vertex(ring, storey + 1, k + 1), s = vertex(ring, storey + 1, k);
      add(p, q, r, !outward);
      add(p, r, s, !outward);
    }
  }
  void ring(int ring, int storey, bool upward) {
    for (int k = 0; k < sides_; ++k) {
      const auto p = vertex(ring, storey, k), q = vertex(ring + 1, storey, k);
      const auto r = vertex(ring + 1, storey, k + 1), s = vertex(ring, storey, k + 1);
      add(p, q, r, !upward);
      add(p, r, s, !upward);
    }
  }

  int sides_, axis_;
  IndexedMesh mesh_;
  std::map<std::tuple<int, int, int>, std::uint32_t> numbers_;
};

/// Cells that hang together.
Profile grown(Draw& draw) {
  Profile cells{{draw.whole(0, 2), draw.whole(0, kSize)}};
  for (auto steps = draw.below(14); steps > 0; --steps) {
    auto it = cells.begin();
    std::advance(it, draw.below(cells.size()));
    auto [ring, storey] = *it;
    (draw.one_in(2) ? ring : storey) += draw.one_in(2) ? 1 : -1;
    if (ring >= 0 && storey >= 0 && ring < kSize && storey < kSize) cells.insert({ring, storey});
  }
  return cells;
}

/// The points of the profile's lattice that lie on the body's skin.
std::set<Cell> skin_points(const Profile& profile) {
  std::set<Cell> points;
  for (int i = 0; i <= kSize; ++i)
    for (int j = 0; j <= kSize; ++j) {
      int in = 0, all = 0;
      for (const int ring : {i - 1, i})
        for (const int storey : {j - 1, j}) {
          if (ring < 0) continue;
          ++all;
          in += profile.contains({ring, storey}) ? 1 : 0;
        }
      if (in > 0 && in < all) points.insert({i, j});
    }
  return points;
}

template <class Set>
bool share(const Set& x, const Set& y) {
  return std::ranges::any_of(x, [&](const auto& e) { return y.contains(e); });
}

MeetingResult truth_of(const Profile& a, const Profile& b) {
  MeetingResult truth;
  const bool interiors = share(a, b);
  truth.boundaries_meet = share(skin_points(a), skin_points(b));
  const bool a_in_b = std::ranges::includes(b, a), b_in_a = std::ranges::includes(a, b);
  if (!interiors)
    truth.meeting = truth.boundaries_meet ? Meeting::touching : Meeting::apart;
  else if (truth.boundaries_meet)
    truth.meeting = Meeting::crossing;
  else
    truth.meeting = a_in_b ? Meeting::a_inside_b : b_in_a ? Meeting::b_inside_a : Meeting::crossing;
  truth.a_within_b = interiors && a_in_b;
  truth.b_within_a = interiors && b_in_a;
  return truth;
}

::testing::AssertionResult is_equivalent(const MeetingResult& found, const MeetingResult& truth) {
  const auto reported = [](const MeetingResult& r) {
    return std::tuple(r.meeting, r.boundaries_meet, r.a_within_b, r.b_within_a);
  };
  if (reported(found) == reported(truth)) return ::testing::AssertionSuccess();
  const auto shown = [](const MeetingResult& r) {
    return std::array{static_cast<int>(r.meeting), static_cast<int>(r.boundaries_meet),
                      static_cast<int>(r.a_within_b), static_cast<int>(r.b_within_a)};
  };
  return ::testing::AssertionFailure() << ::testing::PrintToString(shown(found)) << " in place of "
                                       << ::testing::PrintToString(shown(truth));
}

TEST(CoplanarFacesTest, TurnedBodiesMeetAsTheirProfilesDo) {
  std::size_t flush = 0;
  std::map<Meeting, std::size_t> case_counts;
  for (std::uint64_t seed = 1; seed <= kRounds; ++seed) {
    SCOPED_TRACE(seed);
    Draw draw(seed);
    const int sides = draw.whole(16, 56), axis = draw.whole(0, 3);
    const Profile a = grown(draw), b = draw.one_in(8) ? a : grown(draw);
    const Vec3l at{draw.whole(-1000, 1000), draw.whole(-1000, 1000), draw.whole(-1000, 1000)};
    const Subject x(TurnedBody(a, sides, axis).mesh(), at),
        y(TurnedBody(b, sides, axis).mesh(), at);
    ASSERT_EQ(x.part.kind, PartKind::solid);
    flush += find_coplanar_faces(PairLocalPart(x.treed(), {}), PairLocalPart(y.treed(), {})).empty()
                 ? 0U
                 : 1U;
    const MeetingResult truth = truth_of(a, b);
    QueryContext work;
    const MeetingResult found = meet(x.treed(), y.treed(), work);
    ++case_counts[found.meeting];
    ASSERT_TRUE(is_equivalent(found, truth));
  }
  EXPECT_GT(flush, kRounds / 2);
  EXPECT_GT(case_counts[Meeting::touching], kRounds / 50);
  EXPECT_GT(case_counts[Meeting::crossing], kRounds / 4);
}

/// A prism over a polygon that a point at the origin sees all of, its ends fans round that point;
/// each side of the polygon cut into so many, which must divide its extent.
IndexedMesh prism(const std::vector<Vec3i>& polygon, int cuts, const Vec3i& at, std::int32_t tall) {
  std::vector<Vec3i> ring;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3i &p = polygon[i], d = polygon[(i + 1) % polygon.size()] - p;
    for (int k = 0; k < cuts; ++k) ring.push_back({p.x + d.x / cuts * k, p.y + d.y / cuts * k, 0});
  }
  IndexedMesh mesh;
  const auto n = static_cast<std::uint32_t>(ring.size());
  for (const Vec3i& up : {Vec3i{}, Vec3i{0, 0, tall}}) {
    for (const Vec3i& p : ring) mesh.vertices.push_back(at + p + up);
    mesh.vertices.push_back(at + up);
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n, up = n + 1;
    for (const Triangle& t : {Triangle{i, j, j + up}, Triangle{i, j + up, i + up},
                              Triangle{n, j, i}, Triangle{n + up, i + up, j + up}})
      mesh.triangles.push_back(t);
  }
  return mesh;
}

/// Too few triangles lie in a plane for the rims to be asked.
constexpr int kCorners = 12, kCuts = 4;

std::vector<Vec3i> visible_from_origin(Draw& draw) {
  std::vector<Vec3i> polygon;
  // Many of few radii: sides of two of them lie in one line, or go through each other's corners.
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners, r = 4000.0 * draw.whole(1, 4);
    polygon.push_back({kCuts * static_cast<std::int32_t>(std::lround(r * std::cos(angle))),
                       kCuts * static_cast<std::int32_t>(std::lround(r * std::sin(angle))), 0});
  }
  return polygon;
}

/// A post in a tube, flush with it but clear of it, and a body of the post's that stands on its tip
/// under the tube's end.
TEST(CoplanarFacesTest, ATouchInOnePointIsATouch) {
  constexpr int kSides = 400;
  const auto circle = [](double r) {
    std::vector<Vec3i> ring;
    for (int i = 0; i < kSides; ++i) {
      const double angle = 2 * std::numbers::pi * i / kSides;
      ring.push_back({static_cast<std::int32_t>(std::lround(r * std::cos(angle))),
                      static_cast<std::int32_t>(std::lround(r * std::sin(angle))), 0});
    }
    return ring;
  };
  IndexedMesh tube;
  for (const double r : {200'000.0, 100'000.0})
    for (const std::int32_t z : {0, 90'000})
      for (Vec3i p : circle(r)) {
        p.z = z;
        tube.vertices.push_back(p);
      }
  const auto band = [&](std::uint32_t low, std::uint32_t high) {
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const std::uint32_t j = (i + 1) % kSides, p = low * kSides, q = high * kSides;
      tube.triangles.push_back({p + i, p + j, q + j});
      tube.triangles.push_back({p + i, q + j, q + i});
    }
  };
  band(0, 1);
  band(1, 3);
  band(3, 2);
  band(2, 0);
  for (const std::int32_t below : {0, 1}) {
    IndexedMesh post = prism(circle(99'800), 1, {}, 80'000);
    const auto v = static_cast<std::uint32_t>(post.vertices.size());
    for (const Vec3i& p :
         {Vec3i{0, 0, 0}, Vec3i{900, 0, -5000}, Vec3i{-900, 900, -5000}, Vec3i{-900, -900, -5000}})
      post.vertices.push_back(p + Vec3i{150'000, 7000, -below});
    for (const Triangle& t : {Triangle{v, v + 1, v + 2}, Triangle{v, v + 2, v + 3},
                              Triangle{v, v + 3, v + 1}, Triangle{v + 1, v + 3, v + 2}})
      post.triangles.push_back(t);
    const Subject x(tube), y(post);
    ASSERT_FALSE(
        find_coplanar_faces(PairLocalPart(x.treed(), {}), PairLocalPart(y.treed(), {})).empty());
    QueryContext work;
    const MeetingResult found = meet(x.treed(), y.treed(), work);
    EXPECT_EQ(found.meeting, below == 0 ? Meeting::touching : Meeting::apart);
    EXPECT_EQ(found.boundaries_meet, below == 0);
    EXPECT_GT(work.node_pairs, 512 + (x.part.triangles.size() + y.part.triangles.size()) / 4);
  }
}

TEST(CoplanarFacesTest, FinerFansStateTheSameAsCoarseOnes) {
  std::size_t flush = 0;
  std::map<Meeting, std::size_t> case_counts;
  for (std::uint64_t seed = 1; seed <= kRounds; ++seed) {
    SCOPED_TRACE(seed);
    Draw draw(seed);
    const std::vector<Vec3i> p = visible_from_origin(draw),
                             q = draw.one_in(4) ? p : visible_from_origin(draw);
    const auto aside = [&] { return draw.one_in(2) ? 0 : draw.whole(-4, 5) * kCuts * 2000; };
    const Vec3i at{aside(), aside(), draw.whole(-1, 2) * 5000};
    const std::int32_t tall = draw.one_in(2) ? 5000 : 10'000;
    const auto meeting = [&](int cuts) {
      const Subject x(prism(p, cuts, {}, 5000)), y(prism(q, cuts, at, tall));
      if (cuts > 1)
        flush +=
            find_coplanar_faces(PairLocalPart(x.treed(), {}), PairLocalPart(y.treed(), {})).empty()
                ? 0U
                : 1U;
      QueryContext work;
      return meet(x.treed(), y.treed(), work);
    };
    const MeetingResult coarse = meeting(1), fine = meeting(kCuts);
    ++case_counts[fine.meeting];
    ASSERT_TRUE(is_equivalent(fine, coarse));
  }
  EXPECT_GT(flush, kRounds / 4);
  EXPECT_GT(case_counts[Meeting::touching], kRounds / 20);
  EXPECT_GT(case_counts[Meeting::crossing], kRounds / 4);
}

}  // namespace
}  // namespace strake::geometry
