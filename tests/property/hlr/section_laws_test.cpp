// SPDX-License-Identifier: Apache-2.0
// What must hold of drawings that section planes cut.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>
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
using hlr::EdgeKind;
using hlr::EdgePiece;
using hlr::Section;
using hlr::State;
using test::pieces;

constexpr auto kSeeds = test::rounds<std::uint64_t>(100);
const hlr::Options kUnhatched{.hatch_spacing_mm = 0};

test::LatticeOptions lattice(std::uint64_t seed, std::int32_t unit = 1000) {
  return {.objects = 2 + static_cast<std::uint32_t>(seed % 5), .unit = unit, .steps = 3};
}

hlr::View view_of(std::uint64_t seed, std::vector<Section> sections) {
  return {.direction = test::direction_of(static_cast<std::uint32_t>(seed) % test::kDirections),
          .limits = {},
          .sections = std::move(sections)};
}

std::vector<Section> sections_of(std::uint64_t seed, const test::LatticeOptions& options) {
  test::Random random(seed * 31);
  std::vector<Section> sections(1 + seed % 3);
  for (Section& s : sections) s = test::random_section(random, options);
  return sections;
}

double length(const EdgePiece& p) {
  const auto v = (p.b - p.a).as<double>();
  return std::sqrt(dot(v, v));
}

double length_of(const std::vector<EdgePiece>& list,
                 const std::function<bool(const EdgePiece&)>& is) {
  double sum = 0;
  for (const EdgePiece& p : list) sum += is(p) ? length(p) : 0;
  return sum;
}

TEST(SectionLaws, SameForAnyNumberOfThreads) {
  const test::LatticeOptions crowd{.objects = 60, .unit = 1000, .steps = 6};
  const test::SceneBuilder scene = test::lattice_scene(5, crowd);
  const hlr::View view = view_of(10, {{{0, 0, 1}, {0, 0, 4000}}, {{1, 2, 1}, {6000, 4500, 4000}}});
  const std::vector<EdgePiece> one = pieces(scene.scene(), view);
  EXPECT_GT(std::ranges::count(one, EdgeKind::section, &EdgePiece::kind), 100);
  for (const unsigned threads : {1U, 2U, 3U, 8U, 64U}) {
    parallel::Team team(threads);
    EXPECT_EQ(test::difference(one, pieces(scene.scene(), view, {}, {.team = &team})), "")
        << threads << " threads";
  }
}

TEST(SectionLaws, PlanesBeyondTheModelChangeNothingAndAreReported) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const test::SceneBuilder scene = test::lattice_scene(seed, lattice(seed));
    const auto whole = pieces(scene.scene(), view_of(seed, {}));
    const auto cut = hlr::draw(
        scene.scene(), {},
        view_of(seed, {{{0, 0, 1}, {0, 0, 99000}}, {{-1, 0, -3}, {-7001, 0, 0}}}), {}, {});
    ASSERT_TRUE(cut);
    ASSERT_EQ(test::difference(whole, cut->pieces), "") << "seed " << seed;
    ASSERT_EQ(cut->diagnostics.count("section-misses"), 2U);
  }
}

TEST(SectionLaws, OrderAndRepetitionOfPlanesDoNotMatter) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const test::SceneBuilder scene = test::lattice_scene(seed, lattice(seed));
    std::vector<Section> sections = sections_of(seed, lattice(seed));
    const auto once = pieces(scene.scene(), view_of(seed, sections));
    std::ranges::reverse(sections);
    Section again = sections.front();
    if (again.normal.x < 9 && again.normal.x > -9) again.normal = again.normal * 3;
    sections.push_back(again);
    ASSERT_EQ(test::difference(once, pieces(scene.scene(), view_of(seed, sections))), "")
        << "seed " << seed;
  }
}

/// Where a box lies to planes by its corners.
bool is_away(const geometry::Box3l& box, const std::vector<Section>& sections) {
  return std::ranges::any_of(sections, [&](const Section& s) {
    for (unsigned c = 0; c < 8; ++c) {
      const Vec3l p{(c & 1U) != 0 ? box.hi.x : box.lo.x, (c & 2U) != 0 ? box.hi.y : box.lo.y,
                    (c & 4U) != 0 ? box.hi.z : box.lo.z};
      if (dot(s.normal, p - s.point) < 0) return false;
    }
    return true;
  });
}

TEST(SectionLaws, WhatIsCutAwayDoesNotHideAndIsClipped) {
  std::size_t away = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto options = lattice(seed);
    const test::SceneBuilder scene = test::lattice_scene(seed, options);
    const std::vector<Section> sections = sections_of(seed, options);
    std::vector<bool> left(options.objects, false);
    for (const model::GridBody& body : scene.scene().bodies)
      if (!is_away(body.box(scene.scene().shapes[body.grid_shape]), sections))
        left[model::index(body.object)] = true;
    const hlr::View view = view_of(seed, sections);
    const auto all = pieces(scene.scene(), view, kUnhatched);
    const auto some = hlr::draw(scene.scene(), left, view, kUnhatched, {});
    ASSERT_TRUE(some);
    std::vector<EdgePiece> kept;
    for (const EdgePiece& p : all) {
      if (left[model::index(p.object)] && left[model::index(p.other)]) {
        kept.push_back(p);
        continue;
      }
      ++away;
      ASSERT_EQ(p.state, State::clipped) << "seed " << seed;
    }
    std::vector<EdgePiece> expected = some->pieces;
    for (auto* list : {&kept, &expected})
      for (EdgePiece& p : *list) p.edge = 0;
    ASSERT_EQ(test::difference(expected, kept), "") << "seed " << seed;
  }
  EXPECT_GT(away, 5 * kSeeds);
}

TEST(SectionLaws, EdgesAreDrawnFromEndToEndWhateverCutsThem) {
  const auto of_edges = [](const EdgePiece& p) {
    return p.kind != EdgeKind::section && p.kind != EdgeKind::hatch;
  };
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto options = lattice(seed);
    const test::SceneBuilder scene = test::lattice_scene(seed, options);
    const auto whole = pieces(scene.scene(), view_of(seed, {}));
    const auto cut = pieces(scene.scene(), view_of(seed, sections_of(seed, options)));
    ASSERT_NEAR(length_of(whole, of_edges), length_of(cut, of_edges),
                2 * static_cast<double>(cut.size()))
        << "seed " << seed;
  }
}

TEST(SectionLaws, NothingThatIsDrawnLiesBeyondAPlane) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto options = lattice(seed);
    const test::SceneBuilder scene = test::lattice_scene(seed, options);
    const std::vector<Section> sections = sections_of(seed, options);
    for (const EdgePiece& p : pieces(scene.scene(), view_of(seed, sections))) {
      if (p.state == State::clipped) continue;
      for (const Section& s : sections)
        for (const Vec3l& end : {p.a, p.b}) {
          const Vec3l size{std::abs(s.normal.x), std::abs(s.normal.y), std::abs(s.normal.z)};
          // Each plane, and the end of a piece, rounds by half a unit at most.
          ASSERT_LE(dot(s.normal, end - s.point), 2 * (size.x + size.y + size.z))
              << "seed " << seed;
        }
    }
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

TEST(SectionLaws, OrderOfTrianglesAndVerticesDoesNotMatter) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    auto options = lattice(seed);
    const test::SceneBuilder plain = test::lattice_scene(seed, options);
    options.edit = shuffle;
    const test::SceneBuilder shuffled = test::lattice_scene(seed, options);
    const hlr::View view = view_of(seed, sections_of(seed, options));
    ASSERT_EQ(test::difference(pieces(plain.scene(), view), pieces(shuffled.scene(), view)), "")
        << "seed " << seed;
  }
}

/// Length by object, kind and state.
std::map<std::array<std::uint32_t, 3>, double> lengths(const std::vector<EdgePiece>& list) {
  std::map<std::array<std::uint32_t, 3>, double> sums;
  for (const EdgePiece& p : list)
    sums[{model::index(p.object), static_cast<std::uint32_t>(p.kind),
          static_cast<std::uint32_t>(p.state)}] += length(p);
  return sums;
}

TEST(SectionLaws, AMirroredSceneIsCutLikeAMirror) {
  std::size_t some = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    // On a lattice of 720 these planes meet edges in grid points: nothing is rounded, and so
    // nothing depends on which diagonal a face gets that was cut.
    auto options = lattice(seed, 720);
    const test::SceneBuilder plain = test::lattice_scene(seed, options);
    options.edit = [](test::HandPart& part) {
      for (auto& v : part.vertices) v.x = -v.x;
      for (auto& chain : part.chains)
        for (auto& v : chain) v.x = -v.x;
      for (geometry::Triangle& t : part.triangles) std::swap(t[1], t[2]);
    };
    const test::SceneBuilder mirrored = test::lattice_scene(seed, options);
    auto& bodies = const_cast<model::Scene&>(mirrored.scene()).bodies;  // NOLINT
    for (model::GridBody& body : bodies) body.origin.x = -body.origin.x;
    const std::int64_t at = 360 + 720 * static_cast<std::int64_t>(seed % 2);
    const Section section{{seed % 3 == 0 ? 1 : 0, seed % 3 == 1 ? 1 : 0, 1}, {at, at, at}};
    hlr::View view = view_of(seed % 14, {section});
    const hlr::Options how{.intersections = hlr::Intersections::off, .hatch_spacing_mm = 0};
    const auto expected = lengths(pieces(plain.scene(), view, how));
    view.direction.x = -view.direction.x;
    view.sections[0].normal.x = -section.normal.x;
    view.sections[0].point.x = -section.point.x;
    const auto got = lengths(pieces(mirrored.scene(), view, how));
    for (const auto& [what, sum] : expected) {
      const auto found = got.find(what);
      // Ends of pieces are rounded, and not like a mirror.
      ASSERT_NEAR(sum, found == got.end() ? 0 : found->second, 40) << "seed " << seed;
    }
    some += expected.size();
  }
  EXPECT_GT(some, 3 * kSeeds);
}

}  // namespace
}  // namespace strake
