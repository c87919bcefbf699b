// SPDX-License-Identifier: Apache-2.0
#include "strake/report/clash_diff.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "report/text/columns.hpp"
#include "strake/clash/policy.hpp"
#include "support/clash_model.hpp"

namespace strake::report {
namespace {

using nlohmann::json;
using test::ClashModel;

/// A folder that is gone when the test is, and the documents read from it.
class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("strake-diff-" + unique())) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  Folder(Folder&&) = delete;
  Folder& operator=(Folder&&) = delete;

  [[nodiscard]] std::filesystem::path write(const std::string& name, std::string_view text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  const ClashDocument& keep(ClashDocument document) {
    return documents_.emplace_back(std::move(document));
  }

 private:
  static std::string unique() {
    const auto* const info = ::testing::UnitTest::GetInstance()->current_test_info();
    return std::string(info->name()) +
           std::to_string(::testing::UnitTest::GetInstance()->random_seed());
  }
  std::filesystem::path path_;
  std::deque<ClashDocument> documents_;
};

std::string text_of(const clash::Findings& findings, const model::Model& model) {
  std::string text;
  EXPECT_TRUE(write_clash_json({findings, model}, [&](std::string_view piece) { text += piece; }));
  return text;
}

const ClashDocument& document(Folder& folder, const std::string& name,
                              const clash::Findings& findings, const model::Model& model) {
  return folder.keep(read_clash_document(folder.write(name, text_of(findings, model))).value());
}

clash::Findings run(const ClashModel& m, const clash::Options& options = {}) {
  return {{m.detect(options)}, {}};
}

/// Four boxes in a row: two hits, one clearance violation at 25 mm.
ClashModel row(double c_from = 180) {
  ClashModel m;
  m.box("a", {0, 0, 0}, {100, 100, 100}).box("b", {90, 0, 0}, {200, 100, 100});
  m.box("c", {c_from, 10, 10}, {300, 90, 90}).box("d", {310, 0, 0}, {400, 100, 100});
  return m;
}

std::vector<std::string> names(const ClashDiff& diff, const std::vector<DiffEntry>& entries) {
  std::vector<std::string> all;
  for (const DiffEntry& e : entries) {
    const ClashDocument& run = diff.run_of(e);
    all.push_back(std::string(run.a(e.either()).id) + "-" + std::string(run.b(e.either()).id));
  }
  return all;
}

using Names = std::vector<std::string>;

TEST(ClashDiff, TheSameRunTwice) {
  Folder folder;
  const ClashModel m = row();
  const ClashDocument& x =
      document(folder, "x.json", run(m, {.tolerances = {.clearance_mm = 25}}), m.model);
  const ClashDiff diff = compare(x, x);
  EXPECT_EQ(diff.same.size(), 3U);
  EXPECT_TRUE(diff.added.empty() && diff.changed.empty() && diff.gone.empty() &&
              diff.cannot_tell.empty() && diff.settings.empty());
  EXPECT_FALSE(diff.has_worse());
}

TEST(ClashDiff, NewChangedAndGone) {
  Folder folder;
  const ClashModel before = row();
  ClashModel after = row(190);
  // d comes into c's way; a moves off b.
  after.model.objects.clear();
  after.model.bodies.clear();
  after.model.shapes.clear();
  after.box("a", {0, 0, 0}, {50, 100, 100}).box("b", {90, 0, 0}, {200, 100, 100});
  after.box("c", {190, 10, 10}, {300, 90, 90}).box("d", {295, 0, 0}, {400, 100, 100});
  const ClashDocument& x = document(folder, "x.json", run(before), before.model);
  const ClashDocument& y = document(folder, "y.json", run(after), after.model);
  const ClashDiff diff = compare(x, y);
  EXPECT_EQ(names(diff, diff.added), Names{"c-d"});
  EXPECT_EQ(diff.added[0].why, "");
  EXPECT_EQ(names(diff, diff.changed), Names{"b-c"});
  EXPECT_EQ(diff.changed[0].before->d_mm, -20);
  EXPECT_EQ(diff.changed[0].after->d_mm, -10);
  EXPECT_EQ(names(diff, diff.gone), Names{"a-b"});
  EXPECT_TRUE(diff.cannot_tell.empty());
  EXPECT_TRUE(diff.has_new(true));
  EXPECT_TRUE(diff.has_worse());
  const ClashDiff back = compare(y, x);
  EXPECT_EQ(names(back, back.added), Names{"a-b"});
  EXPECT_EQ(names(back, back.gone), Names{"c-d"});
}

/// A table on four feet, of which `feet` reach the floor.
ClashModel table(int feet) {
  ClashModel m;
  m.box("floor", {0, 0, -100}, {2000, 2000, 0}).object("table");
  for (int i = 0; i < 4; ++i) {
    const double x = i % 2 == 0 ? 100 : 1800, y = i < 2 ? 100 : 1800;
    m.body(test::box_mesh({x, y, i < feet ? 0.0 : 50.0}, {x + 100, y + 100, 700}));
  }
  return m;
}

TEST(ClashDiff, MoreOrFewerPlacesAreAChange) {
  Folder folder;
  const ClashModel before = table(2), after = table(3);
  const ClashDocument& x = document(folder, "x.json", run(before), before.model);
  const ClashDocument& y = document(folder, "y.json", run(after), after.model);
  const ClashDiff diff = compare(x, y);
  ASSERT_EQ(diff.changed.size(), 1U);
  EXPECT_EQ(diff.changed[0].before->regions, 2U);
  EXPECT_EQ(diff.changed[0].after->regions, 3U);
  EXPECT_TRUE(diff.has_worse());
  EXPECT_FALSE(compare(y, x).has_worse());
  EXPECT_NE(
      clash_diff_table(diff, {}).find("CONTACT 0.000 at 3 places (was CONTACT 0.000 at 2 places)"),
      std::string::npos);
  std::string text;
  write_clash_diff_json(diff, [&](std::string_view piece) { text += piece; });
  const json entry = json::parse(text)["changed"][0];
  EXPECT_EQ(entry["region_count"], 3);
  EXPECT_EQ(entry["was"]["region_count"], 2);
  const ClashDocument& uncounted =
      document(folder, "z.json", run(after, {.engine = {.max_regions = 0}}), after.model);
  EXPECT_EQ(compare(x, uncounted).same.size(), 1U) << "what was not counted is no change";
}

TEST(ClashDiff, ReportsWhichDepthIsIncomplete) {
  Folder folder;
  const ClashModel m = row();
  clash::Findings unfinished = run(m);
  unfinished.tests[0].pairs[0].depth_complete = false;
  const ClashDocument& x = document(folder, "x.json", unfinished, m.model);
  const ClashDocument& y = document(folder, "y.json", run(m), m.model);
  EXPECT_EQ(std::ranges::count(x.results, false, &DocumentResult::depth_complete), 1);
  EXPECT_EQ(std::ranges::count(y.results, false, &DocumentResult::depth_complete), 0);
  // How hard a depth was searched for is no change.
  EXPECT_EQ(compare(x, y).same.size(), 2U);
  unfinished.tests[0].pairs[0].d_mm -= 1;
  unfinished.tests[0].pairs[0].d_lower_mm -= 1;
  const ClashDocument& deeper = document(folder, "z.json", unfinished, m.model);
  const ClashDiff diff = compare(y, deeper);
  ASSERT_EQ(diff.changed.size(), 1U);
  EXPECT_TRUE(diff.changed[0].before->depth_complete);
  EXPECT_FALSE(diff.changed[0].after->depth_complete);
  const std::string table = clash_diff_table(diff, {});
  EXPECT_NE(table.find("HIT -11.000, depth incomplete (was HIT -10.000)"), std::string::npos)
      << table;
  std::string text;
  write_clash_diff_json(diff, [&](std::string_view piece) { text += piece; });
  const json changed = json::parse(text)["changed"][0];
  EXPECT_EQ(changed["depth_complete"], false);
  EXPECT_FALSE(changed["was"].contains("depth_complete"));
}

TEST(ClashDiff, AMissingElementIsNotAMendedClash) {
  Folder folder;
  const ClashModel before = row();
  ClashModel after;
  after.box("a", {0, 0, 0}, {100, 100, 100}).box("c", {180, 10, 10}, {300, 90, 90});
  const ClashDocument& x = document(folder, "x.json", run(before), before.model);
  const ClashDocument& y = document(folder, "y.json", run(after), after.model);
  const ClashDiff diff = compare(x, y);
  EXPECT_TRUE(diff.gone.empty());
  EXPECT_EQ(names(diff, diff.cannot_tell), (Names{"b-c", "a-b"}));
  EXPECT_EQ(diff.cannot_tell[0].why, "'b' of t.obj is not in the model");
  const ClashDiff back = compare(y, x);
  ASSERT_EQ(back.added.size(), 2U);
  EXPECT_EQ(back.added[0].why, "'b' of t.obj is not in the model") << "of the old run";
  EXPECT_NE(
      clash_diff_table(back, {}).find("\n      in the old run: 'b' of t.obj is not in the model\n"),
      std::string::npos);
  EXPECT_NE(clash_diff_table(diff, {}).find("\n      'b' of t.obj is not in the model\n"),
            std::string::npos);
}

TEST(ClashDiff, WhatIsNotTestedAnyMore) {
  Folder folder;
  const ClashModel m = row();
  const model::Scene scene = make_scene(m.model, clash::scene_options({}), {}).value();
  const auto with = [&](const clash::Sets& sets) {
    return clash::Findings{{clash::detect(scene, sets, {}, {}).value()}, {}};
  };
  const ClashDocument& all = document(folder, "all.json", with(clash::one_set(scene)), m.model);
  clash::Sets no_b = clash::one_set(scene);
  no_b.in_a[1] = no_b.in_b[1] = false;
  const ClashDiff without = compare(all, document(folder, "no_b.json", with(no_b), m.model));
  ASSERT_EQ(without.cannot_tell.size(), 2U);
  EXPECT_EQ(without.cannot_tell[0].why, "'b' of t.obj is in neither set");
  clash::Sets one_side = clash::one_set(scene);
  for (std::size_t o = 0; o < 4; ++o) {
    one_side.in_a[o] = o < 2;
    one_side.in_b[o] = o >= 2;
  }
  const ClashDiff sides = compare(all, document(folder, "side.json", with(one_side), m.model));
  ASSERT_EQ(sides.cannot_tell.size(), 1U);
  EXPECT_EQ(sides.cannot_tell[0].why, "both are in the same set");
  clash::Sets by_file = clash::one_set(scene);
  by_file.group.assign(4, 0);
  const ClashDiff files = compare(all, document(folder, "files.json", with(by_file), m.model));
  ASSERT_EQ(files.cannot_tell.size(), 2U);
  EXPECT_EQ(files.cannot_tell[0].why, "pairs within a file are not looked at");
}

TEST(ClashDiff, SettingsThatWouldNotReportIt) {
  Folder folder;
  const ClashModel m = row();
  const ClashDocument& wide =
      document(folder, "w.json", run(m, {.tolerances = {.clearance_mm = 25}}), m.model);
  const ClashDocument& tight =
      document(folder, "t.json", run(m, {.tolerances = {.clearance_mm = 5}}), m.model);
  const ClashDiff diff = compare(wide, tight);
  ASSERT_EQ(diff.settings.size(), 1U);
  EXPECT_EQ(diff.settings[0].setting, "clearance_mm");
  EXPECT_EQ(diff.settings[0].before, "25");
  EXPECT_EQ(names(diff, diff.cannot_tell), Names{"c-d"});
  EXPECT_EQ(diff.cannot_tell[0].why, "settings differ: clearance_mm");
  EXPECT_EQ(diff.same.size(), 2U);
  EXPECT_EQ(compare(tight, wide).added[0].why, "settings differ: clearance_mm");
}

TEST(ClashDiff, ClearancesThatObjectsAddTo) {
  Folder folder;
  const ClashModel m = row();
  const auto adding = [&](const std::string& name, const std::vector<double>& mm) -> auto& {
    const auto added =
        std::make_shared<const clash::ObjectClearances>(clash::ObjectClearances{"INSU", mm});
    return document(folder, name, run(m, {.tolerances = {.object_clearances = added}}), m.model);
  };
  const ClashDocument& thick = adding("thick.json", {0, 0, 5, 10});
  const ClashDocument& plain = document(folder, "plain.json", run(m), m.model);
  const ClashDiff other = compare(thick, plain);
  EXPECT_EQ(names(other, other.cannot_tell), Names{"c-d"});
  EXPECT_EQ(other.cannot_tell[0].why, "settings differ: clearance_attribute");
  ASSERT_EQ(other.settings.size(), 1U);
  EXPECT_EQ(other.settings[0].setting, "clearance_attribute");
  // The objects state less now, so what they lacked is settled.
  const ClashDiff thinner = compare(thick, adding("thin.json", {0, 0, 2, 3}));
  EXPECT_EQ(names(thinner, thinner.gone), Names{"c-d"});
  EXPECT_TRUE(thinner.cannot_tell.empty());
  EXPECT_TRUE(thinner.settings.empty());
}

TEST(ClashDiff, OnlySettingsThatDifferAreBlamed) {
  Folder folder;
  const ClashModel m = row();
  const clash::Findings here = run(m, {.tolerances = {.clearance_mm = 5}});
  // A pair farther apart than the settings of both report, as after a change of the engine.
  clash::Findings other = run(m, {.tolerances = {.clearance_mm = 25}});
  other.tests[0].options.tolerances.clearance_mm = 5;
  const ClashDocument& with = document(folder, "s.json", other, m.model);
  const ClashDocument& without = document(folder, "h.json", here, m.model);
  const ClashDiff diff = compare(with, without);
  EXPECT_TRUE(diff.settings.empty());
  EXPECT_EQ(names(diff, diff.cannot_tell), Names{"c-d"});
  EXPECT_EQ(diff.cannot_tell[0].why, "it was farther apart than the tolerances of either run");
  EXPECT_TRUE(diff.gone.empty());
}

TEST(ClashDiff, WeldingThatMovedAPairOutOfReach) {
  Folder folder;
  const ClashModel m = row();
  clash::Findings wide = run(m, {.tolerances = {.clearance_mm = 25}});
  wide.tests[0].options.tolerances.clearance_mm = 0;
  wide.tests[0].weld_mm = 0.1;
  clash::Findings narrow = run(m);
  narrow.tests[0].weld_mm = 0.02;
  const ClashDiff diff = compare(document(folder, "w.json", wide, m.model),
                                 document(folder, "n.json", narrow, m.model));
  EXPECT_EQ(names(diff, diff.cannot_tell), Names{"c-d"});
  EXPECT_EQ(diff.cannot_tell[0].why, "settings differ: weld_mm");
}

TEST(ClashDiff, RulesThatAreNotTheSameAreReported) {
  Folder folder;
  const ClashModel m = row();
  const clash::Findings findings = run(m);
  const auto made_by = [&](const std::string& name, const RulesSource& rules) -> auto& {
    std::string text;
    EXPECT_TRUE(write_clash_json({findings, m.model, nullptr, &rules},
                                 [&](std::string_view piece) { text += piece; }));
    return folder.keep(read_clash_document(folder.write(name, text)).value());
  };
  const ClashDocument& plain = document(folder, "p.json", findings, m.model);
  const ClashDocument& one = made_by("1.json", {"a.toml", {1, 1}});
  const ClashDocument& changed = made_by("2.json", {"a.toml", {1, 2}});
  const ClashDocument& other = made_by("3.json", {"b.toml", {1, 1}});
  const auto reported = [](const ClashDocument& x, const ClashDocument& y) {
    const std::string table = clash_diff_table(compare(x, y), {});
    return table.substr(0, table.find('\n'));
  };
  EXPECT_EQ(reported(one, one), "0 new, 0 changed, 2 unchanged, 0 gone, 0 cannot tell");
  EXPECT_EQ(reported(one, changed), "rules file a.toml is not what it was");
  EXPECT_EQ(reported(one, other), "rules: were a.toml, are b.toml");
  EXPECT_EQ(reported(plain, one), "rules: were none, are a.toml");
  const ClashDocument& profile = made_by("4.json", {"plant.toml", {1, 1}, "plant"});
  const ClashDocument& later = made_by("5.json", {"plant.toml", {1, 2}, "plant"});
  EXPECT_EQ(reported(profile, later), "profile plant is not what it was");
  EXPECT_EQ(reported(plain, profile), "rules: were none, are profile plant");
  EXPECT_EQ(reported(profile, made_by("6.json", {"plant.toml", {1, 1}})),
            "rules: were profile plant, are plant.toml");
  std::string text;
  write_clash_diff_json(compare(plain, one), [&](std::string_view piece) { text += piece; });
  EXPECT_FALSE(json::parse(text)["old"].contains("rules"));
  EXPECT_EQ(json::parse(text)["new"]["rules"]["file"], "a.toml");
  EXPECT_FALSE(json::parse(text)["new"]["rules"].contains("profile"));
  text.clear();
  write_clash_diff_json(compare(plain, profile), [&](std::string_view piece) { text += piece; });
  EXPECT_EQ(json::parse(text)["new"]["rules"]["profile"], "plant");
}

TEST(ClashDiff, ExemptedAndAllowed) {
  Folder folder;
  const ClashModel m = row();
  const model::Scene scene = make_scene(m.model, clash::scene_options({}), {}).value();
  clash::Policy policy;
  policy.exemptions.push_back(
      {"one unit", clash::SameLabel{{7, 7, clash::kNoLabel, clash::kNoLabel}}});
  clash::Allowed& sleeve = policy.allowed.emplace_back();
  sleeve.rule = "sleeve";
  sleeve.a = sleeve.b = {false, true, true, false};
  sleeve.max_depth_mm = 25;
  const auto under = [&](bool list) {
    policy.list_exempted = list;
    return clash::Findings{{clash::detect(scene, clash::one_set(scene), {}, policy, {}).value()},
                           {}};
  };
  const ClashDocument& plain = document(folder, "p.json", run(m), m.model);
  const ClashDocument& listed = document(folder, "l.json", under(true), m.model);
  const ClashDocument& counted = document(folder, "c.json", under(false), m.model);
  const ClashDiff reported = compare(plain, listed);
  EXPECT_EQ(names(reported, reported.cannot_tell), Names{"a-b"});
  EXPECT_EQ(reported.cannot_tell[0].why, "exempted by one unit");
  EXPECT_EQ(names(reported, reported.changed), Names{"b-c"});
  EXPECT_EQ(listed.allowed(*reported.changed[0].after), "sleeve");
  EXPECT_FALSE(reported.has_worse());
  EXPECT_TRUE(compare(listed, plain).has_worse()) << "allowed no more";
  EXPECT_EQ(compare(plain, counted).cannot_tell[0].why,
            "may be among the 1 exempted pairs, which are not listed");
}

TEST(ClashDiff, WhatCouldNotBeComparedIsNotMended) {
  const auto two = [](double a_from, double b_from, double b_to) {
    ClashModel m;
    m.box("a", {a_from, 0, 0}, {100, 100, 100}).box("b", {b_from, 20, 20}, {b_to, 50, 50});
    return m;
  };
  const ClashModel near = two(0, 90, 200), unplaceable = two(-2.2e6, 90, 200),
                   apart = two(-1.5e6, 90, 1.5e6);
  ClashModel incomplete = two(0, 150, 200);
  incomplete.model.objects[1].incomplete = true;
  Folder folder;
  const auto& old_run = document(folder, "old.json", run(near), near.model);
  const auto why = [&](const ClashModel& m) {
    const auto& new_run = document(folder, "new.json", run(m), m.model);
    const ClashDiff diff = compare(old_run, new_run);
    EXPECT_TRUE(diff.gone.empty());
    // The other way round the clash is new for the same reason.
    const ClashDiff back = compare(new_run, old_run);
    EXPECT_EQ(back.added.at(0).why, diff.cannot_tell.at(0).why);
    return diff.cannot_tell.at(0).why;
  };
  EXPECT_EQ(why(unplaceable), "'a' of t.obj could not be compared whole (shape-unplaceable)");
  EXPECT_EQ(why(incomplete), "'b' of t.obj could not be compared whole (object-incomplete)");
  incomplete.model.objects[1].body_count = 0;
  EXPECT_EQ(why(incomplete), "'b' of t.obj could not be compared whole (object-skipped)");
  EXPECT_EQ(why(apart), "the pair could not be compared (pair-too-large)");
}

TEST(ClashDiff, TestsGoTogetherByName) {
  Folder folder;
  const ClashModel m = row();
  clash::Findings two = run(m), other = run(m);
  two.tests.push_back(two.tests[0]);
  two.tests[0].name = "pipes";
  two.tests[1].name = "steel";
  other.tests[0].name = "steel";
  other.tests.push_back(other.tests[0]);
  other.tests[1].name = "hvac";
  const ClashDiff diff =
      compare(document(folder, "x.json", two, m.model), document(folder, "y.json", other, m.model));
  EXPECT_EQ(diff.same.size(), 2U);
  EXPECT_EQ(diff.tests_gone, Names{"pipes"});
  EXPECT_EQ(diff.tests_added, Names{"hvac"});
  ASSERT_EQ(diff.cannot_tell.size(), 2U);
  EXPECT_EQ(diff.cannot_tell[0].why, "there is no test 'pipes'");
  std::string text;
  write_clash_diff_json(diff, [&](std::string_view piece) { text += piece; });
  const json doc = json::parse(text);
  EXPECT_EQ(doc["counts"],
            json::parse(R"({"new": 2, "changed": 0, "same": 2, "gone": 0, "cannot_tell": 2})"));
  const std::string table = clash_diff_table(diff, {});
  EXPECT_NE(table.find("2 new, 0 changed, 2 unchanged, 0 gone, 2 cannot tell\n"),
            std::string::npos);
}

TEST(ClashDiff, TableReportsTheTestWhereThereAreSeveral) {
  Folder folder;
  const ClashModel m = row();
  clash::Findings two = run(m);
  two.tests.push_back(two.tests[0]);
  two.tests[0].name = "pipes";
  two.tests[1].name = "steel";
  ClashModel apart;
  apart.box("a", {0, 0, 0}, {1, 1, 1}).box("b", {90, 0, 0}, {91, 1, 1});
  apart.box("c", {180, 0, 0}, {181, 1, 1}).box("d", {310, 0, 0}, {311, 1, 1});
  clash::Findings none = run(apart);
  none.tests.push_back(none.tests[0]);
  none.tests[0].name = "pipes";
  none.tests[1].name = "steel";
  const std::string table = clash_diff_table(compare(document(folder, "x.json", none, apart.model),
                                                     document(folder, "y.json", two, m.model)),
                                             {});
  EXPECT_NE(table.find("HIT -10.000, test 'pipes'\n"), std::string::npos) << table;
  EXPECT_NE(table.find("HIT -10.000, test 'steel'\n"), std::string::npos) << table;
}

/// The name of the test that a result is from counts as well as the names of its objects.
TEST(ClashDiffTable, RowsFitTheTerminal) {
  Folder folder;
  const ClashModel m = row();
  ClashModel apart;
  apart.box("a", {0, 0, 0}, {1, 1, 1}).box("b", {90, 0, 0}, {91, 1, 1});
  apart.box("c", {180, 0, 0}, {181, 1, 1}).box("d", {310, 0, 0}, {311, 1, 1});
  clash::Findings two = run(m), none = run(apart);
  for (clash::Findings* const findings : {&two, &none}) {
    findings->tests.push_back(findings->tests[0]);
    findings->tests[0].name = "pipes";
    findings->tests[1].name = "hits of more than a cubic centimetre";
  }
  const ClashDiff diff = compare(document(folder, "x.json", none, apart.model),
                                 document(folder, "y.json", two, m.model));
  for (std::size_t width = 64; width <= 120; ++width) {
    const std::string table = clash_diff_table(diff, {.width = width});
    EXPECT_NE(table.find("cubic centimetre'\n"), std::string::npos) << table;
    for (std::size_t from = 0; from < table.size(); from = table.find('\n', from) + 1)
      EXPECT_LE(columns_in(table.substr(from, table.find('\n', from) - from)), width) << table;
  }
  EXPECT_NE(clash_diff_table(diff, {.width = 64}).find("\n      HIT -10.000, test 'pipes'\n"),
            std::string::npos);
}

TEST(ClashDocument, NamesThatAreNoUtf8AreFoundAgain) {
  Folder folder;
  ClashModel m;
  m.box("b\xFFse", {0, 0, 0}, {100, 100, 100}).box("x", {50, 0, 0}, {150, 100, 100});
  const ClashDocument& x = document(folder, "x.json", run(m), m.model);
  ClashModel apart;
  apart.box("b\xFFse", {0, 0, 0}, {10, 100, 100}).box("x", {50, 0, 0}, {150, 100, 100});
  EXPECT_EQ(compare(x, document(folder, "y.json", run(apart), apart.model)).gone.size(), 1U);
}

TEST(ClashDocument, StatesWhatIsWrongAndWhere) {
  Folder folder;
  const auto error = [&](std::string_view text) {
    const auto read = read_clash_document(folder.write("bad.json", text));
    EXPECT_FALSE(read) << text;
    return read ? std::string() : read.error().text();
  };
  const auto expect = [&](std::string_view text, const std::string& part) {
    const std::string stated = error(text);
    EXPECT_NE(stated.find("bad.json"), std::string::npos) << stated;
    EXPECT_NE(stated.find(part), std::string::npos) << stated;
  };
  expect("", "ends too soon");
  expect("[1, 2", "ends too soon");
  expect("solid cube", "bad.json:1: this is no JSON");
  expect("{\n\n  \"a\": }\n", "bad.json:3: this is no JSON");
  expect("[]", "no result of a clash run");
  expect("{\"schema_version\": 3, \"tests\": []}", "it says version 3");
  expect("{\"results\": []}", "no result of a clash run");
  expect("{\"schema_version\": 1, \"results\": [{}]}", "it says version 1");
  expect("{\"results\": [{\"key\": 5}]}", "results[0] \"key\" is no text");
  expect("\"\\ud800\"", "bad.json:1: this is no JSON");
  expect("{\"a\": \"\xFF\"}", "bad.json:1: this is no JSON");
  expect("{\"results\": [\n{\"key\": \"x\"}]}", "results[0] \"key\" is no key of a pair");
  expect("{\"results\": [5]}", "results[0] is no object");
  expect("{\"results\": [{\"class\": \"MISS\"}]}", "\"class\" is no class of a result");
  expect("{\"results\": [{\"depth_complete\": 0}]}", "\"depth_complete\" is no true or false");
  expect("{\"schema_version\": 2} {", "bad.json:1: this is no JSON");
  expect("{\"schema_version\": 2}", "has no \"elements\"");
  expect(std::string(100'000, '['), "nested too deeply");
  std::string objects;
  for (int i = 0; i < 100'000; ++i) objects += "{\"a\":";
  expect(objects, "nested too deeply");
  EXPECT_FALSE(read_clash_document(folder.path()));
  EXPECT_FALSE(read_clash_document(folder.path() / "nowhere.json"));
}

/// Cut anywhere, and with any value replaced by one of another kind: an error or a document, and
/// nothing worse. A cut is always an error.
TEST(ClashDocument, SurvivesDamage) {
  const Folder folder;
  const ClashModel m = row();
  const std::string good = text_of(run(m, {.tolerances = {.clearance_mm = 25}}), m.model);
  for (std::size_t size = 0; size + 2 < good.size(); size += 1 + size / 40) {
    const auto read = read_clash_document(folder.write("cut.json", good.substr(0, size)));
    ASSERT_FALSE(read) << size;
    EXPECT_EQ(read.error().code, ErrorCode::input);
    EXPECT_NE(read.error().message.find("ends too soon"), std::string::npos) << size;
  }
  const json whole = json::parse(good);
  const json flat = whole.flatten();
  const std::vector<json> others{nullptr, true, -1, 1e300, "text", json::array(), json::object()};
  for (const auto& [pointer, value] : flat.items())
    for (const json& other : others) {
      json damaged = whole;
      damaged[json::json_pointer(pointer)] = other;
      const auto read = read_clash_document(folder.write("damaged.json", damaged.dump()));
      if (read) (void)compare(*read, *read);
    }
}

}  // namespace
}  // namespace strake::report
