// SPDX-License-Identifier: Apache-2.0
#include "project/update/rename_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "clash/results/clash_key.hpp"
#include "core/text_encoding.hpp"
#include "project/results/stored_tests.hpp"
#include "project/snapshot/object_names.hpp"
#include "project/snapshot/snapshot.hpp"
#include "project/views/drawing_rows.hpp"

namespace strake::project {
namespace {

using Labels = std::map<std::string, std::string, std::less<>>;

/// A clash that names a renamed file.
struct NamedClash {
  std::int64_t id = 0;
  std::string key, test, a_file, a_id, b_file, b_id;
};

/// Returns the label of today, or the one given.
const std::string& today(const Labels& labels, const std::string& label) {
  const auto at = labels.find(label);
  return at == labels.end() ? label : at->second;
}

Result<std::vector<NamedClash>> clashes_of(Database& database, const Labels& labels) {
  Result<Statement> select = database.prepare(
      "SELECT clash.id, key, name, a_file, a_id, b_file, b_id FROM clash JOIN test ON test.id = "
      "clash.test");
  if (!select) return select.error();
  std::vector<NamedClash> found;
  for (;;) {
    const Result<bool> there = select->step();
    if (!there) return there.error();
    if (!*there) return found;
    if (!labels.contains(select->text(3)) && !labels.contains(select->text(5))) continue;
    NamedClash& clash = found.emplace_back();
    clash.id = select->integer(0);
    int column = 1;
    for (std::string* const text :
         {&clash.key, &clash.test, &clash.a_file, &clash.a_id, &clash.b_file, &clash.b_id})
      *text = select->text(column++);
  }
}

/// Gives the clash its labels and its key; what tells a key that gave way from another stays.
void rename(NamedClash& clash, const Labels& labels) {
  const std::size_t mark = clash.key.find('~');
  const std::string rest = mark == std::string::npos ? std::string() : clash.key.substr(mark);
  clash.a_file = today(labels, clash.a_file);
  clash.b_file = today(labels, clash.b_file);
  clash.key = clash::key_text(clash::pair_hash(clash.test, {clash.a_file, clash.a_id},
                                               {clash.b_file, clash.b_id})) +
              rest;
}

Status rename_clashes(Database& database, const Labels& labels) {
  Result<std::vector<NamedClash>> clashes = clashes_of(database, labels);
  if (!clashes) return clashes.error();
  // Labels may be exchanged: all keys are given up before one of them is another's.
  Result<Statement> give_up = database.prepare("UPDATE clash SET key = '~' || id WHERE id = ?1");
  if (!give_up) return give_up.error();
  for (const NamedClash& clash : *clashes)
    if (const Status status = give_up->bind(1, clash.id).run(); !status) return status;
  Result<Statement> update =
      database.prepare("UPDATE clash SET key = ?2, a_file = ?3, b_file = ?4 WHERE id = ?1");
  if (!update) return update.error();
  // A file that is no more may have had the label: its clashes keep what is left of their keys.
  Result<Statement> make_way =
      database.prepare("UPDATE clash SET key = key || '~' || id WHERE key = ?1");
  if (!make_way) return make_way.error();
  for (NamedClash& clash : *clashes) {
    rename(clash, labels);
    if (const Status status = make_way->bind(1, std::string_view(clash.key)).run(); !status)
      return status;
    update->bind(1, clash.id).bind(2, std::string_view(clash.key));
    update->bind(3, std::string_view(clash.a_file)).bind(4, std::string_view(clash.b_file));
    if (const Status status = update->run(); !status) return status;
  }
  return {};
}

/// Gives the labels of today to the files that a table keeps with the names of their objects.
/// What is damaged stays as it is: it serves nobody.
Status rename_named(Database& database, const Labels& labels, std::string_view table,
                    std::string_view key) {
  Result<Statement> select = database.prepare(fmt::format("SELECT {}, names FROM {}", key, table));
  if (!select) return select.error();
  std::vector<std::pair<std::int64_t, model::Model>> all;
  for (;;) {
    const Result<bool> there = select->step();
    if (!there) return there.error();
    if (!*there) break;
    Result<model::Model> model = decode_names(select->bytes(1), "names of objects");
    if (model) all.emplace_back(select->integer(0), std::move(*model));
  }
  Result<Statement> update =
      database.prepare(fmt::format("UPDATE {} SET names = ?2 WHERE {} = ?1", table, key));
  if (!update) return update.error();
  for (auto& [row, model] : all) {
    for (model::SourceFile& file : model.files)
      if (const auto at = labels.find(valid_utf8(file.label)); at != labels.end())
        file.label = at->second;
    const Result<std::vector<std::byte>> names = encode_names(model);
    if (!names) return names.error();
    update->bind(1, row).bind(2, std::span<const std::byte>(*names));
    if (const Status status = update->run(); !status) return status;
  }
  return {};
}

/// Returns what the identities of the objects of renamed files become.
NewIdentities new_identities(const model::Model& before, const Labels& labels) {
  std::vector<const std::string*> of_file;
  for (const model::SourceFile& file : before.files) {
    const auto at = labels.find(valid_utf8(file.label));
    of_file.push_back(at == labels.end() ? nullptr : &at->second);
  }
  NewIdentities all;
  for (const model::Object& object : before.objects)
    if (const std::string* const label = of_file[object.file]; label != nullptr)
      all.emplace(clash::element_hash(before.files[object.file].label, object.id),
                  clash::element_hash(*label, object.id));
  return all;
}

/// Returns whether the objects that a test was last run on are distinguished by today's labels as
/// they were by those of then: a file may now have the label of one that is no more, and objects
/// that the model has no longer keep their identities.
Result<bool> keeps_files_apart(Database& database, std::int64_t test, const Labels& labels,
                               const NewIdentities& identities) {
  Result<Statement> select = database.prepare("SELECT names FROM test_objects WHERE test = ?1");
  if (!select) return select.error();
  const Result<bool> there = select->bind(1, test).step();
  if (!there) return there.error();
  if (!*there) return false;
  const Result<model::Model> model = decode_names(select->bytes(0), "names of objects");
  if (!model) return false;
  std::vector<std::string> of_file;
  for (const model::SourceFile& file : model->files) of_file.push_back(valid_utf8(file.label));
  std::set<std::string_view> labels_of_today;
  for (const std::string& label : of_file)
    if (!labels_of_today.insert(today(labels, label)).second) return false;
  return std::ranges::all_of(model->objects, [&](const model::Object& object) {
    const std::string& label = of_file[object.file];
    return !labels.contains(label) || identities.contains(clash::element_hash(label, object.id));
  });
}

}  // namespace

Status rename_files(Database& database, const model::Model& before,
                    std::span<const RenamedFile> renamed) {
  Labels labels;
  for (const RenamedFile& file : renamed)
    if (file.before != file.after) labels.emplace(valid_utf8(file.before), valid_utf8(file.after));
  if (labels.empty()) return {};
  if (const Status status = rename_clashes(database, labels); !status) return status;
  const Result<std::vector<std::string>> tests = test_names(database);
  if (!tests) return tests.error();
  const NewIdentities identities = new_identities(before, labels);
  for (const std::string& test : *tests) {
    Result<std::optional<StoredSnapshot>> stored = find_snapshot(database, test);
    if (!stored) return stored.error();
    if (!*stored) continue;
    rename_objects((**stored).snapshot, identities);
    const std::int64_t id = (**stored).test;
    const Result<bool> apart = keeps_files_apart(database, id, labels, identities);
    if (!apart) return apart.error();
    // What was kept knows the objects by their former names: the next run does not follow it.
    if (!*apart) (**stored).snapshot.whole = {};
    if (const Status status = write_snapshot(database, id, (**stored).snapshot, (**stored).elements,
                                             {.hashes = (**stored).parts}, {});
        !status)
      return status;
  }
  if (const Status status = rename_named(database, labels, "test_objects", "test"); !status)
    return status;
  if (const Status status = rename_named(database, labels, "drawing_objects", "view"); !status)
    return status;
  return rename_objects_of_drawings(database, identities);
}

}  // namespace strake::project
