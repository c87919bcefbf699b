// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "strake/core/result.hpp"
#include "strake/report/clash.hpp"

/// The words by which callers say how results are written, for the program and for Python. Where
/// a word has to be one of several, any other is taken for the first: who offers them checks that.
namespace strake::publish {

/// Returns the form that one of the words "standard", "excel" and "excel-comma" names.
[[nodiscard]] report::CsvForm csv_form(std::string_view word);

/// Returns what one of the words "auto", "all", "near", "boxes" and "none" shows.
[[nodiscard]] report::ModelShown model_shown(std::string_view word);

/// Parses a class of results, "hit", "contact", "clearance" or "clearance_violation", and adds it.
/// Errors: usage.
[[nodiscard]] Status add_class(std::string_view word, report::WrittenClasses& classes);

/// Returns a day or a moment as BCF has it. Errors: usage.
[[nodiscard]] Result<std::string> bcf_date(const std::string& text);

/// Returns a name without what BCF cannot hold. Errors: usage, for one of which nothing is left.
[[nodiscard]] Result<std::string> bcf_author(const std::string& text);

}  // namespace strake::publish
