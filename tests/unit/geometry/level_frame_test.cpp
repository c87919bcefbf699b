// SPDX-License-Identifier: Apache-2.0
// Solids of needles that lie askew are asked about in a frame along them, and what is found there
// is true of them as they are.
#include "geometry/depth/level_frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "../../support/depth_subjects.hpp"
#include "../../support/draw.hpp"

namespace strake::geometry {
namespace {

using test::Draw;
using testing::IndexedMesh;
using testing::Subject;
using testing::tube;
using testing::turned_by;

constexpr int kSides = 24;

/// A pipe in its insulation, out of step with it, at some place.
struct PipeAndInsulation {
  Subject pipe, insulation;
  TreedPart of_pipe = pipe.treed(), of_insulation = insulation.treed();
  SupportPlanes planes_of_pipe = make_support_planes(pipe.part),
                planes_of_insulation = make_support_planes(insulation.part);
  DepthField a{of_pipe, {}, &planes_of_pipe},
      b{of_insulation, pipe.origin - insulation.origin, &planes_of_insulation};

  explicit PipeAndInsulation(const Mat3d& turn)
      : pipe(turned_by(turn, tube(kSides, 57'000, 52'000, 0, 900'000)), {5000, 7000, -3000}),
        insulation(turned_by(turn, tube(32, 97'000, 57'000, 0, 900'000)), {5000, 7000, -3000}) {}
};

TEST(LevelFrame, AlongTheAxesNothingIsTurned) {
  const PipeAndInsulation pair(Mat3d{});
  const LevelFrame frame(pair.a, pair.b, false);
  EXPECT_EQ(&frame.a(), &pair.a);
  EXPECT_EQ(&frame.b(), &pair.b);
  EXPECT_EQ(frame.error(), 0);
}

TEST(LevelFrame, NorWhereThatIsNotWanted) {
  const PipeAndInsulation pair(Draw(1).rotation());
  const LevelFrame frame(pair.a, pair.b, true);
  EXPECT_EQ(&frame.a(), &pair.a);
  EXPECT_EQ(frame.scale(), 1);
}

/// Distances in the frame are those before the turn but for the error, and a point of both is one
/// of both.
TEST(LevelFrame, PointsAreAsDeepAsBefore) {
  int in_both = 0, in_both_before = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Draw draws(seed);
    const PipeAndInsulation pair(draws.rotation());
    const LevelFrame frame(pair.a, pair.b, false);
    ASSERT_NE(&frame.a(), &pair.a) << "seed " << seed;
    const Box3d box = frame.a().box();
    PairWork work;
    for (int i = 0; i < 800; ++i) {
      // Near the skins that lie on each other, where points of both are.
      const Part& part = i % 2 == 0 ? frame.a().part() : frame.b().part();
      const Triangle& t = part.triangles[draws.below(part.triangles.size())];
      double u = draws.between(0, 1), v = draws.between(0, 1);
      if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
      }
      const Vec3d c0 = part.vertices[t[0]].as<double>(), c1 = part.vertices[t[1]].as<double>(),
                  c2 = part.vertices[t[2]].as<double>();
      const Vec3d p = on_field_grid(c0 + (c1 - c0) * u + (c2 - c0) * v);
      if (!box.contains({p, p}) || !frame.a().contains(p, work) || !frame.b().contains(p, work))
        continue;
      ++in_both;
      const Vec3d q = on_field_grid(frame.back(p, work));
      if (pair.a.contains(q, work) && pair.b.contains(q, work)) ++in_both_before;
      const double here = greater_distance(frame.a(), frame.b(), p) / frame.scale();
      const double before = greater_distance(pair.a, pair.b, q);
      EXPECT_NEAR(here, before, 2 * frame.error()) << "seed " << seed;
    }
  }
  EXPECT_GT(in_both, 200);
  // Not quite all: at the edges where skins meet a point may be out of the one it was moved off.
  EXPECT_GT(in_both_before, in_both * 49 / 50);
}

/// And no farther out than the turn needs.
TEST(LevelFrame, HullsHoldTheTurnedSolids) {
  for (std::uint64_t seed = 0; seed <= 20; ++seed) {
    const PipeAndInsulation pair(seed == 0 ? Mat3d{} : Draw(seed).rotation());
    const LevelFrame frame(pair.a, pair.b, false);
    const auto expect_tight = [&](const DepthField& field, const std::vector<HalfSpace>& hull) {
      EXPECT_GT(hull.size(), 10U);
      for (const HalfSpace& h : hull) {
        double most = -std::numeric_limits<double>::infinity();
        for (const Vec3i& v : field.part().vertices)
          most = std::max(most, dot(h.normal, field.common(v.as<double>())));
        EXPECT_LE(most, h.offset) << "seed " << seed;
        EXPECT_GE(most, h.offset - 3) << "seed " << seed;
        EXPECT_NEAR(length(h.normal), 1, 1e-9) << "seed " << seed;
      }
    };
    expect_tight(frame.a(), frame.hull_a());
    expect_tight(frame.b(), frame.hull_b());
  }
}

}  // namespace
}  // namespace strake::geometry
