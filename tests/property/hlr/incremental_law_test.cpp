// SPDX-License-Identifier: Apache-2.0
// A drawing that follows changes is the drawing made anew, bit by bit, after any sequence of edits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "strake/hlr/hlr.hpp"
#include "strake/hlr/incremental.hpp"
#include "strake/parallel/team.hpp"
#include "support/changing_model.hpp"
#include "support/drawing_cases.hpp"
#include "support/rounds.hpp"

namespace strake {
namespace {

using test::ChangingModel;
using test::difference;
using test::Draw;
using test::some_options;
using test::some_view;
using test::with_rules;

/// One state of a model, as a view sees it.
struct Observation {
  std::unique_ptr<model::Model> model;
  model::Scene scene;
  std::vector<bool> drawn;
  std::vector<std::uint64_t> identities;
  hlr::Options options;
  hlr::Signatures signatures;
};

Observation observe(const ChangingModel& changing, const hlr::View& view,
                    const hlr::Options& options, const parallel::Context& context) {
  Observation state;
  state.model = std::make_unique<model::Model>(changing.build());
  state.scene = model::make_scene(*state.model, {.sag_mm = 0.3}, context).value();
  state.drawn = changing.drawn();
  for (const test::ChangingObject& one : changing.objects())
    state.identities.push_back(one.identity);
  state.options = options;
  state.signatures = hlr::signatures(state.scene, state.drawn, view, options, context).value();
  return state;
}

std::vector<std::uint32_t> mapped(const Observation& before, const Observation& now) {
  std::map<std::uint64_t, std::uint32_t> number;
  for (std::uint32_t o = 0; o < now.identities.size(); ++o) number[now.identities[o]] = o;
  std::vector<std::uint32_t> result;
  for (std::size_t o = 0; o < before.identities.size(); ++o) {
    const auto found = number.find(before.identities[o]);
    const bool stays = found != number.end() &&
                       before.signatures.objects[o] == now.signatures.objects[found->second];
    result.push_back(stays ? found->second : model::kNoObject);
  }
  return result;
}

/// The lines of some objects, with what they lie on: equal texts are equal to the last bit.
std::string lines_of(const hlr::Drawing& drawing, const std::vector<bool>& left_out) {
  std::ostringstream text;
  text << std::hexfloat;
  const auto skips = [&](model::ObjectId object) { return left_out.at(model::index(object)); };
  const auto put = [&](const auto&... values) { ((text << values << ' '), ...) << '\n'; };
  for (std::size_t o = 0; o < left_out.size(); ++o) {
    if (left_out[o]) continue;
    put(o, drawing.counted.at(o).edges, drawing.counted.at(o).specks);
    if (!drawing.left_out.empty()) put("left out", drawing.left_out.at(o));
    if (!drawing.clipped_left_out.empty()) put("clipped", drawing.clipped_left_out.at(o));
    if (!drawing.hatches.empty())
      put("hatch", drawing.hatches.at(o).angle_deg, drawing.hatches.at(o).spacing_mm);
  }
  for (const hlr::EdgePiece& p : drawing.pieces)
    if (!skips(p.object))
      put(model::index(p.object), p.edge, static_cast<int>(p.kind), static_cast<int>(p.state),
          model::index(p.other), p.a.x, p.a.y, p.a.z, p.b.x, p.b.y, p.b.z);
  for (const hlr::CurvedEdge& edge : drawing.curves.edges) {
    if (skips(edge.object)) continue;
    const hlr::Curve& curve = drawing.curves.all.at(edge.curve);
    put("curve", model::index(edge.object), edge.edge, curve.origin.x, curve.origin.y,
        curve.origin.z);
    for (const geometry::Vec3d& v : {curve.at.centre, curve.at.u, curve.at.v}) put(v.x, v.y, v.z);
  }
  return text.str();
}

/// Whether objects that are said to be as the earlier drawing has them are.
bool is_untouched_as_before(const hlr::Drawing& then, const hlr::Redrawn& redrawn) {
  std::vector<bool> touched = redrawn.touched;
  if (touched.empty()) return true;
  if (touched.size() != redrawn.drawing.counted.size()) return false;
  // What is behind the last of now has no number now.
  const std::size_t objects = std::max(touched.size(), then.counted.size());
  for (std::size_t o = then.counted.size(); o < touched.size(); ++o)
    if (!touched[o]) return false;
  touched.resize(objects, true);
  return lines_of(then, touched) == lines_of(redrawn.drawing, touched);
}

constexpr auto kSequences = test::rounds<std::uint64_t>(100, 3000);
constexpr std::uint64_t kSteps = 6;

TEST(IncrementalLaw, AfterAnyEditsTheDrawingIsThatMadeAnew) {
  constexpr std::array<unsigned, 4> kThreads{1, 2, 3, 8};
  std::vector<std::unique_ptr<parallel::Team>> teams;
  for (const unsigned threads : kThreads)
    teams.push_back(std::make_unique<parallel::Team>(threads));
  std::uint64_t followed = 0, sectioned = 0, solved = 0, all = 0, reported = 0;
  for (std::uint64_t seed = 1; seed <= kSequences; ++seed) {
    Draw draw(seed);
    ChangingModel changing(seed * 77, 12 + draw.below(50));
    const hlr::View view = some_view(draw);
    const hlr::Options options = some_options(draw);
    const bool has_rules = draw.one_in(2);
    const auto rules = [&] { return has_rules ? with_rules(options, changing) : options; };
    Observation before = observe(changing, view, rules(), {});
    auto drawing = hlr::draw(before.scene, before.drawn, view, before.options, {});
    ASSERT_TRUE(drawing.has_value()) << "seed " << seed << ": " << drawing.error().message;
    for (std::uint64_t step = 0; step < kSteps; ++step) {
      changing.edit();
      const parallel::Context context{.team = teams[(seed + step) % teams.size()].get()};
      Observation now = observe(changing, view, rules(), context);
      ASSERT_EQ(now.signatures.view, before.signatures.view);
      const auto full = hlr::draw(now.scene, now.drawn, view, now.options, {});
      const std::vector<std::uint32_t> numbers = mapped(before, now);
      const hlr::Drawing then = *drawing;
      auto redrawn =
          hlr::draw_changes(now.scene, now.drawn, view, now.options,
                            {std::move(*drawing), numbers, before.signatures.boxes}, context);
      ASSERT_EQ(full.has_value(), redrawn.has_value()) << "seed " << seed << ", step " << step;
      if (!full) break;
      ASSERT_EQ(difference(*full, redrawn->drawing), "")
          << "seed " << seed << ", step " << step << (redrawn->in_full ? ", in full" : "");
      ASSERT_TRUE(is_untouched_as_before(then, *redrawn)) << "seed " << seed << ", step " << step;
      if (!redrawn->touched.empty()) ++reported;
      ASSERT_EQ(redrawn->in_full, !redrawn->why.empty());
      if (!redrawn->in_full) {
        ++followed;
        if (!view.sections.empty() && redrawn->edges_solved > 0) ++sectioned;
        solved += redrawn->edges_solved;
        all += full->counters.feature_edges;
      }
      drawing = std::move(redrawn->drawing);
      before = std::move(now);
    }
  }
  EXPECT_GT(2 * followed, kSequences * kSteps);
  EXPECT_GT(8 * sectioned, kSequences * kSteps);
  EXPECT_LT(3 * solved, all);
  EXPECT_GT(8 * reported, kSequences * kSteps);
}

void add_box(ChangingModel& changing, const geometry::Vec3d& lo, const geometry::Vec3d& hi) {
  const auto number = changing.objects().size();
  test::ChangingObject one{
      .identity = number, .name = "box " + std::to_string(number), .bodies = {}};
  one.bodies.push_back({.shape = test::box_mesh(lo, hi), .placement = {}});
  changing.objects().push_back(one);
}

/// Draws what changed from one state to the next; the result equals the drawing made anew.
hlr::Redrawn followed(const Observation& before, const Observation& now, const hlr::View& view) {
  const auto drawing = hlr::draw(before.scene, before.drawn, view, {}, {}).value();
  const auto full = hlr::draw(now.scene, now.drawn, view, {}, {}).value();
  auto redrawn = hlr::draw_changes(now.scene, now.drawn, view, {},
                                   {drawing, mapped(before, now), before.signatures.boxes}, {})
                     .value();
  EXPECT_EQ(difference(full, redrawn.drawing), "");
  return redrawn;
}

/// A pin through the middle of a deck, and a cover that is pushed over it: of the deck only the
/// line around the pin, far from its edges, is hidden then.
TEST(IncrementalLaw, LinesFarFromAllEdgesFollow) {
  ChangingModel changing(1, 0);
  add_box(changing, {-500, -500, 0}, {500, 500, 10});
  add_box(changing, {-5, -5, -20}, {5, 5, 30});
  add_box(changing, {80, -10, 50}, {100, 10, 60});
  // Enough beside them for a change to be a small one.
  for (int i = 0; i < 20; ++i) add_box(changing, {1000.0 + 10 * i, 0, 0}, {1005.0 + 10 * i, 5, 5});
  const hlr::View view{.direction = {0, 0, 1}};
  const Observation before = observe(changing, view, {}, {});
  changing.objects()[2].bodies[0].placement.translation = {-90, 0, 0};
  const hlr::Redrawn redrawn = followed(before, observe(changing, view, {}, {}), view);
  EXPECT_EQ(redrawn.objects_solved, 3U);
  EXPECT_FALSE(redrawn.in_full);
}

/// Three blocks in a row are cut. The hatch of each differs from that of the one before: when the
/// first is gone, both others have another one, and the third is not near the first.
TEST(IncrementalLaw, HatchesFollowWhatIsFarFromThem) {
  ChangingModel changing(1, 0);
  for (int i = 0; i < 3; ++i) add_box(changing, {10.0 * i, 0, 0}, {10.0 * (i + 1), 10, 10});
  for (int i = 0; i < 20; ++i) add_box(changing, {1000.0 + 10 * i, 0, 0}, {1005.0 + 10 * i, 5, 4});
  hlr::View view{.direction = {0, 0, 1}};
  view.sections.push_back({{0, 0, 1}, {0, 0, 5000}});
  const Observation before = observe(changing, view, {}, {});
  changing.objects()[0].bodies[0].placement.translation = {0, 50, 0};
  const hlr::Redrawn redrawn = followed(before, observe(changing, view, {}, {}), view);
  EXPECT_EQ(redrawn.objects_solved, 3U);
  EXPECT_FALSE(redrawn.in_full);
}

/// The report on a solid around the eye names it, whatever changed.
TEST(IncrementalLaw, TheSolidAroundTheEyeIsReported) {
  ChangingModel changing(1, 0);
  for (int i = 0; i < 20; ++i) add_box(changing, {10.0 * i, 0, 0}, {10.0 * i + 5, 5, 5});
  hlr::View view{.direction = {0, -1, 0}};
  view.perspective = {.eye = {2000, 2000, 2000}, .target = {2000, 9000, 2000}, .near_mm = 1};
  const Observation before = observe(changing, view, {}, {});
  changing.objects()[0].name = "another name";
  const Observation renamed = observe(changing, view, {}, {});
  const hlr::Redrawn of_names = followed(before, renamed, view);
  EXPECT_EQ(of_names.drawing.diagnostics.count("eye-in-solid"), 1U);
  EXPECT_EQ(of_names.edges_solved, 0U);
  EXPECT_FALSE(of_names.in_full);
  // Behind the eye nothing is drawn, and nothing can be hidden.
  changing.objects()[9].bodies[0].placement.translation = {0, -50, 0};
  const Observation behind = observe(changing, view, {}, {});
  EXPECT_EQ(followed(renamed, behind, view).drawing.diagnostics.count("eye-in-solid"), 1U);
  changing.objects()[9].bodies[0].placement.translation = {0, -60, 0};
  const Observation farther = observe(changing, view, {}, {});
  const hlr::Redrawn redrawn = followed(behind, farther, view);
  EXPECT_EQ(redrawn.drawing.diagnostics.count("eye-in-solid"), 1U);
  EXPECT_FALSE(redrawn.in_full);
}

TEST(IncrementalLaw, NothingIsSolvedWhereNothingChanged) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Draw draw(seed);
    const ChangingModel changing(seed, 30);
    const hlr::View view = some_view(draw);
    const hlr::Options options = some_options(draw);
    const Observation state = observe(changing, view, options, {});
    const auto drawing = hlr::draw(state.scene, state.drawn, view, options, {}).value();
    const auto again =
        hlr::draw_changes(state.scene, state.drawn, view, options,
                          {drawing, mapped(state, state), state.signatures.boxes}, {});
    ASSERT_TRUE(again.has_value()) << seed;
    EXPECT_EQ(difference(drawing, again->drawing), "") << seed;
    EXPECT_EQ(again->edges_solved, 0U) << seed;
    EXPECT_EQ(std::ranges::count(again->touched, true), 0) << seed;
    EXPECT_FALSE(again->in_full) << seed;
  }
}

TEST(IncrementalLaw, MappingsThatDoNotFitAreRefused) {
  const ChangingModel changing(5, 6);
  const Observation state = observe(changing, {}, {}, {});
  const auto drawing = hlr::draw(state.scene, state.drawn, {}, {}, {}).value();
  const auto boxes = state.signatures.boxes;
  const auto code = [&](const std::vector<std::uint32_t>& now, std::size_t count) {
    const auto redrawn = hlr::draw_changes(state.scene, state.drawn, {}, {},
                                           {drawing, now, std::span(boxes).first(count)}, {});
    return redrawn ? std::string("none") : redrawn.error().message;
  };
  EXPECT_EQ(code({0, 1, 2, 3, 4, 5}, 6), "none");
  EXPECT_NE(code({0, 1, 2, 3, 4, 4}, 6), "none");
  EXPECT_NE(code({0, 1, 2, 3, 4, 6}, 6), "none");
  EXPECT_NE(code({0, 1, 2, 3, 4}, 5), "none");
  EXPECT_NE(code({0, 1, 2, 3, 4, 5}, 5), "none");
}

}  // namespace
}  // namespace strake
