// SPDX-License-Identifier: Apache-2.0
#include "cli/options.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <system_error>
#include <utility>

#include "strake/core/number.hpp"
#include "strake/core/units.hpp"
#include "strake/parallel/team.hpp"

namespace strake::cli {

namespace {

Error usage(std::string message, std::string option, std::string mend) {
  return {ErrorCode::usage, std::move(message), std::move(option), std::move(mend)};
}

}  // namespace

void add_common_options(CLI::App& command, CommonOptions& options) {
  command
      .add_option("--threads", options.threads,
                  fmt::format("Workers (default: the cores, here {})", parallel::default_workers()))
      ->type_name("N")
      ->group("Running");
  command.add_flag("--quiet", options.quiet, "No narration and no progress, errors only")
      ->group("Running");
  command
      .add_flag("--stats", options.stats,
                "Seconds per phase, work, load balance and peak memory on standard error")
      ->group("Running");
  command.add_flag("--json", options.json, "The result on standard output as JSON")
      ->group("Output");
}

void add_input_options(CLI::App& command, InputOptions& options) {
  command.add_option("files", options.files, "RVM, glTF, GLB, OBJ or STL files")
      ->required()
      ->type_name("FILE");
  command
      .add_option("--unit", options.unit,
                  "Length unit of the files, whatever they say themselves: mm, m, in ...")
      ->type_name("UNIT")
      ->group("Input");
  add_choice(command, "--up-axis", options.up_axis, {"x", "y", "z"},
             "Axis that points up in the files, whatever they say themselves")
      ->group("Input");
  command.add_flag("--strict", options.strict, "Exit code 4 when anything was skipped")
      ->group("Input");
}

void add_output_option(CLI::App& command, std::vector<std::string>& files,
                       const std::string& what) {
  command.add_option("-o,--output", files, what)
      ->type_name("FILE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group("Output");
}

CLI::Option* add_choice(CLI::App& command, const std::string& name, std::string& value,
                        const std::vector<std::string>& words, const std::string& help) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "" : "|") + word;
  return command.add_option(name, value, help)
      ->type_name(list)
      ->check([words, list](const std::string& given) {
        for (const std::string& word : words)
          if (given == word) return std::string();
        return "'" + given + "' is not one of " + list;
      });
}

Result<unsigned> worker_count(const CommonOptions& options) {
  if (options.threads.empty()) return parallel::default_workers();
  const auto number = parse_integer(options.threads);
  if (!number || *number < 1 || *number > parallel::Team::kMaxWorkers)
    return usage(fmt::format("'{}' is no number of workers", options.threads), "--threads",
                 fmt::format("write a whole number from 1 to {}", parallel::Team::kMaxWorkers));
  return static_cast<unsigned>(*number);
}

Result<io::ReadOptions> read_options(const InputOptions& options) {
  io::ReadOptions read;
  if (!options.unit.empty()) {
    const Result<double> unit = quantity(options.unit, "--unit", parse_unit_mm);
    if (!unit) return unit.error();
    read.unit_mm = *unit;
  }
  if (options.up_axis == "x") read.up_axis = io::UpAxis::x;
  if (options.up_axis == "y") read.up_axis = io::UpAxis::y;
  if (options.up_axis == "z") read.up_axis = io::UpAxis::z;
  return read;
}

Result<std::vector<double>> number_list(const std::string& text, std::size_t count,
                                        const std::string& option, const std::string& example) {
  std::vector<double> numbers;
  std::size_t at = 0;
  while (at <= text.size()) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const auto number = parse_number(text.substr(at, comma - at));
    if (!number) break;
    numbers.push_back(*number);
    at = comma + 1;
  }
  if (at != text.size() + 1 || numbers.size() != count)
    return usage(fmt::format("'{}' is not {} numbers", text, count), option, "write " + example);
  return numbers;
}

std::string suffix_of(const std::string& file) {
  std::string suffix = std::filesystem::path(file).extension().string();
  for (char& c : suffix)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return suffix;
}

Status check_outputs(const std::vector<std::string>& files,
                     const std::vector<std::string>& suffixes) {
  std::string list;
  for (const std::string& suffix : suffixes) list += (list.empty() ? "" : " or ") + suffix;
  for (const std::string& file : files) {
    const std::string suffix = suffix_of(file);
    if (std::find(suffixes.begin(), suffixes.end(), suffix) == suffixes.end())
      return usage("the format of '" + file + "' is not known", "-o", "end its name in " + list);
    const std::filesystem::path folder = std::filesystem::path(file).parent_path();
    std::error_code error;
    if (!folder.empty() && !std::filesystem::is_directory(folder, error))
      return Error{ErrorCode::output, "cannot be written: there is no such folder", file,
                   "make the folder first"};
  }
  return {};
}

Result<double> quantity(const std::string& text, const std::string& option,
                        Result<double> (*parse)(std::string_view)) {
  const Result<double> value = parse(text);
  if (value) return *value;
  Error error = value.error();
  error.where = option;
  return error;
}

}  // namespace strake::cli
