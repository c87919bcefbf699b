// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <random>
#include <stop_token>
#include <string>
#include <string_view>

#include "core/number.hpp"
#include "report/text/formatting.hpp"
#include "strake/clash/policy.hpp"
#include "strake/core/atomic_file.hpp"
#include "strake/parallel/team.hpp"
#include "strake/report/clash.hpp"
#include "support/clash_model.hpp"

namespace strake::report {
namespace {

using nlohmann::json;
using test::ClashModel;

std::string as_json(const clash::Report& report, const model::Model& model) {
  std::string text;
  EXPECT_TRUE(
      write_clash_json({{{report}, {}}, model}, [&](std::string_view piece) { text += piece; }));
  return text;
}

std::string as_csv(const clash::Report& report, const model::Model& model) {
  std::string text;
  EXPECT_TRUE(
      write_clash_csv({{{report}, {}}, model}, [&](std::string_view piece) { text += piece; }));
  return text;
}

ClashModel row_of_boxes() {
  ClashModel m;
  m.box("deck \"1\", port\n", {0, 0, 0}, {100, 100, 100});
  m.box("Büro \xF0\x9F\x9A\xA2 \xFF", {100, 0, 0}, {200, 100, 100});
  m.box("c", {180, 10, 10}, {300, 90, 90}, true);
  m.box("d", {310, 0, 0}, {400, 100, 100});
  return m;
}

TEST(ClashJson, HasTheKeysThatScriptsRelyOn) {
  const ClashModel m = row_of_boxes();
  const clash::Report report = m.detect({.tolerances = {.clearance_mm = 25}});
  const json doc = json::parse(as_json(report, m.model));
  EXPECT_EQ(doc["schema_version"], 2);
  ASSERT_EQ(doc["tests"].size(), 1U);
  const json& reported = doc["tests"][0];
  EXPECT_EQ(reported["name"], "");
  EXPECT_EQ(reported["sets"], json({{"a", "*"}, {"b", "*"}}));
  EXPECT_EQ(reported["objects"], json({{"a", 4}, {"b", 4}}));
  EXPECT_EQ(reported["settings"]["clearance_mm"], 25);
  EXPECT_EQ(reported["counts"]["HIT"], 1);
  EXPECT_EQ(reported["counts"]["CONTACT"], 1);
  EXPECT_EQ(reported["counts"]["CLEARANCE_VIOLATION"], 1);
  EXPECT_EQ(reported["counts"]["ALLOWED"], 0);
  EXPECT_TRUE(reported["exempted"].empty());
  EXPECT_EQ(reported["hash"], report.hash);
  EXPECT_EQ(doc["hash"], clash::hash_of(clash::Findings{{report}, {}}));
  EXPECT_EQ(doc["files"][0]["label"], "t.obj");
  ASSERT_EQ(doc["results"].size(), 3U);
  const json& touch = doc["results"][0];
  EXPECT_EQ(touch["a"]["id"], "deck \"1\", port\n");
  EXPECT_EQ(touch["b"]["name"], "Büro 🚢 \xEF\xBF\xBD");
  EXPECT_EQ(touch["a"]["file"], "t.obj");
  EXPECT_EQ(touch["test"], 0);
  EXPECT_EQ(touch["class"], "CONTACT");
  EXPECT_EQ(touch["relation"], "ABUT_OUTSIDE");
  EXPECT_EQ(touch["d_mm"], 0);
  const json& hit = doc["results"][1];
  EXPECT_EQ(hit["class"], "HIT");
  EXPECT_EQ(hit["d_mm"], -20);
  EXPECT_LE(hit["d_range_mm"][0], -20.0);
  EXPECT_GE(hit["d_range_mm"][1], -20.0);
  EXPECT_EQ(hit["point_mm"].size(), 3U);
  EXPECT_EQ(hit["flags"], json::array({"INVERTED"}));
  EXPECT_EQ(doc["results"][2]["class"], "CLEARANCE_VIOLATION");
  EXPECT_EQ(doc["results"][2]["d_mm"], 10);
}

TEST(ClashJson, SettingsStateNothingOfTheRun) {
  const ClashModel m = row_of_boxes();
  const json doc = json::parse(as_json(m.detect(), m.model));
  for (const auto& [key, value] : doc["tests"][0]["settings"].items())
    EXPECT_TRUE(key == "clearance_mm" || key == "touch_gap_mm" || key == "touch_overlap_mm" ||
                key == "thickness_cap" || key == "contact_distance_mm" || key == "curves")
        << key;
}

TEST(ClashJson, NothingFoundIsAValidDocument) {
  ClashModel m;
  m.box("a", {0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(json::parse(as_json(m.detect(), m.model))["results"].empty());
}

/// Written for the next test of the suite, which holds it against schemas/clash.schema.json.
TEST(ClashJson, LeavesADocumentForTheSchemaTest) {
  const ClashModel m = row_of_boxes();
  ASSERT_TRUE(write_file(STRAKE_CLASH_DOCUMENT,
                         as_json(m.detect({.tolerances = {.clearance_mm = 25}}), m.model)));
}

/// A hit whose search for the depth a work limit ended, as is that of one of its two places.
clash::Report unfinished_report(const ClashModel& m) {
  clash::Report report = m.detect({.tolerances = {.clearance_mm = 25}});
  clash::Pair& hit = report.pairs[1];
  hit.d_lower_mm = -31.25;
  hit.depth_complete = false;
  const clash::Region place{.cls = hit.cls,
                            .flags = hit.flags,
                            .d_mm = hit.d_mm,
                            .d_lower_mm = hit.d_lower_mm,
                            .d_upper_mm = hit.d_upper_mm,
                            .point_mm = hit.point_mm,
                            .box_mm = {hit.point_mm, hit.point_mm},
                            .part_a = hit.part_a,
                            .part_b = hit.part_b,
                            .depth_complete = false};
  hit.regions = 2;
  hit.first_region = 0;
  report.regions = {place, place};
  report.regions[1].depth_complete = true;
  return report;
}

TEST(ClashReports, ReportWhereADepthIsIncomplete) {
  const ClashModel m = row_of_boxes();
  const clash::Report report = unfinished_report(m);
  const json results = json::parse(as_json(report, m.model))["results"];
  EXPECT_EQ(results[1]["depth_complete"], false);
  EXPECT_EQ(results[1]["regions"][0]["depth_complete"], false);
  EXPECT_FALSE(results[1]["regions"][1].contains("depth_complete"));
  for (const std::size_t i : {0U, 2U}) EXPECT_FALSE(results[i].contains("depth_complete")) << i;
  const std::string csv = as_csv(report, m.model);
  EXPECT_NE(csv.find(",allowed_regions,depth_complete\r\n"), std::string::npos) << csv;
  EXPECT_EQ(csv.find(",false\r\n"), csv.rfind(",false\r\n"));
  EXPECT_NE(csv.find(",2,,false\r\n"), std::string::npos) << csv;
  // It says how a depth was found, not what: it bears on neither hash.
  clash::Report finished = report;
  finished.pairs[1].depth_complete = finished.regions[0].depth_complete = true;
  EXPECT_EQ(clash::hash_of(clash::Findings{{finished}, {}}),
            clash::hash_of(clash::Findings{{report}, {}}));
  EXPECT_EQ(json::parse(as_json(finished, m.model))["results"][1]["key"], results[1]["key"]);
}

/// Written for the schema test, as above.
TEST(ClashJson, LeavesAnUnfinishedDocumentForTheSchemaTest) {
  const ClashModel m = row_of_boxes();
  ASSERT_TRUE(write_file(STRAKE_UNFINISHED_DOCUMENT, as_json(unfinished_report(m), m.model)));
}

TEST(ClashReports, NameTheTestOfEachResult) {
  const ClashModel m = row_of_boxes();
  clash::Findings findings{{m.detect(), m.detect({.tolerances = {.clearance_mm = 25}})}, {}};
  findings.tests[0].name = "as built";
  findings.tests[1].name = "with, room";
  findings.tests[1].exempted = {{"one skid", 3}, {"idle", 0}};
  findings.tests[1].diagnostics.add(Severity::warning, "empty-set", "nothing there", "set B, x");
  std::string text, csv;
  EXPECT_TRUE(
      write_clash_json({findings, m.model}, [&](std::string_view piece) { text += piece; }));
  EXPECT_TRUE(write_clash_csv({findings, m.model}, [&](std::string_view piece) { csv += piece; }));
  const json doc = json::parse(text);
  ASSERT_EQ(doc["results"].size(), 5U);
  for (std::size_t r = 0; r < 5; ++r) EXPECT_EQ(doc["results"][r]["test"], r < 2 ? 0 : 1);
  EXPECT_EQ(doc["tests"][1]["exempted"],
            json::parse(R"([{"rule": "one skid", "pairs": 3}, {"rule": "idle", "pairs": 0}])"));
  EXPECT_EQ(doc["messages"].back()["where"], "test 'with, room', set B, x");
  EXPECT_EQ(doc["diagnostics"].back()["code"], "empty-set");
  EXPECT_NE(csv.find(",as built,"), std::string::npos);
  EXPECT_NE(csv.find(",\"with, room\","), std::string::npos);
  const std::string table = clash_table({findings, m.model}, {});
  EXPECT_LT(table.find("== as built\n"), table.find("1 hit, 1 contact, 0 clearance violations\n"));
  EXPECT_LT(table.find("== with, room\n"),
            table.find("1 hit, 1 contact, 1 clearance violation, 3 exempted by one skid\n"));
  clash::Findings renamed = findings;
  renamed.tests[0].name = "other";
  EXPECT_NE(clash::hash_of(findings), clash::hash_of(renamed));
}

/// Two disciplines, a rule that allows, one that exempts, and levels.
clash::Report ruled_report(const ClashModel& m) {
  clash::Policy policy;
  clash::Matrix matrix;
  matrix.disciplines = {"hull, port", "pipes"};
  matrix.discipline = {0, 0, 1, clash::kNoLabel};
  matrix.cells = {clash::Matrix::kNotChecked, 0, 0, clash::Matrix::kDefault};
  policy.tolerances = {{.clearance_mm = 30}};
  policy.matrix = matrix;
  policy.levels = clash::Levels{};
  policy.levels->object = {clash::Level::hard, clash::Level::hard, clash::Level::soft,
                           clash::Level::hard};
  clash::Allowed& allowed = policy.allowed.emplace_back();
  allowed.rule = "sleeve";
  allowed.a = allowed.b = {false, true, true, false};
  allowed.max_depth_mm = 25;
  policy.list_exempted = true;
  const clash::Options options{.tolerances = {.clearance_mm = 25}};
  const model::Scene scene = make_scene(m.model, clash::scene_options(options), {}).value();
  return clash::detect(scene, clash::one_set(scene), options, policy, {}).value();
}

TEST(ClashReports, ReportWhatRulesDid) {
  const ClashModel m = row_of_boxes();
  const clash::Report report = ruled_report(m);
  const json doc = json::parse(as_json(report, m.model));
  const json& test = doc["tests"][0];
  EXPECT_EQ(test["counts"], json::parse(R"({"HIT": 0, "CONTACT": 0, "CLEARANCE_VIOLATION": 1,
                                            "ALLOWED": 1})"));
  EXPECT_EQ(test["exempted"], json::parse(R"([{"rule": "matrix", "pairs": 1},
                                              {"rule": "no obstruction", "pairs": 0}])"));
  EXPECT_EQ(test["allowed"],
            json::parse(R"([{"rule": "sleeve", "candidates": 1, "pairs": 1, "places": 0}])"));
  EXPECT_EQ(test["matrix"]["disciplines"], json::parse(R"([{"name": "hull, port", "objects": 2},
                                                           {"name": "pipes", "objects": 1}])"));
  const json& cells = test["matrix"]["cells"];
  ASSERT_EQ(cells.size(), 3U);
  EXPECT_EQ(cells[0], json::parse(R"({"a": "hull, port", "b": "hull, port", "checked": false})"));
  EXPECT_EQ(cells[1]["settings"]["clearance_mm"], 30);
  EXPECT_EQ(cells[1]["counts"]["ALLOWED"], 1);
  EXPECT_EQ(cells[2]["settings"]["clearance_mm"], 25);
  ASSERT_EQ(doc["results"].size(), 2U);
  const json& sleeve = doc["results"][0];
  EXPECT_EQ(sleeve["class"], "HIT");
  EXPECT_EQ(sleeve["allowed"], "sleeve");
  EXPECT_EQ(sleeve["a"]["level"], "hard");
  EXPECT_EQ(sleeve["b"]["level"], "soft");
  EXPECT_EQ(sleeve["a"]["discipline"], "hull, port");
  EXPECT_FALSE(doc["results"][1].contains("allowed"));
  EXPECT_EQ(doc["results"][1]["b"]["discipline"], "");
  ASSERT_EQ(doc["exempted"].size(), 1U);
  EXPECT_EQ(doc["exempted"][0]["rule"], "matrix");
  EXPECT_EQ(doc["exempted"][0]["a"]["id"], "deck \"1\", port\n");
  const std::string csv = as_csv(report, m.model);
  EXPECT_NE(csv.find(",sleeve,,hard,soft,\"hull, port\",pipes,,1,,\r\n"), std::string::npos) << csv;
  EXPECT_NE(
      csv.find(",EXEMPTED,,,,,,,,,,,,,,,,,,,,,,matrix,,,\"hull, port\",\"hull, port\",,,,\r\n"),
      std::string::npos)
      << csv;
  const std::string table = clash_table({{{report}, {}}, m.model}, {});
  EXPECT_NE(
      table.find("0 hits, 0 contacts, 1 clearance violation, 1 allowed, 1 exempted by matrix"),
      std::string::npos)
      << table;
  EXPECT_NE(table.find("hits    contacts   clearance     allowed\n"), std::string::npos) << table;
  EXPECT_NE(table.find("hull, port x pipes"), std::string::npos) << table;
  EXPECT_EQ(table.find("pipes x pipes"), std::string::npos) << "nothing was found there";
  EXPECT_EQ(table.find("HIT"), std::string::npos) << "what is allowed is no clash to look at";
  const RulesSource profile{"ship.toml", {}, "ship"};
  const std::string by_profile = clash_table({{{report}, {}}, m.model, nullptr, &profile}, {});
  EXPECT_NE(by_profile.find("0 hits, 0 contacts, 1 clearance violation, 1 allowed\n"
                            "left out by profile ship: 1 pair (matrix); allowed: 1 pair (sleeve)"),
            std::string::npos)
      << by_profile;
}

/// Written for the schema test, as above.
TEST(ClashJson, LeavesARuledDocumentForTheSchemaTest) {
  const ClashModel m = row_of_boxes();
  ASSERT_TRUE(write_file(STRAKE_RULED_DOCUMENT, as_json(ruled_report(m), m.model)));
}

TEST(ClashJson, StreamsInPieces) {
  ClashModel m;
  for (int i = 0; i < 4000; ++i)
    m.box("box number " + std::to_string(i), {i * 10.0, 0, 0}, {i * 10.0 + 10, 10, 10});
  const clash::Report report = m.detect();
  std::size_t total = 0, largest = 0;
  EXPECT_TRUE(write_clash_json({{{report}, {}}, m.model}, [&](std::string_view piece) {
    total += piece.size();
    largest = std::max(largest, piece.size());
  }));
  EXPECT_LT(largest, total / 3);
}

TEST(ClashReports, WhatASinkThrowsComesOutOnce) {
  struct Full {};
  ClashModel m;
  for (int i = 0; i < 4000; ++i)
    m.box("box number " + std::to_string(i), {i * 10.0, 0, 0}, {i * 10.0 + 10, 10, 10});
  const clash::Findings findings{{m.detect({.engine = {.log_pairs = true}})}, {}};
  parallel::Team team(3);
  for (const parallel::Context& context : {parallel::Context{}, parallel::Context{.team = &team}})
    for (const auto write : {write_clash_json, write_clash_csv, write_pair_log}) {
      int calls = 0;
      const auto full_at_second = [&](std::string_view) {
        if (++calls == 2) throw Full();
      };
      EXPECT_THROW((void)write({findings, m.model}, full_at_second, context), Full);
      EXPECT_EQ(calls, 2);
    }
}

TEST(ClashReports, BytesAreThoseOfOneThread) {
  ClashModel m;
  for (int i = 0; i < 900; ++i)
    m.box("box number " + std::to_string(i), {i * 10.0, 0, 0}, {i * 10.0 + 10 + i * 1e-3, 10, 10});
  clash::Findings findings;
  findings.tests = {m.detect({.engine = {.log_pairs = true}}), clash::Report(), m.detect()};
  const auto written = [&](auto&& write, const parallel::Context& context) {
    std::string text;
    EXPECT_TRUE(write(
        ClashContents{findings, m.model}, [&](std::string_view piece) { text += piece; }, context));
    return text;
  };
  for (const auto write : {write_clash_json, write_clash_csv, write_pair_log}) {
    const std::string alone = written(write, {});
    EXPECT_GT(alone.size(), 50'000U);
    for (const unsigned workers : {2U, 7U}) {
      parallel::Team team(workers);
      EXPECT_EQ(written(write, {.team = &team}), alone);
    }
  }
}

TEST(ClashReports, CancelledIsAnError) {
  const ClashModel m = row_of_boxes();
  const clash::Report report = m.detect();
  const std::stop_source stop;
  stop.request_stop();
  const Status status = write_clash_csv({{{report}, {}}, m.model}, [](std::string_view) {},
                                        {.stop = stop.get_token()});
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::cancelled);
}

TEST(ClashReports, LengthsAreThoseOfExactRounding) {
  // The fast way of a length against the C++ library's, ties and their neighbours among them.
  std::mt19937_64 random(20);
  const auto exact = [](double mm) {
    std::string text = fixed(mm, 6);
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
  };
  const auto holds = [&](double mm) {
    std::string text;
    append_mm(text, mm);
    EXPECT_EQ(text, exact(mm));
  };
  for (const double mm : {0.0, -0.0, 5e-7, -5e-7, 4.9e-7, 0.0000015, 0.0000025, 1e9,
                          999999999.9999995, 0.9999995, 123456.7890125, -1e22, 0.1, 1e-300})
    holds(mm);
  for (int i = 0; i < 200'000; ++i) {
    const double size = std::ldexp(1.0, static_cast<int>(random() % 60) - 25);
    const double mm = (static_cast<double>(random() >> 11U) * 0x1p-53 - 0.5) * size;
    holds(mm);
    const double tie = (std::floor(mm * 1e6) + 0.5) / 1e6;
    for (const double near : {tie, std::nextafter(tie, 1e300), std::nextafter(tie, -1e300)})
      holds(near);
    holds(std::floor(mm * 1e3) / 1e3);
  }
}

TEST(ClashCsv, OneLineAPairQuotedWhereNeeded) {
  const ClashModel m = row_of_boxes();
  const std::string text = as_csv(m.detect({.tolerances = {.clearance_mm = 25}}), m.model);
  EXPECT_TRUE(text.starts_with("a_id,a_name,a_file,b_id"));
  EXPECT_NE(text.find("\"deck \"\"1\"\", port\n\""), std::string::npos);
  EXPECT_NE(text.find(",CLEARANCE_VIOLATION,SEPARATE,10,"), std::string::npos);
  EXPECT_NE(text.find(",INVERTED,,"), std::string::npos);
}

TEST(ClashCsv, NoNameBecomesAFormula) {
  ClashModel m;
  m.box("=HYPERLINK(x)", {0, 0, 0}, {100, 100, 100}).box("-5", {50, 0, 0}, {150, 100, 100});
  m.box("@c", {0, 50, 0}, {100, 150, 100}).box("+d", {50, 50, 0}, {150, 150, 100});
  const std::string text = as_csv(m.detect(), m.model);
  for (const std::string bad : {"=HYPERLINK", "-5,", "@c", "+d"}) {
    EXPECT_NE(text.find("'" + bad), std::string::npos) << bad;
    EXPECT_EQ(text.find("," + bad), std::string::npos) << bad;
    EXPECT_EQ(text.find("\n" + bad), std::string::npos) << bad;
  }
  EXPECT_NE(text.find(",-50,"), std::string::npos) << "depths are numbers";
}

/// Cells of a CSV as a spreadsheet takes them: at commas, and at what it takes for one elsewhere.
std::vector<std::string> cells_of(const std::string& text, const std::string& separators) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : text) {
    if (c == '"')
      quoted = !quoted;
    else if (!quoted && separators.find(c) != std::string::npos)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

/// Every sign that begins a formula, behind everything that does not show, and between what other
/// languages part cells at.
TEST(ClashCsv, NoNameBecomesAFormulaBehindBlanks) {
  const std::vector<std::string> signs{
      "=", "+", "-", "@", "\xEF\xBC\x9D", "\xEF\xBC\x8B", "\xEF\xBC\x8D", "\xEF\xBC\xA0"};
  std::vector<std::string> blanks{"",
                                  "\xC2\x85",
                                  "\xC2\xA0",
                                  "\xC2\xAD",
                                  "\xE1\x9A\x80",
                                  "\xE2\x80\x80",
                                  "\xE2\x80\x8B",
                                  "\xE2\x80\x8F",
                                  "\xE2\x80\xA8",
                                  "\xE2\x80\xAF",
                                  "\xE2\x81\x9F",
                                  "\xE2\x81\xA0",
                                  "\xE3\x80\x80",
                                  "\xEF\xBB\xBF",
                                  " \n \xC2\xA0"};
  for (int c = 1; c <= 0x20; ++c) blanks.emplace_back(1, static_cast<char>(c));
  blanks.emplace_back(1, '\x7F');
  for (const std::string& sign : signs) {
    for (const std::string& blank : blanks) {
      const std::string name = blank + sign + "1";
      ClashModel m;
      m.box(name, {0, 0, 0}, {100, 100, 100}).box("b", {50, 0, 0}, {150, 100, 100});
      const std::string text = as_csv(m.detect(), m.model);
      const std::vector<std::string> cells = cells_of(text, ",\r\n");
      EXPECT_NE(std::find(cells.begin(), cells.end(), "'" + name), cells.end()) << name;
      EXPECT_EQ(std::find(cells.begin(), cells.end(), name), cells.end()) << name;
    }
    for (const std::string separator : {",", ";", "\t"}) {
      ClashModel m;
      m.box("a" + separator + sign + "1", {0, 0, 0}, {100, 100, 100});
      m.box("b", {50, 0, 0}, {150, 100, 100});
      for (const std::string& cell : cells_of(as_csv(m.detect(), m.model), separator + "\r\n"))
        EXPECT_FALSE(cell.starts_with(sign) && cell.ends_with(sign + "1")) << cell;
    }
  }
  ClashModel m;
  m.box("  plain\xE2\x82\xAC-1", {0, 0, 0}, {100, 100, 100}).box("b", {50, 0, 0}, {150, 100, 100});
  EXPECT_NE(as_csv(m.detect(), m.model).find(",  plain\xE2\x82\xAC-1,"), std::string::npos);
}

TEST(ClashJson, WitnessesKeysAndVolumes) {
  const ClashModel m = row_of_boxes();
  const clash::Report report =
      m.detect({.tolerances = {.clearance_mm = 25}, .engine = {.volumes = clash::Volumes::on}});
  const json results = json::parse(as_json(report, m.model))["results"];
  const json &touch = results[0], &hit = results[1], &near = results[2];
  EXPECT_EQ(touch["on_a_mm"], touch["on_b_mm"]);
  EXPECT_FALSE(touch.contains("volume_mm3"));
  EXPECT_EQ(near["on_a_mm"][0], 300);
  EXPECT_EQ(near["on_b_mm"][0], 310);
  EXPECT_FALSE(near.contains("push_out"));
  EXPECT_EQ(hit["volume_mm3"], 20 * 80 * 80);
  EXPECT_EQ(hit["push_out"].size(), 3U);
  EXPECT_EQ(hit["surface_mm"].size(), 3U);
  EXPECT_EQ(hit["key"].get<std::string>().size(), 26U);
  EXPECT_NE(hit["key"], touch["key"]);
  // Neither the class nor anything else that may change shows in the key.
  const clash::Options plain{
      .tolerances = {.touch_overlap_mm = 30, .thickness_cap = clash::ThicknessCap::off}};
  const json later = json::parse(as_json(m.detect(plain), m.model))["results"];
  EXPECT_EQ(later[1]["class"], "CONTACT");
  EXPECT_EQ(later[1]["key"], hit["key"]);
}

TEST(ClashCsv, HoldsNothingThatIsNoUtf8) {
  const ClashModel m = row_of_boxes();
  const std::string text = as_csv(m.detect({.tolerances = {.clearance_mm = 25}}), m.model);
  EXPECT_EQ(text.find('\xFF'), std::string::npos);
  EXPECT_NE(text.find(",Büro 🚢 \xEF\xBF\xBD,"), std::string::npos);
}

TEST(ClashTable, WorstFirstClippedAndCounted) {
  const ClashModel m = row_of_boxes();
  const clash::Report report = m.detect({.tolerances = {.clearance_mm = 25}});
  const std::string text = clash_table({{{report}, {}}, m.model}, {.width = 72, .rows = 2});
  EXPECT_LT(text.find("HIT"), text.find("CONTACT"));
  EXPECT_NE(text.find("… and 1 clearance violation more"), std::string::npos);
  EXPECT_NE(text.find("1 hit, 1 contact, 1 clearance violation"), std::string::npos);
  EXPECT_EQ(text.find('\xFF'), std::string::npos);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    const std::string line = text.substr(at, end - at);
    const auto columns = std::count_if(line.begin(), line.end(), [](char c) {
      return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
    });
    EXPECT_LE(columns, 72) << line;
    at = end + 1;
  }
}

TEST(ClashTable, ShowsABracketThatIsWiderThanItsDigits) {
  const ClashModel m = row_of_boxes();
  clash::Report report = m.detect({.tolerances = {.clearance_mm = 25}});
  const auto shown = [&] { return clash_table({{{report}, {}}, m.model}, {.width = 100}); };
  const std::string narrow = shown();
  EXPECT_EQ(narrow.find("d range mm"), std::string::npos) << narrow;
  EXPECT_EQ(narrow.find('['), std::string::npos) << narrow;
  clash::Pair& hit = report.pairs[1];
  // As wide as the grid alone accounts for: not told.
  hit.d_lower_mm = -20.004;
  hit.d_upper_mm = -19.9965;
  EXPECT_EQ(shown(), narrow);
  // Rounded outward: the true d lies in what is printed.
  hit.d_lower_mm = -31.2501;
  hit.d_upper_mm = -19.9999;
  const std::string wide = shown();
  EXPECT_NE(wide.find("d range mm"), std::string::npos) << wide;
  EXPECT_NE(wide.find("-20.000  [-31.251, -19.999]  INTERFERE"), std::string::npos) << wide;
  EXPECT_EQ(std::count(wide.begin(), wide.end(), '['), 1) << wide;
  EXPECT_EQ(std::count(wide.begin(), wide.end(), '\n'),
            std::count(narrow.begin(), narrow.end(), '\n'));
  hit.d_mm = hit.d_upper_mm = -0.0001;
  EXPECT_NE(shown().find("[-31.251, 0.000]"), std::string::npos) << shown();
}

TEST(ClashTable, ManyContactsHideNeitherHitsNorClearanceViolations) {
  ClashModel m;
  for (int i = 0; i < 40; ++i) {
    const double x = 100.0 * i;
    m.box("row" + std::to_string(100 + i), {x, 0, 0}, {x + 100, 100, 100});
  }
  m.box("deep", {3990, 0, 0}, {4500, 100, 100});
  m.box("near", {4510, 0, 0}, {4600, 100, 100});
  const clash::Report report = m.detect({.tolerances = {.clearance_mm = 25}});
  const std::string text = clash_table({{{report}, {}}, m.model}, {.rows = 10});
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 10 + 1 + 1 + 1) << text;
  EXPECT_NE(text.find("deep"), std::string::npos);
  EXPECT_NE(text.find("near"), std::string::npos);
  EXPECT_NE(text.find("… and 31 contacts more"), std::string::npos) << text;
  EXPECT_NE(text.find("1 hit, 39 contacts, 1 clearance violation"), std::string::npos) << text;
}

TEST(ClashTable, ShowsTheVolumeThatItSortsBy) {
  ClashModel m;
  m.box("a", {0, 0, 0}, {100, 100, 100}).box("b", {90, 0, 0}, {200, 100, 100});
  const clash::Report report = m.detect({.engine = {.volumes = clash::Volumes::on}});
  const std::string by_volume =
      clash_table({{{report}, {}}, m.model}, {.sort = clash::SortBy::volume});
  EXPECT_NE(by_volume.find("volume mm3"), std::string::npos);
  EXPECT_NE(by_volume.find("100000.0"), std::string::npos) << by_volume;
  EXPECT_EQ(clash_table({{{report}, {}}, m.model}, {}).find("volume"), std::string::npos);
}

TEST(ClashTable, NothingFoundIsStated) {
  ClashModel m;
  m.box("a", {0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(clash_table({{{m.detect()}, {}}, m.model}, {}),
            "0 hits, 0 contacts, 0 clearance violations\n");
}

}  // namespace
}  // namespace strake::report
