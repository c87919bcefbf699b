// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "project/database/database.hpp"
#include "strake/clash/clash.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"

/// The rows of a test's first run, which come by the million: many to a statement, without the
/// index of keys, which is made after them.
namespace strake::project {

/// What a test that was never run found.
struct FirstResults {
  std::int64_t test = 0, run = 0;
  const model::Model& model;
  const clash::Report& report;
  std::span<const Hash128> keys;  ///< of each result
};

/// Gives each result that no rule allows a row, in their order, and sets its entry of `rows` to
/// that. Returns false, and does nothing, where the table has more rows than would come, or a key
/// of theirs may be that of another of them or of a row that is there.
[[nodiscard]] Result<bool> add_first_rows(Database& database, const FirstResults& results,
                                          std::span<std::int64_t> rows);

}  // namespace strake::project
