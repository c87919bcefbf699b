// SPDX-License-Identifier: Apache-2.0
// Equal bodies behind each other in the line of sight: what the definition gives, at a cost that
// grows with them and not with their square. And the boxes that may hide what is open of an edge.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "hlr/visibility/open_part.hpp"
#include "strake/hlr/hlr.hpp"
#include "support/draw.hpp"
#include "support/hlr_oracle.hpp"
#include "support/rounds.hpp"
#include "support/scene_builder.hpp"

namespace strake {
namespace {

using geometry::Vec3i;
using geometry::Vec3l;
using test::Draw;

/// A frame round a hole: four bars as parts, of which two are askew.
test::HandBody frame(std::int32_t size, std::int32_t depth) {
  const auto bar = [&](const Vec3i& lo, const Vec3i& hi, std::int32_t lean) {
    test::HandPart part = test::hand_box(lo, hi);
    for (Vec3i& v : part.vertices)
      if (v.y == hi.y) v.x += lean;
    if (lean != 0) part.faces.clear();
    return part;
  };
  const std::int32_t s = size, t = size / 5;
  return {
      .parts = {bar({0, 0, 0}, {s, t, depth}, 0), bar({0, s - t, 0}, {s, s, depth}, 0),
                bar({0, t, 0}, {t, s - t, depth}, t), bar({s - t, t, 0}, {s, s - t, depth}, -t)},
      .origin = {}};
}

test::SceneBuilder row(int copies, const Vec3l& step) {
  test::SceneBuilder scene;
  scene.object({frame(1'000'000, 20'000)});
  for (int i = 1; i < copies; ++i) scene.instance(0, Vec3l{i * step.x, i * step.y, i * step.z});
  return scene;
}

hlr::View view_along(const Vec3l& direction) {
  hlr::View view;
  view.direction = direction;
  return view;
}

void expect_as_defined(const test::SceneBuilder& scene, const hlr::View& view,
                       hlr::Options options) {
  const auto got = hlr::draw(scene.scene(), {}, view, options, {});
  options.culling = false;
  const auto plain = hlr::draw(scene.scene(), {}, view, options, {});
  options.solver = hlr::Solver::brute_force;
  const auto expected = hlr::draw(scene.scene(), {}, view, options, {});
  ASSERT_TRUE(expected && plain && got);
  ASSERT_GT(expected->pieces.size(), 0U);
  EXPECT_EQ(test::difference(expected->pieces, plain->pieces), "");
  EXPECT_EQ(test::difference(expected->pieces, got->pieces), "");
}

TEST(BodiesInLine, AreDrawnAsDefined) {
  Draw draw(17);
  for (int round = 0; round < test::rounds(25, 1000); ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    Vec3l direction;
    do direction = {draw.whole(-2, 3), draw.whole(-2, 3), draw.whole(-2, 3)};
    while (direction == Vec3l{0, 0, 0});
    test::SceneBuilder scene;
    scene.object({frame(1000, draw.whole(1, 300))});
    // Many bodies are looked for among all, few one by one.
    std::vector<test::HandBody> many(draw.one_in(3) ? 17 : 2);
    for (test::HandBody& body : many) {
      const Vec3i lo{draw.whole(0, 9) * 100, draw.whole(0, 9) * 100, draw.whole(0, 9) * 100};
      body.parts = {test::hand_box(lo, lo + Vec3i{200, 300, draw.whole(1, 200)})};
      if (draw.one_in(9)) body.alpha = 99;
    }
    scene.object(many);
    for (std::uint64_t i = 2 + draw.below(4); i > 0; --i) {
      // In line, deep under each other or within each other; now and then beside it.
      const std::int64_t behind = draw.whole(-4, 5) * (draw.one_in(2) ? 50 : 700);
      Vec3l offset{behind * direction.x, behind * direction.y, behind * direction.z};
      if (draw.one_in(4)) offset.x += draw.whole(-3, 4);
      scene.instance(static_cast<std::uint32_t>(draw.below(2)), offset);
    }
    hlr::View view = view_along(direction);
    if (draw.one_in(3)) view.limits = {{{-900, -900, -900}, {700, 800, draw.whole(100, 900)}}};
    hlr::Options options{.sharp_angle_deg = 0, .hidden = draw.one_in(2)};
    if (draw.one_in(2)) options.contact_distance_mm = 0.001 * draw.whole(0, 60);
    expect_as_defined(scene, view, options);
  }
}

TEST(BodiesInLine, CostWhatEachCosts) {
  const auto tests_of = [](int copies, const Vec3l& direction) {
    const auto scene =
        row(copies, {400'000 * direction.x, 400'000 * direction.y, 400'000 * direction.z});
    return hlr::draw(scene.scene(), {}, view_along(direction), {}, {})->counters.face_tests;
  };
  for (const Vec3l& direction : {Vec3l{0, 0, 1}, Vec3l{1, -1, 1}}) {
    // Eight times as many, with edges of which one side stays open.
    const std::uint64_t few = tests_of(20, direction);
    EXPECT_GT(few, 0U);
    EXPECT_LT(tests_of(160, direction), 10 * few);
  }
}

/// The open part of the edge from a to b with one side hidden from end to end.
hlr::OpenRange hidden_on(std::uint8_t sides) {
  hlr::OpenRange open({}, hlr::RationalParam::one());
  open.shrink({hlr::RationalParam::zero(), hlr::RationalParam::one(), sides});
  return open;
}

bool meets(const hlr::ViewBox& open, const hlr::ViewBox& box) {
  const hlr::LocalEdge edge{.a = {}, .b = {}, .va = {}, .vb = {}, .box = open};
  const bool exactly = hlr::may_be_hidden_by(edge, box);
  // The query in doubles says the same of boxes as long as it knows no line.
  EXPECT_EQ(hlr::anything_in(open).may_be_hidden_by(hlr::rounded_outwards(box)), exactly);
  return exactly;
}

TEST(OpenBox, MeetsWhatReachesToAnOpenSide) {
  const hlr::ViewPoint a{100, 50, 0}, b{200, 50, 0};
  const hlr::ViewBox above{{100, 50, 5}, {200, 90, 9}}, below{{100, 10, 5}, {200, 50, 9}};
  const hlr::OpenRange both({}, hlr::RationalParam::one());
  for (const bool backwards : {false, true}) {
    const auto box = [&](const hlr::OpenRange& open) {
      return backwards ? hlr::open_box(b, a, open) : hlr::open_box(a, b, open);
    };
    EXPECT_TRUE(meets(box(both), above));
    EXPECT_TRUE(meets(box(both), below));
    const std::uint8_t upper = backwards ? hlr::kRight : hlr::kLeft;
    EXPECT_FALSE(meets(box(hidden_on(upper)), above));
    EXPECT_TRUE(meets(box(hidden_on(upper)), below));
    const std::uint8_t lower = backwards ? hlr::kLeft : hlr::kRight;
    EXPECT_TRUE(meets(box(hidden_on(lower)), above));
    EXPECT_FALSE(meets(box(hidden_on(lower)), below));
    // Beside its ends, and no nearer to the viewer.
    EXPECT_FALSE(meets(box(both), {{200, 0, 5}, {300, 90, 9}}));
    EXPECT_FALSE(meets(box(both), {{0, 0, 5}, {100, 90, 9}}));
    EXPECT_TRUE(meets(box(both), {{0, 0, 5}, {101, 90, 9}}));
    EXPECT_FALSE(meets(box(both), {{0, 0, -9}, {300, 90, 0}}));
  }
}

TEST(OpenBox, HasTheSidesOfUprightEdges) {
  const hlr::ViewPoint a{50, 100, 0}, b{50, 200, 0};
  const hlr::ViewBox right{{50, 100, 5}, {90, 200, 9}}, left{{10, 100, 5}, {50, 200, 9}};
  EXPECT_FALSE(meets(hlr::open_box(a, b, hidden_on(hlr::kLeft)), left));
  EXPECT_TRUE(meets(hlr::open_box(a, b, hidden_on(hlr::kLeft)), right));
  EXPECT_FALSE(meets(hlr::open_box(b, a, hidden_on(hlr::kLeft)), right));
  EXPECT_TRUE(meets(hlr::open_box(b, a, hidden_on(hlr::kLeft)), left));
}

TEST(OpenBox, IsThatOfTheOpenPart) {
  hlr::OpenRange open({}, hlr::RationalParam::one());
  open.shrink({hlr::RationalParam::zero(), hlr::RationalParam::of(1, 2), hlr::kBothSides});
  const hlr::ViewBox box = hlr::open_box({0, 0, 0}, {100, 10, 40}, open);
  EXPECT_FALSE(meets(box, {{0, 0, 90}, {49, 10, 99}}));
  EXPECT_TRUE(meets(box, {{0, 0, 90}, {51, 10, 99}}));
  // One unit long, it is between two columns of points.
  EXPECT_TRUE(meets(hlr::open_box({7, 0, 0}, {8, 90, 0}, {{}, hlr::RationalParam::one()}),
                    {{7, 0, 5}, {8, 90, 9}}));
}

TEST(OwnIntervals, AreUnited) {
  using hlr::RationalParam;
  const auto interval = [](int lo, int hi, std::uint8_t sides) {
    return hlr::OcclusionInterval{RationalParam::of(lo, 12), RationalParam::of(hi, 12), sides,
                                  true};
  };
  const std::vector<hlr::OcclusionInterval> some{
      interval(4, 8, hlr::kBothSides), interval(0, 4, hlr::kLeft), interval(2, 6, hlr::kRight),
      interval(7, 9, hlr::kBothSides), interval(10, 12, hlr::kRight)};
  std::vector<hlr::OcclusionInterval> united;
  hlr::IntervalSweep().unite(some, united);
  const std::vector<hlr::OcclusionInterval> expected{
      interval(0, 2, hlr::kLeft), interval(2, 9, hlr::kBothSides), interval(10, 12, hlr::kRight)};
  ASSERT_EQ(united.size(), expected.size());
  for (std::size_t i = 0; i < united.size(); ++i) {
    EXPECT_EQ(hlr::compare(united[i].lo, expected[i].lo), 0) << i;
    EXPECT_EQ(hlr::compare(united[i].hi, expected[i].hi), 0) << i;
    EXPECT_EQ(united[i].sides, expected[i].sides) << i;
    EXPECT_TRUE(united[i].self);
  }
}

TEST(RationalParams, AreComparedExactly) {
  using hlr::RationalParam;
  constexpr std::int64_t kBig = (std::int64_t{1} << 62) - 57;
  const auto of = [](geometry::Int128 num, geometry::Int128 den) {
    return RationalParam::of(num, den);
  };
  EXPECT_EQ(hlr::compare(of(kBig - 1, kBig), of(kBig - 2, kBig - 1)), 1);
  EXPECT_EQ(hlr::compare(of(kBig - 2, kBig - 1), of(kBig - 1, kBig)), -1);
  EXPECT_EQ(hlr::compare(of(kBig, 2 * geometry::Int128{kBig}), of(1, 2)), 0);
  EXPECT_EQ(hlr::compare(of(1, geometry::Int128{kBig} * 2), of(0, 7)), 1);
  EXPECT_EQ(hlr::compare(of(0, 7), of(1, geometry::Int128{kBig} * kBig)), -1);
  EXPECT_EQ(hlr::compare(of(0, 7), of(0, 9)), 0);
  EXPECT_EQ(hlr::compare(of(9, 9), RationalParam::one()), 0);
}

}  // namespace
}  // namespace strake
