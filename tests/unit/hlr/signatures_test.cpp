// SPDX-License-Identifier: Apache-2.0
// Signatures show all that a drawing sees of an object, and nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "strake/hlr/incremental.hpp"
#include "support/changing_model.hpp"

namespace strake {
namespace {

using hlr::Signatures;
using test::ChangingModel;
using test::ChangingObject;

Signatures signatures_of(const ChangingModel& changing, const hlr::View& view = {},
                         const hlr::Options& options = {},
                         const model::SceneOptions& scene_options = {.sag_mm = 0.3}) {
  const auto model = std::make_unique<model::Model>(changing.build());
  const model::Scene scene = model::make_scene(*model, scene_options, {}).value();
  return hlr::signatures(scene, changing.drawn(), view, options, {}).value();
}

/// Objects 0 to 3 are a mesh, a cylinder, a polyline and two bodies.
ChangingModel four_objects() {
  ChangingModel changing(1, 0);
  const model::Shape box = test::box_mesh({0, 0, 0}, {3, 4, 5});
  const model::Shape pipe = geometry::Primitive(geometry::CylinderPrimitive{2, 9});
  const model::Shape line = geometry::Polylines{.points = {{0, 0, 0}, {1, 2, 3}}, .first = {0, 2}};
  const auto add = [&](const std::vector<model::Shape>& shapes) {
    const auto number = changing.objects().size();
    ChangingObject one{
        .identity = number, .name = "object " + std::to_string(number), .bodies = {}};
    for (const model::Shape& shape : shapes)
      one.bodies.push_back({.shape = shape, .placement = {}});
    changing.objects().push_back(one);
  };
  add({box});
  add({pipe});
  add({line});
  add({box, pipe});
  return changing;
}

struct Mutation {
  std::string name;
  std::size_t object = 0;
  std::function<void(ChangingObject&)> change;
};

TEST(Signatures, WhatADrawingSeesOfAnObjectShowsInItsSignatureAlone) {
  const std::vector<Mutation> mutations{
      {"moved", 0, [](auto& o) { o.bodies[0].placement.translation.y += 0.001; }},
      {"turned", 1,
       [](auto& o) { o.bodies[0].placement.linear.row = {{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}}; }},
      {"vertex", 0,
       [](auto& o) { std::get<geometry::TriangleMesh>(o.bodies[0].shape).vertices[7].x += 0.001; }},
      {"faces", 0,
       [](auto& o) {
         std::get<geometry::TriangleMesh>(o.bodies[0].shape).faces = {0, 0, 1, 1, 2, 2,
                                                                      3, 3, 4, 4, 5, 6};
       }},
      {"a triangle less", 0,
       [](auto& o) { std::get<geometry::TriangleMesh>(o.bodies[0].shape).triangles.pop_back(); }},
      {"radius", 1,
       [](auto& o) {
         o.bodies[0].shape = geometry::Primitive(geometry::CylinderPrimitive{2.0001, 9});
       }},
      {"point", 2,
       [](auto& o) { std::get<geometry::Polylines>(o.bodies[0].shape).points[1].z += 1; }},
      {"transparent", 3, [](auto& o) { o.bodies[1].alpha = 254; }},
      {"precision", 3, [](auto& o) { o.bodies[0].precision_um = 30; }},
      {"a body less", 3, [](auto& o) { o.bodies.pop_back(); }},
      {"a body more", 2, [](auto& o) { o.bodies.push_back(o.bodies[0]); }},
      {"bodies in another order", 3, [](auto& o) { std::swap(o.bodies[0], o.bodies[1]); }},
      {"no bodies", 2, [](auto& o) { o.bodies.clear(); }},
      {"incomplete", 2, [](auto& o) { o.incomplete = true; }},
      {"not drawn", 1, [](auto& o) { o.drawn = false; }},
  };
  const ChangingModel changing = four_objects();
  const Signatures before = signatures_of(changing);
  for (const Mutation& mutation : mutations) {
    ChangingModel changed = changing;
    mutation.change(changed.objects()[mutation.object]);
    const Signatures after = signatures_of(changed);
    EXPECT_EQ(after.view, before.view) << mutation.name;
    for (std::size_t o = 0; o < before.objects.size(); ++o)
      EXPECT_EQ(after.objects[o] == before.objects[o], o != mutation.object)
          << mutation.name << ", object " << o;
  }
}

TEST(Signatures, WhatItDoesNotSeeDoesNotShow) {
  const ChangingModel changing = four_objects();
  const Signatures before = signatures_of(changing);
  ChangingModel changed = changing;
  changed.objects()[0].name = "another";
  changed.objects()[0].identity = 99;
  changed.objects()[1].bodies[0].red = 3;
  EXPECT_EQ(signatures_of(changed).objects, before.objects);
  hlr::Options options;
  options.solver = hlr::Solver::brute_force;
  options.culling = false;
  options.bucketing = 4;
  EXPECT_EQ(signatures_of(changing, {}, options).view, before.view);
  // Sections hatch by colour.
  const hlr::View cut{.sections = {{{0, 0, 1}, {0, 0, 1000}}}};
  const Signatures of_cut = signatures_of(changing, cut), of_changed = signatures_of(changed, cut);
  EXPECT_EQ(of_cut.objects[0], of_changed.objects[0]);
  EXPECT_NE(of_cut.objects[1], of_changed.objects[1]);
  EXPECT_EQ(of_cut.objects[2], of_changed.objects[2]);
}

TEST(Signatures, NumbersOfObjectsAndShapesDoNotShow) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const ChangingModel changing(seed, 40);
    const Signatures before = signatures_of(changing);
    ChangingModel reversed = changing;
    std::ranges::reverse(reversed.objects());
    Signatures after = signatures_of(reversed);
    std::ranges::reverse(after.objects);
    std::ranges::reverse(after.boxes);
    EXPECT_EQ(after.objects, before.objects) << seed;
    EXPECT_EQ(after.boxes, before.boxes) << seed;
  }
}

TEST(Signatures, WhatChangesTheDrawingShowsInThatOfTheView) {
  const ChangingModel changing = four_objects();
  std::vector<Hash128> all{signatures_of(changing).view};
  const auto add_view = [&](const auto& change) {
    hlr::View view;
    change(view);
    all.push_back(signatures_of(changing, view).view);
  };
  const auto add_options = [&](const auto& change) {
    hlr::Options options;
    change(options);
    all.push_back(signatures_of(changing, {}, options).view);
  };
  add_view([](hlr::View& v) { v.direction = {0, 0, 1}; });
  add_view([](hlr::View& v) { v.up = {0, 1, 0}; });
  add_view([](hlr::View& v) { v.limits = geometry::Box3l{{0, 0, 0}, {9, 9, 9}}; });
  add_view([](hlr::View& v) { v.limits = geometry::Box3l{{0, 0, 0}, {9, 9, 8}}; });
  add_view([](hlr::View& v) { v.sections = {{{0, 0, 1}, {0, 0, 9}}}; });
  add_view([](hlr::View& v) {
    v.direction = {0, 0, 1};
    v.perspective = {.eye = {0, 0, 900000}, .target = {}};
  });
  add_view([](hlr::View& v) {
    v.direction = {0, 0, 1};
    v.perspective = {.eye = {0, 0, 900000}, .target = {}, .near_mm = 7};
  });
  add_view([](hlr::View& v) {
    v.direction = {0, 0, 1};
    v.perspective = {.eye = {0, 0, 900000}, .target = {}, .field_of_view_deg = 7};
  });
  add_options([](hlr::Options& o) { o.stage = hlr::Stage::local; });
  add_options([](hlr::Options& o) { o.sharp_angle_deg = 21; });
  add_options([](hlr::Options& o) { o.smooth = hlr::Smooth::all; });
  add_options([](hlr::Options& o) { o.contact_distance_mm = 0; });
  add_options([](hlr::Options& o) { o.intersections = hlr::Intersections::off; });
  add_options([](hlr::Options& o) { o.own_polylines = hlr::OwnPolylines::hidden; });
  add_options([](hlr::Options& o) { o.flush_seams = false; });
  add_options([](hlr::Options& o) { o.sag_mm = 0.1; });
  add_options([](hlr::Options& o) { o.hidden = false; });
  add_options([](hlr::Options& o) { o.clipped = false; });
  add_options([](hlr::Options& o) { o.hidden = o.clipped = false; });
  add_options([](hlr::Options& o) { o.keep_specks = true; });
  add_options([](hlr::Options& o) { o.hatch_spacing_mm = 0; });
  all.push_back(signatures_of(changing, {}, {}, {.sag_mm = 0.4}).view);
  all.push_back(signatures_of(changing, {}, {}, {.sag_mm = 0.3, .weld_mm = 1}).view);
  std::ranges::sort(all);
  EXPECT_EQ(std::ranges::adjacent_find(all), all.end());
}

TEST(Signatures, HatchesAndPartsLeftWholeShowInTheirObjects) {
  const ChangingModel changing = four_objects();
  const Signatures before = signatures_of(changing);
  hlr::Options options;
  options.hatches.resize(4);
  options.uncut.resize(4);
  EXPECT_EQ(signatures_of(changing, {}, options).objects, before.objects);
  options.hatches[1].angle_deg = 30;
  options.hatches[2].spacing_mm = 3;
  options.uncut[3] = true;
  const Signatures after = signatures_of(changing, {}, options);
  EXPECT_EQ(after.objects[0], before.objects[0]);
  for (const std::size_t o : {1U, 2U, 3U}) EXPECT_NE(after.objects[o], before.objects[o]) << o;
}

/// A body that is looked at makes all of its shape finer, wherever they are.
TEST(Signatures, FinenessThatAnotherObjectRequestsShows) {
  ChangingModel changing = four_objects();
  changing.objects()[1].bodies[0].placement.translation = {500, 0, 0};
  const hlr::View view{.direction = {0, 0, 1},
                       .limits = geometry::Box3l{{-20000, -20000, -20000}, {20000, 20000, 20000}}};
  hlr::Options options;
  options.sag_mm = 0.01;
  changing.objects()[3].drawn = false;
  changing.objects()[3].bodies[1].shape = changing.objects()[1].bodies[0].shape;
  const auto one_shape = [&] {
    model::Model model = changing.build();
    // The two pipes are bodies 1 and 4.
    model.bodies[4].shape = model.bodies[1].shape;
    const model::Scene scene = model::make_scene(model, {.sag_mm = 0.3}, {}).value();
    return hlr::signatures(scene, changing.drawn(), view, options, {}).value();
  };
  const Signatures before = one_shape();
  changing.objects()[3].drawn = true;
  const Signatures after = one_shape();
  EXPECT_NE(after.objects[1], before.objects[1]);
  EXPECT_EQ(after.objects[0], before.objects[0]);
}

}  // namespace
}  // namespace strake
