// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "core/number.hpp"
#include "core/text_encoding.hpp"
#include "report/text/formatting.hpp"
#include "strake/report/clash.hpp"

namespace strake::report {
namespace {

using clash::Pair;
using clash::Report;

constexpr std::size_t kClassColumns = 9, kNumberColumns = 10, kRelationColumns = 12;
constexpr std::size_t kVolumeColumns = 14;
constexpr std::size_t kFixedColumns = kClassColumns + kNumberColumns + kRelationColumns + 8;
constexpr std::size_t kLeastName = 8;
/// The widest bracket that is not shown: the grid alone may account for it, as for BORDERLINE, so d
/// is known as well as its digits say, and nearly all meshes and primitives have such a bracket.
constexpr double kUntoldWidthMm = 0.008;

/// The pairs of a class that no rule allows by d, then durable order, as many as are shown.
struct TableBlock {
  std::vector<std::size_t> pairs;
  std::size_t hidden = 0;
};

TableBlock worst_of(const Report& report, clash::Class cls, std::size_t rows, clash::SortBy sort) {
  TableBlock block;
  for (std::size_t i = 0; i < report.pairs.size(); ++i)
    if (report.pairs[i].cls == cls && report.pairs[i].allowed < 0) block.pairs.push_back(i);
  const std::size_t shown = std::min(rows, block.pairs.size());
  const auto volume = [&](std::size_t i) {
    return sort == clash::SortBy::volume ? report.pairs[i].volume_mm3.value_or(0) : 0;
  };
  std::partial_sort(block.pairs.begin(), block.pairs.begin() + static_cast<std::ptrdiff_t>(shown),
                    block.pairs.end(), [&](std::size_t i, std::size_t j) {
                      return std::tuple(-volume(i), report.pairs[i].d_mm, i) <
                             std::tuple(-volume(j), report.pairs[j].d_mm, j);
                    });
  block.hidden = block.pairs.size() - shown;
  block.pairs.resize(shown);
  return block;
}

struct ClassRows {
  clash::Class cls;
  std::string_view one, many;
  std::size_t count, listed, rows;
};

/// Returns the rows of each class: a fifth for each, so that none hides the others, and the rest to
/// those that need a decision before those that are mostly meant.
std::array<ClassRows, 3> shares(const Report& report, std::size_t rows) {
  constexpr std::size_t kParts = 5;
  std::array<ClassRows, 3> all{{
      {clash::Class::hit, "hit", "hits", report.count_hit, report.count_hit, 0},
      {clash::Class::contact, "contact", "contacts", report.count_contact,
       report.count_contact - report.unlisted.contacts, 0},
      {clash::Class::clearance_violation, "clearance violation", "clearance violations",
       report.count_clearance, report.count_clearance, 0},
  }};
  const auto give = [&](ClassRows& c, std::size_t most) {
    const std::size_t given = std::min({most, rows, c.listed - c.rows});
    c.rows += given;
    rows -= given;
  };
  const std::size_t share = std::max<std::size_t>(1, rows / kParts);
  for (ClassRows& c : all) give(c, share);
  for (const std::size_t i : {std::size_t{0}, std::size_t{2}, std::size_t{1}}) give(all[i], rows);
  return all;
}

std::string right_aligned(std::string text, std::size_t columns) {
  if (text.size() < columns) text.insert(0, columns - text.size(), ' ');
  return text;
}

void strip(std::string& line) {
  while (!line.empty() && line.back() == ' ') line.pop_back();
}

struct TableRow {
  std::string_view cls;
  std::string d, range, volume;
  std::string_view relation, a, b;
};

/// The widths of the columns; a column that is 0 wide is left out.
struct Columns {
  std::size_t range = 0, volume = 0, names = kLeastName;
};

std::string text_of(const TableRow& row, const Columns& columns) {
  const auto number = [](const std::string& text, std::size_t width) {
    return width == 0 ? std::string() : right_aligned(text, width) + "  ";
  };
  std::string line = fit_to_columns(row.cls, kClassColumns) + "  " + number(row.d, kNumberColumns) +
                     number(row.range, columns.range) + number(row.volume, columns.volume) +
                     fit_to_columns(row.relation, kRelationColumns) + "  " +
                     fit_to_columns(row.a, columns.names) + "  " +
                     fit_to_columns(row.b, columns.names);
  strip(line);
  return line + "\n";
}

/// Returns the bracket of d, rounded outward, where d may be another number than its digits say.
std::string range_of(const Pair& p) {
  if (!(p.d_upper_mm - p.d_lower_mm > kUntoldWidthMm)) return {};
  constexpr int kDigits = 3;
  constexpr double kSteps = 1000;
  // Adding zero avoids "-0.000".
  return "[" + fixed(std::floor(p.d_lower_mm * kSteps) / kSteps + 0.0, kDigits) + ", " +
         fixed(std::ceil(p.d_upper_mm * kSteps) / kSteps + 0.0, kDigits) + "]";
}

std::string_view label(const model::Model& model, model::ObjectId id) {
  const model::Object& o = model.object(id);
  return o.name.empty() ? o.id : o.name;
}

std::string counted(std::uint64_t n, std::string_view one, std::string_view many) {
  return std::to_string(n) + ' ' + std::string(n == 1 ? one : many);
}

std::string counted(const ClassRows& c, std::size_t n) { return counted(n, c.one, c.many); }

/// Returns how many results brackets leave open: the classes counted are those of the nominal d.
std::string uncertain(const Report& report) {
  std::uint64_t all = 0, worse = 0;
  for (const Pair& p : report.pairs) {
    if ((p.flags & clash::kUncertain) != 0) ++all;
    if (p.severest > (p.allowed < 0 ? p.cls : clash::Class::no_hit)) ++worse;
  }
  if (all == 0) return {};
  return "; UNCERTAIN: " + counted(all, "result", "results") +
         (worse == 0 ? "" : ", " + std::to_string(worse) + " may be of a severer class");
}

/// Returns what a report without hits may hide.
std::string not_compared(const Report& report, const model::Model& model) {
  if (report.objects_a == 0 || report.objects_b == 0)
    return std::string("; not compared: anything, as set ") + (report.objects_a == 0 ? "A" : "B") +
           " is empty";
  const clash::NotComparedCounts lacks = clash::counts_of({&report, 1});
  std::string text;
  if (lacks.pairs > 0) text = counted(lacks.pairs, "pair", "pairs");
  if (lacks.objects > 0)
    text += (text.empty() ? "" : ", ") + std::string("all or part of ") +
            counted(lacks.objects, "object", "objects");
  if (const std::string rest = unread_rest(model); !rest.empty())
    text += (text.empty() ? "" : ", ") + printable(rest);
  return text.empty() ? text : "; not compared: " + text;
}

/// Returns how many pairs each rule of a profile left out and allowed, and how many of the results
/// are soft, in one line.
std::string profile_line(const Report& report, std::string_view profile) {
  std::string left_out, allowed;
  const auto add = [](std::string& text, std::uint64_t pairs, std::string_view rule) {
    if (pairs > 0)
      text += (text.empty() ? "" : ", ") + counted(pairs, "pair", "pairs") + " (" +
              printable(rule) + ")";
  };
  for (const clash::Exempted& e : report.exempted) add(left_out, e.pairs, e.rule);
  for (const clash::AllowedCount& a : report.allowed) add(allowed, a.pairs, a.rule);
  std::uint64_t soft = 0, insulation = 0;
  for (const Pair& p : report.pairs) {
    if (p.allowed >= 0) continue;
    const auto is_of = [&](clash::Level level) { return p.level_a == level || p.level_b == level; };
    if (is_of(clash::Level::soft))
      ++soft;
    else if (is_of(clash::Level::insulation))
      ++insulation;
  }
  std::string line = "left out by profile " + printable(profile) + ": " +
                     (left_out.empty() ? "nothing" : left_out);
  if (!allowed.empty()) line += "; allowed: " + allowed;
  if (soft > 0) line += "; with space kept free: " + counted(soft, "result", "results");
  if (insulation > 0) line += "; with insulation: " + counted(insulation, "result", "results");
  return line + "\n";
}

std::string summary_of(const Report& report, const model::Model& model,
                       const std::array<ClassRows, 3>& classes, std::string_view profile) {
  std::string summary;
  for (const ClassRows& c : classes) {
    summary += (summary.empty() ? "" : ", ") + counted(c, c.count);
    if (c.listed < c.count) summary += " (" + std::to_string(c.count - c.listed) + " not listed)";
  }
  if (report.count_allowed > 0) summary += ", " + std::to_string(report.count_allowed) + " allowed";
  if (report.count_allowed_regions > 0)
    summary +=
        ", " + counted(report.count_allowed_regions, "place", "places") + " of others allowed";
  for (const clash::Exempted& e : report.exempted)
    if (e.pairs > 0 && profile.empty())
      summary += ", " + std::to_string(e.pairs) + " exempted by " + printable(e.rule);
  summary += uncertain(report) + not_compared(report, model) + "\n";
  return profile.empty() ? summary : summary + profile_line(report, profile);
}

std::string cell_row(std::string_view cell, const std::array<std::string, 4>& counts,
                     std::size_t cell_columns) {
  std::string line = fit_to_columns(cell, cell_columns);
  for (const std::string& count : counts) line += "  " + right_aligned(count, kNumberColumns);
  return line + "\n";
}

/// Returns the cells of a matrix in which something was found.
std::string matrix_table(const Report& report, std::size_t width) {
  constexpr std::size_t kCounts = 4 * (kNumberColumns + 2), kMost = 40;
  const std::size_t columns = std::clamp(width - std::min(width, kCounts), kLeastName, kMost);
  std::string out;
  for (const clash::CellReport& c : report.cells) {
    if (c.hit + c.contact + c.clearance_violation + c.allowed == 0) continue;
    if (out.empty())
      out = cell_row("disciplines", {"hits", "contacts", "clearance", "allowed"}, columns);
    out += cell_row(report.disciplines[c.a].name + " x " + report.disciplines[c.b].name,
                    {std::to_string(c.hit), std::to_string(c.contact),
                     std::to_string(c.clearance_violation), std::to_string(c.allowed)},
                    columns);
  }
  return out.empty() ? out : out + "\n";
}

/// Returns the columns; brackets have one where one of them is worth showing.
Columns columns_of(const Report& report, const std::array<TableBlock, 3>& blocks,
                   const TableOptions& options) {
  Columns columns;
  for (const TableBlock& block : blocks)
    for (const std::size_t i : block.pairs)
      columns.range = std::max(columns.range, range_of(report.pairs[i]).size());
  if (options.sort == clash::SortBy::volume) columns.volume = kVolumeColumns;
  std::size_t taken = kFixedColumns;
  for (const std::size_t width : {columns.range, columns.volume})
    taken += width > 0 ? width + 2 : 0;
  const std::size_t room = options.width > taken ? options.width - taken : 0;
  columns.names = std::max(kLeastName, room / 2);
  return columns;
}

std::string test_table(const Report& report, const model::Model& model, const TableOptions& options,
                       std::string_view profile) {
  const std::array<ClassRows, 3> classes = shares(report, options.rows);
  std::array<TableBlock, 3> blocks;
  for (std::size_t c = 0; c < classes.size(); ++c)
    blocks[c] = worst_of(report, classes[c].cls, classes[c].rows, options.sort);
  const Columns columns = columns_of(report, blocks, options);
  std::string out;
  if (!report.pairs.empty())
    out += text_of({"class", "d mm", "d range mm", "volume mm3", "relation", "a", "b"}, columns);
  for (std::size_t c = 0; c < classes.size(); ++c) {
    for (const std::size_t i : blocks[c].pairs) {
      const Pair& p = report.pairs[i];
      out += text_of({short_class_name(p.cls), fixed(p.d_mm, 3), range_of(p),
                      p.volume_mm3 ? fixed(*p.volume_mm3, 1) : "-", name(p.relation),
                      label(model, p.a), label(model, p.b)},
                     columns);
    }
    if (blocks[c].hidden > 0) out += "… and " + counted(classes[c], blocks[c].hidden) + " more\n";
  }
  if (!report.pairs.empty()) out += "\n";
  return out + matrix_table(report, options.width) + summary_of(report, model, classes, profile);
}

std::string group_row(std::string_view cls, std::string d, std::string results, std::string size,
                      std::string_view name) {
  std::string line = fit_to_columns(cls, kClassColumns) + "  " +
                     right_aligned(std::move(d), kNumberColumns) + "  " +
                     right_aligned(std::move(results), kNumberColumns) + "  " +
                     right_aligned(std::move(size), kNumberColumns) + "  " + std::string(name);
  strip(line);
  return line + "\n";
}

std::string group_table(const clash::Grouping& grouping, const TableOptions& options) {
  constexpr std::size_t kFixed = kClassColumns + 3 * kNumberColumns + 8;
  const std::size_t room =
      options.width > kFixed + kLeastName ? options.width - kFixed : kLeastName;
  const std::vector<clash::Group>& groups = grouping.groups;
  std::string out = group_row("class", "d mm", "results", "size m", name(grouping.rules.by));
  const std::size_t shown = std::min(options.rows, groups.size());
  for (std::size_t g = 0; g < shown; ++g) {
    const geometry::Vec3d d = groups[g].box_mm.hi - groups[g].box_mm.lo;
    out +=
        group_row(short_class_name(groups[g].worst), fixed(groups[g].d_mm, 3),
                  std::to_string(groups[g].results.size()),
                  fixed(std::max({d.x, d.y, d.z}) / 1000, 1), fit_to_columns(groups[g].name, room));
  }
  if (shown < groups.size()) {
    const std::size_t more = groups.size() - shown;
    out += "… and " + std::to_string(more) + (more == 1 ? " group more\n" : " groups more\n");
  }
  return out + "\n";
}

}  // namespace

std::string clash_table(const ClashContents& contents, const TableOptions& options) {
  std::string out;
  const bool grouped = contents.grouping != nullptr && !contents.grouping->groups.empty();
  if (grouped) out = group_table(*contents.grouping, options);
  const std::string_view profile =
      contents.rules != nullptr ? std::string_view(contents.rules->profile) : std::string_view();
  bool first = true;
  for (const Report& test : contents.findings.tests) {
    if (!first && contents.grouping == nullptr) out += "\n";
    first = false;
    if (!test.name.empty()) out += "== " + printable(test.name) + "\n";
    out += contents.grouping != nullptr
               ? matrix_table(test, options.width) +
                     summary_of(test, contents.model, shares(test, 0), profile)
               : test_table(test, contents.model, options, profile);
  }
  return out;
}

}  // namespace strake::report
