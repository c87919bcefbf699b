// SPDX-License-Identifier: Apache-2.0
#include "project/check/check_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "clash/results/clash_key.hpp"
#include "core/text_encoding.hpp"

namespace strake::project {
namespace {

/// A row of the table `clash`.
struct KeyedRow {
  std::string key;
  std::array<std::uint64_t, 2> identities{};
};

/// What is wrong with rows or results in one way.
struct FaultKind {
  std::string_view what;
  std::string first = {};
  std::uint64_t count = 0;

  void add(std::string_view where) {
    if (count++ == 0) first = where;
  }
};

class RowCheck {
 public:
  RowCheck(Database& database, const StoredTest& test)
      : database_(database), test_(test), known_(test.snapshot.identities) {
    std::ranges::sort(known_);
  }

  Result<std::vector<std::string>> run() {
    if (const Status status = count_objects(); !status) return status.error();
    if (const Status status = read_rows(); !status) return status.error();
    const clash::Report& report = test_.results.report;
    for (std::size_t i = 0; i < report.pairs.size(); ++i)
      if (const std::int64_t row = test_.results.rows[i]; row != 0) hold(report.pairs[i], row);
    for (const FaultKind* const kind : {&other_key_, &no_row_, &other_objects_})
      if (kind->count > 0)
        faults_.push_back(kind->count == 1 ? fmt::format("{} {}", kind->first, kind->what)
                                           : fmt::format("{} {}, first of {}", kind->first,
                                                         kind->what, kind->count));
    return std::move(faults_);
  }

 private:
  Status count_objects() {
    Result<Statement> select = database_.prepare("SELECT objects FROM test WHERE id = ?1");
    if (!select) return select.error();
    const Result<bool> there = select->bind(1, test_.id).step();
    if (!there) return there.error();
    const auto objects = static_cast<std::int64_t>(test_.snapshot.identities.size());
    if (*there && select->integer(0) != objects)
      faults_.push_back(
          fmt::format("is about {} objects, and its row says {}", objects, select->integer(0)));
    return {};
  }

  Status read_rows() {
    Result<Statement> select =
        database_.prepare("SELECT id, key, a_file, a_id, b_file, b_id FROM clash WHERE test = ?1");
    if (!select) return select.error();
    select->bind(1, test_.id);
    for (;;) {
      const Result<bool> there = select->step();
      if (!there) return there.error();
      if (!*there) return {};
      const std::string_view key = select->text(1);
      const clash::ElementName a{select->text(2), select->text(3)};
      const clash::ElementName b{select->text(4), select->text(5)};
      // What stands behind the mark tells a key that gave way from the one of another clash.
      if (key.substr(0, key.find('~')) != clash::key_text(clash::pair_hash(test_.name, a, b)))
        other_key_.add(called(key));
      rows_.emplace(select->integer(0), KeyedRow{std::string(key),
                                                 {clash::element_hash(a.file_label, a.id),
                                                  clash::element_hash(b.file_label, b.id)}});
    }
  }

  void hold(const clash::Pair& pair, std::int64_t number) {
    const auto found = rows_.find(number);
    if (found == rows_.end()) return no_row_.add(fmt::format("clash {}", number));
    const KeyedRow& row = found->second;
    const std::vector<std::uint64_t>& all = test_.snapshot.identities;
    const std::uint64_t a = all[model::index(pair.a)], b = all[model::index(pair.b)];
    // An object that a later update took out may be called by the label that its file had.
    const bool differs = std::ranges::any_of(row.identities, [&](std::uint64_t identity) {
      return identity != a && identity != b && std::ranges::binary_search(known_, identity);
    });
    if (differs) other_objects_.add(called(row.key));
  }

  static std::string called(std::string_view key) { return "clash " + in_quotes(key); }

  Database& database_;
  const StoredTest& test_;
  std::vector<std::uint64_t> known_;  ///< identities of objects, sorted
  std::unordered_map<std::int64_t, KeyedRow> rows_;
  std::vector<std::string> faults_;
  FaultKind other_key_{"has another key than its objects"};
  FaultKind no_row_{"has a result, and is not there"};
  FaultKind other_objects_{"is of other objects than its result"};
};

}  // namespace

Result<std::vector<std::string>> check_rows(Database& database, const StoredTest& test) {
  return RowCheck(database, test).run();
}

}  // namespace strake::project
