// SPDX-License-Identifier: Apache-2.0
#include "project/results/stored_tests.hpp"

#include <iterator>
#include <span>
#include <string_view>
#include <utility>

#include "core/text_encoding.hpp"
#include "project/codec/blob.hpp"
#include "project/snapshot/object_names.hpp"
#include "project/stored_report/kept_codec.hpp"
#include "strake/core/hash.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::project {
namespace {

using Bytes = std::vector<std::byte>;

Bytes copy_of(std::span<const std::byte> bytes) { return {bytes.begin(), bytes.end()}; }

std::string result_of(const std::string& test) {
  return test.empty() ? std::string("the result of the test of the command line")
                      : "the result of test " + in_quotes(test);
}

/// What is damaged, for errors: of which test in which project.
std::string called(const Database& database, const std::string& test) {
  return database.file().string() + ": " + result_of(test);
}

/// Returns the numbers of the parts, of so many, that have a result which a run took out or put in.
std::vector<std::size_t> touched_parts(const TestToWrite& test, std::size_t parts) {
  std::vector<bool> is_touched(parts, false);
  for (const clash::Pair& pair : test.changes->gone)
    is_touched[index(pair.a) / kObjectsPerPart] = true;
  for (const std::size_t i : test.changes->put_in)
    is_touched[index(test.results.report.pairs[i].a) / kObjectsPerPart] = true;
  std::vector<std::size_t> touched;
  for (std::size_t k = 0; k < parts; ++k)
    if (is_touched[k]) touched.push_back(k);
  return touched;
}

/// Returns the numbers of the parts that differ from those stored.
Result<std::vector<std::size_t>> changed_parts(const TestToWrite& test, const StoredTest* before,
                                               const std::vector<PartRange>& parts,
                                               const parallel::Context& context) {
  if (before != nullptr && test.changes != nullptr) return touched_parts(test, parts.size());
  const std::vector<PartRange> stored =
      before == nullptr ? std::vector<PartRange>()
                        : parts_of(before->results.report, before->snapshot.identities.size());
  const Result<std::vector<std::uint8_t>> differs = parallel::transform(
      context, {.name = "compare results", .n = parts.size()}, [&](std::size_t k) -> std::uint8_t {
        const bool same =
            k < stored.size() && is_same_part(before->results, stored[k], test.results, parts[k]);
        return same ? 0 : 1;
      });
  if (!differs) return differs.error();
  std::vector<std::size_t> changed;
  for (std::size_t k = 0; k < parts.size(); ++k)
    if ((*differs)[k] != 0) changed.push_back(k);
  return changed;
}

/// A result as bytes: what is no part, and the parts that are to be written.
struct EncodedResult {
  Bytes kept, head;
  std::vector<Bytes> parts;
};

/// Encodes a result, of whose parts those with these numbers, all at the same time.
Result<EncodedResult> encode(const TestToWrite& test, std::span<const PartRange> parts,
                             std::span<const std::size_t> changed,
                             const parallel::Context& context) {
  Result<std::vector<Bytes>> encoded =
      parallel::transform(context, {.name = "encode results", .n = changed.size() + 2},
                          [&](std::size_t i) -> Result<Bytes> {
                            // The largest ones come first.
                            if (i == 0) return encode_kept(test.results.report.kept);
                            if (i == 1) return encode_head(test.results.report);
                            return encode_part(test.results, parts[changed[i - 2]]);
                          });
  if (!encoded) return encoded.error();
  const auto first_part = encoded->begin() + 2;
  return EncodedResult{std::move((*encoded)[0]),
                       std::move((*encoded)[1]),
                       {std::move_iterator(first_part), std::move_iterator(encoded->end())}};
}

/// Writes the parts that differ; returns the hashes of all `count` that are stored then.
Result<std::vector<Hash128>> write_parts(Database& database, std::int64_t test, std::size_t count,
                                         std::span<const std::size_t> changed,
                                         const EncodedResult& encoded, const StoredTest* before) {
  Result<Statement> remove =
      database.prepare("DELETE FROM report_part WHERE test = ?1 AND part >= ?2");
  if (!remove) return remove.error();
  remove->bind(1, test).bind(2, static_cast<std::int64_t>(count));
  if (const Status status = remove->run(); !status) return status.error();
  std::vector<Hash128> hashes = before == nullptr ? std::vector<Hash128>() : before->results.parts;
  hashes.resize(count);
  Result<Statement> put =
      database.prepare("INSERT OR REPLACE INTO report_part (test, part, data) VALUES (?1, ?2, ?3)");
  if (!put) return put.error();
  for (std::size_t i = 0; i < changed.size(); ++i) {
    put->bind(1, test).bind(2, static_cast<std::int64_t>(changed[i]));
    put->bind(3, std::span<const std::byte>(encoded.parts[i]));
    if (const Status status = put->run(); !status) return status.error();
    hashes[changed[i]] = hash_bytes(encoded.parts[i]);
  }
  return hashes;
}

/// Writes a result, of whose parts those that differ from the one before.
Status write_result(Database& database, const TestToWrite& test, const StoredTest* before,
                    const parallel::Context& context) {
  const std::vector<PartRange> parts =
      parts_of(test.results.report, test.snapshot.identities.size());
  const Result<std::vector<std::size_t>> changed = changed_parts(test, before, parts, context);
  if (!changed) return changed.error();
  const Result<EncodedResult> encoded = encode(test, parts, *changed, context);
  if (!encoded) return encoded.error();
  const Result<std::vector<Hash128>> hashes =
      write_parts(database, test.id, parts.size(), *changed, *encoded, before);
  if (!hashes) return hashes.error();
  Result<Statement> update =
      database.prepare("UPDATE report SET head = ?2, kept = ?3, seal = ?4 WHERE test = ?1");
  if (!update) return update.error();
  update->bind(1, test.id).bind(2, std::span<const std::byte>(encoded->head));
  update->bind(3, std::span<const std::byte>(encoded->kept));
  return update->bind(4, seal_of(encoded->head, encoded->kept, *hashes)).run();
}

/// Writes what a result was computed from, but for what is stored.
Status write_source(Database& database, const TestToWrite& test, const StoredTest* before,
                    const parallel::Context& context) {
  const bool is_stored =
      test.is_unchanged && before != nullptr && before->snapshot.names == test.snapshot.names &&
      before->snapshot.source == test.snapshot.source && before->snapshot == test.snapshot;
  if (is_stored) return {};
  const std::optional<clash::KeptForChanges>& kept = test.results.report.kept;
  StoredParts stored;
  if (before != nullptr) stored.hashes = before->snapshot_parts;
  if (before != nullptr && before->parts_have_elements == kept.has_value())
    stored.stand = ranges_that_stand(before->snapshot, test.snapshot);
  return write_snapshot(database, test.id, test.snapshot,
                        kept ? kept->elements : std::span<const std::uint64_t>(), stored, context);
}

Result<std::vector<std::string>> names_of(Database& database, std::string_view sql) {
  Result<Statement> select = database.prepare(sql);
  if (!select) return select.error();
  std::vector<std::string> names;
  for (;;) {
    const Result<bool> there = select->step();
    if (!there) return there.error();
    if (!*there) return names;
    names.emplace_back(select->text(0));
  }
}

}  // namespace

Result<std::vector<std::string>> test_names(Database& database) {
  return names_of(database, "SELECT name FROM test ORDER BY id");
}

Result<std::vector<std::string>> last_tests(Database& database) {
  // A run adds a row for each of its tests in their order.
  return names_of(database,
                  "SELECT name FROM run_test JOIN test ON test.id = run_test.test "
                  "WHERE run_test.run = (SELECT max(id) FROM run) ORDER BY run_test.rowid");
}

Result<std::optional<TestRow>> find_test(Database& database, const std::string& name) {
  Result<Statement> select = database.prepare("SELECT id, run FROM test WHERE name = ?1");
  if (!select) return select.error();
  const Result<bool> there = select->bind(1, std::string_view(name)).step();
  if (!there) return there.error();
  if (!*there) return std::optional<TestRow>();
  return std::optional(TestRow{select->integer(0), select->integer(1), false});
}

Result<std::optional<StoredSnapshot>> find_snapshot(Database& database, const std::string& test) {
  Result<Statement> select = database.prepare(
      "SELECT id, snapshot FROM test LEFT JOIN report ON report.test = id WHERE name = ?1");
  if (!select) return select.error();
  const Result<bool> there = select->bind(1, std::string_view(test)).step();
  if (!there) return there.error();
  if (!*there) return std::optional<StoredSnapshot>();
  Result<StoredSnapshot> snapshot = read_snapshot(
      database, select->integer(0), copy_of(select->bytes(1)), called(database, test), {});
  if (!snapshot) return snapshot.error();
  return std::optional(std::move(*snapshot));
}

Result<std::optional<StoredTest>> read_test(Database& database, const std::string& name,
                                            const parallel::Context& context) {
  Result<Statement> select = database.prepare(
      "SELECT id, run, snapshot, head, kept, seal FROM test LEFT JOIN report ON report.test = id "
      "WHERE name = ?1");
  if (!select) return select.error();
  const Result<bool> there = select->bind(1, std::string_view(name)).step();
  if (!there) return there.error();
  if (!*there) return std::optional<StoredTest>();
  StoredTest test;
  test.id = select->integer(0);
  test.run = select->integer(1);
  test.name = name;
  const Bytes snapshot = copy_of(select->bytes(2)), head = copy_of(select->bytes(3)),
              kept = copy_of(select->bytes(4));
  const std::optional<Hash128> seal = select->hash(5);
  select->reset();
  if (!seal) return database.damaged(result_of(name) + " has no seal");
  const std::string what = called(database, name);
  Result<StoredSnapshot> then = read_snapshot(database, test.id, snapshot, what, context);
  if (!then) return then.error();
  test.snapshot = std::move(then->snapshot);
  test.snapshot_parts = std::move(then->parts);
  test.parts_have_elements = !then->elements.empty();
  Result<std::vector<Bytes>> parts = read_parts(database, "report_part", test.id, result_of(name));
  if (!parts) return parts.error();
  Result<RememberedReport> results = decode_report({head, kept, std::move(*parts), *seal},
                                                   test.snapshot.identities.size(), what, context);
  if (!results) return results.error();
  test.results = std::move(*results);
  Result<std::optional<clash::KeptForChanges>> for_changes = decode_kept(
      kept, test.results.report, test.snapshot.identities.size(), std::move(then->elements), what);
  if (!for_changes) return for_changes.error();
  test.results.report.kept = std::move(*for_changes);
  return std::optional(std::move(test));
}

Status write_test(Database& database, const TestToWrite& test, const StoredTest* before,
                  const parallel::Context& context) {
  Result<Statement> update =
      database.prepare("UPDATE test SET settings = ?2, run = ?3, objects = ?4 WHERE id = ?1");
  if (!update) return update.error();
  update->bind(1, test.id).bind(2, std::string_view(test.settings)).bind(3, test.run);
  update->bind(4, static_cast<std::int64_t>(test.snapshot.identities.size()));
  if (const Status status = update->run(); !status) return status;
  if (!test.is_unchanged)
    if (const Status status = write_result(database, test, before, context); !status) return status;
  return write_source(database, test, before, context);
}

Result<std::optional<model::Model>> read_test_objects(Database& database, const StoredTest& test) {
  Result<Statement> select = database.prepare("SELECT names FROM test_objects WHERE test = ?1");
  if (!select) return select.error();
  const Result<bool> there = select->bind(1, test.id).step();
  if (!there) return there.error();
  if (!*there) return std::optional<model::Model>();
  Result<model::Model> model =
      decode_names(select->bytes(0), called(database, test.name) + ", its objects");
  if (!model) return model.error();
  if (model->objects.size() != test.snapshot.identities.size())
    return database.damaged(result_of(test.name) +
                            " is of another number of objects than are named");
  return std::optional(std::move(*model));
}

Status write_test_objects(Database& database, std::int64_t test, const model::Model& model,
                          bool are_known) {
  Result<Statement> select = database.prepare("SELECT names FROM test_objects WHERE test = ?1");
  if (!select) return select.error();
  const Result<bool> there = select->bind(1, test).step();
  if (!there) return there.error();
  if (*there && are_known) return {};
  BlobWriter values = names_of(model);
  if (*there && BlobReader::raw_hash(select->bytes(0)) == values.raw_hash()) return {};
  select->reset();
  const Result<Bytes> names = values.finish();
  if (!names) return names.error();
  Result<Statement> put =
      database.prepare("INSERT OR REPLACE INTO test_objects (test, names) VALUES (?1, ?2)");
  if (!put) return put.error();
  return put->bind(1, test).bind(2, std::span<const std::byte>(*names)).run();
}

}  // namespace strake::project
