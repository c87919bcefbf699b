// SPDX-License-Identifier: Apache-2.0
#include "cli/options/options.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "core/number.hpp"
#include "core/units.hpp"
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

void add_scheduler_options(CLI::App& command, CommonOptions& options) {
  CLI::Option* const scheduler =
      command
          .add_option("--scheduler", options.scheduler,
                      "Cut the model into tiles, which the workers of a Dask cluster take "
                      "(tcp://HOST:8786), or this machine one after the other (local): for models "
                      "that fit into no memory. Python does it: pip install 'strake[cluster]' "
                      "(docs/cluster.md)")
          ->type_name("ADDRESS|local")
          ->group("Cluster");
  const auto add = [&](const char* name, std::string& value, const char* type, const char* help) {
    command.add_option(name, value, help)->type_name(type)->needs(scheduler)->group("Cluster");
  };
  add("--worker-memory", options.worker_memory, "SIZE", "What a worker may take (default 1GiB)");
  add("--worker-threads", options.worker_threads, "N", "Threads of a worker (default 1)");
  add("--tile-folder", options.tile_folder, "FOLDER",
      "Where tiles are while the run lasts, seen by all workers under one path (default: a "
      "temporary folder, which workers on this machine see)");
}

void add_distribution_option(CLI::App& command, CommonOptions& options) {
  add_choice(command, "--distribution", options.distribution,
             {"planned", "in-order", "equal-ranges"},
             "How workers share the work out, for comparisons; the result is the same: whoever is "
             "free takes the next, the longest first (planned) or as it comes (in-order), or each "
             "has its range, all of the same number of items (equal-ranges) (default planned)")
      ->group("Running");
}

void add_input_options(CLI::App& command, InputOptions& options) {
  command
      .add_option("files", options.files,
                  "RVM, glTF, GLB, OBJ, STL or PLY files, IFC and others where an importer is "
                  "installed, or projects, which stand for theirs")
      ->required()
      ->type_name("FILE");
  may_repeat(
      command.add_option(
          "--unit", options.units,
          "Length unit of the files, instead of the one that they state: mm, m, in ...; of one "
          "of them as part.stl=m; may be repeated"))
      ->type_name("[FILE=]UNIT")
      ->group("Input");
  may_repeat(command.add_option(
                 "--up-axis", options.up_axes,
                 "Axis that points up in the files, instead of the one that they state; of one of "
                 "them as part.stl=y; may be repeated"))
      ->type_name("[FILE=]x|y|z")
      ->group("Input");
  command
      .add_flag(
          "--strict", options.strict,
          "Exit code 4 when anything was skipped or, in clash, a set is empty, a pair was not "
          "compared, or a clearance lacks its attribute or a length there")
      ->group("Input");
}

void add_georeference_option(CLI::App& command, InputOptions& options) {
  command
      .add_flag("--georeference", options.georeference,
                "Put files whose importer says where they lie on a map there: x east, y north; "
                "otherwise coordinates are those of each file")
      ->group("Input");
}

void add_output_option(CLI::App& command, std::vector<std::string>& files, std::string_view what,
                       std::span<const OutputFormat> formats) {
  command.add_option("-o,--output", files, describe_formats(what, formats) + "; may be repeated")
      ->type_name("FILE")
      ->expected(1)
      ->allow_extra_args(false)  // what follows the file is the next model
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group("Output");
}

CLI::Option* add_match_files_option(CLI::App& command, std::vector<std::string>& pairs) {
  return command
      .add_option(
          "--match-files", pairs,
          "A file of the old run that is another in the new one, by their labels, as "
          "ship.glb=ship_revB.glb; others are matched by label, then by what is in them; may "
          "be repeated")
      ->type_name("OLD=NEW")
      ->expected(1)
      ->allow_extra_args(false)  // what follows the pair is a result
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
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

void add_former_name(CLI::App& command, const std::string& name, std::string& value) {
  command.add_option(name, value)->group("");  // hidden
}

CLI::Option* may_repeat(CLI::Option* option) {
  return option->expected(1)->allow_extra_args(false)->multi_option_policy(
      CLI::MultiOptionPolicy::TakeAll);
}

Result<unsigned> worker_count(const CommonOptions& options) {
  if (options.threads.empty()) return parallel::default_workers();
  const auto number = parse_integer(options.threads);
  if (!number || *number < 1 || *number > parallel::Team::kMaxWorkers)
    return usage(fmt::format("'{}' is no number of workers", options.threads), "--threads",
                 fmt::format("write a whole number from 1 to {}", parallel::Team::kMaxWorkers));
  return static_cast<unsigned>(*number);
}

parallel::Distribution distribution_of(const CommonOptions& options) {
  if (options.distribution == "in-order") return parallel::Distribution::in_order;
  if (options.distribution == "equal-ranges") return parallel::Distribution::equal_ranges;
  return parallel::Distribution::planned;
}

namespace {

/// A value with the file that it is given for: "part.stl=m" is for that file, "m" for all. The last
/// '=' counts, as names of files may hold some.
struct FileValue {
  std::string text, file, value;
  bool of_all;

  explicit FileValue(std::string all_of_it) : text(std::move(all_of_it)) {
    const std::size_t at = text.rfind('=');
    of_all = at == std::string::npos;
    if (!of_all) file = text.substr(0, at);
    value = of_all ? text : text.substr(at + 1);
  }
};

/// Whether a path ends in the folders and the name of another.
bool ends_in(const std::filesystem::path& path, const std::filesystem::path& end) {
  const auto from = std::distance(end.begin(), end.end());
  const auto length = std::distance(path.begin(), path.end());
  return from <= length &&
         std::equal(end.begin(), end.end(), std::next(path.begin(), length - from));
}

/// Returns the files that a value is given for: those of its path, or else the one whose path ends
/// in it, as the labels of results do.
Result<std::vector<std::size_t>> files_meant(const FileValue& given_value,
                                             const std::vector<io::FileToRead>& files,
                                             const std::string& option) {
  std::vector<std::size_t> same, ending;
  const std::filesystem::path meant = std::filesystem::path(given_value.file).lexically_normal();
  std::error_code ignored;
  for (std::size_t f = 0; f < files.size(); ++f) {
    const std::filesystem::path path = files[f].path.lexically_normal();
    const std::filesystem::path whole =
        std::filesystem::absolute(files[f].path, ignored).lexically_normal();
    if (given_value.of_all || path == meant || whole == meant) same.push_back(f);
    if (!given_value.file.empty() && ends_in(path, meant)) ending.push_back(f);
  }
  if (!same.empty()) return same;
  if (ending.empty())
    return usage("'" + given_value.file + "' is none of the files", option,
                 "write the path or the name of one, as part.stl=" + given_value.value);
  for (const std::size_t f : ending)
    if (files[f].path.lexically_normal() != files[ending.front()].path.lexically_normal())
      return usage("'" + given_value.file + "' may be " + files[ending.front()].path.string() +
                       " or " + files[f].path.string(),
                   option, "write more of the path");
  return ending;
}

/// Calls take(options, value) for every file that a value is given for; a value for one file takes
/// precedence over one for all.
template <class Take>
Status apply_file_values(const std::vector<std::string>& values, const std::string& option,
                         std::vector<io::FileToRead>& files, const Take& take) {
  for (const bool of_all : {true, false}) {
    std::vector<bool> taken(files.size());
    for (const std::string& text : values) {
      const FileValue given_value(text);
      if (given_value.of_all != of_all) continue;
      const auto meant = files_meant(given_value, files, option);
      if (!meant) return meant.error();
      for (const std::size_t f : *meant) {
        if (taken[f])
          return usage(of_all ? "is given more than once for all files"
                              : "is given more than once for " + files[f].path.string(),
                       option, "give it once; FILE=" + given_value.value + " is of one file");
        taken[f] = true;
        if (Status status = take(files[f].options, given_value.value); !status) return status;
      }
    }
  }
  return {};
}

}  // namespace

io::UpAxis up_axis_of(char letter) {
  return letter == 'x' ? io::UpAxis::x : letter == 'y' ? io::UpAxis::y : io::UpAxis::z;
}

Result<std::vector<io::FileToRead>> files_to_read(const InputOptions& options) {
  std::vector<io::FileToRead> files;
  for (const std::string& file : options.files) {
    files.push_back({file, {}});
    files.back().options.on_map = options.georeference;
  }
  Status status = apply_file_values(
      options.units, "--unit", files, [](io::ReadOptions& read, const std::string& text) -> Status {
        const Result<double> unit = quantity_option(text, "--unit", parse_unit_mm);
        if (!unit) return unit.error();
        read.unit_mm = *unit;
        return {};
      });
  if (!status) return status.error();
  status = apply_file_values(options.up_axes, "--up-axis", files,
                             [](io::ReadOptions& read, const std::string& text) -> Status {
                               if (text != "x" && text != "y" && text != "z")
                                 return usage("'" + text + "' is not one of x|y|z", "--up-axis",
                                              "write x, y or z");
                               read.up_axis = up_axis_of(text.front());
                               return {};
                             });
  if (!status) return status.error();
  return files;
}

Result<std::vector<double>> coordinates_option(const std::string& text, std::size_t count,
                                               const std::string& option,
                                               const std::string& example) {
  const std::string mend =
      "write " + example + " in millimetres, or with units, as 4.5m; decimals with a point";
  const auto commas = static_cast<std::size_t>(std::ranges::count(text, ','));
  if (commas + 1 != count)
    return usage(fmt::format("'{}' has {} coordinate{}, not {}", text, commas + 1,
                             commas == 0 ? "" : "s", count),
                 option, mend);
  std::vector<double> coordinates;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const Result<double> one =
        quantity_option(text.substr(at, comma - at), option, parse_coordinate_mm);
    if (!one) return usage(one.error().message + " of '" + text + "'", option, one.error().mend);
    coordinates.push_back(*one);
    at = comma + 1;
  }
  return coordinates;
}

Status length_option(double& value, const std::string& text, const std::string& option) {
  if (text.empty()) return {};
  const Result<double> length = quantity_option(text, option, parse_distance_mm);
  if (!length) return length.error();
  value = *length;
  return {};
}

Status whole_number(std::uint64_t& value, const std::string& text, const std::string& option) {
  if (text.empty()) return {};
  const auto number = parse_integer(text);
  if (!number || *number < 0)
    return Error{ErrorCode::usage, "'" + text + "' is no whole number", option,
                 "write digits only, as 20000, up to 9223372036854775807"};
  value = static_cast<std::uint64_t>(*number);
  return {};
}

Status check_no_empty_values(const CLI::App& command) {
  for (const CLI::Option* const option : command.get_options()) {
    if (option->get_type_name().ends_with(kOrEmpty)) continue;
    for (const std::string& value : option->results())
      if (value.empty())
        return usage("the value is empty",
                     option->get_positional() ? option->get_type_name() : option->get_name(),
                     option->get_positional() ? "give a value, or leave it out"
                                              : "give a value, or leave the option out");
  }
  for (const CLI::App* const inner : command.get_subcommands())
    if (Status status = check_no_empty_values(*inner); !status) return status;
  return {};
}

Result<double> quantity_option(const std::string& text, const std::string& option,
                               Result<double> (*parse)(std::string_view)) {
  const Result<double> value = parse(text);
  if (value) return *value;
  Error error = value.error();
  error.where = option;
  return error;
}

}  // namespace strake::cli
