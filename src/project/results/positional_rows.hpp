// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "project/results/clash_rows.hpp"
#include "strake/clash/clash.hpp"
#include "strake/model/model.hpp"
#include "strake/report/decisions.hpp"

namespace strake::project {

/// Returns a row as the decision that it is.
[[nodiscard]] report::Decision decision_of(const ClashRow& row, const std::string& test);

/// Returns for each of some results whose ids are only positions the row that it has, by where the
/// clash is, as for decisions in a file; nothing where that does not show.
[[nodiscard]] std::vector<std::optional<std::size_t>> match_positional(
    const model::Model& model, const clash::Report& report, std::span<const std::size_t> results,
    std::span<const ClashRow> rows);

}  // namespace strake::project
