// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rules/rule_file.hpp"
#include "settings/table_reader.hpp"

namespace strake::rules {

/// Reads the tolerances that a table gives, on top of others; returns whether it gives any. A
/// clearance that it gives replaces the whole of the other one, the attribute too.
bool read_tolerances(settings::ParseContext& reading, settings::TableReader& table,
                     ToleranceRule& rule);

}  // namespace strake::rules
