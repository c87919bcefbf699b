// SPDX-License-Identifier: Apache-2.0
// Sheets that pass through each other by more than any snap moves them, in all the ways that lie
// near to lying on each other: none of these crossings may be taken for a touch. Which they are is
// told by the number of times that a path on one of them meets the other, worked out from the
// sources without the engine.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "support/clash_model.hpp"
#include "support/draw.hpp"
#include "support/drawn_sheets.hpp"
#include "support/rounds.hpp"
#include "support/sheet_crossing_path.hpp"

namespace strake::clash {
namespace {

using geometry::Mat3d;
using geometry::Triangle;
using geometry::TriangleMesh;
using geometry::Vec3d;
using test::Profile;
using Point = std::array<double, 2>;

constexpr int kRounds = test::rounds(600, 30000);
/// The contact distance, and what the snap of both sheets may add to it; mm.
constexpr double kOff = 0.003 + 0.002, kOverlap = 0.02, kMargin = kOverlap + 2 * kOff;

/// A sheet where it stands, and a path on it.
struct Drawn {
  TriangleMesh mesh;
  std::vector<Vec3d> path;
};

class Scene {
 public:
  explicit Scene(std::uint64_t seed) : draw_(seed) {}

  double any(double low, double high) { return draw_.between(low, high); }
  /// Each order of magnitude is as likely as another.
  double size(double low, double high) { return std::exp(any(std::log(low), std::log(high))); }
  int number(int low, int high) { return draw_.whole(low, high + 1); }
  bool chance(double p) { return any(0, 1) < p; }
  double sign() { return chance(0.5) ? 1 : -1; }
  Mat3d rotation() { return draw_.rotation(); }

  /// How far along a step of a profile: anywhere, at a corner or near one.
  double along(const Profile& profile, std::size_t step) {
    const double t = any(0.02, 0.98);
    if (chance(0.6)) return t;
    const Point &p = profile[step], &q = profile[step + 1];
    const double near = size(0.01, 1) / std::hypot(q[0] - p[0], q[1] - p[1]);
    const double off = chance(0.5) || near > 0.5 ? 0 : near;
    return chance(0.5) ? off : 1 - off;
  }
  /// An angle of any size between folded back and straight on.
  double bend() { return sign() * (chance(0.3) ? size(1e-5, 0.1) : any(0, 2.9)); }

  Profile folded(int steps, double shortest, double longest) {
    Profile profile{{0, 0}};
    double heading = any(-3, 3);
    for (int i = 0; i < steps; ++i) {
      const double step = size(shortest, longest);
      profile.push_back({profile.back()[0] + step * std::cos(heading),
                         profile.back()[1] + step * std::sin(heading)});
      heading += bend();
    }
    return profile;
  }

  /// Cut into bays and more corners, some wound to and fro, its triangles in any order.
  Drawn sheet(const Profile& profile, double y0, double y1, double path_at) {
    Drawn s{test::drawn(chance(0.3) ? test::refined(profile, number(2, 3)) : profile, y0, y1,
                        number(1, 4), chance(0.5)),
            {}};
    if (chance(0.2))
      for (Triangle& t : s.mesh.triangles)
        if (chance(0.5)) std::swap(t[1], t[2]);
    s.mesh = test::shuffled(std::move(s.mesh), draw_);
    for (const auto& [x, z] : test::refined(profile, 6)) s.path.push_back({x, path_at, z});
    return s;
  }

 private:
  test::Draw draw_;
};

Drawn placed(Drawn s, const Mat3d& turn, const Vec3d& move) {
  s.mesh = test::placed(std::move(s.mesh), turn, move);
  for (Vec3d& p : s.path) p = turn * p + move;
  return s;
}

/// The point so far along a profile, and the unit direction there.
struct Station {
  Point at{}, along{};
  std::size_t step = 0;
};
Station station(const Profile& profile, std::size_t step, double t) {
  const Point &p = profile[step], &q = profile[step + 1];
  const double length = std::hypot(q[0] - p[0], q[1] - p[1]);
  return {{p[0] + (q[0] - p[0]) * t, p[1] + (q[1] - p[1]) * t},
          {(q[0] - p[0]) / length, (q[1] - p[1]) / length},
          step};
}

Station any_station(const Profile& profile, Scene& scene) {
  const auto step = static_cast<std::size_t>(scene.number(0, static_cast<int>(profile.size()) - 2));
  return station(profile, step, scene.along(profile, step));
}

/// So far on along a direction and off to its left.
Point beside(const Point& p, const Point& along, double on, double left) {
  return {p[0] + on * along[0] - left * along[1], p[1] + on * along[1] + left * along[0]};
}

/// What lies on a profile from one station to another and leaves it at both ends, to its left by so
/// much there and here; less than nothing is to its right.
Profile lying_on(const Profile& base, const Station& from, const Station& to, double left_before,
                 double left_after, Scene& scene) {
  // Up a slope of any steepness, and on in parallel or anyhow.
  const auto leave = [&](const Station& s, double way, double left, Profile& out) {
    const double run = std::fabs(left) * scene.size(0.01, 300);
    out.push_back(beside(s.at, s.along, way * run, left));
    const double on = scene.size(0.05, 50);
    out.push_back(beside(out.back(), s.along, way * on,
                         left < 0 ? -scene.any(0, 1) * on * 0.2 : scene.any(0, 1) * on * 0.2));
  };
  Profile profile;
  leave(from, -1, left_before, profile);
  std::reverse(profile.begin(), profile.end());
  profile.push_back(from.at);
  for (std::size_t i = from.step + 1; i <= to.step; ++i) profile.push_back(base[i]);
  profile.push_back(to.at);
  leave(to, 1, left_after, profile);
  return profile;
}

/// What is found of one pair.
struct Tally {
  int crossings = 0, uncertain = 0, lost = 0;
};

void tally_pair(const Drawn& a, const Drawn& b, Scene& scene, Tally& tally) {
  std::vector<test::PathSegment> rims = test::rim_of(a.mesh);
  const std::vector<test::PathSegment> rim_b = test::rim_of(b.mesh);
  rims.insert(rims.end(), rim_b.begin(), rim_b.end());
  if (!test::passes_through(a.path, b.mesh, rims, kOff, kMargin)) return;
  ++tally.crossings;
  const bool askew = scene.chance(0.9);
  const Mat3d turn = askew ? scene.rotation() : Mat3d{};
  Vec3d move;
  move.x = scene.any(-500, 500);
  move.y = scene.any(-500, 500);
  move.z = scene.any(-500, 500);
  test::ClashModel m;
  const bool swap = scene.chance(0.5);
  m.object("a").body(test::placed(swap ? b.mesh : a.mesh, turn, move));
  m.object("b").body(test::placed(swap ? a.mesh : b.mesh, turn, move));
  Options options;
  options.tolerances.touch_overlap_mm = kOverlap;
  options.engine.max_regions = 0;
  const Report report = m.detect(options);
  if (report.pairs.size() == 1) {
    const Pair& p = report.pairs.front();
    if (p.cls == Class::hit) return;
    // The search for the deepest point came to its limit, and says so.
    if ((p.flags & kUncertain) != 0 && p.d_lower_mm < -kOverlap) {
      ++tally.uncertain;
      return;
    }
  }
  ++tally.lost;
  ADD_FAILURE() << "lost: " << report.pairs.size() << " pairs, d "
                << (report.pairs.empty() ? 1 : report.pairs.front().d_mm);
}

template <class Make>
void expect_all_kept(std::uint64_t seed, Make&& make, int min_share) {
  Tally tally;
  for (int round = 0; round < kRounds && tally.lost < 3; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    Scene scene(seed * 1'000'003 + static_cast<std::uint64_t>(round));
    const auto [a, b] = make(scene);
    tally_pair(a, b, scene, tally);
  }
  EXPECT_EQ(tally.lost, 0);
  EXPECT_GE(tally.crossings * 100, kRounds * min_share);
  EXPECT_LE(tally.uncertain * 100, tally.crossings);
}

using Two = std::pair<Drawn, Drawn>;

/// Two stations of a profile in order.
std::pair<Station, Station> two_stations(const Profile& base, Scene& scene) {
  const int steps = static_cast<int>(base.size()) - 1;
  int i = scene.number(0, steps - 1), j = scene.number(0, steps - 1);
  if (i > j) std::swap(i, j);
  double s = scene.along(base, static_cast<std::size_t>(i)),
         t = scene.along(base, static_cast<std::size_t>(j));
  if (i == j && s > t) std::swap(s, t);
  return {station(base, static_cast<std::size_t>(i), s),
          station(base, static_cast<std::size_t>(j), t)};
}

Two leaving_on_both_sides(const Profile& base, Scene& scene) {
  const auto [from, to] = two_stations(base, scene);
  const double side = scene.sign();
  const double before = side * scene.size(0.0052, 20), after = -side * scene.size(0.0052, 20);
  const double wide = scene.chance(0.3) ? scene.size(0.2, 5) : scene.any(50, 400);
  const double at = scene.any(100, 300);
  return {scene.sheet(lying_on(base, from, to, before, after, scene), at - wide / 2, at + wide / 2,
                      at + scene.any(-0.3, 0.3) * wide),
          scene.sheet(base, scene.any(-50, 50), scene.any(350, 600), 0)};
}

TEST(RobustCrossings, OfWhatLiesOnFoldsAndLeavesThemOnBothSides) {
  expect_all_kept(
      1,
      [](Scene& scene) {
        return leaving_on_both_sides(scene.folded(scene.number(1, 7), 5, 200), scene);
      },
      30);
}

TEST(RobustCrossings, OfWhatLiesOnPipesAndLeavesThemOnBothSides) {
  expect_all_kept(
      2,
      [](Scene& scene) {
        Profile ring;
        const int facets = scene.number(5, 40);
        const double radius = scene.size(5, 500);
        for (int i = 0; i <= facets; ++i) {
          const double angle = 2 * std::numbers::pi * (i % facets) / facets;
          ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
        }
        return leaving_on_both_sides(ring, scene);
      },
      30);
}

TEST(RobustCrossings, OfFoldsThatMeetAnyhow) {
  expect_all_kept(
      3,
      [](Scene& scene) {
        const Profile pa = scene.folded(scene.number(1, 5), 5, 100),
                      pb = scene.folded(scene.number(1, 5), 5, 100);
        const Point qa = any_station(pa, scene).at, qb = any_station(pb, scene).at;
        const double half = scene.size(0.2, 100);
        Drawn a = scene.sheet(pa, -half, half, scene.any(-0.1, 0.1) * half);
        // About the axes that both are drawn along, or any.
        Mat3d turn = scene.rotation();
        if (scene.chance(0.3)) {
          const double angle = scene.bend();
          turn = {{Vec3d{std::cos(angle), 0, std::sin(angle)}, Vec3d{0, 1, 0},
                   Vec3d{-std::sin(angle), 0, std::cos(angle)}}};
        }
        Vec3d off;
        off.x = scene.sign() * scene.size(1e-4, 0.1);
        off.y = scene.sign() * scene.size(1e-4, 0.1);
        off.z = scene.sign() * scene.size(1e-4, 0.1);
        const Vec3d there{qb[0], 0, qb[1]};
        a = placed(std::move(a), Mat3d{}, Vec3d{-qa[0], 0, -qa[1]});
        a = placed(std::move(a), turn, there + off);
        return Two{std::move(a), scene.sheet(pb, -120, 130, 0)};
      },
      20);
}

TEST(RobustCrossings, OfFoldsThatReachThroughByLittle) {
  expect_all_kept(
      4,
      [](Scene& scene) {
        const Profile base = scene.folded(scene.number(1, 5), 5, 200);
        const Station at = any_station(base, scene);
        // Down a slope, on for a while or not at all, and up another one.
        const double side = scene.sign(), down = scene.size(0.0052, 0.05),
                     high = scene.size(0.05, 30);
        const double on = scene.chance(0.5) ? scene.size(0.01, 20) : 0;
        const auto slope = [&] { return scene.size(0.01, 300); };
        // A fold whose ends are as near to each other as corners of one point is one skin, which
        // ends where it folds.
        const auto is_one_skin = [](const Profile& v) {
          const Point &p = v.front(), &q = v.back();
          return std::hypot(p[0] - q[0], p[1] - q[1]) < kOff;
        };
        Profile v;
        do {
          v.clear();
          v.push_back(beside(at.at, at.along, -on - (high + down) * slope(), side * high));
          v.push_back(beside(at.at, at.along, -on, -side * down));
          if (on > 0) v.push_back(beside(at.at, at.along, on, -side * down));
          v.push_back(beside(at.at, at.along, on + (high + down) * slope(), side * high));
        } while (is_one_skin(v));
        const double wide = scene.chance(0.3) ? scene.size(0.2, 5) : scene.any(20, 300);
        return Two{scene.sheet(v, -wide / 2, wide / 2, scene.any(-0.3, 0.3) * wide),
                   scene.sheet(base, -170, 180, 0)};
      },
      30);
}

TEST(RobustCrossings, OfSheetsThatAreNearlyParallel) {
  expect_all_kept(
      5,
      [](Scene& scene) {
        const double length = scene.size(20, 2000), tilt = scene.size(3e-5, 0.02);
        Profile flat{{0, 0}, {length, 0}}, slight{{0.1 * length, 0}, {0.9 * length, 0}};
        flat = test::refined(flat, scene.number(1, 9));
        slight = test::refined(slight, scene.number(1, 9));
        // Waves that follow each other, but for the tilt about some place.
        const double wave = scene.chance(0.5) ? scene.size(0.01, 0.3) * length : 0,
                     middle = scene.any(0.2, 0.8) * length;
        const auto wavy = [&](Point& p) { p[1] += wave * std::sin(3 * p[0] / length); };
        if (wave > 0)
          slight = [&] {
            Profile on;
            for (const Point& p : flat)
              if (p[0] > 0.05 * length && p[0] < 0.95 * length) on.push_back(p);
            if (on.size() < 2) on = flat;
            return on;
          }();
        for (Point& p : slight) {
          const double up = (p[0] - middle) * tilt;
          wavy(p);
          p[1] += up;
        }
        for (Point& p : flat) wavy(p);
        const double wide = scene.size(1, 500);
        return Two{scene.sheet(slight, -wide / 2, wide / 2, scene.any(-0.3, 0.3) * wide),
                   scene.sheet(flat, -wide, wide, 0)};
      },
      30);
}

TEST(RobustCrossings, ElsewhereThanWhereTheyLieOnEachOther) {
  expect_all_kept(
      6,
      [](Scene& scene) {
        const Profile base = scene.folded(scene.number(2, 7), 5, 200);
        const auto [from, to] = two_stations(base, scene);
        const double side = scene.sign();
        Profile on = lying_on(base, from, to, side * scene.size(0.0052, 20),
                              side * scene.size(0.0052, 20), scene);
        // From its end through some place of the base and on.
        const Point aim = any_station(base, scene).at;
        const Point& end = on.back();
        const double way = std::hypot(aim[0] - end[0], aim[1] - end[1]);
        if (way > 1) {
          const double beyond = scene.size(0.05, 50) / way;
          on.push_back({aim[0] + (aim[0] - end[0]) * beyond, aim[1] + (aim[1] - end[1]) * beyond});
        }
        const double wide = scene.chance(0.3) ? scene.size(0.2, 5) : scene.any(20, 300);
        return Two{scene.sheet(on, -wide / 2, wide / 2, scene.any(-0.3, 0.3) * wide),
                   scene.sheet(base, -170, 180, 0)};
      },
      30);
}

}  // namespace
}  // namespace strake::clash
