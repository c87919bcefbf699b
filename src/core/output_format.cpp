// SPDX-License-Identifier: Apache-2.0
#include "core/output_format.hpp"

#include <filesystem>
#include <optional>

#include "core/text_encoding.hpp"

namespace strake {

std::string suffix_of(const std::string& file) {
  return lowered(std::filesystem::path(file).extension().string());
}

Result<std::size_t> format_number(std::span<const OutputFormat> formats, const std::string& file) {
  const std::string name = lowered(std::filesystem::path(file).filename().string());
  std::optional<std::size_t> longest;
  for (std::size_t i = 0; i < formats.size(); ++i) {
    const std::string_view suffix = formats[i].suffix;
    if (name.size() <= suffix.size() || !name.ends_with(suffix)) continue;
    if (!longest || suffix.size() > formats[*longest].suffix.size()) longest = i;
  }
  if (longest) return *longest;
  return Error{ErrorCode::usage,
               "the format of '" + file + "' is not known",
               {},
               "end its name in " + list_suffixes(formats, "or")};
}

std::string list_suffixes(std::span<const OutputFormat> formats, std::string_view word) {
  std::string list;
  for (const OutputFormat& format : formats) {
    if (!list.empty()) list.append(" ").append(word).append(" ");
    list += format.suffix;
  }
  return list;
}

std::string describe_formats(std::string_view what, std::span<const OutputFormat> formats) {
  constexpr std::string_view kPlace = "{}";
  std::string text(what);
  for (const OutputFormat& format : formats) {
    std::string help(format.help);
    if (const std::size_t at = help.find(kPlace); at != std::string::npos)
      help.replace(at, kPlace.size(), format.suffix);
    text += help;
  }
  return text;
}

}  // namespace strake
