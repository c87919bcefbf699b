// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/text_encoding.hpp"
#include "report/text/formatting.hpp"
#include "strake/report/view_diff.hpp"

namespace strake::report {
namespace {

constexpr std::array<LineChange, kLineChanges> kColumns{LineChange::added, LineChange::gone,
                                                        LineChange::changed, LineChange::same};

std::string row(std::string_view name, std::size_t names, const LineCounts& counts) {
  std::string out = "  " + fit_to_columns(name, names);
  for (const LineChange change : kColumns)
    out += fmt::format("{:>12}", counts.at(static_cast<std::size_t>(change)).lines);
  return out + "\n";
}

std::string head(std::string_view title, std::size_t names) {
  std::string out = "  " + fit_to_columns(title, names);
  for (const LineChange change : kColumns) out += fmt::format("{:>12}", change_name(change));
  return out + "\n";
}

std::string settings_text(const ViewDiff& diff) {
  std::string out = file_matches_text(diff.files);
  const auto value_text = [](const std::string& value) {
    return value.empty() ? std::string("absent") : printable(value);
  };
  for (const ViewSettingChange& s : diff.settings)
    out += printable(s.setting) + ": was " + value_text(s.before) + ", is " + value_text(s.after) +
           "\n";
  return out.empty() ? out : out + "\n";
}

/// Returns the length of what is not the same.
double weight(const LineCounts& counts) {
  double length = 0;
  for (std::size_t c = 1; c < kLineChanges; ++c) length += counts.at(c).length_mm;
  return length;
}

std::string objects_text(const ViewDiff& diff, std::size_t names, std::size_t rows) {
  if (diff.by_object.empty()) return {};
  std::vector<std::pair<std::uint32_t, const LineCounts*>> objects;
  for (const auto& [object, counts] : diff.by_object) objects.emplace_back(object, &counts);
  std::ranges::sort(objects, {},
                    [](const auto& of) { return std::pair(-weight(*of.second), of.first); });
  std::string out = head("objects, lines", names);
  const std::size_t shown = std::min(rows, objects.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const ViewObject& object = *diff.objects[objects[i].first];
    out += row(object.name.empty() ? object.id : object.name, names, *objects[i].second);
  }
  if (shown < objects.size()) out += fmt::format("  … and {} more\n", objects.size() - shown);
  return out + "\n";
}

/// Says which lines are gone and new because their objects were left out as far from all others.
std::string left_out_text(const ViewDiff& diff) {
  const auto phrase = [](std::string_view why, const LineCount& count) {
    return count.lines == 0
               ? std::string()
               : fmt::format("{} their objects out as far from all others: {} ({:.3f} m)\n", why,
                             count.lines, count.length_mm / 1000);
  };
  return phrase("gone because the newer drawing leaves", diff.gone_left_out) +
         phrase("new because the older drawing left", diff.new_left_out);
}

}  // namespace

std::string view_diff_table(const ViewDiff& diff, const TableOptions& options) {
  constexpr std::size_t kNumbers = 12 * kLineChanges + 2, kMin = 26, kMax = 60;
  const std::size_t names =
      std::clamp(options.width > kNumbers ? options.width - kNumbers : kMin, kMin, kMax);
  std::string out = settings_text(diff);
  if (!diff.by_class.empty()) {
    out += head("classes, lines", names);
    for (const auto& [cls, counts] : diff.by_class)
      out +=
          row(fmt::format("{} {}", drawing::state_name(cls.second), drawing::kind_name(cls.first)),
              names, counts);
    out += "\n";
  }
  out += objects_text(diff, names, options.rows);
  std::string_view between;
  for (const LineChange change : kColumns) {
    const LineCount& count = diff.total.at(static_cast<std::size_t>(change));
    out += fmt::format("{}{} {} ({:.3f} m)", between, count.lines, change_name(change),
                       count.length_mm / 1000);
    between = ", ";
  }
  return out + "\n" + left_out_text(diff);
}

}  // namespace strake::report
