// SPDX-License-Identifier: Apache-2.0
#include "project/snapshot/stored_snapshot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <ranges>
#include <span>
#include <string>
#include <vector>

#include "project/codec/blob.hpp"
#include "project/database/result_tables.hpp"
#include "project/database/snapshot_tables.hpp"
#include "strake/parallel/team.hpp"

namespace strake::project {
namespace {

/// A test in a database, with room for a snapshot.
class StoredSnapshotTest : public ::testing::Test {
 protected:
  void SetUp() override {
    database_ = std::move(Database::in_memory()).value();
    ASSERT_TRUE(database_->execute(kResultTables));
    ASSERT_TRUE(database_->execute(kSnapshotTables));
    ASSERT_TRUE(
        database_->execute("INSERT INTO run VALUES (1, '', '', '', 0);"
                           "INSERT INTO test VALUES (5, '', '', 1, 0);"
                           "INSERT INTO report VALUES (5, x'', x'', x'', x'')"));
  }

  static Snapshot of(std::size_t objects) {
    Snapshot made{{1, 2}, {}, {}, {3, 4}, {5, 6}};
    for (std::uint64_t o = 0; o < objects; ++o) {
      made.identities.push_back(o * 7919);
      made.signatures.push_back({o, ~o});
    }
    return made;
  }
  Result<StoredSnapshot> read() {
    Statement select = database_->prepare("SELECT snapshot FROM report WHERE test = 5").value();
    EXPECT_TRUE(select.step().value());
    const std::span<const std::byte> bytes = select.bytes(0);
    const std::vector<std::byte> head(bytes.begin(), bytes.end());
    return read_snapshot(*database_, 5, head, "the result", context_);
  }
  /// The parts that are stored, by the numbers of the rows that hold them.
  std::vector<std::int64_t> rows() {
    Statement select = database_->prepare("SELECT rowid FROM snapshot_part ORDER BY part").value();
    std::vector<std::int64_t> found;
    while (select.step().value()) found.push_back(select.integer(0));
    return found;
  }

  std::unique_ptr<Database> database_;
  parallel::Team team_{3};
  parallel::Context context_{.team = &team_};
};

TEST_F(StoredSnapshotTest, ComesBackAsItWas) {
  for (const std::size_t objects : {0U, 1U, 4096U, 4097U, 10'000U}) {
    const Snapshot snapshot = of(objects);
    ASSERT_TRUE(write_snapshot(*database_, 5, snapshot, {}, {}, context_));
    const StoredSnapshot stored = read().value();
    EXPECT_EQ(stored.test, 5);
    EXPECT_TRUE(stored.snapshot == snapshot) << objects;
    EXPECT_EQ(stored.snapshot.names, snapshot.names);
    EXPECT_EQ(stored.snapshot.source, snapshot.source);
    EXPECT_EQ(stored.parts.size(), rows().size());
  }
}

TEST_F(StoredSnapshotTest, ElementsComeBackWithIt) {
  const Snapshot snapshot = of(9'000);
  std::vector<std::uint64_t> elements(snapshot.identities.size());
  const std::ranges::iota_view numbers(std::uint64_t{5}, std::uint64_t{5 + elements.size()});
  std::ranges::copy(numbers, elements.begin());
  ASSERT_TRUE(write_snapshot(*database_, 5, snapshot, elements, {}, context_));
  const StoredSnapshot stored = read().value();
  EXPECT_EQ(stored.elements, elements);
  // Another element is another part.
  const std::vector<std::int64_t> before = rows();
  elements[4'500] = 1;
  ASSERT_TRUE(
      write_snapshot(*database_, 5, snapshot, elements, {.hashes = stored.parts}, context_));
  EXPECT_EQ(read().value().elements, elements);
  EXPECT_EQ(rows()[0], before[0]);
  EXPECT_NE(rows()[1], before[1]);
}

TEST_F(StoredSnapshotTest, OnlyPartsThatChangedAreWritten) {
  Snapshot snapshot = of(20'000);
  ASSERT_TRUE(write_snapshot(*database_, 5, snapshot, {}, {}, context_));
  const std::vector<std::int64_t> before = rows();
  ASSERT_EQ(before.size(), 5U);
  const std::vector<Hash128> parts = read().value().parts;
  snapshot.signatures[9'000] = {77, 77};
  snapshot.whole = {8, 8};
  ASSERT_TRUE(write_snapshot(*database_, 5, snapshot, {}, {.hashes = parts}, context_));
  const std::vector<std::int64_t> after = rows();
  for (std::size_t k = 0; k < before.size(); ++k) EXPECT_EQ(after[k] != before[k], k == 2) << k;
  EXPECT_TRUE(read().value().snapshot == snapshot);
  // Fewer objects: what is left over goes.
  const Snapshot few = of(5'000);
  const std::vector<Hash128> parts_of_few = read().value().parts;
  ASSERT_TRUE(write_snapshot(*database_, 5, few, {}, {.hashes = parts_of_few}, context_));
  EXPECT_EQ(rows().size(), 2U);
  EXPECT_TRUE(read().value().snapshot == few);
}

TEST_F(StoredSnapshotTest, PartsThatStandAreNotHashed) {
  const Snapshot snapshot = of(10'000);
  ASSERT_TRUE(write_snapshot(*database_, 5, snapshot, {}, {}, context_));
  const std::vector<Hash128> parts = read().value().parts;
  const std::vector<std::int64_t> before = rows();
  // The first would be written if it were hashed; the second is, though it stands elsewhere.
  Snapshot now = snapshot;
  now.signatures[10] = now.signatures[5'000] = {1, 1};
  ASSERT_TRUE(write_snapshot(*database_, 5, now, {},
                             {.hashes = parts, .stand = {true, false, true}}, context_));
  const std::vector<std::int64_t> after = rows();
  EXPECT_EQ(after[0], before[0]);
  EXPECT_NE(after[1], before[1]);
  EXPECT_EQ(after[2], before[2]);
  // One that is not stored is written, whatever is said of it.
  ASSERT_TRUE(database_->execute("DELETE FROM snapshot_part"));
  ASSERT_TRUE(write_snapshot(*database_, 5, snapshot, {},
                             {.hashes = {}, .stand = {true, true, true}}, context_));
  EXPECT_TRUE(read().value().snapshot == snapshot);
}

TEST_F(StoredSnapshotTest, OneOfVersion2IsReadOutOfItsRow) {
  const Snapshot snapshot = of(10'000);
  BlobWriter out;
  write(out, snapshot);
  const std::vector<std::byte> bytes = out.finish().value();
  Statement update = database_->prepare("UPDATE report SET snapshot = ?1").value();
  ASSERT_TRUE(update.bind(1, std::span<const std::byte>(bytes)).run());
  const StoredSnapshot stored = read().value();
  EXPECT_TRUE(stored.snapshot == snapshot);
  EXPECT_EQ(stored.snapshot.names, Hash128());
  EXPECT_EQ(stored.snapshot.source, Hash128());
  EXPECT_TRUE(stored.parts.empty());
}

TEST_F(StoredSnapshotTest, DamageIsAnError) {
  const auto damaged = [&](const std::string& how) {
    EXPECT_TRUE(write_snapshot(*database_, 5, of(10'000), {}, {}, context_));
    EXPECT_TRUE(read());
    EXPECT_TRUE(database_->execute(how)) << how;
    const Result<StoredSnapshot> found = read();
    ASSERT_FALSE(found) << how;
    EXPECT_EQ(found.error().code, ErrorCode::input) << how;
  };
  damaged("DELETE FROM snapshot_part WHERE part = 1");
  damaged("DELETE FROM snapshot_part WHERE part = 2");
  damaged("DELETE FROM snapshot_part");
  damaged("UPDATE snapshot_part SET data = x'00' WHERE part = 0");
  damaged("UPDATE snapshot_part SET data = (SELECT data FROM snapshot_part WHERE part = 0)");
  damaged("UPDATE snapshot_part SET part = 9 WHERE part = 2");
  damaged("INSERT INTO snapshot_part SELECT test, 3, data FROM snapshot_part WHERE part = 2");
  damaged("UPDATE report SET snapshot = x''");
}

}  // namespace
}  // namespace strake::project
