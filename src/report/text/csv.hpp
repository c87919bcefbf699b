// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "strake/model/model.hpp"

namespace strake::report {

/// A text as a cell of RFC 4180, quoted where needed. What a spreadsheet would take for a formula
/// is kept from being one by an apostrophe: names that begin with '=' or '-' are common, and one
/// from a foreign file may do anything.
void append_csv(std::string& out, std::string_view raw);

/// What names an object: its id, name and file, a comma behind each.
void append_csv_identity(std::string& out, const model::Model& model, model::ObjectId id);

}  // namespace strake::report
