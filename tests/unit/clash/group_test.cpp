// SPDX-License-Identifier: Apache-2.0
#include "strake/clash/group.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "clash/results/clash_key.hpp"
#include "strake/core/hash.hpp"
#include "support/clash_model.hpp"

namespace strake::clash {
namespace {

using test::ClashModel;

/// Objects "o0", "o1" … of which only the names matter.
model::Model named_objects(std::uint32_t count) {
  ClashModel m;
  for (std::uint32_t i = 0; i < count; ++i) m.object("o" + std::to_string(i));
  m.model.files.push_back({"u.obj", "OBJ", "mm", "z", 1, 0});
  return m.model;
}

Pair pair(std::uint32_t a, std::uint32_t b, const geometry::Vec3d& at = {}, double d = -10) {
  Pair p;
  p.a = model::ObjectId{a};
  p.b = model::ObjectId{b};
  p.cls = d < 0 ? Class::hit : Class::contact;
  p.d_mm = d;
  p.point_mm = at;
  return p;
}

Findings findings_of(std::vector<Pair> pairs) {
  Report report;
  report.pairs = std::move(pairs);
  return {{std::move(report)}, {}};
}

std::vector<Group> groups(const Findings& findings, const model::Model& model,
                          const GroupRules& rules) {
  return group_results(findings, model, rules).value().groups;
}

TEST(Groups, OneBeamWithManyPipes) {
  // o5 is a beam with four pipes; two of these also hit each other; o8 and o9 stand alone.
  const Findings findings =
      findings_of({pair(0, 1, {}, -3), pair(0, 5, {}, -40), pair(1, 5, {}, -9), pair(2, 5, {}, 0),
                   pair(3, 5), pair(8, 9, {1, 2, 3})});
  const model::Model model = named_objects(10);
  const auto found = groups(findings, model, {.by = GroupBy::element, .contacts = true});
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].name, "o5");
  EXPECT_EQ(found[0].results.size(), 4U);
  EXPECT_EQ(found[0].worst, Class::hit);
  EXPECT_EQ(found[0].d_mm, -40);
  EXPECT_EQ(found[0].count_hit, 3U);
  EXPECT_EQ(found[0].count_contact, 1U);
  EXPECT_EQ(found[1].name, "o8") << "-10 before -3";
  EXPECT_EQ(found[1].box_mm.lo, (geometry::Vec3d{1, 2, 3}));
  EXPECT_EQ(found[2].name, "o0");
}

TEST(Groups, LeaveOutWhatIsMeant) {
  Findings findings = findings_of({pair(0, 1), pair(1, 2, {}, 0), pair(1, 3)});
  findings.tests[0].pairs[2].allowed = 0;
  const model::Model model = named_objects(4);
  const auto found = groups(findings, model, {.by = GroupBy::element});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].results, (std::vector<ResultRef>{{0, 0}}));
  EXPECT_EQ(groups(findings, model, {.by = GroupBy::element, .contacts = true})[0].results.size(),
            2U);
}

TEST(Groups, IdsStayWhenOtherResultsComeAndGo) {
  const model::Model model = named_objects(10);
  const Findings today = findings_of({pair(0, 5), pair(1, 5), pair(8, 9, {1e5, 0, 0})});
  const Findings tomorrow = findings_of({pair(1, 5, {1, 1, 1}, -2), pair(2, 5), pair(3, 5)});
  const GroupRules largest{.by = GroupBy::element, .sort = SortBy::size};
  EXPECT_EQ(groups(today, model, largest)[0].id, groups(tomorrow, model, largest)[0].id);
  std::set<std::string> ids;
  for (const GroupBy by :
       {GroupBy::element, GroupBy::proximity, GroupBy::test, GroupBy::files, GroupBy::assembly})
    for (const Group& g : groups(today, model, {.by = by})) {
      EXPECT_EQ(g.id.size(), 26U);
      EXPECT_TRUE(ids.insert(g.id).second);
    }
}

TEST(Groups, ByTestAndFiles) {
  model::Model model = named_objects(6);
  for (std::size_t o = 3; o < 6; ++o) model.objects[o].file = 1;
  Findings findings = findings_of({pair(0, 1), pair(0, 4), pair(1, 5)});
  findings.tests.push_back(findings.tests[0]);
  findings.tests[0].name = "first";
  findings.tests[1].name = "second";
  const auto by_test = groups(findings, model, {.by = GroupBy::test});
  ASSERT_EQ(by_test.size(), 2U);
  EXPECT_EQ(by_test[0].results.size(), 3U);
  const auto by_files = groups(findings, model, {.by = GroupBy::files, .sort = SortBy::size});
  ASSERT_EQ(by_files.size(), 2U);
  EXPECT_EQ(by_files[0].name, "t.obj and u.obj");
  EXPECT_EQ(by_files[0].results.size(), 4U);
  EXPECT_EQ(by_files[1].name, "t.obj");
}

/// A site of two equipments: /P has boxes in a part that only counts, /Q one box and a nozzle; and
/// a box in no group, of another file.
model::Model assembled() {
  model::Model model = named_objects(5);
  model.groups = {{"/SITE", model::GroupId::none},
                  {"/P", model::GroupId{0}},
                  {"SUBEQUIPMENT 1 of EQUIPMENT /P", model::GroupId{1}},
                  {"/Q", model::GroupId{0}}};
  const auto put = [&](std::size_t o, const char* name, std::uint32_t parent) {
    model.objects[o].name = name;
    model.objects[o].parent = model::GroupId{parent};
  };
  put(0, "BOX 1 of SUBEQUIPMENT 1 of EQUIPMENT /P", 2);
  put(1, "BOX 1 of EQUIPMENT /P", 1);
  put(2, "/Q", 0);  // an equipment that is an object, too
  put(3, "/Q/N1", 3);
  model.objects[4].file = 1;
  return model;
}

TEST(Groups, ByWhatTheTwoArePartsOf) {
  const model::Model model = assembled();
  const Findings findings =
      findings_of({pair(0, 1), pair(0, 2), pair(0, 3), pair(1, 3), pair(2, 3), pair(1, 4)});
  const auto found = groups(findings, model, {.by = GroupBy::assembly, .sort = SortBy::size});
  std::vector<std::pair<std::string, std::size_t>> reported;
  for (const Group& group : found) reported.emplace_back(group.name, group.results.size());
  std::ranges::sort(reported);
  EXPECT_EQ(reported,
            (std::vector<std::pair<std::string, std::size_t>>{
                {"/P and /Q", 3}, {"/P and u.obj", 1}, {"within /P", 1}, {"within /Q", 1}}));
  EXPECT_EQ(found[0].name, "/P and /Q");
}

TEST(Groups, ByAssemblyDistinguishNeighboursOfOneName) {
  model::Model model = named_objects(4);
  const auto add = [&](const char* name, model::GroupId parent) {
    model.groups.push_back({name, parent});
    return static_cast<model::GroupId>(model.groups.size() - 1);
  };
  const model::GroupId deck1 = add("DECK 1", model::GroupId::none);
  const model::GroupId deck2 = add("DECK 2", model::GroupId::none);
  model.objects[0].parent = add("CABIN", deck1);
  model.objects[1].parent = add("CABIN", deck1);
  model.objects[2].parent = model.objects[3].parent = add("CABIN", deck2);
  const auto found = groups(findings_of({pair(0, 1), pair(2, 3), pair(0, 2), pair(1, 2)}), model,
                            {.by = GroupBy::assembly});
  std::vector<std::string> names;
  std::set<std::string> ids;
  for (const Group& group : found) names.push_back(group.name), ids.insert(group.id);
  std::ranges::sort(names);
  EXPECT_EQ(names, (std::vector<std::string>{"DECK 1/CABIN and DECK 1/CABIN",
                                             "DECK 1/CABIN and DECK 2/CABIN",
                                             "DECK 1/CABIN and DECK 2/CABIN", "within CABIN"}));
  EXPECT_EQ(ids.size(), 4U);
}

TEST(Groups, ByAssemblyKeepTheirIds) {
  const model::Model model = assembled();
  const GroupRules rules{.by = GroupBy::assembly};
  const auto today = groups(findings_of({pair(0, 2)}), model, rules);
  const auto tomorrow = groups(findings_of({pair(1, 3, {1, 2, 3}, -1)}), model, rules);
  EXPECT_EQ(today[0].id, tomorrow[0].id);
  EXPECT_NE(today[0].id, groups(findings_of({pair(0, 1)}), model, rules)[0].id);
}

TEST(Groups, OfAnElementAreSplitByPlaceWhereRequested) {
  const Findings findings = findings_of({pair(0, 5, {0, 0, 0}), pair(1, 5, {900, 0, 0}),
                                         pair(2, 5, {1800, 0, 0}), pair(3, 5, {9000, 0, 0})});
  const model::Model model = named_objects(6);
  const auto found =
      groups(findings, model, {.distance_mm = 1000, .sort = SortBy::size, .apart = true});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].name, "o5 at 0.9 0.0 0.0 m");
  EXPECT_EQ(found[0].results, (std::vector<ResultRef>{{0, 0}, {0, 1}, {0, 2}}));
  EXPECT_EQ(found[1].name, "o5 at 9.0 0.0 0.0 m");
  EXPECT_NE(found[0].id, found[1].id);
  EXPECT_EQ(groups(findings, model, {.distance_mm = 1000}).size(), 1U);
  // By proximity there is nothing to split further.
  GroupRules near{.by = GroupBy::proximity, .distance_mm = 1000};
  const auto by_place = groups(findings, model, near);
  near.apart = true;
  const auto again = groups(findings, model, near);
  ASSERT_EQ(again.size(), by_place.size());
  EXPECT_EQ(again[0].id, by_place[0].id);
  EXPECT_EQ(again[0].name, by_place[0].name);
}

TEST(Groups, SortedByVolumeAndSize) {
  Findings findings = findings_of({pair(0, 1, {}, -50), pair(2, 3, {}, -5), pair(2, 4, {}, -4)});
  findings.tests[0].pairs[0].volume_mm3 = 10;
  findings.tests[0].pairs[2].volume_mm3 = 30;
  const model::Model model = named_objects(5);
  const auto name_of_first = [&](SortBy sort) {
    return groups(findings, model, {.by = GroupBy::element, .sort = sort})[0].name;
  };
  EXPECT_EQ(name_of_first(SortBy::depth), "o0");
  EXPECT_EQ(name_of_first(SortBy::volume), "o2");
  EXPECT_EQ(name_of_first(SortBy::size), "o2");
}

/// Single linkage by definition: paths of steps within the distance.
std::vector<std::uint32_t> linked(const std::vector<Pair>& pairs, double distance) {
  std::vector<std::uint32_t> group(pairs.size(), 0xffffffffU);
  std::uint32_t count = 0;
  for (std::size_t start = 0; start < pairs.size(); ++start) {
    if (group[start] != 0xffffffffU) continue;
    std::vector<std::size_t> open{start};
    group[start] = count;
    while (!open.empty()) {
      const std::size_t i = open.back();
      open.pop_back();
      for (std::size_t j = 0; j < pairs.size(); ++j) {
        const geometry::Vec3d d = pairs[i].point_mm - pairs[j].point_mm;
        if (group[j] != 0xffffffffU || !(dot(d, d) <= distance * distance)) continue;
        group[j] = count;
        open.push_back(j);
      }
    }
    ++count;
  }
  return group;
}

TEST(Groups, ProximityIsSingleLinkage) {
  const model::Model model = named_objects(1000);
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const double size = 5000.0 * static_cast<double>(1 + seed % 8);
    // Every third seed on a lattice whose steps are the distance itself.
    const auto draw = [&] {
      const double x = static_cast<double>(random() % 10'000) / 10'000 * size - size / 2;
      return seed % 3 == 0 ? std::round(x / 1000) * 1000 : x;
    };
    std::vector<Pair> pairs;
    for (std::uint32_t i = 0; i + 1 < 300; ++i)
      pairs.push_back(pair(i, i + 1, {draw(), draw(), seed % 2 == 0 ? 0 : draw()}));
    const std::vector<std::uint32_t> truth = linked(pairs, 1000);
    const auto found =
        groups(findings_of(pairs), model, {.by = GroupBy::proximity, .distance_mm = 1000});
    std::vector<std::uint32_t> got(pairs.size());
    for (std::uint32_t g = 0; g < found.size(); ++g)
      for (const ResultRef& r : found[g].results) got[r.pair] = g;
    for (std::size_t i = 0; i < pairs.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        ASSERT_EQ(got[i] == got[j], truth[i] == truth[j]) << i << ' ' << j;
  }
}

TEST(Groups, NothingFoundAndBadDistance) {
  const model::Model model = named_objects(2);
  for (const GroupBy by :
       {GroupBy::element, GroupBy::proximity, GroupBy::test, GroupBy::files, GroupBy::assembly})
    EXPECT_TRUE(groups(findings_of({}), model, {.by = by}).empty());
  for (const double distance : {0.0, -1.0, std::nan("")})
    EXPECT_EQ(group_results(findings_of({}), model, {.distance_mm = distance}).error().code,
              ErrorCode::usage);
}

TEST(Keys, DependOnIdsFilesAndTestAlone) {
  model::Model model = named_objects(3);
  const auto id = [](std::uint32_t o) { return model::ObjectId{o}; };
  const std::string key = pair_key("t", model, id(0), id(1));
  EXPECT_EQ(key.size(), 26U);
  EXPECT_EQ(pair_key("t", model, id(1), id(0)), key);
  std::swap(model.objects[0], model.objects[2]);
  EXPECT_EQ(pair_key("t", model, id(2), id(1)), key) << "another order of objects";
  model.objects[1].name = "renamed";
  EXPECT_EQ(pair_key("t", model, id(2), id(1)), key) << "names may change";
  EXPECT_NE(pair_key("u", model, id(2), id(1)), key);
  EXPECT_NE(pair_key("t", model, id(0), id(1)), key);
  model.objects[1].file = 1;
  EXPECT_NE(pair_key("t", model, id(2), id(1)), key);
}

TEST(Keys, AreThoseOfAllBytesHoweverLongNamesAre) {
  for (const std::size_t length : {0U, 1U, 400U, 488U, 489U, 2000U}) {
    const std::string file(7, 'f'), id(length, 'i');
    EXPECT_EQ(element_hash(file, id),
              Hasher().add(std::string_view(file)).add(std::string_view(id)).value().low)
        << length;
  }
}

TEST(Keys, StayTheSameInEveryVersion) {
  const model::Model model = named_objects(2);
  EXPECT_EQ(pair_key("", model, model::ObjectId{0}, model::ObjectId{1}),
            "7njcejt3bndfg5ht315pa9v4p0");
  EXPECT_EQ(key_text({}), std::string(26, '0'));
  EXPECT_EQ(key_text({~std::uint64_t{0}, ~std::uint64_t{0}}), "7" + std::string(25, 'z'));
}

TEST(Keys, AreReadBack) {
  for (const Hash128 hash : {Hash128{}, Hash128{1, 2}, Hash128{~std::uint64_t{0}, 3}})
    EXPECT_EQ(parse_key(key_text(hash)), hash);
  EXPECT_LT(key_text({1, 0}), key_text({2, 0}));
  const std::string good = key_text({7, 9});
  for (const std::string& bad :
       {std::string(), good + "0", good.substr(1), "8" + good.substr(1), "i" + good.substr(1)})
    EXPECT_EQ(parse_key(bad), std::nullopt) << bad;
  EXPECT_EQ(parse_key(good.substr(0, 25) + "U"), std::nullopt) << "one text for each hash";
}

}  // namespace
}  // namespace strake::clash
