// SPDX-License-Identifier: Apache-2.0
// Round primitives in a view: their contours are lines of the drawing, the same for all that share
// a shape, and decided like any other line.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "geometry/numeric/trig.hpp"
#include "model/scene/view_tessellation.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/team.hpp"
#include "support/random_primitives.hpp"

namespace strake {
namespace {

using geometry::Mat3d;
using geometry::Vec3d;
using geometry::Vec3l;
using hlr::EdgeKind;
using hlr::EdgePiece;
using hlr::State;

/// Objects "0", "1", … of one primitive each.
class Plant {
 public:
  Plant() { model_.files.emplace_back(); }
  std::uint32_t shape(const geometry::Primitive& primitive) {
    model_.shapes.emplace_back(primitive);
    return static_cast<std::uint32_t>(model_.shapes.size() - 1);
  }
  void object(std::uint32_t shape, const Mat3d& linear, const Vec3d& at) {
    model::Object object;
    object.id = std::to_string(model_.objects.size());
    object.first_body = static_cast<std::uint32_t>(model_.bodies.size());
    object.body_count = 1;
    model_.objects.push_back(object);
    model::Body body;
    body.shape = model::ShapeId{shape};
    body.placement = {linear, at};
    model_.bodies.push_back(body);
  }
  void object(const geometry::Primitive& primitive, const Mat3d& linear = {},
              const Vec3d& at = {}) {
    object(shape(primitive), linear, at);
  }
  [[nodiscard]] const model::Scene& scene(double sag_mm = 0.5) {
    auto made = model::make_scene(model_, {.sag_mm = sag_mm}, {});
    EXPECT_TRUE(made);
    if (made) scene_ = std::move(*made);
    return scene_;
  }

 private:
  model::Model model_;
  model::Scene scene_;
};

hlr::Drawing drawn(const model::Scene& scene, const Vec3l& direction,
                   const hlr::Options& options = {}, const parallel::Context& context = {}) {
  auto drawing = hlr::draw(scene, {}, {.direction = direction, .limits = {}}, options, context);
  EXPECT_TRUE(drawing);
  return drawing ? std::move(*drawing) : hlr::Drawing{};
}

using Text = std::vector<std::tuple<std::uint32_t, std::uint32_t, EdgeKind, State, Vec3l, Vec3l>>;

Text text(const std::vector<EdgePiece>& pieces, const Vec3l& from = {}) {
  Text result;
  for (const EdgePiece& p : pieces)
    result.emplace_back(model::index(p.object), p.edge, p.kind, p.state, p.a - from, p.b - from);
  return result;
}

TEST(ContourLines, OfAPipeAreTwoStraightGenerators) {
  test::PrimitiveDraw draw(1);
  for (int i = 0; i < 50; ++i) {
    Plant plant;
    const double radius = draw.between(5, 400), height = 500;
    const Mat3d linear = draw.rotation();
    plant.object(geometry::CylinderPrimitive{radius, height}, linear);
    const Vec3l direction{draw.whole(-900, 900), draw.whole(-900, 900), draw.whole(1, 900)};
    const Vec3d axis = linear * Vec3d{0, 0, 1}, d = direction.as<double>();
    const Vec3d side = cross(axis, d);
    const double size = std::sqrt(dot(side, side));
    if (size < 0.05 * std::sqrt(dot(d, d))) continue;
    int contours = 0;
    for (const EdgePiece& p : drawn(plant.scene(), direction).pieces) {
      if (p.kind != EdgeKind::contour) continue;
      ++contours;
      EXPECT_EQ(p.state, State::visible);
      // On the pipe's true outline on paper, up to the snap, and from end to end.
      for (const Vec3l& end : {p.a, p.b})
        EXPECT_NEAR(std::fabs(dot(end.as<double>(), side)) / size, radius * 1000, 2);
      EXPECT_NEAR(std::sqrt(dot((p.b - p.a).as<double>(), (p.b - p.a).as<double>())), 500e3, 3);
    }
    EXPECT_EQ(contours, 2) << i;
  }
}

TEST(ContourLines, AreThoseOfEachView) {
  Plant plant;
  plant.object(geometry::SpherePrimitive{800});
  const model::Scene& scene = plant.scene();
  for (const Vec3l& direction : {Vec3l{1, 2, 3}, Vec3l{-5, 1, 2}, Vec3l{0, 0, 1}}) {
    const Vec3d d = direction.as<double>();
    int count = 0;
    for (const EdgePiece& p : drawn(scene, direction).pieces) {
      ++count;
      EXPECT_EQ(p.kind, EdgeKind::contour);
      EXPECT_EQ(p.state, State::visible);
      EXPECT_LT(std::fabs(dot(p.a.as<double>(), d)) / std::sqrt(dot(d, d)), 1.5);
      EXPECT_NEAR(std::sqrt(dot(p.a.as<double>(), p.a.as<double>())), 400e3, 1.5);
    }
    EXPECT_GE(count, 16);
  }
}

// A run of pipe, elbow and pipe: what meets has the same vertices, and there is no line but the
// rims, once for each of the two that share one, and two contours all along.
TEST(ContourLines, OfAPipeAndItsElbowMeetVertexToVertex) {
  for (const Vec3l& direction :
       {Vec3l{1, -1, 1}, Vec3l{3, 7, 2}, Vec3l{0, 0, 1}, Vec3l{0, -1, 0}, Vec3l{-4, 1, 9}}) {
    Plant plant;
    plant.object(geometry::CircularTorusPrimitive{450, 150, geometry::kPi / 2});
    Mat3d along_y, along_x;
    along_y.row = {Vec3d{1, 0, 0}, Vec3d{0, 0, 1}, Vec3d{0, -1, 0}};
    along_x.row = {Vec3d{0, 0, 1}, Vec3d{0, 1, 0}, Vec3d{-1, 0, 0}};
    plant.object(geometry::CylinderPrimitive{150, 2000}, along_y, {450, -1000, 0});
    plant.object(geometry::CylinderPrimitive{150, 2000}, along_x, {-1000, 450, 0});
    const hlr::Drawing drawing = drawn(plant.scene(), direction, {.stage = hlr::Stage::none});
    std::map<Vec3l, int> elbow, pipes, contours;
    for (const EdgePiece& p : drawing.pieces) {
      if (p.kind == EdgeKind::contour) ++contours[p.a], ++contours[p.b];
      if (p.kind != EdgeKind::sharp) continue;
      const bool bend = model::index(p.object) == 0;
      for (const Vec3l& end : {p.a, p.b})
        if (bend || end.y == 0 || end.x == 0) ++(bend ? elbow : pipes)[end];
    }
    EXPECT_GE(elbow.size(), 32U);
    for (const auto& [at, count] : elbow) {
      EXPECT_EQ(pipes[at], count);
      // A pipe that is seen along its axis has none.
      if (contours.contains(at) && direction != Vec3l{0, -1, 0}) {
        EXPECT_EQ(contours[at], 2);
      }
    }
  }
}

TEST(ContourLines, OfOneShapeAreTheSameWhereverItStands) {
  Plant plant;
  const std::uint32_t bend = plant.shape(geometry::CircularTorusPrimitive{300, 100, 1.5});
  test::PrimitiveDraw draw(4);
  const Mat3d linear = draw.rotation();
  std::vector<Vec3d> places;
  for (int i = 0; i < 5; ++i) {
    places.push_back({1000.0 * i, 5000.0 * i, -3000.0 * i});
    plant.object(bend, linear, places.back());
  }
  const model::Scene& scene = plant.scene();
  EXPECT_EQ(scene.shapes.size(), 1U);
  std::vector<std::vector<EdgePiece>> of(places.size());
  for (const EdgePiece& p : drawn(scene, {2, -3, 4}).pieces)
    of[model::index(p.object)].push_back(p);
  EXPECT_GT(of[0].size(), 100U);
  for (std::size_t i = 0; i < of.size(); ++i) {
    for (EdgePiece& p : of[i]) p.object = {};
    EXPECT_EQ(text(of[i], (places[i] * 1000.0).as<std::int64_t>()), text(of[0])) << i;
  }
}

/// A crowd of round primitives and boxes that hide, touch and pass through each other.
void crowd(Plant& plant, std::uint64_t seed, std::size_t objects) {
  test::PrimitiveDraw draw(seed);
  std::vector<std::uint32_t> shapes;
  for (std::size_t i = 0; i < objects; ++i) {
    if (i % 3 != 0 || shapes.empty()) {
      const double tube = draw.between(10, 60);
      shapes.push_back(plant.shape(
          draw.one_in(3) ? geometry::Primitive(geometry::CircularTorusPrimitive{
                               tube * draw.between(0.7, 4), tube, draw.between(0.3, 6)})
                         : draw.convex(draw.below(test::PrimitiveDraw::kConvexKinds), 200)));
    }
    plant.object(shapes[draw.below(shapes.size())], draw.linear(), draw.point(150));
  }
}

TEST(ContourLines, AreDecidedAsByBruteForceWithAndWithoutCulling) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    Plant plant;
    crowd(plant, seed, 6);
    const model::Scene& scene = plant.scene(12);
    for (const Vec3l& direction : {Vec3l{1, -1, 1}, Vec3l{0, 0, 1}, Vec3l{5, 3, -8}}) {
      hlr::Options options;
      const Text usual = text(drawn(scene, direction, options).pieces);
      options.culling = false;
      EXPECT_EQ(text(drawn(scene, direction, options).pieces), usual);
      options.solver = hlr::Solver::brute_force;
      EXPECT_EQ(text(drawn(scene, direction, options).pieces), usual);
    }
  }
}

TEST(ContourLines, AreTheSameForAnyNumberOfThreads) {
  Plant plant;
  crowd(plant, 9, 30);
  const model::Scene& scene = plant.scene(4);
  const Text one = text(drawn(scene, {3, -1, 2}).pieces);
  for (const unsigned threads : {1U, 2U, 3U, 8U, 64U}) {
    parallel::Team team(threads);
    EXPECT_EQ(text(drawn(scene, {3, -1, 2}, {}, {.team = &team}).pieces), one);
  }
}

TEST(ContourLines, KnowTheCirclesThatTheyAreChordsOf) {
  Plant plant;
  test::PrimitiveDraw draw(12);
  plant.object(geometry::BoxPrimitive{100, 100, 100});
  plant.object(geometry::CylinderPrimitive{200, 900}, draw.rotation(), {5000, 0, 77});
  plant.object(geometry::SpherePrimitive{500}, draw.rotation(), {-5000, 300, 0});
  plant.object(geometry::EllipticalDishPrimitive{300, 120}, draw.rotation(), {0, 9000, 0});
  const hlr::Drawing drawing = drawn(plant.scene(), {1, 2, 3}, {.stage = hlr::Stage::none});
  std::size_t curved = 0;
  for (const EdgePiece& p : drawing.pieces) {
    const auto found = std::ranges::find_if(drawing.curves.edges, [&](const auto& e) {
      return e.object == p.object && e.edge == p.edge;
    });
    const bool generator = p.kind == EdgeKind::contour && model::index(p.object) == 1;
    ASSERT_EQ(found == drawing.curves.edges.end(), generator || model::index(p.object) == 0);
    if (found == drawing.curves.edges.end()) continue;
    ++curved;
    const hlr::Curve& curve = drawing.curves.all[found->curve];
    for (const Vec3l& end : {p.a, p.b})
      EXPECT_TRUE(curve.at.passes((end - curve.origin).as<double>() * 0.001, 0.002));
  }
  EXPECT_GT(curved, 80U);
}

TEST(ContourLines, ThatCutATorusAtItsAxisAreStraight) {
  Plant plant;
  // The tube reaches over the axis: each end face is the outer part of a circle and a straight cut.
  plant.object(geometry::CircularTorusPrimitive{200, 300, 1.2});
  const hlr::Drawing drawing = drawn(plant.scene(), {1, 2, 3}, {.stage = hlr::Stage::none});
  std::size_t cuts = 0;
  for (const EdgePiece& p : drawing.pieces) {
    const auto on_axis = [](const Vec3l& v) { return v.x == 0 && v.y == 0; };
    if (!on_axis(p.a) || !on_axis(p.b)) continue;
    ++cuts;
    EXPECT_TRUE(std::ranges::none_of(drawing.curves.edges, [&](const auto& e) {
      return e.object == p.object && e.edge == p.edge;
    }));
  }
  EXPECT_GT(cuts, 0U);
  EXPECT_GT(drawing.curves.edges.size(), 10U);
}

TEST(SceneOfAView, ChangesNothingWhereNothingIsRound) {
  Plant plant;
  plant.object(geometry::BoxPrimitive{10, 20, 30});
  plant.object(geometry::SpherePrimitive{50});
  const model::Scene& scene = plant.scene();
  const model::ViewTessellationOptions from{.towards = Vec3l{1, 2, 3}};
  const auto without = model::tessellate_for_view(scene, {true, false}, from, {});
  ASSERT_TRUE(without);
  EXPECT_FALSE(without->has_value());
  const auto once = model::tessellate_for_view(scene, {}, from, {});
  ASSERT_TRUE(once);
  ASSERT_TRUE(once->has_value());
  const auto twice = model::tessellate_for_view(**once, {}, from, {});
  ASSERT_TRUE(twice);
  ASSERT_TRUE(twice->has_value());
  EXPECT_NE((*once)->shapes[1].parts[0].vertices, scene.shapes[1].parts[0].vertices);
  EXPECT_EQ((*once)->shapes[1].parts[0].vertices, (*twice)->shapes[1].parts[0].vertices);
  EXPECT_EQ((*once)->shapes[0].parts[0].vertices, scene.shapes[0].parts[0].vertices);
}

/// What limits or an eye leave out keeps the triangles of the scene, however fine the rest is.
TEST(SceneOfAView, IsFinerOnlyWhereItShows) {
  Plant plant;
  plant.object(geometry::SpherePrimitive{50});
  plant.object(geometry::SpherePrimitive{60});
  const model::Scene& scene = plant.scene();
  const auto triangles = [&](const model::ViewTessellationOptions& sight) {
    const auto tessellated = model::tessellate_for_view(scene, {}, sight, {}).value();
    const model::Scene& made = tessellated ? *tessellated : scene;
    return std::pair(made.shapes[0].parts[0].triangles.size(),
                     made.shapes[1].parts[0].triangles.size());
  };
  const auto as_is = triangles({});
  const auto fine = triangles({.sag_mm = 0.01});
  EXPECT_GT(fine.first, 4 * as_is.first);
  EXPECT_GT(fine.second, 4 * as_is.second);
  const geometry::Box3l second = scene.bodies[1].box(scene.shapes[1]);
  const auto one = triangles(
      {.sag_mm = 0.01, .shows = [&](const geometry::Box3l& box) { return box == second; }});
  EXPECT_EQ(one, std::pair(as_is.first, fine.second));
}

/// The length of what runs round a pipe at a place along its axis, in whatever state.
double rim_length_mm(const hlr::Drawing& drawing, const Vec3d& axis, double at_mm) {
  double sum = 0;
  for (const EdgePiece& p : drawing.pieces) {
    const auto off = [&](const Vec3l& end) {
      return std::fabs(dot(axis, end.as<double>()) / 1000 - at_mm);
    };
    const auto along = (p.b - p.a).as<double>();
    if (off(p.a) < 0.01 && off(p.b) < 0.01) sum += std::sqrt(dot(along, along)) / 1000;
  }
  return sum;
}

TEST(Contours, PipesInLineHaveNoRimBetweenThemWithoutFlushSeams) {
  constexpr double kRadius = 50;
  const Mat3d turned{{Vec3d{0.6, 0, 0.8}, Vec3d{0, 1, 0}, Vec3d{-0.8, 0, 0.6}}};
  for (const Mat3d& linear : {Mat3d{}, turned}) {
    const Vec3d axis = linear * Vec3d{0, 0, 1};
    Plant plant;
    plant.object(geometry::CylinderPrimitive{kRadius, 300}, linear, axis * 150);
    plant.object(geometry::CylinderPrimitive{kRadius, 500}, linear, axis * 550);
    const model::Scene& scene = plant.scene();
    const hlr::Drawing with = drawn(scene, {3, -2, 1});
    const hlr::Drawing without = drawn(scene, {3, -2, 1}, {.flush_seams = false});
    EXPECT_NEAR(rim_length_mm(with, axis, 300), 2 * 2 * geometry::kPi * kRadius, 10);
    EXPECT_EQ(rim_length_mm(without, axis, 300), 0);
    for (const double end : {0.0, 800.0})
      EXPECT_NEAR(rim_length_mm(without, axis, end), 2 * geometry::kPi * kRadius, 5);
  }
}

}  // namespace
}  // namespace strake
