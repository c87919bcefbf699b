// SPDX-License-Identifier: Apache-2.0
// What must hold of any drawing, and what must not change it, bit by bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "strake/hlr/hlr.hpp"
#include "strake/parallel/team.hpp"
#include "support/drawn_pieces.hpp"
#include "support/hlr_oracle.hpp"
#include "support/lattice_scene.hpp"
#include "support/rounds.hpp"

namespace strake {
namespace {

using geometry::Vec3l;
using hlr::EdgePiece;
using hlr::State;
using test::pieces;

constexpr auto kSeeds = test::rounds<std::uint64_t>(120);
/// Where intersections are rounded, or new ones appear, a law speaks of edges alone.
constexpr auto kOff = hlr::Intersections::off;

test::LatticeOptions lattice(std::uint64_t seed) {
  return {.objects = 2 + static_cast<std::uint32_t>(seed % 5), .unit = 1000, .steps = 3};
}

hlr::View view_of(std::uint64_t seed, const test::LatticeOptions& options) {
  test::Random random(seed * 77);
  const Vec3l direction = test::direction_of(random.below(test::kDirections));
  return {.direction = direction, .limits = test::random_limits(random, options)};
}

TEST(HiddenLineLaws, SameForAnyNumberOfThreads) {
  const test::LatticeOptions crowd{.objects = 60, .unit = 1000, .steps = 6};
  const test::SceneBuilder scene = test::lattice_scene(5, crowd);
  const hlr::View view{.direction = {1, 2, 3}, .limits = {}};
  const std::vector<EdgePiece> one = pieces(scene.scene(), view);
  EXPECT_GT(one.size(), 1000U);
  for (const unsigned threads : {1U, 2U, 3U, 8U, 64U}) {
    parallel::Team team(threads);
    EXPECT_EQ(test::difference(one, pieces(scene.scene(), view, {}, {.team = &team})), "")
        << threads << " threads";
  }
}

TEST(HiddenLineLaws, PiecesOfAnEdgeFollowEachOtherFromEndToEnd) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto options = lattice(seed);
    const test::SceneBuilder scene = test::lattice_scene(seed, options);
    const std::vector<EdgePiece> drawn = pieces(scene.scene(), view_of(seed, options));
    const std::vector<EdgePiece> whole =
        pieces(scene.scene(), {.direction = view_of(seed, options).direction, .limits = {}},
               {.stage = hlr::Stage::none});
    std::size_t next = 0;
    for (const EdgePiece& edge : whole) {
      ASSERT_LT(next, drawn.size()) << "seed " << seed;
      ASSERT_EQ(drawn[next].a, edge.a) << "seed " << seed;
      while (next + 1 < drawn.size() && drawn[next + 1].object == edge.object &&
             drawn[next + 1].edge == edge.edge) {
        ASSERT_EQ(drawn[next].b, drawn[next + 1].a) << "seed " << seed;
        ASSERT_NE(drawn[next].state, drawn[next + 1].state) << "seed " << seed;
        ++next;
      }
      ASSERT_EQ(drawn[next++].b, edge.b) << "seed " << seed;
    }
    ASSERT_EQ(next, drawn.size()) << "seed " << seed;
  }
}

// Triangles in another order, each starting elsewhere, vertices renumbered.
void shuffle(test::HandPart& part) {
  if (!part.chains.empty()) return;
  const auto n = static_cast<std::uint32_t>(part.vertices.size());
  std::reverse(part.vertices.begin(), part.vertices.end());
  for (geometry::Triangle& t : part.triangles) t = {n - 1 - t[1], n - 1 - t[2], n - 1 - t[0]};
  std::reverse(part.triangles.begin(), part.triangles.end());
  std::reverse(part.faces.begin(), part.faces.end());
}

TEST(HiddenLineLaws, OrderOfTrianglesAndVerticesDoesNotMatter) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    auto options = lattice(seed);
    const test::SceneBuilder plain = test::lattice_scene(seed, options);
    options.edit = shuffle;
    const test::SceneBuilder shuffled = test::lattice_scene(seed, options);
    const hlr::View view = view_of(seed, options);
    ASSERT_EQ(test::difference(pieces(plain.scene(), view), pieces(shuffled.scene(), view)), "")
        << "seed " << seed;
  }
}

// Turns the diagonal of the first quad of each face that is convex.
void turn_diagonals(test::HandPart& part) {
  for (std::size_t i = 0; i + 1 < part.faces.size(); ++i)
    for (std::size_t j = i + 1; j < part.faces.size(); ++j) {
      if (part.faces[i] != part.faces[j]) continue;
      geometry::Triangle &s = part.triangles[i], &t = part.triangles[j];
      for (int turn = 0; turn < 9; ++turn) {
        std::rotate(s.begin(), s.begin() + 1, s.end());
        if (turn % 3 == 0) std::rotate(t.begin(), t.begin() + 1, t.end());
        if (s[1] != t[2] || s[2] != t[1]) continue;  // s = (a b c), t = (d c b)
        const auto p = [&](std::uint32_t v) { return part.vertices[v].as<std::int64_t>(); };
        const auto area = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
          return cross(p(b) - p(a), p(c) - p(a));
        };
        const Vec3l n = area(s[0], s[1], s[2]);
        if (dot(n, area(s[0], s[1], t[0])) > 0 && dot(n, area(s[0], t[0], s[2])) > 0) {
          const std::uint32_t a = s[0], b = s[1], c = s[2], d = t[0];
          s = {a, b, d};
          t = {a, d, c};
          return;
        }
      }
    }
}

TEST(HiddenLineLaws, TriangulationOfFacesDoesNotMatter) {
  std::size_t turned = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    auto options = lattice(seed);
    const test::SceneBuilder plain = test::lattice_scene(seed, options);
    options.edit = [&](test::HandPart& part) {
      const auto before = part.triangles;
      turn_diagonals(part);
      if (before != part.triangles) ++turned;
    };
    const test::SceneBuilder other = test::lattice_scene(seed, options);
    const hlr::View view = view_of(seed, options);
    for (const double contact_mm : {0.0, -1.0}) {
      const hlr::Options how{.contact_distance_mm = contact_mm};
      ASSERT_EQ(
          test::difference(pieces(plain.scene(), view, how), pieces(other.scene(), view, how)), "")
          << "seed " << seed;
    }
  }
  EXPECT_GT(turned, kSeeds / 3);
}

test::SceneBuilder copy(const model::Scene& scene, const std::vector<std::uint32_t>& order,
                        const Vec3l& offset) {
  test::SceneBuilder result;
  for (const std::uint32_t object : order) {
    std::vector<test::HandBody> bodies;
    for (const model::GridBody& body : scene.bodies_of(model::ObjectId{object})) {
      test::HandBody hand{.parts = {},
                          .origin = body.origin + offset,
                          .alpha = scene.model->bodies[body.body].color.alpha};
      for (const geometry::Part& part : scene.shapes[body.grid_shape].parts) {
        test::HandPart one{part.vertices, part.triangles.to_vector(), part.faces.to_vector(), {}};
        for (std::size_t c = 0; c + 1 < part.chain_first.size(); ++c)
          one.chains.emplace_back(part.vertices.begin() + part.chain_first[c],
                                  part.vertices.begin() + part.chain_first[c + 1]);
        if (!one.chains.empty()) one.vertices.clear();
        hand.parts.push_back(one);
      }
      bodies.push_back(hand);
    }
    result.object(bodies);
  }
  return result;
}

/// Edges of objects, and intersections.
std::pair<std::vector<EdgePiece>, std::vector<EdgePiece>> parted(
    const std::vector<EdgePiece>& all) {
  std::pair<std::vector<EdgePiece>, std::vector<EdgePiece>> result;
  for (const EdgePiece& p : all)
    (p.kind == hlr::EdgeKind::intersection ? result.second : result.first).push_back(p);
  return result;
}

/// Intersections by what does not depend on which object comes first.
auto places(const std::vector<EdgePiece>& crossings, const std::vector<std::uint32_t>& order) {
  std::vector<std::tuple<std::uint32_t, std::uint32_t, Vec3l, Vec3l, State>> all;
  const auto number = [&](model::ObjectId id) {
    return order.empty() ? model::index(id) : order[model::index(id)];
  };
  for (const EdgePiece& p : crossings) {
    const auto [least, most] = std::minmax({number(p.object), number(p.other)});
    all.emplace_back(least, most, p.a, p.b, p.state);
  }
  std::ranges::sort(all);
  return all;
}

TEST(HiddenLineLaws, OrderOfObjectsDoesNotMatter) {
  std::size_t some = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto options = lattice(seed);
    const test::SceneBuilder plain = test::lattice_scene(seed, options);
    std::vector<std::uint32_t> order(options.objects);
    for (std::uint32_t i = 0; i < options.objects; ++i) order[i] = options.objects - 1 - i;
    const test::SceneBuilder reversed = copy(plain.scene(), order, {});
    const hlr::View view = view_of(seed, options);
    const auto [drawn, drawn_crossings] = parted(pieces(reversed.scene(), view));
    const auto [edges, crossings] = parted(pieces(plain.scene(), view));
    std::vector<EdgePiece> back;
    for (std::uint32_t object = 0; object < options.objects; ++object)
      for (EdgePiece p : drawn) {
        if (order[model::index(p.object)] != object) continue;
        p.object = p.other = model::ObjectId{object};
        back.push_back(p);
      }
    ASSERT_EQ(test::difference(edges, back), "") << "seed " << seed;
    ASSERT_EQ(places(crossings, {}), places(drawn_crossings, order)) << "seed " << seed;
    some += crossings.size();
  }
  EXPECT_GT(some, kSeeds * 5 / 6);
}

TEST(HiddenLineLaws, TranslationMovesThePiecesAndNothingElse) {
  const Vec3l offset{123456789012345, -777777777777, 31};
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto options = lattice(seed);
    const test::SceneBuilder plain = test::lattice_scene(seed, options);
    std::vector<std::uint32_t> order(options.objects);
    for (std::uint32_t i = 0; i < options.objects; ++i) order[i] = i;
    const test::SceneBuilder moved = copy(plain.scene(), order, offset);
    hlr::View view = view_of(seed, options);
    std::vector<EdgePiece> expected = pieces(plain.scene(), view);
    for (EdgePiece& p : expected) {
      p.a = p.a + offset;
      p.b = p.b + offset;
    }
    if (view.limits) view.limits = {view.limits->lo + offset, view.limits->hi + offset};
    ASSERT_EQ(test::difference(expected, pieces(moved.scene(), view)), "") << "seed " << seed;
  }
}

TEST(HiddenLineLaws, ScalingByAPowerOfTwoKeepsEveryState) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    auto options = lattice(seed);
    options.unit = 999;
    const test::SceneBuilder plain = test::lattice_scene(seed, options);
    const hlr::View view{.direction = view_of(seed, options).direction, .limits = {}};
    // What is a speck hangs on how the ends are rounded.
    const auto small =
        pieces(plain.scene(), view,
               {.contact_distance_mm = 0.003, .intersections = kOff, .keep_specks = true});
    options.unit *= 16;
    const test::SceneBuilder scaled = test::lattice_scene(seed, options);
    const auto large =
        pieces(scaled.scene(), view,
               {.contact_distance_mm = 0.048, .intersections = kOff, .keep_specks = true});
    ASSERT_EQ(small.size(), large.size()) << "seed " << seed;
    for (std::size_t i = 0; i < small.size(); ++i) {
      ASSERT_EQ(small[i].state, large[i].state) << "seed " << seed;
      for (int k = 0; k < 3; ++k) {
        ASSERT_LE(std::abs(small[i].a[k] * 16 - large[i].a[k]), 8) << "seed " << seed;
        ASSERT_LE(std::abs(small[i].b[k] * 16 - large[i].b[k]), 8) << "seed " << seed;
      }
    }
  }
}

double visible_length(const std::vector<EdgePiece>& list, std::uint32_t objects) {
  double sum = 0;
  for (const EdgePiece& p : list) {
    if (p.state != State::visible || model::index(p.object) >= objects) continue;
    const auto v = (p.b - p.a).as<double>();
    sum += std::sqrt(dot(v, v));
  }
  return sum;
}

TEST(HiddenLineLaws, ObjectsBehindChangeNothingAndObjectsInFrontRevealNothing) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto options = lattice(seed);
    test::SceneBuilder scene = test::lattice_scene(seed, options);
    const hlr::View view{.direction = view_of(seed, options).direction, .limits = {}};
    // What stands in front may cross something.
    const hlr::Options options_of_edges{.intersections = kOff};
    const std::vector<EdgePiece> before = pieces(scene.scene(), view, options_of_edges);
    const auto size = view.direction.as<double>();
    const double most = std::max({std::fabs(size.x), std::fabs(size.y), std::fabs(size.z)});
    const auto along = [&](double steps) {
      Vec3l p;
      for (int k = 0; k < 3; ++k) p[k] = std::llround(size[k] / most * steps * options.unit);
      return p;
    };
    const test::HandPart box = test::hand_box({0, 0, 0}, {3000, 3000, 3000});
    scene.object({{.parts = {box}, .origin = along(-20)}});
    std::vector<EdgePiece> behind = pieces(scene.scene(), view, options_of_edges);
    behind.resize(std::min(behind.size(), before.size()));
    ASSERT_EQ(test::difference(before, behind), "") << "seed " << seed;

    const double open = visible_length(before, options.objects);
    scene.object({{.parts = {test::hand_box({500, 500, 500}, {2500, 2000, 1500})},
                   .origin = along(static_cast<double>(seed % 4))}});
    ASSERT_LE(visible_length(pieces(scene.scene(), view, options_of_edges), options.objects),
              open + static_cast<double>(before.size()))
        << "seed " << seed;

    scene.object({{.parts = {test::hand_box({-9000, -9000, -9000}, {12000, 12000, 12000})},
                   .origin = along(100)}});
    for (const EdgePiece& p : pieces(scene.scene(), view))
      if (model::index(p.object) < options.objects) {
        ASSERT_NE(p.state, State::visible) << "seed " << seed;
      }
  }
}

}  // namespace
}  // namespace strake
