// SPDX-License-Identifier: Apache-2.0
#include "rules/file_settings.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/glob.hpp"
#include "core/units.hpp"

namespace strake::rules {
namespace {

/// Returns the end of a path that has so many '/' in it; the whole where it has no more.
std::string_view end_of(std::string_view path, std::ptrdiff_t slashes) {
  std::size_t at = path.rfind('/');
  for (; slashes > 0 && at != std::string_view::npos && at > 0; --slashes)
    at = path.rfind('/', at - 1);
  const bool whole = at == std::string_view::npos || (at == 0 && slashes > 0);
  return whole ? path : path.substr(at + 1);
}

FileSettings read_one(settings::ParseContext& reading, const settings::Value& value) {
  settings::TableReader table(reading, value, "[[file]]");
  FileSettings file;
  file.name = table.required_text("name");
  table.call(file.name);
  file.where = reading.file() + ", line " + std::to_string(value.at.line) + ": " + table.what();
  file.unit_mm = table.quantity("unit", parse_unit_mm, "a unit of length in quotes, as \"m\"");
  constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"};
  if (const auto axis = table.word("up_axis", kAxes)) file.up_axis = axis->front();
  if (!file.unit_mm && !file.up_axis)
    reading.fault(value.at, table.what() + " says nothing of the file",
                  "write unit = \"m\", or up_axis = \"y\"");
  return file;
}

}  // namespace

bool FileSettings::is_of(const std::filesystem::path& file) const {
  std::error_code ignored;
  const std::string path =
      std::filesystem::absolute(file, ignored).lexically_normal().generic_string();
  return glob_match(name, end_of(path, std::count(name.begin(), name.end(), '/')));
}

std::vector<FileSettings> read_file_settings(settings::ParseContext& reading,
                                             settings::TableReader& top) {
  std::vector<FileSettings> files;
  for (const settings::Value* value : top.tables("file"))
    files.push_back(read_one(reading, *value));
  return files;
}

}  // namespace strake::rules
