// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <vector>

#include "strake/core/hash.hpp"
#include "strake/report/decisions.hpp"

namespace strake::report {

/// A row and the key that it should have today: that of its result, or of its renamed files.
struct WantedKey {
  const Decision* row = nullptr;
  Hash128 key;
  bool found = false;  ///< a result is the row's
};

/// The keys that the rows of a file have from now on.
struct RowKeys {
  std::map<const Decision*, Hash128> keys;  ///< of the rows that stay
  std::set<Hash128> held;                   ///< all of these
};

/// Gives each row the key that it wants, unless that stays with another: a key stands in a file
/// once. A row that nobody has written into and whose result is not found is taken out where
/// another has its key.
[[nodiscard]] RowKeys assign_keys(const std::vector<WantedKey>& rows);

}  // namespace strake::report
