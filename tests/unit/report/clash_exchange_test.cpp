// SPDX-License-Identifier: Apache-2.0
// Clash results for programs of others: the XML of Navisworks, the JSON of ifcclash.
#include <gtest/gtest.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clash/results/clash_key.hpp"
#include "report/text/uuid.hpp"
#include "strake/clash/group.hpp"
#include "strake/report/clash.hpp"
#include "strake/report/decisions.hpp"
#include "support/clash_model.hpp"
#include "support/row_of_boxes.hpp"

namespace strake::report {
namespace {

using nlohmann::json;
using test::ClashModel;
using test::findings_up_to_25_mm;
using test::row_of_boxes;

template <class Write>
std::string exchanged(Write&& write, const ClashContents& contents,
                      const parallel::Context& context = {}) {
  std::string text;
  EXPECT_TRUE(write(contents, [&](std::string_view piece) { text += piece; }, context));
  return text;
}

std::size_t count(std::string_view text, std::string_view part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++n;
  return n;
}

bool has(std::string_view text, std::string_view part) { return text.find(part) != text.npos; }

std::string key_of(const ClashModel& m, const clash::Pair& pair) {
  return clash::pair_key("", m.model, pair.a, pair.b);
}

TEST(ClashXml, HasEachResultWithItsSignedDistance) {
  const ClashModel m = row_of_boxes();
  const clash::Findings findings = findings_up_to_25_mm(m);
  const std::string xml = exchanged(write_clash_xml, {findings, m.model});
  EXPECT_EQ(count(xml, "<clashresult "), 3U);
  EXPECT_TRUE(has(xml, R"(<clashresult name="Clash1" guid=")")) << xml;
  EXPECT_TRUE(has(xml, R"( status="new" distance="-20.5"><description>Hard</description>)")) << xml;
  EXPECT_TRUE(has(xml, R"( distance="10"><description>Clearance</description>)")) << xml;
  EXPECT_TRUE(has(xml, R"(test_type="clearance" status="ok" tolerance="25")")) << xml;
  EXPECT_TRUE(has(xml, R"(<summary total="3" new="3" active="0" reviewed="0" approved="0")"))
      << xml;
}

TEST(ClashXml, GuidsStayWithTheClashAndNotWithItsPlaceInTheFile) {
  const ClashModel m = row_of_boxes();
  clash::Findings findings = findings_up_to_25_mm(m);
  const std::string guid = uuid_from_key(kClashNamespace, key_of(m, findings.tests[0].pairs[2]));
  EXPECT_TRUE(has(exchanged(write_clash_xml, {findings, m.model}), "\"Clash3\" guid=\"" + guid));
  findings.tests[0].pairs.erase(findings.tests[0].pairs.begin());
  EXPECT_TRUE(has(exchanged(write_clash_xml, {findings, m.model}), "\"Clash2\" guid=\"" + guid));
}

TEST(ClashXml, ReportsWhatWasDecided) {
  const ClashModel m = row_of_boxes();
  const clash::Findings findings = findings_up_to_25_mm(m);
  const std::vector<clash::Pair>& pairs = findings.tests[0].pairs;
  const Result<DecisionFile> file =
      parse_decisions("key,status,by,date,comment,class,d_mm\n" + key_of(m, pairs[0]) +
                          ",approved,N. N.,2026-01-09,\"as <agreed> & so\",HIT,-20.5\n" +
                          key_of(m, pairs[2]) + ",resolved,,2026-01-09,,CLEARANCE_VIOLATION,10\n",
                      "d.csv");
  ASSERT_TRUE(file);
  const Result<DecidedResults> decided = decide(findings, m.model, *file, {});
  ASSERT_TRUE(decided);
  const std::string xml =
      exchanged(write_clash_xml, {.findings = findings, .model = m.model, .decided = &*decided});
  EXPECT_TRUE(has(xml, R"(status="approved" distance="-20.5")")) << xml;
  EXPECT_TRUE(has(xml,
                  "<approvedby>N. N.</approvedby><approveddate><date year=\"2026\" month=\"1\" "
                  "day=\"9\" hour=\"0\" minute=\"0\" second=\"0\"/></approveddate>"))
      << xml;
  EXPECT_TRUE(has(xml, "<body>as &lt;agreed&gt; &amp; so</body>")) << xml;
  // It was said to be mended and is still there.
  EXPECT_TRUE(has(xml, R"(status="new" distance="10")")) << xml;
  EXPECT_TRUE(has(xml, "<body>resolved, and back: found again</body>")) << xml;
  EXPECT_TRUE(has(xml, R"(new="2" active="0" reviewed="0" approved="1" resolved="0")")) << xml;
}

TEST(ClashXml, PutsTheResultsOfAGroupIntoIt) {
  const ClashModel m = row_of_boxes();
  const clash::Findings findings = findings_up_to_25_mm(m);
  const Result<clash::Grouping> grouping =
      clash::group_results(findings, m.model, {.by = clash::GroupBy::element});
  ASSERT_TRUE(grouping);
  const std::string xml =
      exchanged(write_clash_xml, {.findings = findings, .model = m.model, .grouping = &*grouping});
  // The contact belongs to no group and comes last.
  ASSERT_EQ(grouping->groups.size(), 2U);
  EXPECT_EQ(count(xml, "<clashgroup "), 2U);
  EXPECT_EQ(count(xml, "</clashresults></clashgroup>"), 2U);
  EXPECT_EQ(count(xml, "<clashresult "), 3U);
  EXPECT_GT(xml.find("<description>Contact"), xml.rfind("</clashgroup>")) << xml;
}

TEST(ClashXml, NamesAreText) {
  ClashModel m = row_of_boxes();
  m.model.objects[0].name =
      std::string("</name>&\"'\x01\xFF\xE2\x80\xAE") + std::string(10000, 'x');
  const clash::Findings findings = findings_up_to_25_mm(m);
  const std::string xml = exchanged(write_clash_xml, {findings, m.model});
  EXPECT_TRUE(has(xml, "&lt;/name&gt;&amp;&quot;&#39;\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBDxxx"));
  EXPECT_EQ(xml.find('\x01'), xml.npos);
}

TEST(ClashXml, ResultsThatARuleAllowsAreLeftOut) {
  const ClashModel m = row_of_boxes();
  clash::Findings findings = findings_up_to_25_mm(m);
  findings.tests[0].pairs[0].allowed = 0;
  findings.tests[0].allowed.push_back({.rule = "r"});
  EXPECT_EQ(count(exchanged(write_clash_xml, {findings, m.model}), "<clashresult "), 2U);
}

TEST(IfcclashJson, HasASetForEachKindOfResult) {
  ClashModel m = row_of_boxes();
  m.model.objects[0].attributes = {{"Class", "IfcWall"}};
  const clash::Findings findings = findings_up_to_25_mm(m);
  const json sets = json::parse(exchanged(write_ifcclash_json, {findings, m.model}));
  ASSERT_EQ(sets.size(), 3U);
  EXPECT_EQ(sets[0]["name"], "Strake");
  EXPECT_EQ(sets[0]["mode"], "intersection");
  EXPECT_EQ(sets[0]["tolerance"], 0.001);
  EXPECT_EQ(sets[0]["a"], json::parse(R"([{"file": "t.obj", "mode": "a"}])"));
  EXPECT_FALSE(sets[0].contains("b"));
  ASSERT_EQ(sets[0]["clashes"].size(), 1U);
  const json hit = sets[0]["clashes"]["a-b"];
  EXPECT_EQ(hit["a_global_id"], "a");
  EXPECT_EQ(hit["a_ifc_class"], "IfcWall");
  EXPECT_EQ(hit["b_ifc_class"], "");
  EXPECT_EQ(hit["b_name"], "b");
  EXPECT_EQ(hit["type"], "protrusion");
  EXPECT_EQ(hit["distance"], 0.0205);
  EXPECT_EQ(hit["p1"].size(), 3U);
  EXPECT_EQ(sets[1]["mode"], "collision");
  EXPECT_EQ(sets[1]["allow_touching"], true);
  EXPECT_EQ(sets[2]["clearance"], 0.025);
  EXPECT_EQ(sets[2]["clashes"]["c-d"]["distance"], 0.01);
  EXPECT_EQ(sets[2]["clashes"]["c-d"]["type"], "clearance");
}

TEST(IfcclashJson, IdsOfSeveralFilesAreDistinguished) {
  ClashModel m = row_of_boxes();
  m.model.files.push_back({"u.obj", "OBJ", "mm", "z", 1, 0});
  m.model.objects[2].file = m.model.objects[3].file = 1;
  m.model.objects[2].id = "a";
  m.model.objects[3].id = "b";
  clash::Findings findings = findings_up_to_25_mm(m);
  findings.tests[0].pairs[2].cls = clash::Class::hit;
  const json clashes =
      json::parse(exchanged(write_ifcclash_json, {findings, m.model}))[0]["clashes"];
  EXPECT_TRUE(clashes.contains("t.obj:a-t.obj:b")) << clashes;
  EXPECT_TRUE(clashes.contains("u.obj:a-u.obj:b")) << clashes;
}

TEST(IfcclashJson, IdsWithHyphensAreDistinguished) {
  ClashModel m = row_of_boxes();
  m.model.objects[0].id = "x-y";
  m.model.objects[1].id = "z";
  m.model.objects[2].id = "x";
  m.model.objects[3].id = "y-z%2D";
  clash::Findings findings = findings_up_to_25_mm(m);
  findings.tests[0].pairs[2].cls = clash::Class::hit;
  const json clashes =
      json::parse(exchanged(write_ifcclash_json, {findings, m.model}))[0]["clashes"];
  EXPECT_TRUE(clashes.contains("x%2Dy-z")) << clashes;
  EXPECT_TRUE(clashes.contains("x-y%2Dz%252D")) << clashes;
}

TEST(IfcclashJson, ATestWithoutHitsIsASetWithoutClashes) {
  const ClashModel m = row_of_boxes();
  clash::Findings findings = findings_up_to_25_mm(m);
  findings.tests[0].pairs.clear();
  const json sets = json::parse(exchanged(write_ifcclash_json, {findings, m.model}));
  ASSERT_EQ(sets.size(), 1U);
  EXPECT_TRUE(sets[0]["clashes"].is_object());
  EXPECT_TRUE(sets[0]["clashes"].empty());
}

TEST(ClashExchange, ACancelledRunIsAnError) {
  const ClashModel m = row_of_boxes();
  const clash::Findings findings = findings_up_to_25_mm(m);
  const std::stop_source stop;
  stop.request_stop();
  const parallel::Context context{.stop = stop.get_token()};
  for (const auto write : {write_clash_xml, write_ifcclash_json}) {
    const Status status = write({findings, m.model}, [](std::string_view) {}, context);
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ErrorCode::cancelled);
  }
}

}  // namespace
}  // namespace strake::report
