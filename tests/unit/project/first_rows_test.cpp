// SPDX-License-Identifier: Apache-2.0
// The rows of a test's first run, beside those that come one by one.
#include "project/new_rows/first_rows.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "clash/results/clash_key.hpp"
#include "project/database/exchange_tables.hpp"
#include "project/database/history_tables.hpp"
#include "project/database/result_tables.hpp"
#include "project/results/clash_rows.hpp"
#include "support/clash_model.hpp"

namespace strake::project {
namespace {

using test::ClashModel;

/// Boxes of 100 mm, each 20 mm in the next.
ClashModel beams(int count) {
  ClashModel m;
  for (int i = 0; i < count; ++i)
    m.box("c" + std::to_string(i), {80.0 * i, 0, 0}, {80.0 * i + 100, 100, 100});
  return m;
}

class FirstRows : public ::testing::Test {
 protected:
  void SetUp() override {
    database_ = std::move(Database::in_memory()).value();
    ASSERT_TRUE(database_->execute(kResultTables));
    ASSERT_TRUE(database_->execute(kHistoryTables));
    ASSERT_TRUE(database_->execute(kExchangeTables));
    ASSERT_TRUE(
        database_->execute("INSERT INTO run VALUES (1, '', '', '', 1);"
                           "INSERT INTO test VALUES (3, '', '', 1, 2), (4, 'other', '', 1, 2)"));
  }

  /// What add_first_rows() makes of a model; `rows_` is the row of each result then.
  bool add(const ClashModel& m, bool some_allowed = false) {
    report_ = m.detect();
    std::vector<Hash128> keys;
    for (clash::Pair& pair : report_.pairs) {
      if (some_allowed && keys.size() % 5 == 2) pair.allowed = 0;
      keys.push_back(clash::pair_hash("", m.model, pair.a, pair.b));
    }
    rows_.assign(keys.size(), 0);
    const Result<bool> done = add_first_rows(*database_, {3, 1, m.model, report_, keys}, rows_);
    EXPECT_TRUE(done) << done.error().text();
    EXPECT_EQ(one("SELECT sql FROM sqlite_schema WHERE name = 'clash_key'"), kMakeKeyIndex);
    EXPECT_EQ(one("PRAGMA integrity_check"), "ok");
    return *done;
  }

  /// The same rows one by one.
  void add_one_by_one(const ClashModel& m) {
    ClashRows rows = std::move(ClashRows::of(*database_)).value();
    const auto side = [&](model::ObjectId id) {
      const model::Object& object = m.model.object(id);
      return NewClash::Side{m.model.files[0].label, object.id, object.name};
    };
    for (const clash::Pair& p : report_.pairs) {
      if (p.allowed >= 0) continue;
      const std::string key = clash::pair_key("", m.model, p.a, p.b);
      EXPECT_TRUE(rows.insert({3,
                               1,
                               key,
                               side(p.a),
                               side(p.b),
                               {p.cls, p.d_mm, p.regions},
                               p.relation,
                               p.point_mm})
                      .value());
    }
  }

  /// Adds rows of another test.
  void add_others(int count) {
    EXPECT_TRUE(database_->execute(
        "WITH RECURSIVE n(i) AS (VALUES (1) UNION ALL SELECT i + 1 FROM n WHERE i < " +
        std::to_string(count) +
        ") INSERT INTO clash (key, test, a_file, a_id, a_name, b_file, b_id, b_name, class, "
        "relation, d_mm, x_mm, y_mm, z_mm, regions, first_run, new_run) SELECT 'k' || i, 4, '', "
        "'', '', '', '', '', 'HIT', 'CROSS', -1, 0, 0, 0, 1, 1, 1 FROM n"));
  }

  std::string one(const char* sql) {
    Statement select = std::move(database_->prepare(sql)).value();
    EXPECT_TRUE(select.step().value());
    return std::string(select.text(0));
  }
  std::string count() { return one("SELECT count(*) FROM clash"); }

  std::unique_ptr<Database> database_;
  clash::Report report_;
  std::vector<std::int64_t> rows_;
};

TEST_F(FirstRows, are_those_that_come_one_by_one) {
  // Two statements of many rows and one of what is left; none; less than one statement has.
  for (const int objects : {48, 1, 3}) {
    SetUp();
    const ClashModel m = beams(objects);
    ASSERT_TRUE(add(m, true));
    std::int64_t last = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i)
      EXPECT_EQ(rows_[i], report_.pairs[i].allowed < 0 ? ++last : 0);
    const char* const all =
        "SELECT "
        "json_group_array(json_array(id,test,key,a_file,a_id,a_name,b_file,b_id,b_name,class,"
        "relation,d_mm,x_mm,y_mm,z_mm,regions,first_run,new_run,gone_run,unknown,decision)) FROM "
        "(SELECT * FROM clash ORDER BY id)";
    const std::string at_once = one(all);
    SetUp();
    add_one_by_one(m);
    EXPECT_EQ(one(all), at_once);
  }
}

TEST_F(FirstRows, follow_those_of_other_tests_unless_these_are_more) {
  add_others(10);
  EXPECT_TRUE(add(beams(11)));
  EXPECT_EQ(rows_.front(), 11);
  EXPECT_EQ(count(), "20");
  SetUp();
  add_others(11);
  EXPECT_FALSE(add(beams(11)));
  EXPECT_EQ(count(), "11");
}

TEST_F(FirstRows, of_one_key_come_one_by_one) {
  // Bytes that are no UTF-8 are shown as another character: the two ids are one in files.
  ClashModel m;
  m.box("beam", {0, 0, 0}, {1000, 100, 100});
  m.box("c\xfe", {0, 50, 0}, {100, 200, 100});
  m.box("c\xff", {500, 50, 0}, {600, 200, 100});
  EXPECT_FALSE(add(m));
  EXPECT_EQ(report_.pairs.size(), 2U);
  EXPECT_EQ(count(), "0");
  // Likewise where a row has the key, of a test that somebody gave another name.
  EXPECT_TRUE(add(beams(3)));
  ASSERT_TRUE(database_->execute("UPDATE clash SET test = 4"));
  EXPECT_FALSE(add(beams(3)));
  EXPECT_EQ(count(), "2");
}

}  // namespace
}  // namespace strake::project
