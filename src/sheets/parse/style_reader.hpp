// SPDX-License-Identifier: Apache-2.0
// Reader of the tables of styles of objects.
#pragma once

#include "settings/named_sets.hpp"
#include "settings/table_reader.hpp"
#include "sheets/spec/sheet_spec.hpp"

namespace strake::sheets {

/// Reads a [[style]]: whose lines it is about, and colour, pen and type of line.
[[nodiscard]] ObjectStyleSpec read_object_style(settings::ParseContext& reading,
                                                settings::NamedSets& sets,
                                                const settings::Value& value);

}  // namespace strake::sheets
