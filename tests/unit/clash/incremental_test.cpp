// SPDX-License-Identifier: Apache-2.0
#include "strake/clash/incremental.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <memory>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "support/clash_model.hpp"
#include "support/same_reports.hpp"

namespace strake::clash {
namespace {

using test::ClashModel;
using test::ReportDifference;

/// Four cubes in a row, each 10 into the next, under a rule of every kind.
struct RuledCubes {
  ClashModel cubes;
  Sets sets;
  Options options;
  Policy policy;

  RuledCubes() {
    for (const char* const id : {"a", "b", "c", "d"}) {
      const double x = 90.0 * (id[0] - 'a');
      cubes.box(id, {x, 0, 0}, {x + 100, 100, 100});
    }
    options.engine.keep_for_changes = true;
    sets.in_a = sets.in_b = {true, true, true, true};
    sets.group = {0, 1, 2, 3};
    sets.group_names = {{0, 1}, {0, 2}, {0, 3}, {0, 4}};
    options.tolerances.object_clearances =
        std::make_shared<ObjectClearances>(ObjectClearances{"INSU", {0, 0, 0, 0}});
    policy.tolerances = {{}};
    policy.matrix = Matrix{.disciplines = {"hull", "pipe"},
                           .discipline = {0, 1, 0, 1},
                           .cells = {0, 0, 0, Matrix::kDefault}};
    policy.exemptions = {
        {"label", SameLabel{{0, 0, kNoLabel, kNoLabel}}},
        {"links", Linked{{{0, 1, 1, 1, 1}, {0}}, {{0, 0, 0, 1, 1}, {0}}}},
        {"between", Between{{true, false, false, false}, {false, false, false, true}}}};
    policy.levels = Levels{.object = std::vector<Level>(4, Level::hard)};
    Allowed allowed;
    allowed.rule = "meant";
    allowed.a = allowed.b = {false, false, true, true};
    allowed.max_depth_mm = 1;
    policy.allowed = {allowed};
  }

  [[nodiscard]] model::Scene scene() const {
    return make_scene(cubes.model, scene_options(options), {}).value();
  }
  [[nodiscard]] Signatures signatures() const {
    return clash::signatures(scene(), sets, options, policy, {}).value();
  }
};

struct Mutation {
  const char* what;
  std::function<void(RuledCubes&)> apply;
};

/// What the scene has of the first object.
std::vector<Mutation> changes_of_bodies() {
  return {{"incomplete", [](RuledCubes& t) { t.cubes.model.objects[0].incomplete = true; }},
          {"place", [](RuledCubes& t) { t.cubes.model.bodies[0].placement.translation.y = 1; }},
          {"place off the grid",
           [](RuledCubes& t) { t.cubes.model.bodies[0].placement.translation.y = 1e-4; }},
          {"turn", [](RuledCubes& t) { t.cubes.model.bodies[0].placement.linear.row[0].x = 0.5; }},
          {"category",
           [](RuledCubes& t) { t.cubes.model.bodies[0].category = model::Category::obstruction; }},
          {"precision", [](RuledCubes& t) { t.cubes.model.bodies[0].precision_um = 1; }},
          {"shape", [](RuledCubes& t) {
             std::get<geometry::TriangleMesh>(t.cubes.model.shapes[0]).vertices[0].x -= 1;
           }}};
}

/// What sets and rules say of the first object.
std::vector<Mutation> changes_of_rules() {
  return {
      {"set A", [](RuledCubes& t) { t.sets.in_a[0] = false; }},
      {"set B", [](RuledCubes& t) { t.sets.in_b[0] = false; }},
      {"group", [](RuledCubes& t) { t.sets.group[0] = 1; }},
      {"clearance",
       [](RuledCubes& t) {
         t.options.tolerances.object_clearances =
             std::make_shared<ObjectClearances>(ObjectClearances{"INSU", {5, 0, 0, 0}});
       }},
      {"discipline", [](RuledCubes& t) { t.policy.matrix->discipline[0] = 1; }},
      {"label",
       [](RuledCubes& t) { std::get<SameLabel>(t.policy.exemptions[0].test).label[0] = kNoLabel; }},
      {"link",
       [](RuledCubes& t) {
         std::get<Linked>(t.policy.exemptions[1].test).answers_to = {{0, 0, 1, 1, 1}, {0}};
       }},
      {"between",
       [](RuledCubes& t) { std::get<Between>(t.policy.exemptions[2].test).a[0] = false; }},
      {"level", [](RuledCubes& t) { t.policy.levels->object[0] = Level::soft; }},
      {"allowed", [](RuledCubes& t) { t.policy.allowed[0].a[0] = true; }}};
}

TEST(ClashSignatures, EveryInputOfAnObjectShowsInItsSignature) {
  std::vector<Mutation> mutations = changes_of_bodies();
  std::ranges::copy(changes_of_rules(), std::back_inserter(mutations));
  const Signatures before = RuledCubes().signatures();
  for (const Mutation& mutation : mutations) {
    RuledCubes test;
    mutation.apply(test);
    const Signatures now = test.signatures();
    EXPECT_NE(now.objects[0], before.objects[0]) << mutation.what;
    EXPECT_EQ(now.objects[3], before.objects[3]) << mutation.what;
    EXPECT_EQ(now.rules, before.rules) << mutation.what;
  }
}

TEST(ClashSignatures, HashesThatSomebodyHasOfShapesTakeThePlaceOfTheirPoints) {
  const RuledCubes cubes;
  const model::Scene scene = cubes.scene();
  const auto signed_by = [&](const std::vector<Hash128>& hashes) {
    return clash::signatures(scene, cubes.sets, cubes.options, cubes.policy, {},
                             {.shapes = hashes});
  };
  std::vector<Hash128> hashes(scene.model->shapes.size());
  EXPECT_EQ(signed_by(hashes).value().objects, cubes.signatures().objects);
  for (std::uint64_t s = 0; s < hashes.size(); ++s) hashes[s] = {1, s};
  const Signatures before = signed_by(hashes).value();
  const std::uint32_t shape = model::index(scene.model->bodies[0].shape);
  hashes[shape].high = 2;
  const Signatures now = signed_by(hashes).value();
  EXPECT_EQ(now.rules, before.rules);
  for (std::size_t o = 0; o < before.objects.size(); ++o) {
    const bool has_it = model::index(scene.model->bodies[o].shape) == shape;
    EXPECT_EQ(now.objects[o] != before.objects[o], has_it) << o;
  }
  hashes.pop_back();
  EXPECT_EQ(signed_by(hashes).error().code, ErrorCode::usage);
}

std::vector<Mutation> changes_of_settings() {
  return {{"clearance", [](RuledCubes& t) { t.options.tolerances.clearance_mm = 5; }},
          {"gap", [](RuledCubes& t) { t.options.tolerances.touch_gap_mm = 2; }},
          {"cap", [](RuledCubes& t) { t.options.tolerances.thickness_cap = ThicknessCap::off; }},
          {"contact distance", [](RuledCubes& t) { t.options.contact_distance_mm = 0.1; }},
          {"volumes", [](RuledCubes& t) { t.options.engine.volumes = Volumes::on; }},
          {"curves", [](RuledCubes& t) { t.options.engine.curves = Curves::on; }},
          {"contacts", [](RuledCubes& t) { t.options.engine.contacts = Contacts::count; }},
          {"regions", [](RuledCubes& t) { t.options.engine.max_regions = 3; }},
          {"relations", [](RuledCubes& t) { t.options.reporting.relations = {Relation::cross}; }},
          {"least volume", [](RuledCubes& t) { t.options.reporting.min_volume_mm3 = 3; }},
          {"name of a set", [](RuledCubes& t) { t.sets.name_a = "x"; }},
          {"groups", [](RuledCubes& t) { t.sets.group.clear(); }},
          {"tolerances", [](RuledCubes& t) { t.policy.tolerances[0].clearance_mm = 7; }},
          {"discipline", [](RuledCubes& t) { t.policy.matrix->disciplines[0] = "x"; }},
          {"cell", [](RuledCubes& t) { t.policy.matrix->cells[3] = Matrix::kNotChecked; }},
          {"exemption", [](RuledCubes& t) { t.policy.exemptions[0].rule = "x"; }},
          {"levels", [](RuledCubes& t) { t.policy.levels->left_out[0][0] = "x"; }},
          {"allowance", [](RuledCubes& t) { t.policy.allowed[0].rule = "x"; }},
          {"depth", [](RuledCubes& t) { t.policy.allowed[0].max_depth_mm = 2; }},
          {"volume", [](RuledCubes& t) { t.policy.allowed[0].max_volume_mm3 = 2; }},
          {"relation", [](RuledCubes& t) { t.policy.allowed[0].relations = {Relation::cross}; }},
          {"region", [](RuledCubes& t) { t.policy.allowed[0].region_mm = geometry::Box3d{}; }},
          {"cavity", [](RuledCubes& t) { t.policy.allowed[0].cavity = {{{}, {1, 0, 0}}}; }},
          {"list", [](RuledCubes& t) { t.policy.list_exempted = true; }}};
}

TEST(ClashSignatures, EverySettingShowsInTheRules) {
  const Signatures before = RuledCubes().signatures();
  for (const Mutation& mutation : changes_of_settings()) {
    RuledCubes test;
    mutation.apply(test);
    EXPECT_NE(test.signatures().rules, before.rules) << mutation.what;
  }
}

TEST(ClashSignatures, EverythingButTheSceneShowsInTheHashOfInputs) {
  const auto hash = [](const RuledCubes& t) {
    return hash_of_inputs(t.scene(), t.sets, t.options, t.policy);
  };
  const Hash128 before = hash(RuledCubes());
  EXPECT_EQ(hash(RuledCubes()), before);
  std::vector<Mutation> mutations = changes_of_rules();
  std::ranges::copy(changes_of_settings(), std::back_inserter(mutations));
  mutations.push_back({"names of groups", [](RuledCubes& t) { t.sets.group_names[0] = {9, 9}; }});
  mutations.push_back({"names of labels", [](RuledCubes& t) {
                         std::get<SameLabel>(t.policy.exemptions[0].test).names = {{1, 2}};
                       }});
  mutations.push_back({"names of links", [](RuledCubes& t) {
                         std::get<Linked>(t.policy.exemptions[1].test).names = {{1, 2}};
                       }});
  for (const Mutation& mutation : mutations) {
    RuledCubes test;
    mutation.apply(test);
    EXPECT_NE(hash(test), before) << mutation.what;
  }
}

TEST(ClashSignatures, TheHashOfInputsHasEveryObjectOfMany) {
  ClashModel model;
  for (int i = 0; i < 130; ++i) model.box(std::to_string(i), {1.0 * i, 0, 0}, {i + 0.5, 1, 1});
  const model::Scene scene = make_scene(model.model, {}, {}).value();
  Sets sets = one_set(scene);
  const Hash128 before = hash_of_inputs(scene, sets, {}, {});
  for (std::size_t o = 0; o < sets.in_a.size(); ++o) {
    sets.in_a[o] = false;
    EXPECT_NE(hash_of_inputs(scene, sets, {}, {}), before) << o;
    sets.in_a[o] = true;
  }
}

/// What a project knows of a model, with a hash for so many bodies each.
class Known {
 public:
  explicit Known(const model::Model& model, std::size_t bodies_of_each = 2) {
    for (const model::Shape& shape : model.shapes) {
      WordHash hash;
      if (const auto* const mesh = std::get_if<geometry::TriangleMesh>(&shape))
        for (const geometry::Vec3d& v : mesh->vertices) hash.add(v.x).add(v.y).add(v.z);
      shapes_.push_back(hash.value());
    }
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      const model::Body& body = model.bodies[b];
      if (b % bodies_of_each == 0) bodies_.push_back({static_cast<std::uint32_t>(b), {}});
      WordHash hash;
      hash.add(bodies_.back().hash).add(model::index(body.shape));
      hash.add(double{body.precision_um}).add(static_cast<std::uint8_t>(body.category));
      for (int k = 0; k < 3; ++k) {
        const geometry::Vec3d& row = body.placement.linear.row[static_cast<std::size_t>(k)];
        hash.add(row.x).add(row.y).add(row.z).add(body.placement.translation[k]);
      }
      bodies_.back().hash = hash.value();
    }
    WordHash hash;
    for (const model::Object& object : model.objects)
      hash.add(std::string_view(object.id)).add(object.incomplete);
    objects_ = hash.value();
  }
  [[nodiscard]] KnownModel all() const { return {shapes_, bodies_, objects_}; }

 private:
  std::vector<Hash128> shapes_;
  std::vector<HashedBodies> bodies_;
  Hash128 objects_;
};

TEST(ClashSignatures, ThoseThatFollowEarlierOnesAreThoseMadeAnew) {
  const auto sign = [](const RuledCubes& t, const EarlierSignatures& earlier) {
    const Known known(t.cubes.model);
    return clash::signatures(t.scene(), t.sets, t.options, t.policy, {}, known.all(), earlier)
        .value();
  };
  const Signatures before = sign(RuledCubes(), {});
  ASSERT_EQ(before.ranges.size(), 1U);
  std::vector<Mutation> mutations = changes_of_bodies();
  std::ranges::copy(changes_of_rules(), std::back_inserter(mutations));
  std::ranges::copy(changes_of_settings(), std::back_inserter(mutations));
  for (const Mutation& mutation : mutations) {
    RuledCubes test;
    mutation.apply(test);
    const Signatures anew = sign(test, {});
    const Signatures followed = sign(test, {before.objects, before.ranges});
    EXPECT_EQ(followed.rules, anew.rules) << mutation.what;
    EXPECT_EQ(followed.objects, anew.objects) << mutation.what;
    EXPECT_NE(followed.ranges, before.ranges) << mutation.what;
  }
}

TEST(ClashSignatures, OnlyRangesThatChangedAreSignedAgain) {
  ClashModel cubes;
  for (int i = 0; i < 9000; ++i)
    cubes.box(std::to_string(100'000 + i), {2.0 * i, 0, 0}, {2.0 * i + 1, 1, 1});
  const auto sign = [&](const EarlierSignatures& earlier, bool knows_names) {
    const model::Scene scene = make_scene(cubes.model, {}, {}).value();
    const Known known(cubes.model, 1000);
    KnownModel all = known.all();
    if (!knows_names) all.objects = {};
    return clash::signatures(scene, one_set(scene), {}, {}, {}, all, earlier).value();
  };
  const Signatures before = sign({}, true);
  ASSERT_EQ(before.ranges.size(), 3U);
  // What an earlier run says is taken where nothing changed, whatever it is.
  const std::vector<Hash128> marked(before.objects.size(), Hash128{7, 7});
  EXPECT_EQ(sign({marked, before.ranges}, true).objects, marked);
  EXPECT_EQ(sign({marked, before.ranges}, false).objects, before.objects);
  EXPECT_TRUE(sign({}, false).ranges.empty());
  cubes.model.bodies[5000].placement.translation.y += 1;
  const Signatures now = sign({marked, before.ranges}, true);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(now.ranges[k] != before.ranges[k], k == 1) << k;
  for (std::size_t o = 0; o < marked.size(); ++o) {
    const bool is_again = o >= 4096 && o < 8192;
    EXPECT_EQ(now.objects[o] == marked[o], !is_again) << o;
    if (is_again) {
      EXPECT_EQ(now.objects[o] != before.objects[o], o == 5000) << o;
    }
  }
}

TEST(ClashSignatures, ANameKeepsALabelApartFromItsMembers) {
  RuledCubes before, now;
  auto& named = std::get<SameLabel>(now.policy.exemptions[0].test);
  auto& earlier = std::get<SameLabel>(before.policy.exemptions[0].test);
  earlier.names = {{1, 2}};
  named.names = {{1, 2}};
  named.label[0] = kNoLabel;  // its first object leaves
  EXPECT_EQ(before.signatures().objects[1], now.signatures().objects[1]);
  earlier.names = named.names = {};
  EXPECT_NE(before.signatures().objects[1], now.signatures().objects[1]);
}

Result<Report> followed(const RuledCubes& test, Report earlier,
                        const std::vector<std::uint32_t>& now) {
  const model::Scene scene = test.scene();
  return detect_changes(scene, test.sets, test.options, test.policy, {std::move(earlier), now}, {});
}

Report full(const RuledCubes& test) {
  const model::Scene scene = test.scene();
  return detect(scene, test.sets, test.options, test.policy, {}).value();
}

/// Two rows of cubes, each in touch with the next of its row; those of the second begin a block of
/// numbers later and lie in those of the first.
ClashModel two_rows(std::size_t length) {
  ClashModel cubes;
  for (const double y : {0.0, 95.0})
    for (std::size_t i = 0; i < length; ++i) {
      const double x = 100.0 * static_cast<double>(i);
      const std::string number = std::to_string(10'000 + i);
      cubes.box((y > 0 ? "second" : "first") + number, {x, y, 0}, {x + 100, y + 100, 100});
    }
  return cubes;
}

TEST(DetectChanges, FindsResultsOfChangesByTheirBlocks) {
  constexpr std::size_t kLength = 2 * PartnerBlocks::kObjects + 100;
  Options options;
  options.engine.keep_for_changes = true;
  const ClashModel before = two_rows(kLength);
  const model::Scene scene = make_scene(before.model, scene_options(options), {}).value();
  const Report earlier = detect(scene, one_set(scene), options, {}, {}).value();
  PartnerBlocks partners;
  for (std::uint32_t first = 0; first < 2 * kLength; first += PartnerBlocks::kObjects) {
    std::vector<Pair> of_block;
    std::ranges::copy_if(earlier.pairs, std::back_inserter(of_block), [&](const Pair& pair) {
      return index(pair.a) / PartnerBlocks::kObjects == first / PartnerBlocks::kObjects;
    });
    partners.of.push_back(partners_of(of_block));
  }
  EXPECT_EQ(partners.of.front(), (std::vector<std::uint32_t>{0, 1, 2, 3}));
  for (const std::vector<std::size_t>& moved : {std::vector<std::size_t>{0},
                                                {kLength + 5},
                                                {2 * kLength - 1},
                                                {1023, 1024, kLength + 1500}}) {
    ClashModel now = before;
    std::vector<std::uint32_t> map(2 * kLength);
    std::iota(map.begin(), map.end(), 0U);
    for (const std::size_t object : moved) {
      now.model.bodies[now.model.objects[object].first_body].placement.translation.z += 30;
      map[object] = model::kNoObject;
    }
    const model::Scene at = make_scene(now.model, scene_options(options), {}).value();
    const Report full = detect(at, one_set(at), options, {}, {}).value();
    const auto followed =
        detect_changes(at, one_set(at), options, {}, {earlier, map, true, &partners}, {});
    ASSERT_TRUE(followed);
    EXPECT_EQ(ReportDifference::of(full, *followed), "") << moved.front();
    EXPECT_LT(followed->counters.part_pairs, 20U);
  }
  partners.of.pop_back();
  std::vector<std::uint32_t> none(2 * kLength, model::kNoObject);
  EXPECT_FALSE(
      detect_changes(scene, one_set(scene), options, {}, {earlier, none, true, &partners}, {}));
}

TEST(DetectChanges, TestsOnlyPairsOfWhatChanged) {
  RuledCubes test;
  test.policy = {};
  test.sets.group.clear();
  const Report before = full(test);
  ASSERT_EQ(before.pairs.size(), 3U);
  test.cubes.model.bodies[3].placement.translation.x = -2;
  const Report now = followed(test, before, {0, 1, 2, model::kNoObject}).value();
  EXPECT_EQ(ReportDifference::of(full(test), now), "");
  EXPECT_EQ(now.counters.part_pairs, 1U);
  EXPECT_NE(now.hash, before.hash);
}

TEST(DetectChanges, TestsNothingWhereNothingChanged) {
  const RuledCubes test;
  const Report before = full(test);
  const Report now = followed(test, before, {0, 1, 2, 3}).value();
  EXPECT_EQ(ReportDifference::of(before, now), "");
  EXPECT_EQ(now.counters.part_pairs, 0U);
}

TEST(DetectChanges, TestsNothingUnderANewName) {
  RuledCubes test;
  test.policy = {};  // labels and links without names would be named by objects
  const Report before = full(test);
  const Signatures then = test.signatures();
  test.cubes.model.files[0].label = "revB.obj";
  EXPECT_EQ(test.signatures().objects, then.objects);
  EXPECT_FALSE(have_same_names(before, test.cubes.model, {}).value());
  const Report now = followed(test, before, {0, 1, 2, 3}).value();
  EXPECT_EQ(ReportDifference::of(full(test), now), "");
  EXPECT_EQ(now.counters.part_pairs, 0U);
  EXPECT_NE(now.hash, before.hash);
  EXPECT_TRUE(have_same_names(now, test.cubes.model, {}).value());
}

TEST(DetectChanges, IsAFullRunWhereTheEarlierOneKeptNothing) {
  RuledCubes test;
  test.options.engine.keep_for_changes = false;
  const Report before = full(test);
  EXPECT_FALSE(before.kept);
  const Report now = followed(test, before, {0, 1, 2, 3}).value();
  EXPECT_EQ(ReportDifference::of(before, now), "");
  EXPECT_EQ(now.counters.part_pairs, before.counters.part_pairs);
}

TEST(DetectChanges, ObjectsThatChangedPlacesCountAsChanged) {
  RuledCubes test;
  test.policy = {};
  test.sets.group.clear();
  const Report before = full(test);
  std::swap(test.cubes.model.objects[0], test.cubes.model.objects[1]);
  test.cubes.model.objects[0].id = "a";
  test.cubes.model.objects[1].id = "b";
  const Report now = followed(test, before, {1, 0, 2, 3}).value();
  EXPECT_EQ(now.pairs.size(), 3U);
  EXPECT_EQ(now.count_hit, before.count_hit);
}

TEST(DetectChanges, RefusesAMapThatDoesNotFit) {
  const RuledCubes test;
  const Report before = full(test);
  for (const std::vector<std::uint32_t>& map :
       {std::vector<std::uint32_t>{0, 0, 1, 2}, std::vector<std::uint32_t>{0, 1, 2, 4}}) {
    const Result<Report> now = followed(test, before, map);
    ASSERT_FALSE(now);
    EXPECT_EQ(now.error().code, ErrorCode::usage);
  }
}

}  // namespace
}  // namespace strake::clash
