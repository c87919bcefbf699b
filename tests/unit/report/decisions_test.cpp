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
#include <tuple>
#include <utility>
#include <vector>

#include "clash/results/clash_key.hpp"
#include "report/text/csv_table.hpp"
#include "strake/clash/group.hpp"
#include "strake/report/clash.hpp"
#include "support/clash_model.hpp"

namespace strake::report {
namespace {

using nlohmann::json;
using test::ClashModel;

/// Three boxes in a row, each 20 mm in the next.
ClashModel three_boxes(double depth_mm = 20) {
  ClashModel m;
  m.box("a", {0, 0, 0}, {100, 100, 100});
  m.box("b", {100 - depth_mm, 0, 0}, {200, 100, 100});
  m.box("c", {180, 0, 0}, {300, 100, 100});
  return m;
}

clash::Findings findings_of(const ClashModel& m) { return {{m.detect()}, {}}; }

std::string key_of(const ClashModel& m, std::uint32_t a, std::uint32_t b) {
  return clash::pair_key("", m.model, model::ObjectId{a}, model::ObjectId{b});
}

DecisionFile parsed(const std::string& text) {
  Result<DecisionFile> file = parse_decisions(text, "d.csv");
  EXPECT_TRUE(file) << file.error().text();
  return std::move(file).value();
}

std::string error_of(const std::string& text) {
  const Result<DecisionFile> file = parse_decisions(text, "d.csv");
  return file ? "no error" : file.error().text();
}

/// A model, what was found in it and what was decided about it.
struct Decided {
  ClashModel m;
  clash::Findings findings;
  DecisionFile file;
  DecidedResults results;

  Decided(ClashModel model, const std::string& csv, const DecisionRules& rules = {})
      : m(std::move(model)),
        findings(findings_of(m)),
        file(csv.empty() ? DecisionFile{"d.csv", {}, {}} : parsed(csv)),
        results(decide(findings, m.model, file, rules).value()) {}
  Decided(const Decided&) = delete;
  Decided& operator=(const Decided&) = delete;

  [[nodiscard]] ClashContents contents() const {
    ClashContents all{findings, m.model};
    all.decided = &results;
    return all;
  }
  [[nodiscard]] std::string updated() const { return update_decisions(contents()).text; }
  [[nodiscard]] std::string table() const { return clash_table(contents(), {}); }
  [[nodiscard]] Reopened reopened(std::size_t pair) const {
    const DecidedResult* const r = results.of(0, findings.tests[0].pairs[pair]);
    return r == nullptr ? Reopened::no : r->reopened;
  }
};

std::string row(const std::string& key, const std::string& rest) { return key + "," + rest + "\n"; }

TEST(CsvTable, GivesBackWhatItReads) {
  for (const std::string_view text : {"a,b\r\n1,\"x \"\"y\"\"\nz\"\r\n",
                                      "\xEF\xBB\xBF"
                                      "a;b;c\n\n;;\n1;2",
                                      "a\tb\rc\td\r", "", "a"}) {
    const Result<CsvTable> table = parse_csv_table(text, "t.csv");
    ASSERT_TRUE(table) << text;
    EXPECT_EQ(csv_text(*table), text);
  }
}

TEST(CsvTable, ReadsWhateverIsLeftOfAFile) {
  const std::string whole = "\xEF\xBB\xBFkey;status;\"x\"\"y\"\r\n1;\"2\n3\";4\r5;;\n";
  std::size_t read = 0;
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    const std::string text = whole.substr(0, length);
    const Result<CsvTable> table = parse_csv_table(text, "t.csv");
    if (!table) continue;
    ++read;
    EXPECT_EQ(csv_text(*table), text);
    (void)parse_decisions(text, "t.csv");
  }
  EXPECT_GT(read, whole.size() / 2);
}

TEST(CsvTable, KnowsTheSeparatorAndTheLines) {
  const CsvTable table = parse_csv_table("key;\"a,b,c\";x\n\"1\n2\";3;4\n5;6;7\n", "t.csv").value();
  EXPECT_EQ(table.separator, ';');
  ASSERT_EQ(table.records.size(), 3U);
  EXPECT_EQ(table.records[1].line, 2U);
  EXPECT_EQ(table.records[2].line, 4U) << "a cell has a line break";
  EXPECT_EQ(cell_text(table.records[0].cells[1]), "a,b,c");
  EXPECT_EQ(cell_text("\"say \"\"no\"\"\""), "say \"no\"");
}

TEST(CsvTable, RefusesWhatIsNoCsv) {
  const auto error = [](std::string_view text) {
    const Result<CsvTable> table = parse_csv_table(text, "t.csv");
    return table ? "no error" : table.error().text();
  };
  EXPECT_EQ(
      error("a,b\n1,\"2\n"),
      "t.csv, line 2: a quote is not closed (end the cell with a quote; one within it is written "
      "twice)");
  EXPECT_EQ(
      error("a,b\n1,2\n\"3\"4,5\n"),
      "t.csv, line 3: there is text behind a quoted cell (write a quote within a cell twice)");
  EXPECT_EQ(error("a\nM\xFCller\n"),
            "t.csv, line 2: is not UTF-8 (save it in the spreadsheet as 'CSV UTF-8')");
}

TEST(Decisions, AreReadInAnyFormThatASpreadsheetWrites) {
  const std::string key(26, '0');
  for (const std::string& text :
       {"key,status,by,date,comment,d_mm\r\n" + key + ",Approved,Ann,2026-01-31,\"a, b\",-5.5\r\n",
        "\xEF\xBB\xBFKEY;Date;Status;Owner;By;Comment;d_mm\n" + key +
            ";31.1.2026;APPROVED;x;Ann;a, b;-5,5\n;;;;;;\n",
        "comment\tkey\tstatus\tby\tdate\td_mm\na, b\t" + key +
            "\tapproved\tAnn\t31.01.2026\t-5.5"}) {
    const DecisionFile file = parsed(text);
    ASSERT_EQ(file.decisions.size(), 1U) << text;
    const Decision& d = file.decisions[0];
    EXPECT_EQ(d.status, DecisionStatus::approved);
    EXPECT_EQ(d.by + "|" + d.date + "|" + d.comment, "Ann|2026-01-31|a, b");
    EXPECT_EQ(d.d_mm, -5.5);
    EXPECT_EQ(d.line, 2U);
  }
}

TEST(Decisions, TellWhereAFileIsWrong) {
  const std::string key(26, '0'), head = "key,status,date,d_mm\n";
  EXPECT_TRUE(
      error_of("key,state\n")
          .starts_with(
              "d.csv, line 1: has no column 'status' but 'key', 'state' (write the headings"));
  EXPECT_TRUE(error_of("").starts_with("d.csv, line 1: is empty ("));
  EXPECT_TRUE(
      error_of("key,status,Key\n").starts_with("d.csv, line 1: has the column 'key' twice ("));
  EXPECT_EQ(error_of(head + "x,new,,\n"),
            "d.csv, line 2: 'x' is no key (a key is the 26 letters and digits that results have as "
            "'key')");
  EXPECT_EQ(error_of(head + ",approved,,\n").substr(0, 27), "d.csv, line 2: '' is no key");
  EXPECT_EQ(
      error_of(head + key + ",done,,\n"),
      "d.csv, line 2: 'done' is no status (write new, active, reviewed, approved or resolved)");
  for (const char* const date : {"2026-02-30", "1/2/2026", "yesterday", "31.13.2026", "2026-1"})
    EXPECT_EQ(
        error_of(head + key + ",new," + date + ",\n"),
        "d.csv, line 2: '" + std::string(date) + "' is no date (write 2026-01-31, or 31.1.2026)");
  EXPECT_EQ(error_of(head + key + ",new,,\n\n" + key + ",new,,\n"),
            "d.csv, line 4: the key stands in line 2 already (keep one of the two rows)");
  EXPECT_EQ(error_of(head + key + ",new,,deep\n").substr(0, 34),
            "d.csv, line 2: 'deep' is no number");
  EXPECT_EQ(error_of(head + key + ",new,,1,and more\n").substr(0, 67),
            "d.csv, line 2: the row has more cells than there are headings (put ");
}

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
  const Decided d(three_boxes(30), head + row(key, "approved,-20,1"));
  EXPECT_NE(d.table().find("HIT    deeper  -30.000"), std::string::npos) << d.table();
  EXPECT_NE(d.table().find("; approved, but deeper or nearer than they were: 1\n"),
            std::string::npos);
  EXPECT_NE(d.table().find("2 hits, "), std::string::npos);
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

TEST(Decisions, AreThoseOfThePlaceWhereIdsArePositions) {
  ClashModel m = three_boxes();
  for (model::Object& object : m.model.objects) object.positional_id = true;
  const std::string key = key_of(m, 0, 1), head = "key,status,d_mm,x_mm,y_mm,z_mm\n";
  const clash::Pair pair = findings_of(m).tests[0].pairs[0];
  const std::string x = std::to_string(pair.point_mm.x), y = std::to_string(pair.point_mm.y),
                    z = std::to_string(pair.point_mm.z);
  const Decided same(m, head + row(key, "approved,-20," + x + "," + y + "," + z));
  EXPECT_TRUE(same.results.is_settled(0, pair));
  for (const std::string& other :
       {"approved,-20,1" + x + "," + y + "," + z, "approved,-21," + x + "," + y + "," + z,
        std::string("approved,-20,,,"), std::string("approved,,,,")}) {
    const Decided d(m, head + row(key, other));
    EXPECT_EQ(d.results.of(0, pair), nullptr) << other;
    EXPECT_EQ(d.results.not_found.size(), 1U);
    EXPECT_EQ(parsed(d.updated()).decisions.size(), 2U)
        << "the key is that of another clash: it is not written twice";
  }
}

/// A beam with pipes across it, whose ids are their positions in the file, as of nodes of one name.
ClashModel pipes(const std::vector<double>& at_mm) {
  ClashModel m;
  m.box("beam", {0, 0, 0}, {5000, 100, 100});
  for (std::size_t i = 0; i < at_mm.size(); ++i) {
    m.box(i == 0 ? "pipe" : "pipe#" + std::to_string(i + 1), {at_mm[i], 80, 30},
          {at_mm[i] + 100, 400, 70});
    m.model.objects.back().name = "pipe";
    m.model.objects.back().positional_id = true;
  }
  return m;
}

/// Returns the text of a decision file with another word in one of its rows, counted from 1 on.
std::string with(const std::string& text, std::size_t row, std::string_view was,
                 std::string_view is) {
  std::size_t begin = 0;
  for (std::size_t r = 0; r < row; ++r) begin = text.find('\n', begin) + 1;
  std::string changed = text;
  return changed.replace(changed.find(was, begin), was.size(), is);
}

/// Returns the decision file of pipes at 200, 500 and 800 mm, with the first two approved.
std::string decided_pipes() {
  const std::string text = Decided(pipes({200, 500, 800}), "").updated();
  return with(with(text, 1, ",new,", ",approved,"), 2, ",new,", ",approved,");
}

std::array<std::uint64_t, 2> new_and_approved(const Decided& d) {
  const auto& counts = d.results.counts;
  return {counts[0], counts[static_cast<std::size_t>(DecisionStatus::approved)]};
}

using NewAndApproved = std::array<std::uint64_t, 2>;

TEST(Decisions, StayWithTheirPlacesWhereAnObjectComesBeforeThem) {
  const Decided d(pipes({3000, 200, 500, 800}), decided_pipes());
  EXPECT_EQ(new_and_approved(d), (NewAndApproved{2, 2}));
  EXPECT_TRUE(d.results.not_found.empty());
  const UpdatedDecisions updated = update_decisions(d.contents());
  EXPECT_EQ(std::tuple(updated.added, updated.taken_out, updated.without_row), std::tuple(1, 0, 0));
  const Decided next(pipes({3000, 200, 500, 800}), updated.text);
  EXPECT_EQ(next.file.decisions.size(), 4U);
  for (const Decision& row : next.file.decisions) {
    const std::string id = row.a.id == "beam" ? row.b.id : row.a.id;
    EXPECT_EQ(row.key, clash::pair_hash("", {"t.obj", "beam"}, {"t.obj", id})) << updated.text;
  }
  EXPECT_EQ(new_and_approved(next), (NewAndApproved{2, 2}));
  EXPECT_EQ(next.updated(), updated.text);
}

TEST(Decisions, StayWithTheirPlacesWhereAnObjectBeforeThemIsGone) {
  const Decided d(pipes({500, 800, 1100}), decided_pipes());
  EXPECT_EQ(new_and_approved(d), (NewAndApproved{2, 1}));
  ASSERT_EQ(d.results.not_found.size(), 1U);
  EXPECT_EQ(d.results.not_found[0], &d.file.decisions[0]);
  const UpdatedDecisions updated = update_decisions(d.contents());
  const Decided next(pipes({500, 800, 1100}), updated.text);
  EXPECT_EQ(new_and_approved(next), (NewAndApproved{2, 1}))
      << "the row of what is gone keeps its key";
  EXPECT_EQ(next.updated(), updated.text);
}

TEST(UpdatedDecisions, TellWhichResultsHaveNoRowAsTheirKeysAreTaken) {
  const std::string text = decided_pipes();
  const UpdatedDecisions updated =
      update_decisions(Decided(pipes({1000, 1300, 1600}), text).contents());
  EXPECT_EQ(std::tuple(updated.added, updated.without_row), std::tuple(0, 2));
  const DecisionFile file = parsed(updated.text);
  ASSERT_EQ(file.decisions.size(), 3U);
  EXPECT_EQ(file.decisions[0].status, DecisionStatus::approved);
  EXPECT_EQ(file.decisions[2].point_mm->x, 1650) << "nobody had written into it";
}

TEST(Decisions, RecoverFromARunThatAddedRowsForOtherPlaces) {
  // A `new` row has the key that the decision about the place at 500 mm has to get.
  const Decided first(pipes({3000, 200, 500}), "");
  const std::string text = decided_pipes();
  std::string third = first.updated();
  third = third.substr(third.rfind('\n', third.size() - 2) + 1);
  const std::string both = text.substr(0, text.rfind('\n', text.size() - 2) + 1) + third;
  ASSERT_EQ(parsed(both).decisions.size(), 3U);
  const Decided d(pipes({3000, 200, 500}), both);
  EXPECT_EQ(new_and_approved(d), (NewAndApproved{1, 2}));
  EXPECT_TRUE(d.results.not_found.empty());
  const UpdatedDecisions updated = update_decisions(d.contents());
  EXPECT_EQ(std::tuple(updated.added, updated.taken_out, updated.without_row), std::tuple(1, 1, 0));
  EXPECT_EQ(new_and_approved(Decided(pipes({3000, 200, 500}), updated.text)),
            (NewAndApproved{1, 2}));
}

TEST(Decisions, WithoutADepthGoByThePointWhereIdsArePositions) {
  const std::string text = with(with(decided_pipes(), 1, ",-20,", ",,"), 1, ",1,,", ",,,");
  for (const std::vector<double>& at :
       {std::vector<double>{200, 500, 800}, {3000, 200, 500, 800}}) {
    const Decided d(pipes(at), text);
    EXPECT_EQ(new_and_approved(d)[1], 2U) << at.size();
    EXPECT_EQ(parsed(d.updated()).decisions[0].d_mm, -20) << "from now on it is known";
  }
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

/// The same model in a file of another name.
ClashModel renamed(const std::string& label) {
  ClashModel m = three_boxes();
  m.model.files[0].label = label;
  return m;
}

TEST(Decisions, FollowAFileThatWasRenamed) {
  const Decided first(three_boxes(), "");
  std::string text = first.updated();
  text.replace(text.find(",new,"), 5, ",approved,");
  const Decided second(renamed("t_revB.obj"), text);
  EXPECT_EQ(second.results.counts, (std::array<std::uint64_t, 5>{1, 0, 0, 1, 0}));
  EXPECT_TRUE(second.results.not_found.empty());
  EXPECT_EQ(second.results.files.matches.at(0).before, "t.obj");
  const std::string updated = second.updated();
  EXPECT_EQ(updated.find("t.obj"), std::string::npos) << updated;
  const Decided third(renamed("t_revB.obj"), updated);
  EXPECT_EQ(third.results.counts, second.results.counts);
  EXPECT_TRUE(third.results.files.by_label_alone());
}

TEST(Decisions, FollowAFileThatSomebodySaysWasRenamed) {
  const std::string key = key_of(three_boxes(), 0, 1), csv = "key,status\n" + row(key, "approved");
  EXPECT_EQ(Decided(renamed("n.obj"), csv).results.not_found.size(), 1U);
  const std::vector<std::string> pairs{"t.obj=n.obj"};
  const Decided d(renamed("n.obj"), csv, {.match_files = pairs});
  EXPECT_EQ(d.results.counts[static_cast<std::size_t>(DecisionStatus::approved)], 1U);
  EXPECT_EQ(parsed(d.updated()).decisions[0].key,
            clash::parse_key(key_of(renamed("n.obj"), 0, 1)).value());
}

TEST(Decisions, OfTheNewNameGoBeforeThoseOfTheOldOne) {
  const std::string was = key_of(three_boxes(), 0, 1), is = key_of(renamed("n.obj"), 0, 1);
  const std::vector<std::string> pairs{"t.obj=n.obj"};
  for (const auto& [old_status, new_status, taken, rows] :
       {std::tuple("approved", "new", DecisionStatus::approved, 2U),
        std::tuple("approved", "active", DecisionStatus::active, 3U)}) {
    const Decided d(renamed("n.obj"), "key,status\n" + row(was, old_status) + row(is, new_status),
                    {.match_files = pairs});
    EXPECT_EQ(d.results.counts[static_cast<std::size_t>(taken)], 1U) << new_status;
    EXPECT_EQ(parsed(d.updated()).decisions.size(), rows) << "no key stands there twice";
  }
}

TEST(UpdatedDecisions, AreMendedAfterANightInWhichNobodyKnewOfTheNewName) {
  const std::string was = key_of(three_boxes(), 0, 1);
  const Decided night(renamed("n.obj"), "key,status\n" + row(was, "approved"));
  const std::string text = night.updated();
  ASSERT_EQ(parsed(text).decisions.size(), 3U) << "the decision, and two new ones";
  const std::vector<std::string> pairs{"t.obj=n.obj"};
  const Decided d(renamed("n.obj"), text, {.match_files = pairs});
  EXPECT_EQ(new_and_approved(d), (NewAndApproved{1, 1}));
  EXPECT_TRUE(d.results.not_found.empty()) << "the new row is that of a clash that is found";
  const UpdatedDecisions updated = update_decisions(d.contents());
  EXPECT_EQ(std::tuple(updated.added, updated.taken_out), std::tuple(0, 1));
  const Decided next(renamed("n.obj"), updated.text);
  EXPECT_EQ(new_and_approved(next), (NewAndApproved{1, 1}));
  EXPECT_TRUE(next.results.not_found.empty());
}

TEST(Decisions, TakeTheSameCommandTheNextNight) {
  const std::vector<std::string> pairs{"t.obj=n.obj"};
  std::string text = Decided(three_boxes(), "").updated();
  text.replace(text.find(",new,"), 5, ",approved,");
  const Decided first(renamed("n.obj"), text, {.match_files = pairs});
  EXPECT_TRUE(first.results.renamed_before.empty());
  const Decided second(renamed("n.obj"), first.updated(), {.match_files = pairs});
  EXPECT_EQ(second.results.renamed_before, pairs);
  EXPECT_EQ(new_and_approved(second), (NewAndApproved{1, 1}));
}

TEST(Decisions, FollowAFileOfWhichTheyNameAFewObjects) {
  ClashModel m;
  for (int i = 0; i < 12; ++i)
    m.box("b" + std::to_string(i), {80.0 * i, 0, 0}, {80.0 * i + 100, 100, 100});
  const std::string text = Decided(m, "").updated();
  // Two rows, of three objects; the second row says no more than its key.
  std::string few = text.substr(0, text.find('\n', text.find('\n', text.find('\n') + 1) + 1) + 1);
  const std::string last = key_of(m, 10, 11);
  few = with(few, 1, ",new,", ",approved,") + last + ",approved\r\n";
  m.model.files[0].label = "n.obj";
  const Decided d(m, few);
  ASSERT_EQ(d.results.files.matches.size(), 1U);
  EXPECT_EQ(d.results.files.matches[0].relation, FileRelation::renamed);
  EXPECT_EQ(new_and_approved(d)[1], 2U);
}

}  // namespace
}  // namespace strake::report
