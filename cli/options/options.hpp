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

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own name
class App;
class Option;
}  // namespace CLI

namespace strake::cli {

/// Options that every verb has, as written.
struct CommonOptions {
  std::string threads;
  bool quiet = false, stats = false, json = false;
};

/// Options of the verbs that read models, as written.
struct InputOptions {
  std::vector<std::string> files;
  std::vector<std::string> units, up_axes;  ///< "mm" of all files, "part.stl=m" of one
  bool strict = false;
};

void add_common_options(CLI::App& command, CommonOptions& options);
void add_input_options(CLI::App& command, InputOptions& options);
/// -o FILE, may be given several times: "`what` as .json or .csv; may be repeated".
void add_output_option(CLI::App& command, std::vector<std::string>& files, std::string_view what,
                       std::span<const OutputFormat> formats);
/// An option whose value is one of a few words.
CLI::Option* add_choice(CLI::App& command, const std::string& name, std::string& value,
                        const std::vector<std::string>& words, const std::string& help);

/// An error where an option of the command, or of the one within it, was given an empty value: an
/// unset variable of a script is no default.
[[nodiscard]] Status check_no_empty_values(const CLI::App& command);

/// The number of workers asked for, or the machine's own.
[[nodiscard]] Result<unsigned> worker_count(const CommonOptions& options);
/// The files, each with what was said of it or of all.
[[nodiscard]] Result<std::vector<io::FileToRead>> files_to_read(const InputOptions& options);

/// "x,y,z" as three numbers, and so on; an error names the option.
[[nodiscard]] Result<std::vector<double>> number_list(const std::string& text, std::size_t count,
                                                      const std::string& option,
                                                      const std::string& example);
/// Whether every file of -o is of one of the formats and can be written where it is to stand, and
/// is neither one of `inputs` nor named twice.
[[nodiscard]] Status check_outputs(const std::vector<std::string>& files,
                                   std::span<const OutputFormat> formats,
                                   const std::vector<std::string>& inputs);
/// The same of a file that another option names: it is none of those of -o either.
[[nodiscard]] Status check_other_output(const std::string& option, const std::string& file,
                                        const OutputFormat& format,
                                        const std::vector<std::string>& inputs,
                                        const std::vector<std::string>& outputs);
/// A length that is an option of the command line: overwrites `value` where it was given.
[[nodiscard]] Status length_option(double& value, const std::string& text,
                                   const std::string& option);

/// A whole number that is an option of the command line: overwrites `value` where it was given.
[[nodiscard]] Status whole_number(std::uint64_t& value, const std::string& text,
                                  const std::string& option);

/// A length, angle or scale by its own parser, with the option named in the error.
[[nodiscard]] Result<double> quantity_option(const std::string& text, const std::string& option,
                                             Result<double> (*parse)(std::string_view));

}  // namespace strake::cli
