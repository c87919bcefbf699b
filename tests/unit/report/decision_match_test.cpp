// SPDX-License-Identifier: Apache-2.0
// Which decision is about which result where ids or files have other names.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "report/decisions/row_keys.hpp"
#include "support/decided.hpp"

namespace strake::report {
namespace {

using test::ClashModel;
using test::Decided;
using test::findings_of;
using test::key_of;
using test::parsed;
using test::row;
using test::three_boxes;

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

TEST(UpdatedDecisions, ReportWhichResultsHaveNoRowAsTheirKeysAreTaken) {
  const std::string text = decided_pipes();
  const UpdatedDecisions updated =
      update_decisions(Decided(pipes({1000, 1300, 1600}), text).contents());
  EXPECT_EQ(std::tuple(updated.added, updated.without_row), std::tuple(0, 2));
  const DecisionFile file = parsed(updated.text);
  ASSERT_EQ(file.decisions.size(), 3U);
  EXPECT_EQ(file.decisions[0].status, DecisionStatus::approved);
  EXPECT_NEAR(file.decisions[2].point_mm->x, 1650, 0.01) << "nobody had written into it";
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

TEST(Decisions, FollowAFileThatSomebodyStatesWasRenamed) {
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

TEST(RowKeys, AreThoseThatRowsWantUnlessOneStays) {
  std::vector<Decision> rows(4);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].key = {0, i};
    rows[i].status = DecisionStatus::approved;
  }
  const auto keys_of =
      [&](const std::vector<std::tuple<std::size_t, std::uint64_t, bool>>& wanted) {
        std::vector<WantedKey> all;
        for (const auto& [r, key, found] : wanted) all.push_back({&rows[r], {0, key}, found});
        const RowKeys assigned = assign_keys(all);
        std::vector<std::uint64_t> keys;
        for (const auto& [row, key] : assigned.keys) keys.push_back(key.low);
        EXPECT_EQ(assigned.held.size(), keys.size()) << "a key stands in a file once";
        return keys;  // in the order of the rows, which lie one behind the other
      };
  using Keys = std::vector<std::uint64_t>;
  EXPECT_EQ(keys_of({{0, 1, true}, {1, 0, true}}), (Keys{1, 0})) << "two change places";
  EXPECT_EQ(keys_of({{0, 1, true}, {1, 2, true}, {2, 3, true}}), (Keys{1, 2, 3}));
  EXPECT_EQ(keys_of({{0, 0, false}, {1, 0, true}, {2, 1, true}}), (Keys{0, 1, 2}))
      << "who wants the key of one that stays has to stay";
  EXPECT_EQ(keys_of({{0, 9, false}, {1, 9, true}}), (Keys{0, 9})) << "what is found goes first";
  rows[3].status = DecisionStatus::undecided;
  EXPECT_EQ(keys_of({{0, 3, true}, {3, 3, false}}), (Keys{3})) << "nobody has written into it";
  rows[3].comment = "ask Ann";
  EXPECT_EQ(keys_of({{0, 3, true}, {3, 3, false}}), (Keys{0, 3}));
}

TEST(Decisions, WithACommentAreNotTakenForAnotherPlace) {
  const std::string text = decided_pipes();
  const std::string noted = with(text, 3, ",new,,,,", ",new,,,ask Ann,");
  const Decided d(pipes({1000, 1300, 1600}), noted);
  EXPECT_EQ(d.results.not_found.size(), 3U);
  EXPECT_EQ(d.updated(), noted);
  const Decided moved(pipes({3000, 200, 500, 800}), noted);
  EXPECT_TRUE(moved.results.not_found.empty());
}

}  // namespace
}  // namespace strake::report
