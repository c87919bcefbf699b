// SPDX-License-Identifier: Apache-2.0
#include "cli/run/file_settings.hpp"

#include <cstddef>

#include "cli/options/options.hpp"
#include "core/text_encoding.hpp"
#include "io/source/units_and_axes.hpp"
#include "rules/rule_context.hpp"

namespace strake::cli {

namespace {

/// Takes what a table says of a file and what nobody has said of it before; returns whether that is
/// anything.
bool take_settings(const rules::FileSettings& from, io::ReadOptions& options) {
  bool some = false;
  if (from.unit_mm && !options.unit_mm) {
    options.unit_mm = from.unit_mm;
    some = true;
  }
  if (from.up_axis && !options.up_axis) {
    options.up_axis = up_axis_of(*from.up_axis);
    some = true;
  }
  return some;
}

/// Returns the name of a unit that a table may say.
std::string unit_name(double unit_mm) {
  const std::string text = io::unit_text({.unit_mm = unit_mm, .up_axis = {}, .encoding = {}}, {});
  return text.substr(0, text.find(" ("));
}

/// Returns the name of the unit in which a file was read: nothing of whether it was stated.
std::string unit_read(const project::StoredFile& file) {
  return file.source.unit.substr(0, file.source.unit.find(" ("));
}

}  // namespace

void apply_file_settings(std::span<const rules::FileSettings> settings,
                         std::vector<io::FileToRead>& files) {
  for (const rules::FileSettings& one : settings)
    for (io::FileToRead& file : files)
      if (one.is_of(file.path)) take_settings(one, file.options);
}

Diagnostics idle_file_settings(std::span<const rules::FileSettings> settings,
                               const std::vector<std::filesystem::path>& files) {
  Diagnostics diagnostics;
  std::vector<io::ReadOptions> settings_of(files.size());
  for (const rules::FileSettings& one : settings) {
    bool matches = false, some = false;
    for (std::size_t f = 0; f < files.size(); ++f) {
      if (!one.is_of(files[f])) continue;
      matches = true;
      some = take_settings(one, settings_of[f]) || some;
    }
    if (!matches)
      diagnostics.add(Severity::warning, rules::kMatchesNothing,
                      "no file of the run has such a name", one.where);
    else if (!some)
      diagnostics.add(Severity::warning, rules::kShadowed,
                      "earlier [[file]] tables say as much of every file that it is about",
                      one.where);
  }
  return diagnostics;
}

Status check_file_settings(std::span<const rules::FileSettings> settings,
                           const std::vector<project::StoredFile>& files,
                           const std::string& project) {
  for (const project::StoredFile& file : files) {
    std::vector<io::FileToRead> settings_of{{file.path, {}}};
    apply_file_settings(settings, settings_of);
    const io::ReadOptions& options = settings_of.front().options;
    const auto error = [&](const std::string& read, const std::string& rule,
                           const std::string& option) {
      return Error{
          ErrorCode::usage,
          in_quotes(file.source.label) + " was read " + read +
              ", and a [[file]] table of the rules says " + rule,
          project,
          "read it so: strake project update " + project + ' ' + file.path.string() + ' ' + option};
    };
    if (options.unit_mm) {
      const std::string unit = unit_name(*options.unit_mm);
      if (unit != unit_read(file))
        return error("with the unit " + unit_read(file), unit, "--unit " + unit);
    }
    if (options.up_axis) {
      const std::string axis = io::up_axis_text(*options.up_axis);
      if (axis != file.source.up_axis)
        return error("with " + file.source.up_axis + " up", axis, "--up-axis " + axis);
    }
  }
  return {};
}

}  // namespace strake::cli
