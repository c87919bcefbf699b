// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "project/results/stored_tests.hpp"
#include "strake/core/result.hpp"

namespace strake::project {

/// Holds a test to its rows: that it is about as many objects as its row says, that each clash has
/// the key of its two objects, and that the clash of each result is of its objects.
/// Returns what does not fit, of each kind the first and how many there are. Errors: those of the
/// database.
[[nodiscard]] Result<std::vector<std::string>> check_rows(Database& database,
                                                          const StoredTest& test);

}  // namespace strake::project
