// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/output_format.hpp"
#include "strake/core/result.hpp"
#include "strake/io/reader.hpp"
#include "strake/parallel/context.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own name
class App;
class Option;
}  // namespace CLI

namespace strake::cli {

/// The options that every verb has, as written; `distribution` and those of clusters are of some
/// only.
struct CommonOptions {
  std::string threads, distribution;
  std::string scheduler;                                   ///< empty: this process does the work
  std::string worker_memory, worker_threads, tile_folder;  ///< for --scheduler
  bool quiet = false, stats = false, json = false;
};

/// The options of the verbs that read models, as written.
struct InputOptions {
  std::vector<std::string> files;
  std::vector<std::string> units, up_axes;  ///< "mm" for all files, "part.stl=m" for one
  bool strict = false, georeference = false;
};

void add_common_options(CLI::App& command, CommonOptions& options);
/// Adds --scheduler and what goes with it, for verbs that Python's strake.cluster has.
void add_scheduler_options(CLI::App& command, CommonOptions& options);
/// Adds --distribution, for verbs whose work is worth a comparison.
void add_distribution_option(CLI::App& command, CommonOptions& options);
void add_input_options(CLI::App& command, InputOptions& options);
/// Adds --georeference, for verbs that read files for one run.
void add_georeference_option(CLI::App& command, InputOptions& options);
/// Adds -o FILE, which may be given several times: "`what` as .json or .csv; may be repeated".
void add_output_option(CLI::App& command, std::vector<std::string>& files, std::string_view what,
                       std::span<const OutputFormat> formats);
/// Adds --match-files of a comparison.
CLI::Option* add_match_files_option(CLI::App& command, std::vector<std::string>& pairs);
/// Adds an option whose value is one of a few words.
CLI::Option* add_choice(CLI::App& command, const std::string& name, std::string& value,
                        const std::vector<std::string>& words, const std::string& help);
/// Lets `value` be given by a name that its option had before, which no help, page or completion
/// shows.
void add_former_name(CLI::App& command, const std::string& name, std::string& value);

/// Lets an option be given several times, with one value each.
CLI::Option* may_repeat(CLI::Option* option);

/// The end of the type of an option for which an empty value has a meaning of its own.
inline constexpr std::string_view kOrEmpty = "|''";

/// Returns an error where an option of the command, or of the one within it, was given an empty
/// value, but for types that end in kOrEmpty: an unset variable of a script is no default.
[[nodiscard]] Status check_no_empty_values(const CLI::App& command);

/// Returns the number of workers requested, or the machine's own.
[[nodiscard]] Result<unsigned> worker_count(const CommonOptions& options);
/// Returns how the regions of the run share their items out.
[[nodiscard]] parallel::Distribution distribution_of(const CommonOptions& options);
/// Returns the axis of one of the letters x, y and z.
[[nodiscard]] io::UpAxis up_axis_of(char letter);
/// Returns the files, each with the options given for it or for all.
[[nodiscard]] Result<std::vector<io::FileToRead>> files_to_read(const InputOptions& options);

/// Parses "x,y,z" as three coordinates of the model, and so on; an error names the option.
[[nodiscard]] Result<std::vector<double>> coordinates_option(const std::string& text,
                                                             std::size_t count,
                                                             const std::string& option,
                                                             const std::string& example);
/// Parses a distance that is an option of the command line; overwrites `value` where it was given.
[[nodiscard]] Status length_option(double& value, const std::string& text,
                                   const std::string& option);

/// Parses a whole number that is an option of the command line; overwrites `value` where it was
/// given.
[[nodiscard]] Status whole_number(std::uint64_t& value, const std::string& text,
                                  const std::string& option);

/// Parses a length, angle or scale by its own parser, with the option named in the error.
[[nodiscard]] Result<double> quantity_option(const std::string& text, const std::string& option,
                                             Result<double> (*parse)(std::string_view));

}  // namespace strake::cli
