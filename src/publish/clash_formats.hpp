// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/output_format.hpp"
#include "report/report_writers.hpp"
#include "strake/core/result.hpp"

/// All that results are put out as: what a module writes of one kind stands in a table of that
/// module; here the tables of one kind of result come together, for the program and for Python.
namespace strake::publish {

/// Returns the formats that clash results are written in, in the order of help and errors: texts
/// and tables of report, then what shows the model.
[[nodiscard]] std::vector<OutputFormat> clash_formats();

/// Returns the writer that a file's name requests. Errors: those of format_number().
[[nodiscard]] Result<report::ClashWriter> find_clash_writer(const std::string& file);

}  // namespace strake::publish
