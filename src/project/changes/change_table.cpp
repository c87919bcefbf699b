// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/text/counted.hpp"
#include "core/text_encoding.hpp"
#include "report/text/columns.hpp"
#include "report/text/formatting.hpp"
#include "strake/project/update.hpp"

namespace strake::project {
namespace {

/// As people read it; scripts have change_name().
std::string_view kind_title(ChangeKind kind) {
  return kind == ChangeKind::reattributed ? "re-attributed" : change_name(kind);
}

/// Returns a line for a file that came or went.
std::string file_lines(const Changes& changes) {
  std::string text = report::file_matches_text(changes.files);
  const auto add = [&](std::string_view what, const std::vector<std::string>& labels) {
    for (const std::string& label : labels) text += fmt::format("{} {}\n", what, printable(label));
  };
  add("file added:  ", changes.files.only_after);
  add("file removed:", changes.files.only_before);
  return text;
}

std::string object_line(const ObjectChange& change, std::size_t width) {
  const ObjectChange::Name& name = change.name();
  std::string text = fmt::format("{}: {}", name.file, name.id);
  if (!name.name.empty() && name.name != name.id) text += fmt::format(" ({})", name.name);
  if (change.is(ChangeKind::renamed)) text += fmt::format(", was {}", change.before.id);
  constexpr std::size_t kIndent = 2;
  const std::size_t room = std::max<std::size_t>(width, kIndent + 20) - kIndent;
  const std::size_t columns = std::min(report::columns_in(printable(text)), room);
  return report::ended(std::string(kIndent, ' ') + report::fit_to_columns(text, columns));
}

std::string kind_lines(const Changes& changes, ChangeKind kind, const ChangesTable& table) {
  const std::uint64_t count = changes.count(kind);
  if (count == 0) return {};
  std::string text = fmt::format("{}: {}\n", kind_title(kind), counted(count, "object"));
  std::size_t shown = 0;
  for (const ObjectChange& change : changes.objects) {
    if (!change.is(kind)) continue;
    if (shown == table.rows) break;
    ++shown;
    text += object_line(change, table.width);
  }
  if (shown > 0 && count > shown) text += fmt::format("  … and {} more\n", count - shown);
  return text;
}

}  // namespace

std::string changes_text(const Changes& changes, const ChangesTable& table) {
  std::string text = file_lines(changes);
  for (std::size_t k = 0; k < kChangeKinds; ++k)
    text += kind_lines(changes, static_cast<ChangeKind>(k), table);
  return text + fmt::format("unchanged: {}\n", counted(changes.unchanged, "object"));
}

}  // namespace strake::project
