// SPDX-License-Identifier: Apache-2.0
#include "report/decisions/row_keys.hpp"

#include "report/decisions/decision_match.hpp"

namespace strake::report {
namespace {

class KeyAssignment {
 public:
  explicit KeyAssignment(const std::vector<WantedKey>& rows) : rows_(rows) {}

  RowKeys run() && {
    // What a result has goes before what a name suggests.
    for (const bool found : {true, false})
      for (const WantedKey& row : rows_)
        if (row.found == found && !is_spare(row)) want(row);
    while (!stay_.empty()) give_way();
    for (const auto& [key, row] : owner_) keep(row, key);
    for (const WantedKey& row : rows_)
      if (is_spare(row) && !result_.held.contains(row.key)) keep(row.row, row.key);
    return std::move(result_);
  }

 private:
  static bool is_spare(const WantedKey& row) { return !row.found && is_bare(*row.row); }

  void keep(const Decision* row, const Hash128& key) {
    result_.keys.emplace(row, key);
    result_.held.insert(key);
  }

  void want(const WantedKey& row) {
    if (!owner_.emplace(row.key, row.row).second) stay_.push_back(row.row);
  }

  /// Lets a row stay as it is; who wants its key has to stay, too.
  void give_way() {
    const Decision* const row = stay_.back();
    stay_.pop_back();
    keep(row, row->key);
    const auto rival = owner_.find(row->key);
    if (rival == owner_.end()) return;
    stay_.push_back(rival->second);
    owner_.erase(rival);
  }

  const std::vector<WantedKey>& rows_;
  std::map<Hash128, const Decision*> owner_;  ///< by the key that it gets
  std::vector<const Decision*> stay_;
  RowKeys result_;
};

}  // namespace

RowKeys assign_keys(const std::vector<WantedKey>& rows) { return KeyAssignment(rows).run(); }

}  // namespace strake::report
