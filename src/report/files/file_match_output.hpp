// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "strake/report/file_match.hpp"

namespace strake::report {

/// Appends the members `files_matched` and `files_ambiguous` of a comparison, each with a comma and
/// a line break before it, where there are such: files of equal labels need not be told.
void append_file_matches(std::string& out, const FileMatches& files);

}  // namespace strake::report
