// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "strake/core/result.hpp"

/// Each kind of output (drawings, clash results, models ...) has one table of writers. A row is a
/// struct with a member `format` and a function that writes; the suffix of a file's name picks the
/// row, the longest that fits: a table may have ".json" and ".ifcclash.json". Help and errors are
/// made from the table, so a new format is one row and what writes it.
namespace strake {

/// What a table says of one format.
struct OutputFormat {
  std::string_view suffix;  ///< in lower case, with its dots: ".svg"
  /// How the format continues the help on outputs, "{}" for its suffix: ", or a picture as {}".
  std::string_view help = {};
};

/// The suffix of a file name in lower case: ".svg".
[[nodiscard]] std::string suffix_of(const std::string& file);

/// The formats of a table, in its order.
template <class Writer>
[[nodiscard]] std::vector<OutputFormat> formats_of(std::span<const Writer> table) {
  std::vector<OutputFormat> formats;
  for (const Writer& writer : table) formats.push_back(writer.format);
  return formats;
}

/// The number of the format that a file's name requests. Errors: usage, for a suffix that none of
/// them has; its `where` is left to the caller, who knows the option that named the file.
[[nodiscard]] Result<std::size_t> format_number(std::span<const OutputFormat> formats,
                                                const std::string& file);

/// The writer that a file's name requests. Errors: those of format_number().
template <class Writer>
[[nodiscard]] Result<Writer> find_writer(std::span<const Writer> table, const std::string& file) {
  const Result<std::size_t> number = format_number(formats_of(table), file);
  if (!number) return number.error();
  return table[*number];
}

/// ".svg or .json": the suffixes with a word between each two.
[[nodiscard]] std::string list_suffixes(std::span<const OutputFormat> formats,
                                        std::string_view word);

/// "Result as .json or .csv": what is written, continued by the help of each format.
[[nodiscard]] std::string describe_formats(std::string_view what,
                                           std::span<const OutputFormat> formats);

}  // namespace strake
