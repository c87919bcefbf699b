// SPDX-License-Identifier: Apache-2.0
// What was decided about clashes: the file, what a result takes from it, and what it becomes.
#include "strake/report/decisions.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "strake/clash/group.hpp"
#include "strake/report/clash.hpp"
#include "support/decided.hpp"

namespace strake::report {
namespace {

using nlohmann::json;
using test::ClashModel;
using test::Decided;
using test::key_of;
using test::parsed;
using test::row;
using test::three_boxes;

TEST(Decisions, SettleWhatIsApproved) {
  const ClashModel m = three_boxes();
  const Decided d(three_boxes(), "key,status\n" + row(key_of(m, 0, 1), "approved") +
                                     row(std::string(26, '0'), "active"));
  EXPECT_EQ(d.results.counts, (std::array<std::uint64_t, 5>{1, 0, 0, 1, 0}));
  ASSERT_EQ(d.results.not_found.size(), 1U);
  EXPECT_EQ(d.results.not_found[0]->status, DecisionStatus::active);
  const std::string table = d.table();
  EXPECT_NE(table.find("HIT    new     -20.000"), std::string::npos) << table;
  EXPECT_NE(table.find("1 hit, 0 contacts, 0 clearance violations, 1 approved\n"
                       "decisions of d.csv: 1 new, 0 active, 0 reviewed, 1 approved, 0 resolved; "
                       "no longer found: 1\n"),
            std::string::npos)
      << table;
  EXPECT_EQ(table.find("\nHIT"), table.rfind("\nHIT")) << "what is approved is listed: " << table;
}

TEST(Decisions, BelongToNoGroupWhereTheySettle) {
  const ClashModel m = three_boxes();
  const Decided d(three_boxes(), "key,status\n" + row(key_of(m, 0, 1), "approved"));
  const auto grouping =
      clash::group_results(d.findings, d.m.model, {}, [&](const clash::ResultRef& r) {
        return d.results.is_settled(r.test, d.findings.tests[r.test].pairs[r.pair]);
      });
  ASSERT_TRUE(grouping);
  ASSERT_EQ(grouping->groups.size(), 1U);
  EXPECT_EQ(grouping->groups[0].results.size(), 1U);
}

TEST(Decisions, ComeBackWhereAClashGotWorse) {
  const std::string key = key_of(three_boxes(), 0, 1), head = "key,status,d_mm,regions\n";
  const auto after = [&](double depth_mm, const std::string& csv, const DecisionRules& rules = {}) {
    return Decided(three_boxes(depth_mm), head + row(key, csv), rules).reopened(0);
  };
  EXPECT_EQ(after(20.9, "approved,-20,1"), Reopened::no);
  EXPECT_EQ(after(21.1, "approved,-20,1"), Reopened::deeper);
  EXPECT_EQ(after(21.1, "approved,-20,1", {.deeper_mm = 2}), Reopened::no);
  EXPECT_EQ(after(19, "approved,-20,1"), Reopened::no);
  EXPECT_EQ(after(50, "approved,,"), Reopened::no) << "the file does not say how deep it was";
  EXPECT_EQ(after(21.1, "reviewed,-20,1"), Reopened::no) << "it is listed anyway";
  EXPECT_EQ(after(20, "resolved,-20,1"), Reopened::found_again);
  for (const char* const depth : {"-21.123456", "-21.1235", "-21.12"})
    EXPECT_EQ(after(21.1234564, "approved," + std::string(depth) + ",1", {.deeper_mm = 0}),
              Reopened::no)
        << "a spreadsheet rounds";
  EXPECT_EQ(after(21.13, "approved,-21.12,1", {.deeper_mm = 0}), Reopened::deeper);
  EXPECT_EQ(after(20.1, "approved,-20,1", {.deeper_mm = 0}), Reopened::deeper);
  const Decided d(three_boxes(30), head + row(key, "approved,-20,1"));
  EXPECT_NE(d.table().find("HIT    deeper  -30.000"), std::string::npos) << d.table();
  EXPECT_NE(d.table().find("; approved, but deeper or nearer than they were: 1\n"),
            std::string::npos);
  EXPECT_NE(d.table().find("2 hits, "), std::string::npos);
}

TEST(Decisions, ComeBackWhereTheClassIsSeverer) {
  const std::string key = key_of(three_boxes(), 0, 1), head = "key,status,class,d_mm\n";
  const auto after = [&](const std::string& csv) {
    return Decided(three_boxes(), head + row(key, csv)).reopened(0);
  };
  EXPECT_EQ(after("approved,CONTACT,-20"), Reopened::severer);
  EXPECT_EQ(after("approved,clearance_violation,-20"), Reopened::severer);
  EXPECT_EQ(after("approved,HIT,-20"), Reopened::no);
  EXPECT_EQ(after("approved,,-20"), Reopened::no);
  EXPECT_EQ(after("approved,CONTACT,"), Reopened::no) << "approved as it is now";
  EXPECT_EQ(Decided(three_boxes(), "key,status,class\n" + row(key, "approved,CONTACT")).reopened(0),
            Reopened::severer);
  const Decided d(three_boxes(), head + row(key, "approved,CONTACT,-20"));
  EXPECT_NE(d.table().find("HIT    severer  -20.000"), std::string::npos) << d.table();
  EXPECT_NE(d.table().find("; approved, but of a severer class than they were: 1\n"),
            std::string::npos)
      << d.table();
}

TEST(Decisions, ComeBackWhereTheTwoMeetAtMorePlaces) {
  ClashModel m;
  m.box("a", {0, 0, 0}, {100, 100, 100});
  m.object("b").body(test::box_mesh({80, 0, 0}, {200, 10, 100}));
  m.body(test::box_mesh({80, 90, 0}, {200, 100, 100}));
  const std::string key = key_of(m, 0, 1);
  EXPECT_EQ(Decided(m, "key,status,regions\n" + row(key, "approved,2")).reopened(0), Reopened::no);
  EXPECT_EQ(Decided(m, "key,status,regions\n" + row(key, "approved,1")).reopened(0),
            Reopened::more_regions);
}

TEST(Decisions, AreInTheDocument) {
  const ClashModel m = three_boxes();
  const Decided d(three_boxes(), "key,status,by,date,comment\n" +
                                     row(key_of(m, 0, 1), "resolved,Ann,1.2.2026,moved") +
                                     row(std::string(26, '0'), "approved,Bob,,"));
  std::string text;
  ASSERT_TRUE(write_clash_json(d.contents(), [&](std::string_view piece) { text += piece; }));
  const json document = json::parse(text);
  EXPECT_EQ(document["results"][0]["decision"], json({{"status", "resolved"},
                                                      {"by", "Ann"},
                                                      {"date", "2026-02-01"},
                                                      {"comment", "moved"},
                                                      {"reopened", "found again"}}));
  EXPECT_EQ(document["results"][1]["decision"], json({{"status", "new"}}));
  const json& all = document["decisions"];
  EXPECT_EQ(all["file"], "d.csv");
  EXPECT_EQ(all["counts"]["resolved"], 1);
  EXPECT_EQ(all["counts"]["new"], 1);
  EXPECT_EQ(all["reopened"]["found_again"], 1);
  ASSERT_EQ(all["not_found"].size(), 1U);
  EXPECT_EQ(all["not_found"][0],
            json({{"key", std::string(26, '0')}, {"status", "approved"}, {"by", "Bob"}}));
}

TEST(Decisions, ACsvOfResultsIsADecisionFile) {
  const ClashModel m = three_boxes();
  const Decided d(three_boxes(), "key,status,comment\n" + row(key_of(m, 0, 1), "approved,=1+1"));
  std::string text;
  ASSERT_TRUE(write_clash_csv(d.contents(), [&](std::string_view piece) { text += piece; }));
  const DecisionFile again = parsed(text);
  ASSERT_EQ(again.decisions.size(), 2U);
  EXPECT_EQ(again.decisions[0].status, DecisionStatus::approved);
  EXPECT_EQ(again.decisions[0].comment, "'=1+1");
  EXPECT_EQ(again.decisions[1].status, DecisionStatus::undecided);
  EXPECT_EQ(again.decisions[0].d_mm, -20);
}

TEST(UpdatedDecisions, MakeAFileThatTheNextRunTakes) {
  const Decided first(three_boxes(), "");
  const std::string text = first.updated();
  EXPECT_TRUE(text.starts_with("key,status,by,date,comment,class,d_mm,")) << text;
  EXPECT_EQ(update_decisions(first.contents()).added, 2U);
  const Decided second(three_boxes(), text);
  EXPECT_EQ(second.updated(), text) << "a second run changes nothing";
  EXPECT_TRUE(second.results.not_found.empty());
  EXPECT_EQ(second.file.decisions[0].a.file, "t.obj");
}

TEST(UpdatedDecisions, KeepRowsAndColumnsOfOthers) {
  const ClashModel m = three_boxes();
  const std::string gone(26, '0'), key = key_of(m, 0, 1);
  const Decided d(three_boxes(25),
                  "\xEF\xBB\xBFOwner;Key;Status;Comment;d_mm\n"
                  "\"A; B\";" +
                      key +
                      ";Approved;\"say \"\"no\"\"\";-20\n"
                      "x;" +
                      gone + ";active\n");
  const std::string text = d.updated();
  EXPECT_TRUE(text.starts_with("\xEF\xBB\xBFOwner;Key;Status;Comment;d_mm;by;date;class;x_mm;"))
      << text;
  EXPECT_NE(text.find("\n\"A; B\";" + key + ";Approved;\"say \"\"no\"\"\";-20;"), std::string::npos)
      << text;
  EXPECT_NE(text.find("\nx;" + gone + ";active\n"), std::string::npos) << text;
  EXPECT_EQ(parsed(text).decisions.size(), 3U);
  EXPECT_EQ(Decided(three_boxes(25), text).updated(), text);
}

TEST(UpdatedDecisions, AreAboutWhatIsThereWhenOneDecides) {
  const ClashModel m = three_boxes();
  const std::string head = "key,status,d_mm\n", key = key_of(m, 0, 1);
  const auto depth = [&](const std::string& csv) {
    return parsed(Decided(three_boxes(25), head + row(key, csv)).updated()).decisions[0].d_mm;
  };
  EXPECT_EQ(depth("new,-20"), -25) << "nobody has decided yet";
  EXPECT_EQ(depth("approved,-20"), -20);
  EXPECT_EQ(depth("approved,"), -25) << "from now on it is known";
}

TEST(UpdatedDecisions, AreAboutOneMeasurement) {
  const ClashModel m = three_boxes();
  const std::string head = "key,status,class,d_mm,regions,x_mm\n", key = key_of(m, 0, 1);
  const auto updated = [&](const std::string& csv) {
    return parsed(Decided(three_boxes(25), head + row(key, csv)).updated()).decisions[0];
  };
  const Decision renewed = updated("approved,CONTACT,,7,1");
  EXPECT_EQ(renewed.d_mm, -25);
  EXPECT_EQ(renewed.cls, clash::Class::hit);
  EXPECT_EQ(renewed.regions, 1U);
  EXPECT_NE(renewed.point_mm->x, 1);
  const Decision kept = updated("approved,CONTACT,-20,7,1");
  EXPECT_EQ(kept.cls, clash::Class::contact);
  EXPECT_EQ(kept.regions, 7U);
  EXPECT_EQ(kept.point_mm->x, 1);
  const Decision without =
      parsed(Decided(three_boxes(25), "key,status,regions\n" + row(key, "approved,7")).updated())
          .decisions[0];
  EXPECT_EQ(without.regions, 7U) << "a file that never had depths states regions of its own";
}

TEST(Decisions, ReportPlacesThatNobodyCounted) {
  const ClashModel m = three_boxes();
  const auto unknown = [&](std::uint64_t max_regions, const std::string& csv) {
    clash::Options options;
    options.engine.max_regions = max_regions;
    const clash::Findings findings{{m.detect(options)}, {}};
    const DecisionFile file = parsed("key,status,regions\n" + row(key_of(m, 0, 1), csv));
    return decide(findings, m.model, file, {})->count_regions_unknown();
  };
  EXPECT_EQ(unknown(0, "approved,1"), 1U);
  EXPECT_EQ(unknown(8, "approved,1"), 0U);
  EXPECT_EQ(unknown(0, "approved,"), 0U);
  EXPECT_EQ(unknown(0, "active,1"), 0U);
}

}  // namespace
}  // namespace strake::report
