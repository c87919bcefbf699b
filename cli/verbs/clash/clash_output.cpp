// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/clash/clash_output.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>

#include "cli/options/options.hpp"
#include "core/text_encoding.hpp"
#include "model/attribute_uses.hpp"
#include "publish/form_words.hpp"

namespace strake::cli {

namespace {

Error option_error(std::string message, const char* option, const char* mend) {
  return {ErrorCode::usage, std::move(message), option, mend};
}

/// Returns what stands between the commas, without blanks round it.
std::vector<std::string> listed_words(std::string_view list) {
  std::vector<std::string> words;
  for (;;) {
    const std::size_t comma = list.find(',');
    words.emplace_back(trimmed(list.substr(0, comma)));
    if (comma == std::string_view::npos) return words;
    list.remove_prefix(comma + 1);
  }
}

Result<std::vector<std::string>> columns_of(const std::string& list) {
  std::vector<std::string> names;
  for (const std::string& word : listed_words(list)) {
    if (word.size() < 2 || word.front() != '@')
      return option_error("'" + word + "' is no column", "--columns",
                          "write attributes as @Tag,@Area ('strake info --attributes' lists them)");
    std::string name = word.substr(1);
    if (std::ranges::find(names, name) != names.end())
      return option_error("'" + word + "' stands there twice", "--columns",
                          "name each attribute once");
    names.push_back(std::move(name));
  }
  return names;
}

Result<report::WrittenClasses> classes_of(const std::string& list) {
  report::WrittenClasses classes{false, false, false};
  for (const std::string& word : listed_words(list)) {
    const Status added = publish::add_class(word, classes);
    if (!added) {
      Error error = added.error();
      error.where = "--class";
      return error;
    }
  }
  return classes;
}

}  // namespace

void add_page_geometry_option(CLI::App& command, std::string& option) {
  add_choice(command, "--page-geometry", option, {"auto", "all", "near", "boxes", "none"},
             "What .html shows of the model: all of it; what clashes and what is near, and boxes "
             "for the rest; boxes; or nothing (default auto: all, or where that is too much for a "
             "browser what is near)")
      ->group("Result");
}

void add_clash_output_options(CLI::App& command, ClashOutputInput& options) {
  constexpr const char* kGroup = "Result";
  command
      .add_option("--columns", options.columns,
                  "Attributes of both objects that files of results have besides, as @Tag,@Area: "
                  "their own or those of the nearest group above that states them")
      ->type_name("@NAME,...")
      ->group(kGroup);
  command
      .add_option("--class", options.classes,
                  "Results of these classes only in the table, files and groups: hit, contact, "
                  "clearance, with commas between; results that may be of one of them stay, and "
                  "all are counted (default: all)")
      ->type_name("CLASS,...")
      ->group(kGroup);
  command
      .add_option("--top", options.top,
                  fmt::format("Rows of the table, of each test or of groups (default {})",
                              report::TableOptions{}.rows))
      ->type_name("N")
      ->group(kGroup);
  add_choice(command, "--csv", options.csv, {"standard", "excel", "excel-comma"},
             "Form of .csv: RFC 4180; or for a double click in Excel, with a byte order mark, and "
             "where Excel's decimal sign is the comma with commas in numbers and semicolons "
             "between cells (default standard)")
      ->group(kGroup);
  add_bcf_options(command, options.bcf);
  add_page_geometry_option(command, options.page_geometry);
}

Result<ClashOutput> clash_output(const ClashOutputInput& input, const WrittenFiles& files) {
  ClashOutput output;
  if (!input.columns.empty()) {
    Result<std::vector<std::string>> columns = columns_of(input.columns);
    if (!columns) return columns.error();
    output.columns = std::move(*columns);
    if (!files.attributes)
      return option_error("attributes are written to files of results only", "--columns",
                          "add -o FILE.csv or -o FILE.json");
  }
  if (!input.classes.empty()) {
    const Result<report::WrittenClasses> classes = classes_of(input.classes);
    if (!classes) return classes.error();
    output.classes = *classes;
  }
  if (!input.top.empty()) {
    if (const Status status = whole_number(output.rows.emplace(), input.top, "--top"); !status)
      return status.error();
    if (!files.table)
      return option_error("there is no table with --json", "--top", "leave out one of them");
  }
  output.csv = publish::csv_form(input.csv);
  if (!input.csv.empty() && !files.csv && !files.pair_log && !files.decisions)
    return option_error("no .csv is written", "--csv", "add -o FILE.csv");
  const Result<report::BcfForm> bcf = bcf_form(input.bcf, files.bcf);
  if (!bcf) return bcf.error();
  output.bcf = *bcf;
  output.shown = publish::model_shown(input.page_geometry);
  if (!input.page_geometry.empty() && !files.page)
    return option_error("no page is written", "--page-geometry", "add -o FILE.html");
  return output;
}

Diagnostics check_columns(const std::vector<std::string>& columns, const model::Model& model) {
  Diagnostics diagnostics;
  if (columns.empty()) return diagnostics;
  const std::vector<model::AttributeUse> uses = model::attribute_uses(model, 0, model.files.size());
  for (const std::string& column : columns)
    if (std::ranges::find(uses, column, &model::AttributeUse::name) == uses.end())
      diagnostics.add(Severity::warning, "column-not-stated", model::no_object_states(column, uses),
                      "--columns");
  return diagnostics;
}

}  // namespace strake::cli
