// SPDX-License-Identifier: Apache-2.0
// What the tables of a rules file say of tolerances, relations and volumes.
#pragma once

#include <string_view>

#include "rules/rule_file.hpp"
#include "settings/table_reader.hpp"
#include "strake/clash/reporting.hpp"

namespace strake::rules {

/// Reads the tolerances that a table gives, on top of others; returns whether it gives any. A
/// clearance that it gives replaces the whole of the other one, the attribute too.
bool read_tolerances(settings::ParseContext& reading, settings::TableReader& table,
                     ToleranceRule& rule);

/// Reads one relation or a list of them, as results call them ("A_IN_B", or "a_in_b"), or by one of
/// the words that stand for some of them: "inside", "through", "abut". Empty where the key is
/// missing; other words are faults.
[[nodiscard]] clash::RelationSet read_relations(settings::ParseContext& reading,
                                                settings::TableReader& table, std::string_view key);

/// Reads `relations` and `min_volume` of a test, on top of others.
void read_reporting(settings::ParseContext& reading, settings::TableReader& table,
                    clash::Reporting& reporting);

}  // namespace strake::rules
