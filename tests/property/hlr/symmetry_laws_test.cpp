// SPDX-License-Identifier: Apache-2.0
// Quarter turns and mirrors of model and view, objects that are split, and closed forms: drawings
// whose lines are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "strake/hlr/hlr.hpp"
#include "support/drawn_pieces.hpp"
#include "support/lattice_scene.hpp"
#include "support/mapped_scene.hpp"
#include "support/rounds.hpp"

namespace strake {
namespace {

using geometry::Vec3l;
using hlr::EdgeKind;
using hlr::EdgePiece;
using hlr::State;
using test::pieces;

constexpr auto kSeeds = test::rounds<std::uint64_t>(240);
/// Divisible by all numbers to 16, so that nearly all crossings are points of the grid.
constexpr std::int32_t kUnit = 720720;

test::LatticeOptions lattice(std::uint64_t seed) {
  return {.objects = 2 + static_cast<std::uint32_t>(seed % 5), .unit = kUnit, .steps = 3};
}

/// A signed permutation of the axes: one of 24 turns and 24 mirrors of the grid.
struct Symmetry {
  std::array<int, 3> axis{};
  std::array<int, 3> sign{};

  explicit Symmetry(std::uint64_t number) {
    axis = {0, 1, 2};
    for (std::uint64_t k = 0; k < number % 6; ++k) std::next_permutation(axis.begin(), axis.end());
    for (std::size_t k = 0; k < 3; ++k) sign.at(k) = (number / 6 >> k & 1U) != 0 ? -1 : 1;
  }
  Vec3l operator()(const Vec3l& p) const {
    return {sign[0] * p[axis[0]], sign[1] * p[axis[1]], sign[2] * p[axis[2]]};
  }
  [[nodiscard]] bool mirrors() const {
    int inversions = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i + 1; j < 3; ++j) inversions += axis.at(i) > axis.at(j) ? 1 : 0;
    return (inversions % 2 != 0) != (sign[0] * sign[1] * sign[2] < 0);
  }
};

TEST(Symmetry, ThereAreFortyEightAndHalfOfThemMirror) {
  std::map<std::array<std::int64_t, 3>, int> visible_pieces;
  int mirrors = 0;
  for (std::uint64_t s = 0; s < 48; ++s) {
    const Vec3l p = Symmetry(s)({1, 10, 100});
    ++visible_pieces[{p.x, p.y, p.z}];
    mirrors += Symmetry(s).mirrors() ? 1 : 0;
  }
  EXPECT_EQ(visible_pieces.size(), 48U);
  EXPECT_EQ(mirrors, 24);
}

/// A drawing as what is seen of it: the lines, whichever way they run and however they are counted.
using Line = std::tuple<std::uint32_t, EdgeKind, State, Vec3l, Vec3l>;

template <class Map>
std::vector<Line> lines(const std::vector<EdgePiece>& list, const Map& map) {
  std::vector<Line> all;
  for (const EdgePiece& p : list) {
    const Vec3l a = map(p.a), b = map(p.b);
    all.emplace_back(model::index(p.object), p.kind, p.state, std::min(a, b), std::max(a, b));
  }
  std::ranges::sort(all);
  return all;
}

/// The first few lines that only one of two drawings has.
std::string difference(const std::vector<Line>& a, const std::vector<Line>& b) {
  std::string text;
  const auto list = [&](const char* whose, const std::vector<Line>& x, const std::vector<Line>& y) {
    std::vector<Line> only;
    std::ranges::set_difference(x, y, std::back_inserter(only));
    for (std::size_t i = 0; i < std::min<std::size_t>(only.size(), 4); ++i) {
      const auto& [object, kind, state, p, q] = only[i];
      text += whose + std::to_string(object) + " kind " + std::to_string(static_cast<int>(kind)) +
              " state " + std::to_string(static_cast<int>(state));
      for (const Vec3l& v : {p, q})
        text += " (" + std::to_string(v.x) + ' ' + std::to_string(v.y) + ' ' + std::to_string(v.z) +
                ')';
      text += '\n';
    }
  };
  list("only before: ", a, b);
  list("only after: ", b, a);
  return text;
}

TEST(HiddenLineSymmetry, QuarterTurnsAndMirrorsOfModelAndViewChangeNothing) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto options = lattice(seed);
    const test::SceneBuilder plain = test::lattice_scene(seed, options);
    test::Random random(seed * 77);
    hlr::View view{.direction = test::direction_of(random.below(test::kDirections)),
                   .limits = test::random_limits(random, options)};
    const Symmetry symmetry(1 + seed % 47);
    const test::SceneBuilder other = test::mapped(plain.scene(), symmetry, symmetry.mirrors());
    // The contact distance cuts edges between points of the grid, where rounding has a side.
    const hlr::Options how{.contact_distance_mm = 0, .intersections = hlr::Intersections::off};
    const auto before = lines(pieces(plain.scene(), view, how), symmetry);
    view.direction = symmetry(view.direction);
    view.up = symmetry(view.up);
    if (view.limits) {
      const Vec3l p = symmetry(view.limits->lo), q = symmetry(view.limits->hi);
      for (int k = 0; k < 3; ++k) {
        view.limits->lo[k] = std::min(p[k], q[k]);
        view.limits->hi[k] = std::max(p[k], q[k]);
      }
    }
    const auto after = lines(pieces(other.scene(), view, how), [](const Vec3l& p) { return p; });
    ASSERT_EQ(difference(before, after), "") << "seed " << seed;
  }
}

TEST(HiddenLineSymmetry, AnObjectSplitInTwoShowsTheSame) {
  std::size_t split = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto options = lattice(seed);
    const test::SceneBuilder plain = test::lattice_scene(seed, options);
    const auto same = [](const Vec3l& p) { return p; };
    const test::SceneBuilder apart = test::mapped(plain.scene(), same, false, true);
    if (apart.scene().model->objects.size() == plain.scene().model->objects.size()) continue;
    ++split;
    test::Random random(seed * 77);
    const hlr::View view{.direction = test::direction_of(random.below(test::kDirections)),
                         .limits = test::random_limits(random, options)};
    const hlr::Options how{.intersections = hlr::Intersections::off};
    // Whose face hides a line is another matter now, and wires are seen in solids of their own.
    const auto reported = [&](const model::Scene& scene) {
      std::vector<Line> all = lines(pieces(scene, view, how), same);
      std::erase_if(all, [](const Line& line) {
        return std::get<State>(line) != State::visible ||
               std::get<EdgeKind>(line) == EdgeKind::polyline;
      });
      for (Line& line : all) std::get<0>(line) = 0;
      std::ranges::sort(all);
      return all;
    };
    ASSERT_EQ(difference(reported(plain.scene()), reported(apart.scene())), "") << "seed " << seed;
  }
  EXPECT_GT(split, kSeeds / 10);
}

/// Lengths by state, in millimetres.
std::map<State, double> lengths(const std::vector<EdgePiece>& list) {
  std::map<State, double> sum;
  for (const EdgePiece& p : list) {
    const auto v = (p.b - p.a).as<double>();
    sum[p.state] += std::sqrt(dot(v, v)) / 1000;
  }
  return sum;
}

std::vector<EdgePiece> visible_pieces(const test::SceneBuilder& scene, const Vec3l& direction) {
  return pieces(scene.scene(), {.direction = direction, .limits = {}}, {});
}

constexpr std::int32_t kMm = 1000;
test::HandBody box_at(const Vec3l& at, const geometry::Vec3i& size) {
  return {.parts = {test::hand_box({0, 0, 0}, size)}, .origin = at};
}

TEST(ClosedForm, BoxesApartShowThreeFacesEach) {
  // Far enough from each other that none hides another from any of these sides.
  test::SceneBuilder scene;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      scene.object(
          {box_at({i * 100000LL * kMm, j * 100000LL * kMm, 0}, {100 * kMm, 200 * kMm, 300 * kMm})});
  for (const Vec3l& direction : {Vec3l{1, 1, 1}, Vec3l{1, -2, 3}, Vec3l{-3, -1, 2}}) {
    const auto sum = lengths(visible_pieces(scene, direction));
    EXPECT_EQ(sum.at(State::visible), 16 * 3 * 600.0);
    EXPECT_EQ(sum.at(State::hidden_by_self), 16 * 600.0);
    EXPECT_EQ(sum.size(), 2U);
  }
}

TEST(ClosedForm, ARowOfBoxesInTheLineOfSightShowsItsOutlineOnly) {
  // Each is behind the one before, as seen from (1, 2, 3), its outline on the other's: of those
  // behind the six edges of the outline border on nothing that hides them on their outer side.
  constexpr int kBoxes = 5;
  test::SceneBuilder scene;
  for (std::int64_t i = 0; i < kBoxes; ++i)
    scene.object({box_at({-1000 * i * kMm, -2000 * i * kMm, -3000 * i * kMm},
                         {100 * kMm, 200 * kMm, 300 * kMm})});
  const auto sum = lengths(visible_pieces(scene, {1, 2, 3}));
  EXPECT_EQ(sum.at(State::visible), 3 * 600.0 + (kBoxes - 1) * 2 * 600.0);
  EXPECT_EQ(sum.at(State::hidden_by_self), kBoxes * 600.0);
  EXPECT_EQ(sum.at(State::hidden_by_other), (kBoxes - 1) * 600.0);
}

TEST(ClosedForm, ALargerBoxInFrontHidesAll) {
  for (const Vec3l& direction : {Vec3l{0, 0, 1}, Vec3l{1, 2, 3}, Vec3l{5, -4, 1}}) {
    test::SceneBuilder scene;
    scene.object({box_at({0, 0, 0}, {100 * kMm, 100 * kMm, 100 * kMm})});
    scene.object({box_at(direction * (2000 * kMm) - Vec3l{150 * kMm, 150 * kMm, 150 * kMm},
                         {400 * kMm, 400 * kMm, 400 * kMm})});
    for (const EdgePiece& p : visible_pieces(scene, direction))
      if (model::index(p.object) == 0) {
        EXPECT_TRUE(p.state == State::hidden_by_self || p.state == State::hidden_by_other ||
                    p.state == State::projecting);
      }
  }
}

TEST(ClosedForm, StackedPlatesShowTheirSides) {
  // Of each the two sides towards the viewer, and the top of the uppermost. Where two meet, the
  // edges of both lie on each other, in front; those at the back are hidden.
  constexpr int kPlates = 100;
  constexpr double kLong = 500, kWide = 300, kThick = 8;
  test::SceneBuilder scene;
  for (std::int64_t i = 0; i < kPlates; ++i)
    scene.object({box_at({0, 0, i * 8 * kMm}, {500 * kMm, 300 * kMm, 8 * kMm})});
  const auto sum =
      lengths(pieces(scene.scene(), {.direction = {1, 2, 1}, .limits = {}},
                     {.contact_distance_mm = 0, .intersections = hlr::Intersections::off}));
  EXPECT_EQ(sum.at(State::visible), kPlates * (2 * kLong + 2 * kWide + 3 * kThick) + kLong + kWide);
  EXPECT_EQ(sum.at(State::hidden_by_self) + sum.at(State::hidden_by_other),
            kPlates * (2 * kLong + 2 * kWide + kThick) - kLong - kWide);
}

TEST(ClosedForm, ARackSeenFromAboveIsCutWhereItsBeamsCross) {
  // Twelve beams along x, under seven along y; seen from above a beam's lower edges lie on its
  // upper ones, and all upright edges are points.
  constexpr int kLower = 12, kUpper = 7;
  constexpr double kLength = 5000, kWidth = 60;
  test::SceneBuilder scene;
  for (std::int64_t i = 0; i < kLower; ++i)
    scene.object({box_at({0, (200 + i * 300) * kMm, 0}, {5000 * kMm, 60 * kMm, 100 * kMm})});
  for (std::int64_t i = 0; i < kUpper; ++i)
    scene.object(
        {box_at({(400 + i * 600) * kMm, 0, 500 * kMm}, {60 * kMm, 5000 * kMm, 100 * kMm})});
  const auto sum = lengths(visible_pieces(scene, {0, 0, 1}));
  const double hidden = 4 * kWidth * kLower * kUpper;
  EXPECT_EQ(sum.at(State::visible), 4 * (kLength + kWidth) * (kLower + kUpper) - hidden);
  EXPECT_EQ(sum.at(State::hidden_by_other), hidden);
  EXPECT_EQ(sum.at(State::projecting), 4 * 100.0 * (kLower + kUpper));
}

}  // namespace
}  // namespace strake
