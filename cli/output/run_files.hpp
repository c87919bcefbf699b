// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/output_format.hpp"
#include "strake/core/result.hpp"
#include "strake/io/reader.hpp"
#include "strake/parallel/context.hpp"

namespace strake::cli {

/// All files of a run. Whoever reads a file says so here, and so does every option that names an
/// output: whichever comes later is refused where the two are one file, by whatever names, since
/// nothing that is written may take the place of what is read.
class RunFiles {
 public:
  /// Adds a file that is read. Errors: usage where an output would overwrite it.
  [[nodiscard]] Status add_input(const std::filesystem::path& file);
  [[nodiscard]] Status add_inputs(const std::vector<std::string>& files);
  /// Adds a project with the write log beside it. Errors: those of add_input().
  [[nodiscard]] Status add_project(const std::filesystem::path& file);
  /// Adds a model file with those that its head tells are read with it, as the attributes of an RVM
  /// file. The rest is looked for where an output exists that may be such a file: no text that
  /// names no material, as results of an earlier run are. Errors: those of add_input(); a file that
  /// cannot be read is left to its reader.
  [[nodiscard]] Status add_model(const std::filesystem::path& file,
                                 const parallel::Context& context);

  /// Adds an output that `option` names. Errors: usage where it is of none of the formats, is read,
  /// or is an output already; output where it cannot be written.
  [[nodiscard]] Status add_output(const std::string& option, const std::string& file,
                                  std::span<const OutputFormat> formats);
  /// Adds the files of -o. Errors: those of add_output().
  [[nodiscard]] Status add_outputs(const std::vector<std::string>& files,
                                   std::span<const OutputFormat> formats);

  /// Checks a file that is to be written at once, whether or not an option names it. Errors: usage
  /// where it is read.
  [[nodiscard]] Status check(const std::filesystem::path& target) const;

 private:
  /// What a name leads to.
  struct Place {
    std::filesystem::path path;                                        ///< in full, without links
    std::optional<std::pair<std::uint64_t, std::uint64_t>> node = {};  ///< device and number

    [[nodiscard]] static Place of(const std::filesystem::path& file);
    [[nodiscard]] bool is(const Place& other) const;
  };
  struct Input {
    Place place;
    std::string read_with;  ///< the model file that it belongs to; empty: none
  };
  struct Output {
    std::string option, file;
    Place place;
  };

  [[nodiscard]] Status add(const std::filesystem::path& file, const std::string& read_with);
  [[nodiscard]] Status add_companions(const io::FileBytes& file, const parallel::Context& context);
  [[nodiscard]] Status add_all_companions(const std::filesystem::path& file,
                                          const parallel::Context& context);
  [[nodiscard]] static Error overwritten(const std::string& file, const Input& input,
                                         const std::string& option);

  std::vector<Input> inputs_;
  std::vector<Output> outputs_;
};

}  // namespace strake::cli
