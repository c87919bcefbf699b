// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "settings/table_reader.hpp"
#include "strake/clash/reporting.hpp"

namespace strake::rules {

/// Reads one relation or a list of them, as results call them ("A_IN_B", or "a_in_b"), or by one of
/// the words that stand for some of them: "inside", "through", "abut". Empty where the key is
/// missing; other words are faults.
[[nodiscard]] clash::RelationSet read_relations(settings::ParseContext& reading,
                                                settings::TableReader& table, std::string_view key);

/// Reads `relations` and `min_volume` of a test, on top of others.
void read_reporting(settings::ParseContext& reading, settings::TableReader& table,
                    clash::Reporting& reporting);

}  // namespace strake::rules
