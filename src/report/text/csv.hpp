// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "strake/model/model.hpp"

namespace strake::report {

/// Appends a text as a cell of RFC 4180, quoted where needed. An apostrophe keeps a spreadsheet
/// from taking it for a formula: names that begin with '=' or '-' are common, and one from a
/// foreign file may do anything.
void append_csv(std::string& out, std::string_view raw);

/// Appends what names an object: its id, name and file, a comma behind each.
void append_csv_identity(std::string& out, const model::Model& model, model::ObjectId id);

}  // namespace strake::report
