// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "report/decisions/decision_files.hpp"
#include "strake/clash/clash.hpp"
#include "strake/model/model.hpp"
#include "strake/report/decisions.hpp"

namespace strake::report {

/// Which row is about which result.
struct MatchedRows {
  std::vector<std::vector<const Decision*>> tests;  ///< of each test, of each pair; null: none
  /// Rows that nobody has written into, of results that a decision is about.
  std::vector<const Decision*> replaced;
};

/// Finds the row about each result: by the key that it has, or had. Where an id is only a position,
/// that is another clash's as soon as objects come or go: rows that name files and objects are
/// found by place, decided ones first, and others by key where the place is the same. Rows that
/// nobody has written into are taken by key wherever they were.
[[nodiscard]] MatchedRows match_rows(const clash::Findings& findings, const model::Model& model,
                                     const DecisionFile& file, const DecidedKeys& keys);

/// Whether nobody has written into a row: no status, no name, no date and no comment.
[[nodiscard]] bool is_bare(const Decision& row);

/// Whether the id of one of the two objects is only a position in its file.
[[nodiscard]] bool is_positional(const model::Model& model, const clash::Pair& pair);

/// Whether a result is where a row states it to be; d counts where the row has it.
[[nodiscard]] bool is_same_place(const clash::Pair& pair, const Decision& row);

}  // namespace strake::report
