// SPDX-License-Identifier: Apache-2.0
#include "project/database/database.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "project/database/result_tables.hpp"
#include "project/database/schema.hpp"
#include "strake/project/check.hpp"
#include "strake/project/project.hpp"
#include "support/io_files.hpp"
#include "support/stored_models.hpp"

namespace strake::project {
namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void expect_error(const auto& result, ErrorCode code, std::string_view text) {
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, code) << result.error().text();
  EXPECT_NE(result.error().text().find(text), std::string::npos) << result.error().text();
}

class ProjectFileTest : public ::testing::Test {
 protected:
  /// Makes an empty project and closes it.
  [[nodiscard]] fs::path make() const {
    EXPECT_TRUE(Project::create(file_));
    return file_;
  }
  /// Writes SQL into the file as another program would.
  void edit(const char* sql) const {
    auto project = Project::open(file_, {.access = Access::write});
    ASSERT_TRUE(project) << project.error().text();
    const Status done = project->database().execute(sql);
    ASSERT_TRUE(done) << done.error().text();
  }

  test::TemporaryFolder folder_;
  fs::path file_ = folder_.path() / "ship.strake";
};

TEST_F(ProjectFileTest, ANewProjectIsOneFileAndKnown) {
  static_cast<void>(make());
  EXPECT_TRUE(is_project(file_));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 1);
  auto project = Project::open(file_, {});
  ASSERT_TRUE(project) << project.error().text();
  EXPECT_EQ(project->path(), file_);
  const auto files = project->files();
  ASSERT_TRUE(files);
  EXPECT_TRUE(files->empty());
  const auto model = project->model({});
  ASSERT_TRUE(model) << model.error().text();
  EXPECT_TRUE(model->objects.empty());
}

TEST_F(ProjectFileTest, AFileThatExistsIsLeftAlone) {
  static_cast<void>(folder_.write("ship.strake", "something of mine"));
  expect_error(Project::create(file_), ErrorCode::output, "exists already");
  EXPECT_EQ(contents(file_), "something of mine");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 1);
}

TEST_F(ProjectFileTest, NoFolderNoProject) {
  expect_error(Project::create(folder_.path() / "none" / "ship.strake"), ErrorCode::output,
               "cannot be written");
}

TEST_F(ProjectFileTest, WhatIsNoProjectIsReported) {
  expect_error(Project::open(file_, {}), ErrorCode::input, "cannot be read");
  expect_error(Project::open(folder_.path(), {}), ErrorCode::input, "cannot be read");
  const fs::path text = folder_.write("a.txt", "solid\n");
  EXPECT_FALSE(is_project(text));
  expect_error(Project::open(text, {}), ErrorCode::input, "is no project");
  static_cast<void>(make());
  std::string bytes = contents(file_);
  bytes[68] = 'X';
  expect_error(Project::open(folder_.write("other.db", bytes), {}), ErrorCode::input,
               "another program");
}

TEST_F(ProjectFileTest, ANewerProjectIsRefused) {
  static_cast<void>(make());
  edit("PRAGMA user_version = 99");
  for (const Access access : {Access::read, Access::write})
    expect_error(Project::open(file_, {.access = access}), ErrorCode::input, "newer Strake");
}

TEST_F(ProjectFileTest, AVersionThatNeverWasIsDamage) {
  static_cast<void>(make());
  edit("PRAGMA user_version = 0");
  expect_error(Project::open(file_, {}), ErrorCode::input, "no version 0");
}

TEST_F(ProjectFileTest, OtherTablesAreRefused) {
  for (const char* sql : {"CREATE TABLE other (a)", "CREATE VIEW other AS SELECT * FROM file",
                          "CREATE TRIGGER other AFTER INSERT ON file BEGIN DELETE FROM file; END",
                          "CREATE INDEX other ON file (bytes)", "DROP TABLE model_seal",
                          "ALTER TABLE file ADD COLUMN other TEXT"}) {
    SCOPED_TRACE(sql);
    static_cast<void>(make());
    edit(sql);
    expect_error(Project::open(file_, {}), ErrorCode::input, "damaged");
    fs::remove(file_);
  }
  static_cast<void>(make());
  edit("ANALYZE");
  EXPECT_TRUE(Project::open(file_, {}));
}

TEST_F(ProjectFileTest, AJournalOfTheOldKindIsRefused) {
  static_cast<void>(make());
  static_cast<void>(folder_.write("ship.strake-journal", "hostile"));
  expect_error(Project::open(file_, {}), ErrorCode::input, "WAL");
}

/// A copy that VACUUM INTO of SQLite makes is in this mode.
TEST_F(ProjectFileTest, WithoutAWriteLogItIsAProjectAllTheSame) {
  static_cast<void>(make());
  for (const Access access : {Access::read, Access::write}) {
    edit("PRAGMA journal_mode = DELETE");
    ASSERT_EQ(contents(file_)[18], 1);
    auto opened = Project::open(file_, {.access = access});
    ASSERT_TRUE(opened) << opened.error().text();
    EXPECT_TRUE(opened->database().execute("SELECT * FROM file"));
    // Whoever reads it is not in the way of a writer.
    auto writer = Project::open(file_, {.access = Access::write});
    ASSERT_TRUE(writer) << writer.error().text();
    auto transaction = Transaction::begin(writer->database());
    ASSERT_TRUE(transaction) << transaction.error().text();
    ASSERT_TRUE(writer->database().execute("UPDATE model_seal SET files = zeroblob(15)"));
    ASSERT_TRUE(transaction->commit());
    EXPECT_EQ(contents(file_)[18], 2);
  }
}

TEST_F(ProjectFileTest, WithoutAWriteLogItIsReadWhereNothingMayBeWritten) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  static_cast<void>(make());
  edit("PRAGMA journal_mode = DELETE");
  const std::string before = contents(file_);
  ASSERT_EQ(before[18], 1);
  ASSERT_EQ(::chmod(file_.c_str(), 0444), 0);
  ASSERT_EQ(::chmod(folder_.path().c_str(), 0555), 0);
  EXPECT_TRUE(Project::open(file_, {}));
  expect_error(Project::open(file_, {.access = Access::write}), ErrorCode::output, "read-only");
  EXPECT_EQ(contents(file_), before);
  ASSERT_EQ(::chmod(folder_.path().c_str(), 0755), 0);
}

TEST_F(ProjectFileTest, AFileThatMayNotGrowIsReportedAsThat) {
  static_cast<void>(make());
  auto project = Project::open(file_, {.access = Access::write});
  ASSERT_TRUE(project);
  auto transaction = Transaction::begin(project->database());
  ASSERT_TRUE(transaction);
  ASSERT_TRUE(project->database().execute(
      "CREATE TABLE large (bytes); INSERT INTO large VALUES (zeroblob(1000000))"));
  struct rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
  struct rlimit small = limit;
  small.rlim_cur = 65536;
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const Status committed = transaction->commit();
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  std::signal(SIGXFSZ, before);
  expect_error(committed, ErrorCode::output, "File too large");
  EXPECT_NE(committed.error().mend.find("ulimit -f"), std::string::npos);
}

TEST_F(ProjectFileTest, ReadersNeitherWaitNorSeeHalf) {
  static_cast<void>(make());
  auto writer = Project::open(file_, {.access = Access::write});
  ASSERT_TRUE(writer) << writer.error().text();
  auto transaction = Transaction::begin(writer->database());
  ASSERT_TRUE(transaction) << transaction.error().text();
  ASSERT_TRUE(writer->database().execute("UPDATE model_seal SET files = zeroblob(15)"));
  auto reader = Project::open(file_, {});
  ASSERT_TRUE(reader) << reader.error().text();
  EXPECT_EQ(test::number(*reader, "SELECT length(files) FROM model_seal"), 16);
  ASSERT_TRUE(transaction->commit());
  // Open, it sees what was there then.
  EXPECT_EQ(test::number(*reader, "SELECT length(files) FROM model_seal"), 16);
  auto later = Project::open(file_, {});
  ASSERT_TRUE(later);
  EXPECT_EQ(test::number(*later, "SELECT length(files) FROM model_seal"), 15);
}

TEST_F(ProjectFileTest, ASecondWriterIsReported) {
  static_cast<void>(make());
  auto first = Project::open(file_, {.access = Access::write});
  ASSERT_TRUE(first);
  auto second = Project::open(file_, {.access = Access::write, .wait_s = 0.2});
  ASSERT_TRUE(second);
  {
    auto transaction = Transaction::begin(first->database());
    ASSERT_TRUE(transaction);
    const auto start = std::chrono::steady_clock::now();
    expect_error(Transaction::begin(second->database()), ErrorCode::output, "another program");
    EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(150));
    expect_error(Project::open(file_, {.access = Access::write}), ErrorCode::output,
                 "another program");
  }
  EXPECT_TRUE(Transaction::begin(second->database()));
}

/// As where several readers come first to a project of an earlier version.
TEST_F(ProjectFileTest, AReaderWaitsForWhoeverBringsTheTablesUpToDate) {
  static_cast<void>(make());
  auto other = Project::open(file_, {.access = Access::write});
  ASSERT_TRUE(other) << other.error().text();
  const Status older = other->database().execute(
      "BEGIN; DROP TABLE map_place; DROP TABLE drawing_part; PRAGMA user_version = 4; COMMIT");
  ASSERT_TRUE(older) << older.error().text();
  auto transaction = Transaction::begin(other->database());
  ASSERT_TRUE(transaction) << transaction.error().text();
  std::optional<Transaction> held(std::move(*transaction));
  constexpr std::chrono::milliseconds kHeld(300);
  const auto start = std::chrono::steady_clock::now();
  std::thread owner([&] {
    std::this_thread::sleep_for(kHeld);
    EXPECT_TRUE(held->commit());
    held.reset();
  });
  auto reader = Project::open(file_, {});
  EXPECT_GE(std::chrono::steady_clock::now() - start, kHeld);
  owner.join();
  ASSERT_TRUE(reader) << reader.error().text();
  EXPECT_EQ(test::number(*reader, "SELECT count(*) FROM drawing_part"), 0);
  EXPECT_EQ(schema_version(reader->database()).value(), kSchemaVersion);
}

TEST_F(ProjectFileTest, WithoutACommitNothingIsWritten) {
  static_cast<void>(make());
  auto project = Project::open(file_, {.access = Access::write});
  ASSERT_TRUE(project);
  {
    auto transaction = Transaction::begin(project->database());
    ASSERT_TRUE(transaction);
    ASSERT_TRUE(project->database().execute("DELETE FROM model_seal"));
  }
  EXPECT_EQ(test::number(*project, "SELECT count(*) FROM model_seal"), 1);
}

TEST_F(ProjectFileTest, AReaderCannotWrite) {
  static_cast<void>(make());
  auto reader = Project::open(file_, {});
  ASSERT_TRUE(reader);
  expect_error(Transaction::begin(reader->database()), ErrorCode::output, "read-only");
  EXPECT_FALSE(reader->database().execute("DELETE FROM model_seal"));
}

TEST_F(ProjectFileTest, WhoeverClosesLastLeavesOneFile) {
  static_cast<void>(make());
  const auto count = [&] {
    return std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator());
  };
  EXPECT_TRUE(Project::open(file_, {}));
  EXPECT_EQ(count(), 1);
  {
    auto reader = Project::open(file_, {});
    ASSERT_TRUE(reader) << reader.error().text();
    edit("UPDATE model_seal SET files = zeroblob(15)");
    EXPECT_GT(count(), 1);
  }
  EXPECT_EQ(count(), 1);
  auto later = Project::open(file_, {});
  ASSERT_TRUE(later) << later.error().text();
  EXPECT_EQ(test::number(*later, "SELECT length(files) FROM model_seal"), 15);
}

TEST_F(ProjectFileTest, AFileThatIsNoLongerWhereItWasIsReported) {
  auto project = Project::open(make(), {.access = Access::write});
  ASSERT_TRUE(project) << project.error().text();
  EXPECT_TRUE(project->database().check_in_place());
  const fs::path away = folder_.path() / "away.strake";
  fs::rename(file_, away);
  expect_error(project->database().check_in_place(), ErrorCode::output, "moved");
  static_cast<void>(folder_.write("ship.strake", "another one"));
  expect_error(project->database().check_in_place(), ErrorCode::output, "replaced");
  fs::rename(away, file_);
  EXPECT_TRUE(project->database().check_in_place());
}

TEST_F(ProjectFileTest, ALastPageThatIsCutOffIsFound) {
  static_cast<void>(make());
  const auto faults = [&] {
    auto project = Project::open(file_, {});
    EXPECT_TRUE(project) << project.error().text();
    const auto found = check(*project, {});
    EXPECT_TRUE(found) << found.error().text();
    return found->size();
  };
  EXPECT_EQ(faults(), 0U);
  // The last byte of an empty page: zero, which is what SQLite takes it for.
  edit("CREATE TABLE more (a); INSERT INTO more VALUES (zeroblob(20000)); DROP TABLE more");
  EXPECT_EQ(faults(), 0U);
  fs::resize_file(file_, fs::file_size(file_) - 1);
  EXPECT_EQ(faults(), 1U);
}

TEST_F(ProjectFileTest, AFolderThatMayNotBeWrittenIsReadAllTheSame) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  static_cast<void>(make());
  ASSERT_EQ(::chmod(file_.c_str(), 0444), 0);
  ASSERT_EQ(::chmod(folder_.path().c_str(), 0555), 0);
  {
    auto reader = Project::open(file_, {});
    EXPECT_TRUE(reader) << (reader ? "" : reader.error().text());
    if (reader) {
      EXPECT_TRUE(reader->model({}));
    }
    expect_error(Project::open(file_, {.access = Access::write}), ErrorCode::output, "cannot be");
  }
  ASSERT_EQ(::chmod(folder_.path().c_str(), 0755), 0);
}

TEST_F(ProjectFileTest, FaultsOfStatementsAreReported) {
  static_cast<void>(make());
  auto project = Project::open(file_, {.access = Access::write});
  ASSERT_TRUE(project);
  Database& database = project->database();
  expect_error(database.prepare("SELECT none"), ErrorCode::internal, "no such column");
  auto statement = database.prepare("SELECT ?1");
  ASSERT_TRUE(statement);
  statement->bind(2, std::int64_t{1});
  EXPECT_FALSE(statement->step());
  statement->reset();
  const Hash128 hash{0x0123456789abcdefULL, 0xfedcba9876543210ULL};
  statement->bind(1, hash);
  ASSERT_TRUE(statement->step().value());
  EXPECT_EQ(statement->hash(0), hash);
  // The digits in the shell are those that messages show.
  auto digits = database.prepare("SELECT lower(hex(?1))");
  ASSERT_TRUE(digits);
  digits->bind(1, hash);
  ASSERT_TRUE(digits->step().value());
  EXPECT_EQ(digits->text(0), hash.text());
}

TEST(ProjectMigration, StepsLeadFromVersionToVersion) {
  auto database = Database::in_memory();
  ASSERT_TRUE(database);
  ASSERT_TRUE((*database)->execute("CREATE TABLE t (a); PRAGMA user_version = 1"));
  constexpr std::array<MigrationStep, 2> kSteps{
      {{2, "ALTER TABLE t ADD COLUMN c"}, {1, "ALTER TABLE t ADD COLUMN b"}}};
  ASSERT_TRUE(migrate(**database, 3, kSteps));
  EXPECT_EQ(schema_version(**database).value(), 3);
  EXPECT_TRUE((*database)->execute("INSERT INTO t (a, b, c) VALUES (1, 2, 3)"));
}

TEST(ProjectMigration, AStepThatFailsLeavesAllAsItWas) {
  auto database = Database::in_memory();
  ASSERT_TRUE(database);
  ASSERT_TRUE((*database)->execute("CREATE TABLE t (a); PRAGMA user_version = 1"));
  constexpr std::array<MigrationStep, 2> kSteps{
      {{1, "ALTER TABLE t ADD COLUMN b"}, {2, "ALTER TABLE none ADD COLUMN c"}}};
  EXPECT_FALSE(migrate(**database, 3, kSteps));
  EXPECT_EQ(schema_version(**database).value(), 1);
  EXPECT_FALSE((*database)->execute("SELECT b FROM t"));
  // And where no step goes on.
  EXPECT_FALSE(migrate(**database, 5, std::span(kSteps).first(1)));
  EXPECT_EQ(schema_version(**database).value(), 1);
}

/// What was UNIQUE is an index with a name, of the same rows: nothing is copied.
TEST(ProjectMigration, KeysOfClashesGetAnIndexWithAName) {
  auto database = Database::in_memory();
  ASSERT_TRUE(database);
  ASSERT_TRUE((*database)->execute(
      "CREATE TABLE clash (id INTEGER PRIMARY KEY, key TEXT NOT NULL UNIQUE, a TEXT) STRICT;"
      "INSERT INTO clash (key) VALUES ('b'), ('a'); PRAGMA user_version = 1"));
  constexpr std::array<MigrationStep, 1> kSteps{{{1, "CREATE TABLE other (a)", kNameKeyIndex}}};
  ASSERT_TRUE(migrate(**database, 2, kSteps));
  const auto text = [&](const char* sql) {
    Statement select = std::move((*database)->prepare(sql)).value();
    EXPECT_TRUE(select.step().value());
    return std::string(select.text(0));
  };
  EXPECT_EQ(text("SELECT sql FROM sqlite_schema WHERE name = 'clash'"),
            "CREATE TABLE clash (id INTEGER PRIMARY KEY, key TEXT NOT NULL, a TEXT) STRICT");
  EXPECT_EQ(text("PRAGMA integrity_check"), "ok");
  EXPECT_FALSE((*database)->execute("INSERT INTO clash (key) VALUES ('a')"));
  EXPECT_TRUE((*database)->execute("INSERT INTO clash (key) VALUES ('c')"));
  ASSERT_TRUE((*database)->execute(kDropKeyIndex));
  ASSERT_TRUE((*database)->execute(kMakeKeyIndex));
  EXPECT_FALSE((*database)->execute("INSERT INTO clash (key) VALUES ('c')"));
  // Nobody else writes into the table of tables.
  EXPECT_FALSE((*database)->execute("DELETE FROM sqlite_schema"));
}

/// A step for every version that there has ever been, so that none is forgotten.
TEST(ProjectMigration, ThereIsAStepFromEachVersion) {
  EXPECT_EQ(static_cast<std::int64_t>(migration_steps().size()), kSchemaVersion - 1);
}

}  // namespace
}  // namespace strake::project
