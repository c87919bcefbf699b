// SPDX-License-Identifier: Apache-2.0
#include "cli/run/file_settings.hpp"

#include <cstddef>

#include "cli/options/options.hpp"
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

}  // namespace

void apply_file_settings(std::span<const rules::FileSettings> settings,
                         std::vector<io::FileToRead>& files) {
  for (const rules::FileSettings& one : settings)
    for (io::FileToRead& file : files)
      if (one.is_of(file.path)) take_settings(one, file.options);
}

Diagnostics idle_file_settings(std::span<const rules::FileSettings> settings,
                               const std::vector<std::string>& files) {
  Diagnostics diagnostics;
  std::vector<io::ReadOptions> said(files.size());
  for (const rules::FileSettings& one : settings) {
    bool matches = false, some = false;
    for (std::size_t f = 0; f < files.size(); ++f) {
      if (!one.is_of(files[f])) continue;
      matches = true;
      some = take_settings(one, said[f]) || some;
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

}  // namespace strake::cli
