// SPDX-License-Identifier: Apache-2.0
// What becomes of the objects of random crowds, most of them damaged: none vanishes silently.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string>

#include "strake/drawing/drawing.hpp"
#include "strake/geometry/primitive.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/team.hpp"
#include "support/draw.hpp"
#include "support/meshes.hpp"

namespace strake {
namespace {

using geometry::Vec3d;
using hlr::Fate;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A body and what is wrong with it.
model::Body add_body(model::Model& model, test::Draw& draw, double room) {
  const Vec3d at{draw.between(0, room), draw.between(0, room), draw.between(0, room)};
  geometry::TriangleMesh mesh = test::box_mesh({0, 0, 0}, {40, 30, 20});
  model::Shape shape = mesh;
  model::Body body;
  body.placement.translation = at;
  switch (draw.below(14)) {
    case 0:
      mesh.vertices[draw.below(8)].x = kNan;  // drawn without the triangles there
      shape = mesh;
      break;
    case 1:
      for (Vec3d& v : mesh.vertices) v.y = kNan;
      shape = mesh;
      break;
    case 2:
      for (Vec3d& v : mesh.vertices) v = v * 1e-6;
      shape = mesh;
      break;
    case 3:
      mesh.triangles[draw.below(12)][1] = 77;
      shape = mesh;
      break;
    case 4:
      for (Vec3d& v : mesh.vertices) v = v * 1e6;
      shape = mesh;
      break;
    case 5:
      mesh.triangles.resize(draw.below(12));  // open, or without a triangle
      shape = mesh;
      break;
    case 6:
      body.placement.translation.z = draw.one_in(2) ? kNan : 1e30;
      break;
    case 7:
      shape = geometry::Primitive{geometry::CylinderPrimitive{draw.one_in(2) ? -1.0 : 0.0, 5}};
      break;
    case 8:
      shape = geometry::Polylines{{{0, 0, 0}, {0, 0, 50}}, {0, 2}};  // a point from above
      break;
    case 9:
      shape = geometry::Polylines{{{0, 0, 0}, {kNan, 0, 50}, {9, 9, 9}}, {0, 3}};
      break;
    case 10:
      body.category = model::Category::insulation;
      break;
    case 11:
      for (Vec3d& v : mesh.vertices) v.z = v.x = 0;  // nothing but lines
      shape = mesh;
      break;
    case 12:
      body.placement.translation = {50, 50, 50};  // several lie on each other
      break;
    default:
      break;
  }
  body.shape = model::ShapeId{static_cast<std::uint32_t>(model.shapes.size())};
  model.shapes.push_back(std::move(shape));
  return body;
}

model::Model crowd(std::uint64_t seed, std::uint32_t objects, double room = 200) {
  test::Draw draw(seed);
  model::Model model;
  model.files.push_back({"crowd.obj", "OBJ", "mm", "z", 1, 0});
  for (std::uint32_t o = 0; o < objects; ++o) {
    model::Object object;
    object.id = object.name = std::to_string(o);
    object.first_body = static_cast<std::uint32_t>(model.bodies.size());
    object.body_count = draw.one_in(9) ? 0 : draw.one_in(3) ? 2 : 1;
    object.incomplete = draw.one_in(12);
    for (std::uint32_t b = 0; b < object.body_count; ++b)
      model.bodies.push_back(add_body(model, draw, room));
    model.objects.push_back(object);
  }
  return model;
}

hlr::View view_of(test::Draw& draw) {
  constexpr std::array<geometry::Vec3l, 4> kDirections{
      {{0, 0, 1}, {0, -1, 0}, {1, -1, 1}, {3, -7, 2}}};
  hlr::View view;
  view.direction = kDirections.at(draw.below(kDirections.size()));
  view.up = view.direction.x == 0 && view.direction.y == 0 ? geometry::Vec3l{0, 1, 0}
                                                           : geometry::Vec3l{0, 0, 1};
  if (draw.one_in(3)) view.limits = {{0, 0, 0}, {150'000, 120'000, 120'000}};
  if (draw.one_in(3)) view.sections.push_back({{1, 0, 0}, {100'000, 0, 0}});
  return view;
}

/// Told from the pieces and the scene alone.
void expect_true(const model::Scene& scene, const std::vector<bool>& drawn,
                 const hlr::Drawing& drawing) {
  std::map<std::uint32_t, std::set<hlr::State>> states;
  for (const hlr::EdgePiece& piece : drawing.pieces)
    states[model::index(piece.object)].insert(piece.state);
  std::set<std::uint32_t> lacking, named;
  for (const model::IncompleteObject& l : scene.lacking) lacking.insert(model::index(l.object));
  for (const hlr::Defect& d : drawing.account.defects) named.insert(model::index(d.object));
  ASSERT_EQ(drawing.account.fates.size(), drawn.size());
  for (std::uint32_t o = 0; o < drawn.size(); ++o) {
    const Fate fate = drawing.account.fates[o];
    const std::set<hlr::State>& states_of_object = states[o];
    const bool placed = !scene.bodies_of(model::ObjectId{o}).empty();
    EXPECT_EQ(drawn[o], fate != Fate::unselected) << o;
    EXPECT_EQ(fate == Fate::drawn, states_of_object.contains(hlr::State::visible)) << o;
    if (fate == Fate::hidden) {
      EXPECT_TRUE(states_of_object.contains(hlr::State::hidden_by_self) ||
                  states_of_object.contains(hlr::State::hidden_by_other));
    }
    EXPECT_TRUE(fate != Fate::clipped || states_of_object.contains(hlr::State::clipped)) << o;
    EXPECT_FALSE((fate == Fate::failed || fate == Fate::left_out) && placed) << o;
    // What is wrong with an object, or that it makes no line, is reported by name.
    const bool wrong = lacking.contains(o) || fate == Fate::degenerate || fate == Fate::failed;
    EXPECT_EQ(named.contains(o), drawn[o] && wrong) << o;
  }
}

std::uint64_t sum(const hlr::Account& account) {
  std::uint64_t total = 0;
  for (const Fate fate : {Fate::drawn, Fate::coincident, Fate::hidden, Fate::clipped,
                          Fate::degenerate, Fate::failed, Fate::left_out})
    total += account.of(fate);
  return total;
}

TEST(Accounting, FatesOfDamagedCrowdsAddUp) {
  std::array<std::uint64_t, hlr::kFates> met{};
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const model::Model model = crowd(seed, 40);
    const auto scene = model::make_scene(model, {}, {});
    ASSERT_TRUE(scene);
    test::Draw draw(seed + 1000);
    std::vector<bool> drawn(model.objects.size(), true);
    if (draw.one_in(2))
      for (std::size_t o = 0; o < drawn.size(); ++o) drawn[o] = !draw.one_in(4);
    const auto drawing = hlr::draw(*scene, drawn, view_of(draw), {}, {});
    ASSERT_TRUE(drawing) << drawing.error().text();
    const auto selected = static_cast<std::uint64_t>(std::count(drawn.begin(), drawn.end(), true));
    EXPECT_EQ(drawing->account.objects(), selected) << seed;
    EXPECT_EQ(sum(drawing->account), selected) << seed;
    EXPECT_EQ(drawing->account.of(Fate::coincident), 0U);
    expect_true(*scene, drawn, *drawing);

    const auto paper = drawing::lay_out(*drawing, model, {}, {});
    ASSERT_TRUE(paper) << paper.error().text();
    EXPECT_EQ(sum(paper->account), selected) << seed;
    std::set<model::ObjectId> on_paper;
    for (const drawing::Line& line : paper->lines)
      if (line.state == drawing::LineState::visible) on_paper.insert(line.object);
    EXPECT_EQ(on_paper.size(), paper->account.of(Fate::drawn)) << seed;
    EXPECT_EQ(paper->account.of(Fate::drawn) + paper->account.of(Fate::coincident),
              drawing->account.of(Fate::drawn));
    EXPECT_EQ(std::accumulate(paper->count.begin(), paper->count.end(), std::uint64_t{0}),
              paper->lines.size());
    for (std::size_t f = 0; f < hlr::kFates; ++f) met.at(f) += paper->account.count.at(f);
  }
  for (std::size_t f = 0; f < hlr::kFates; ++f) EXPECT_GT(met.at(f), 5U) << f;
}

TEST(Accounting, IsTheSameForAnyNumberOfThreads) {
  const model::Model model = crowd(7, 9000, 3000);  // more than one block
  const auto scene = model::make_scene(model, {}, {});
  ASSERT_TRUE(scene);
  const auto account = [&](unsigned threads) {
    parallel::Team team(threads);
    const parallel::Context context{.team = &team};
    const auto drawing =
        hlr::draw(*scene, {}, {.direction = {0, 0, 1}, .up = {0, 1, 0}, .limits = {}},
                  {.stage = hlr::Stage::local, .intersections = hlr::Intersections::off}, context);
    EXPECT_TRUE(drawing);
    return drawing::lay_out(*drawing, model, {}, context).value().account;
  };
  const hlr::Account one = account(1), eight = account(8);
  EXPECT_EQ(one.objects(), 9000U);
  EXPECT_EQ(one.fates, eight.fates);
  EXPECT_EQ(one.defects, eight.defects);
  EXPECT_EQ(one.in_part, eight.in_part);
}

// What can be drawn of a defective mesh is.
TEST(Accounting, ABadTriangleCostsItsOwnLinesOnly) {
  model::Model model;
  model.files.push_back({"t.obj", "OBJ", "mm", "z", 1, 0});
  geometry::TriangleMesh mesh = test::box_mesh({0, 0, 0}, {40, 30, 20});
  test::add_box(mesh, {100, 0, 0}, {140, 30, 20});
  mesh.vertices.push_back({kNan, 0, 0});
  mesh.triangles.push_back({0, 1, 16});
  model.shapes.emplace_back(mesh);
  model.bodies.emplace_back();
  model::Object object;
  object.id = object.name = "tank";
  object.body_count = 1;
  model.objects.push_back(object);
  const auto scene = model::make_scene(model, {}, {});
  ASSERT_TRUE(scene);
  const auto drawing = hlr::draw(*scene, {}, {}, {}, {});
  ASSERT_TRUE(drawing);
  EXPECT_EQ(drawing->counters.feature_edges, 24U);
  EXPECT_EQ(drawing->account.of(Fate::drawn), 1U);
  EXPECT_EQ(drawing->account.in_part, 1U);
  EXPECT_EQ(drawing->account.defects,
            (std::vector<hlr::Defect>{{model::ObjectId{0}, "mesh-bad-triangle"}}));
  ASSERT_EQ(drawing->diagnostics.count("object-in-part"), 1U);
  EXPECT_EQ(drawing->diagnostics.kept().front().where, "t.obj: tank");
}

}  // namespace
}  // namespace strake
