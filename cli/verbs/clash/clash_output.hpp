// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/verbs/clash/bcf/bcf_options.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/report/clash.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own name
class App;
}  // namespace CLI

/// The options for what of a clash result is written, and in what form.
namespace strake::cli {

/// As written.
struct ClashOutputInput {
  std::string columns, classes, top, csv, page_geometry;
  BcfInput bcf;
};

/// The parsed form of a ClashOutputInput.
struct ClashOutput {
  std::vector<std::string> columns;  ///< names of attributes
  report::WrittenClasses classes;
  std::optional<std::uint64_t> rows;  ///< of the table; absent: as many as it has by itself
  report::CsvForm csv;
  report::BcfForm bcf;
  report::ModelShown shown = report::ModelShown::automatic;  ///< of the model in a page
};

/// What a run writes, as far as the options bear on it.
struct WrittenFiles {
  bool csv = false, bcf = false, page = false;
  bool attributes = false;  ///< a format that has ClashOutput::columns
  bool pair_log = false;    ///< CSV too, but without attributes
  bool decisions = false;   ///< likewise
  bool table = false;       ///< on the terminal
};

void add_clash_output_options(CLI::App& command, ClashOutputInput& options);

/// Adds --page-geometry: how much of the model a page shows.
void add_page_geometry_option(CLI::App& command, std::string& option);

/// Errors: usage for what is misspelt, and for an option that bears on none of the files.
[[nodiscard]] Result<ClashOutput> clash_output(const ClashOutputInput& input,
                                               const WrittenFiles& files);

/// Returns a warning "column-not-stated" for each column that no object has a value for.
[[nodiscard]] Diagnostics check_columns(const std::vector<std::string>& columns,
                                        const model::Model& model);

}  // namespace strake::cli
