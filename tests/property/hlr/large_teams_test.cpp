// SPDX-License-Identifier: Apache-2.0
// Drawings of more bodies than a worker takes at once are the same for any team, in all that they
// count, too: the loops before and behind the edges of a view go through bodies in blocks.
#include <gtest/gtest.h>

#include <cstdint>
#include <tuple>
#include <vector>

#include "strake/generate/ship.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/team.hpp"

namespace strake::hlr {
namespace {

constexpr std::uint64_t kObjects = 12'000;

auto fields(const EdgePiece& piece) {
  return std::tie(piece.object, piece.edge, piece.kind, piece.state, piece.other, piece.a, piece.b);
}

auto fields(const Counters& work) {
  return std::tie(work.feature_edges, work.covered_edges, work.face_tests, work.exact_fallbacks,
                  work.crossing_pairs, work.crossing_tests, work.specks, work.left_out,
                  work.shared_shapes, work.shared_bodies);
}

void expect_equal(const Drawing& found, const Drawing& expected) {
  ASSERT_EQ(found.pieces.size(), expected.pieces.size());
  for (std::size_t i = 0; i < expected.pieces.size(); ++i)
    ASSERT_EQ(fields(found.pieces[i]), fields(expected.pieces[i])) << "piece " << i;
  EXPECT_EQ(fields(found.counters), fields(expected.counters));
  EXPECT_EQ(found.counted, expected.counted);
  EXPECT_EQ(found.left_out, expected.left_out);
  EXPECT_EQ(found.account.fates, expected.account.fates);
  EXPECT_EQ(found.contact_distance_mm, expected.contact_distance_mm);
  EXPECT_EQ(found.origin, expected.origin);
}

struct OneView {
  const char* name;
  View view;
  Stage stage = Stage::global;
  bool hidden = true;
};

std::vector<OneView> views(const geometry::Vec3l& middle) {
  const View iso{.direction = {1, -1, 1}}, right{.direction = {1, 0, 0}};
  View cut = right;
  cut.sections = {{.normal = {1, 0, 0}, .point = middle}};
  return {{"isometric, local", iso, Stage::local},
          {"isometric, visible lines", iso, Stage::global, false},
          // Bodies stand behind each other along the ship.
          {"along the ship", right, Stage::global, false},
          {"section", cut, Stage::local}};
}

TEST(LargeTeams, DrawAShipAsOneWorkerDoes) {
  const auto ship = generate::generate_ship({.objects = kObjects}, {});
  ASSERT_TRUE(ship.has_value()) << ship.error().text();
  const auto scene = model::make_scene(ship->model, {}, {});
  ASSERT_TRUE(scene.has_value()) << scene.error().text();
  ASSERT_GT(scene->bodies.size(), 2 * 4096U) << "of several blocks";
  const geometry::Vec3l middle = scene->bodies[scene->bodies.size() / 2].origin;
  for (const OneView& one : views(middle)) {
    SCOPED_TRACE(one.name);
    Options how;
    how.stage = one.stage;
    how.hidden = one.hidden;
    const auto expected = draw(*scene, {}, one.view, how, {});
    ASSERT_TRUE(expected.has_value()) << expected.error().text();
    ASSERT_GT(expected->pieces.size(), 1000U);
    for (const unsigned workers : {2U, 3U, 8U}) {
      parallel::Team team(workers);
      const auto found = draw(*scene, {}, one.view, how, {.team = &team});
      ASSERT_TRUE(found.has_value()) << found.error().text();
      expect_equal(*found, *expected);
    }
  }
}

}  // namespace
}  // namespace strake::hlr
