// SPDX-License-Identifier: Apache-2.0
// Drawings without flush seams: which edges vanish, how much of them, and that nothing else does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "strake/hlr/hlr.hpp"
#include "strake/parallel/team.hpp"
#include "support/draw.hpp"
#include "support/hlr_oracle.hpp"
#include "support/lattice_scene.hpp"
#include "support/rounds.hpp"
#include "support/scene_builder.hpp"

namespace strake {
namespace {

using geometry::Vec3i;
using geometry::Vec3l;
using hlr::EdgeKind;
using hlr::EdgePiece;

constexpr std::int32_t kPerMm = 1000;
constexpr std::int32_t kContactUnits = 3;  // of what says nothing of its precision
const hlr::View kIso{.direction = {1, -1, 1}, .limits = {}};

test::HandPart box_mm(const Vec3i& lo, const Vec3i& hi) {
  return test::hand_box(lo * kPerMm, hi * kPerMm);
}

test::SceneBuilder scene_of(const std::vector<test::HandPart>& objects) {
  test::SceneBuilder scene;
  for (const test::HandPart& part : objects) scene.object({{.parts = {part}, .origin = {}}});
  return scene;
}

const test::HandPart kLeft = box_mm({0, 0, 0}, {100, 100, 100});
const test::HandPart kRight = box_mm({100, 0, 0}, {200, 100, 100});

hlr::Drawing draw(const test::SceneBuilder& scene, bool seams, hlr::Options options = {},
                  const hlr::View& view = kIso) {
  options.flush_seams = seams;
  auto drawing = hlr::draw(scene.scene(), {}, view, options, {});
  EXPECT_TRUE(drawing.has_value());
  return drawing ? std::move(*drawing) : hlr::Drawing{};
}

hlr::Drawing without_seams(const test::SceneBuilder& scene, const hlr::Options& options = {},
                           const hlr::View& view = kIso) {
  return draw(scene, false, options, view);
}

using Is = std::function<bool(const EdgePiece&)>;

/// The length of some pieces in whatever state, millimetres.
double seams_mm(const hlr::Drawing& drawing, const Is& is) {
  double sum = 0;
  for (const EdgePiece& p : drawing.pieces) {
    const auto v = (p.b - p.a).as<double>();
    sum += is(p) ? std::sqrt(dot(v, v)) / kPerMm : 0;
  }
  return sum;
}

/// Whether a piece lies in the plane across an axis.
Is in_plane(int axis, std::int64_t at_mm) {
  return [=](const EdgePiece& p) {
    return p.a[axis] == at_mm * kPerMm && p.b[axis] == at_mm * kPerMm;
  };
}

Is both(const Is& one, const Is& other) {
  return [=](const EdgePiece& p) { return one(p) && other(p); };
}

Is of_object(std::uint32_t object, const Is& is) {
  return [=](const EdgePiece& p) { return model::index(p.object) == object && is(p); };
}

constexpr int kX = 0, kY = 1, kZ = 2;

TEST(FlushSeams, AreDrawnByDefault) {
  const test::SceneBuilder scene = scene_of({kLeft, kRight});
  const auto drawing = hlr::draw(scene.scene(), {}, kIso, {}, {});
  ASSERT_TRUE(drawing.has_value());
  EXPECT_NEAR(seams_mm(*drawing, in_plane(kX, 100)), 8 * 100, 1e-6);
  EXPECT_EQ(drawing->counters.seams, 0U);
}

TEST(FlushSeams, OfTwoEqualBoxesVanishAndNothingElse) {
  const test::SceneBuilder scene = scene_of({kLeft, kRight});
  const hlr::Drawing with = draw(scene, true), without = without_seams(scene);
  EXPECT_EQ(seams_mm(without, in_plane(kX, 100)), 0);
  EXPECT_EQ(without.counters.seams, 8U);
  std::vector<EdgePiece> rest;
  std::ranges::copy_if(with.pieces, std::back_inserter(rest),
                       [](const EdgePiece& p) { return !in_plane(kX, 100)(p); });
  EXPECT_EQ(test::difference(rest, without.pieces), "");
  EXPECT_EQ(with.account.fates, without.account.fates);
}

TEST(FlushSeams, VanishInPerspectiveToo) {
  hlr::View view = kIso;
  const Vec3l target = Vec3l{100, 50, 50} * kPerMm;
  view.perspective = hlr::Perspective{target + Vec3l{1, -1, 1} * (500 * kPerMm), target};
  EXPECT_EQ(seams_mm(without_seams(scene_of({kLeft, kRight}), {}, view), in_plane(kX, 100)), 0);
}

TEST(FlushSeams, OfDifferentColoursStay) {
  test::SceneBuilder scene = scene_of({kLeft, kRight});
  scene.model().bodies[1].color = {200, 0, 0, 255};
  EXPECT_NEAR(seams_mm(without_seams(scene), in_plane(kX, 100)), 8 * 100, 1e-6);
  scene.model().bodies[0].color = {200, 0, 0, 255};
  EXPECT_EQ(seams_mm(without_seams(scene), in_plane(kX, 100)), 0);
  scene.model().bodies[1].category = model::Category::insulation;
  EXPECT_NEAR(seams_mm(without_seams(scene), in_plane(kX, 100)), 8 * 100, 1e-6);
}

TEST(FlushSeams, OfPartsThatAreNotDrawnStay) {
  const test::SceneBuilder scene = scene_of({kLeft, kRight});
  const auto drawing = hlr::draw(scene.scene(), {true, false}, kIso, {.flush_seams = false}, {});
  ASSERT_TRUE(drawing.has_value());
  EXPECT_NEAR(seams_mm(*drawing, in_plane(kX, 100)), 4 * 100, 1e-6);
}

TEST(FlushSeams, AreFoundWithinAnObjectAndWithinABody) {
  test::SceneBuilder bodies, parts;
  bodies.object({{.parts = {kLeft}, .origin = {}}, {.parts = {kRight}, .origin = {}}});
  parts.object({{.parts = {kLeft, kRight}, .origin = {}}});
  for (const test::SceneBuilder* scene : {&bodies, &parts}) {
    const hlr::Drawing drawing = without_seams(*scene);
    EXPECT_EQ(seams_mm(drawing, in_plane(kX, 100)), 0);
    EXPECT_EQ(drawing.counters.seams, 8U);
  }
}

TEST(FlushSeams, VanishAsFarAsBothEdgesReach) {
  // The right box_mm is narrower: its upper face and its front go on from the left one's.
  const hlr::Drawing drawing =
      without_seams(scene_of({kLeft, box_mm({100, 0, 0}, {200, 60, 100})}));
  const Is joint = in_plane(kX, 100);
  for (const std::int64_t z : {0, 100}) {
    const Is level = both(joint, in_plane(kZ, z));
    EXPECT_NEAR(seams_mm(drawing, of_object(0, level)), 40, 1e-6);
    EXPECT_EQ(seams_mm(drawing, of_object(1, level)), 0);
  }
  EXPECT_EQ(seams_mm(drawing, both(joint, in_plane(kY, 0))), 0);
  EXPECT_NEAR(seams_mm(drawing, both(joint, in_plane(kY, 100))), 100, 1e-6);
  // Where the faces turn the edge stays, although its part touches the other there.
  EXPECT_NEAR(seams_mm(drawing, both(joint, in_plane(kY, 60))), 100, 1e-6);
}

TEST(FlushSeams, AreFlatWithinTheContactDistance) {
  const auto upper_edge_mm = [](std::int32_t more) {
    test::HandPart higher = kRight;
    for (Vec3i& v : higher.vertices)
      if (v.z > 0) v.z += more;
    const hlr::Drawing drawing = without_seams(scene_of({kLeft, higher}), {.keep_specks = true});
    return seams_mm(drawing, [](const EdgePiece& p) {
      return in_plane(kX, 100)(p) && p.a.z == p.b.z && p.a.z > 0;
    });
  };
  for (const std::int32_t more : {-kContactUnits, -1, 0, 1, kContactUnits})
    EXPECT_EQ(upper_edge_mm(more), 0) << more;
  for (const std::int32_t more : {-kContactUnits - 1, kContactUnits + 1, kPerMm})
    EXPECT_NEAR(upper_edge_mm(more), 200, 1e-6) << more;
}

TEST(FlushSeams, AreNoneAcrossAGap) {
  const auto joint_edges_mm = [](std::int32_t gap) {
    test::HandPart moved = kRight;
    for (Vec3i& v : moved.vertices) v.x += gap;
    return seams_mm(without_seams(scene_of({kLeft, moved})), [](const EdgePiece& p) {
      return p.a.x == p.b.x && p.a.x > 0 && p.a.x < 110 * kPerMm;
    });
  };
  EXPECT_EQ(joint_edges_mm(kContactUnits), 0);
  EXPECT_NEAR(joint_edges_mm(kContactUnits + 1), 8 * 100, 1e-6);
}

TEST(FlushSeams, AreNoneAtAnInnerCornerThatAThirdPartMakes) {
  // A box_mm stands on the left one, flush with the joint of the two: all three meet in that line.
  const hlr::Drawing drawing =
      without_seams(scene_of({kLeft, kRight, box_mm({0, 0, 100}, {100, 100, 200})}));
  const Is corner = both(in_plane(kX, 100), in_plane(kZ, 100));
  EXPECT_NEAR(seams_mm(drawing, corner), 3 * 100, 1e-6);
  // The fronts of the three are one face all the same.
  const Is front = in_plane(kY, 0);
  EXPECT_EQ(seams_mm(drawing, both(front, in_plane(kX, 100))), 100);  // of the one on top
  EXPECT_EQ(seams_mm(drawing, both(front, in_plane(kZ, 100))), 100);  // of the right one
}

TEST(FlushSeams, OfAThirdPartInAnotherColourHideNothing) {
  test::SceneBuilder scene = scene_of({kLeft, kRight, box_mm({0, 0, 100}, {100, 100, 200})});
  scene.model().bodies[2].color = {200, 0, 0, 255};
  const hlr::Drawing drawing = without_seams(scene);
  const Is corner = both(in_plane(kX, 100), in_plane(kZ, 100));
  EXPECT_EQ(seams_mm(drawing, of_object(0, corner)), 0);
  EXPECT_EQ(seams_mm(drawing, of_object(1, corner)), 0);
  EXPECT_NEAR(seams_mm(drawing, of_object(2, corner)), 100, 1e-6);
}

TEST(FlushSeams, VanishWithinABlockOfFour) {
  const hlr::Drawing drawing =
      without_seams(scene_of({kLeft, kRight, box_mm({0, 0, 100}, {100, 100, 200}),
                              box_mm({100, 0, 100}, {200, 100, 200})}));
  EXPECT_EQ(seams_mm(drawing, in_plane(kX, 100)), 0);
  EXPECT_EQ(seams_mm(drawing, in_plane(kZ, 100)), 0);
  // The outline of the whole: four edges of 200 mm, four of 100 mm in two halves each way.
  EXPECT_NEAR(seams_mm(drawing, [](const EdgePiece&) { return true; }), 4 * 200 + 4 * 200 + 4 * 100,
              1e-6);
}

TEST(FlushSeams, OfABoxOnAPlateAreWhereTheirSidesAreFlush) {
  const hlr::Drawing drawing = without_seams(
      scene_of({box_mm({0, 0, 0}, {100, 100, 10}), box_mm({0, 0, 10}, {50, 100, 60})}));
  const Is joint = in_plane(kZ, 10);
  EXPECT_EQ(seams_mm(drawing, both(joint, in_plane(kX, 0))), 0);
  for (const std::int64_t y : {0, 100})
    EXPECT_NEAR(seams_mm(drawing, both(joint, in_plane(kY, y))), 50, 1e-6);
  EXPECT_NEAR(seams_mm(drawing, both(joint, in_plane(kX, 50))), 100, 1e-6);
}

test::HandPart sheet(const Vec3i& a, const Vec3i& b, const Vec3i& c, const Vec3i& d) {
  test::HandPart part;
  part.vertices = {a * kPerMm, b * kPerMm, c * kPerMm, d * kPerMm};
  part.triangles = {{0, 1, 2}, {0, 2, 3}};
  part.faces = {0, 0};
  return part;
}

TEST(FlushSeams, OfSheetsGoOnInOnePlaneWhicheverWayTheyAreWound) {
  const test::HandPart left = sheet({0, 0, 0}, {100, 0, 0}, {100, 100, 0}, {0, 100, 0});
  const test::HandPart right = sheet({100, 0, 0}, {200, 0, 0}, {200, 100, 0}, {100, 100, 0});
  const test::HandPart turned = sheet({100, 0, 0}, {100, 100, 0}, {200, 100, 0}, {200, 0, 0});
  const test::HandPart upright = sheet({100, 0, 0}, {100, 100, 0}, {100, 100, 100}, {100, 0, 100});
  const Is joint = both(in_plane(kX, 100), in_plane(kZ, 0));
  EXPECT_EQ(seams_mm(without_seams(scene_of({left, right})), joint), 0);
  EXPECT_EQ(seams_mm(without_seams(scene_of({left, turned})), joint), 0);
  EXPECT_NEAR(seams_mm(without_seams(scene_of({left, upright})), joint), 200, 1e-6);
  EXPECT_NEAR(seams_mm(without_seams(scene_of({left, right, upright})), joint), 300, 1e-6);
  // A sheet that goes on from the face of a solid.
  const test::HandPart from_solid =
      sheet({100, 0, 100}, {200, 0, 100}, {200, 100, 100}, {100, 100, 100});
  EXPECT_NEAR(seams_mm(without_seams(scene_of({kLeft, from_solid})),
                       both(in_plane(kX, 100), in_plane(kZ, 100))),
              200, 1e-6);
}

hlr::View cut_at(std::int64_t z_mm) {
  hlr::View view = kIso;
  view.sections = {{{0, 0, 1}, {0, 0, z_mm * kPerMm}}};
  return view;
}

TEST(FlushSeams, OfWhatASectionLeavesVanishAndTheCutFacesStayApart) {
  const hlr::Drawing drawing =
      without_seams(scene_of({kLeft, kRight}), {.hatch_spacing_mm = 0}, cut_at(50));
  const Is joint = in_plane(kX, 100);
  EXPECT_EQ(seams_mm(drawing,
                     [&](const EdgePiece& p) {
                       return joint(p) && p.kind == EdgeKind::sharp &&
                              p.state != hlr::State::clipped;
                     }),
            0);
  EXPECT_NEAR(seams_mm(drawing,
                       [&](const EdgePiece& p) { return joint(p) && p.kind == EdgeKind::section; }),
              200, 1e-6);
}

TEST(FlushSeams, StayWhereOnlyOneOfThePartsIsLeft) {
  const hlr::Drawing drawing = without_seams(
      scene_of({kLeft, kRight}), {.hatch_spacing_mm = 0, .uncut = {true, false}}, cut_at(40));
  const Is front = both(in_plane(kX, 100), in_plane(kY, 0));
  EXPECT_NEAR(seams_mm(drawing, of_object(0, front)), 60, 1e-2);
  EXPECT_EQ(
      seams_mm(drawing,
               of_object(0, both(front, [](const EdgePiece& p) { return p.b.z <= 40 * kPerMm; }))),
      0);
}

TEST(FlushSeams, AreFoundHoweverTheModelStands) {
  test::Draw random(7);
  for (int round = 0; round < 50; ++round) {
    const geometry::Mat3d turn = random.rotation();
    const auto turned = [&](test::HandPart part) {
      for (Vec3i& v : part.vertices) {
        const geometry::Vec3d p = turn * v.as<double>();
        v = {static_cast<std::int32_t>(std::lround(p.x)),
             static_cast<std::int32_t>(std::lround(p.y)),
             static_cast<std::int32_t>(std::lround(p.z))};
      }
      return part;
    };
    const test::HandPart wide = turned(box_mm({0, 0, 0}, {1000, 1000, 20}));
    const test::HandPart narrow = turned(box_mm({1000, 150, 0}, {1600, 850, 20}));
    // Rounding makes intersections as well, which go with the seams along which they run.
    const Is edge = [](const EdgePiece& p) { return p.kind != EdgeKind::intersection; };
    const double all = seams_mm(draw(scene_of({wide, narrow}), true), edge);
    const hlr::Drawing drawing = without_seams(scene_of({wide, narrow}));
    // Both edges of the upper and of the lower joint, over the width of the narrow plate.
    EXPECT_NEAR(all - seams_mm(drawing, edge), 4 * 700, 0.1) << "round " << round;
    EXPECT_GE(drawing.counters.seams, 4U) << "round " << round;
  }
}

/// Whether a piece lies within one of the same edge and state.
bool is_within(const EdgePiece& p, const std::vector<EdgePiece>& pieces) {
  return std::ranges::any_of(pieces, [&](const EdgePiece& q) {
    const Vec3l d = q.b - q.a;
    return p.object == q.object && p.edge == q.edge && p.kind == q.kind && p.state == q.state &&
           dot(d, p.a - q.a) >= 0 && dot(d, q.b - p.b) >= 0;
  });
}

TEST(FlushSeams, TakeAwayAndChangeNothingByAllSolversAndThreads) {
  std::uint64_t seams = 0;
  for (std::uint64_t seed = 1; seed <= test::rounds<std::uint64_t>(40); ++seed) {
    const test::SceneBuilder scene =
        test::lattice_scene(seed, {.objects = 8, .unit = 1000, .steps = 3});
    const hlr::View view{
        .direction = test::direction_of(static_cast<std::uint32_t>(seed) % test::kDirections),
        .limits = {}};
    const hlr::Drawing with = draw(scene, true, {}, view);
    const hlr::Drawing without = without_seams(scene, {.solver = hlr::Solver::brute_force}, view);
    seams += without.counters.seams;
    EXPECT_EQ(with.account.fates, without.account.fates) << "seed " << seed;
    for (const EdgePiece& p : without.pieces)
      ASSERT_TRUE(is_within(p, with.pieces)) << "seed " << seed;
    for (const unsigned threads : {1U, 3U}) {
      parallel::Team team(threads);
      const auto got = hlr::draw(scene.scene(), {}, view, {.flush_seams = false}, {.team = &team});
      ASSERT_TRUE(got.has_value());
      EXPECT_EQ(test::difference(without.pieces, got->pieces), "") << "seed " << seed;
    }
  }
  EXPECT_GT(seams, 0U);
}

}  // namespace
}  // namespace strake
