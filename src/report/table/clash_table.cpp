// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "core/number.hpp"
#include "core/text/counted.hpp"
#include "core/text_encoding.hpp"
#include "report/table/group_table.hpp"
#include "report/table/pair_table.hpp"
#include "report/text/columns.hpp"
#include "report/text/formatting.hpp"
#include "strake/report/clash.hpp"
#include "strake/report/decisions.hpp"

namespace strake::report {
namespace {

using clash::Pair;
using clash::Report;

constexpr std::size_t kNumberColumns = 10, kMinCell = 8;
/// The widest bracket that is not shown: the grid alone may account for it, as for BORDERLINE, so d
/// is known as well as its digits say, and nearly all meshes and primitives have such a bracket.
constexpr double kUntoldWidthMm = 0.008;

/// The pairs of a class that no rule allows by d, then durable order, as many as are shown.
struct TableBlock {
  std::vector<std::size_t> pairs;
  std::size_t hidden = 0;
};

/// What was decided about the results of one test; of nothing where there are no decisions.
class TestDecisions {
 public:
  TestDecisions(const DecidedResults* decided, std::size_t test) : decided_(decided), test_(test) {}

  [[nodiscard]] bool is_settled(const Pair& pair) const {
    return decided_ != nullptr && decided_->is_settled(test_, pair);
  }
  [[nodiscard]] Reopened reopened(const Pair& pair) const {
    const DecidedResult* const d = decided_ == nullptr ? nullptr : decided_->of(test_, pair);
    return d == nullptr ? Reopened::no : d->reopened;
  }
  /// Returns what the table says of a result.
  [[nodiscard]] std::string_view status(const Pair& pair) const {
    if (decided_ == nullptr) return {};
    const DecidedResult* const d = decided_->of(test_, pair);
    if (d == nullptr) return name(DecisionStatus::undecided);
    return d->reopened == Reopened::no ? name(d->decision->status) : name(d->reopened);
  }
  /// Returns how many results are settled, of those that are(result).
  template <class Are>
  [[nodiscard]] std::uint64_t count_settled(Are&& are) const {
    if (decided_ == nullptr) return 0;
    return static_cast<std::uint64_t>(std::ranges::count_if(
        decided_->tests[test_], [&](const DecidedResult& r) { return r.is_settled() && are(r); }));
  }

 private:
  const DecidedResults* decided_;
  std::size_t test_;
};

/// A test as the table shows it.
struct ShownTest {
  const Report& report;
  TestDecisions decisions;
  const model::Model& model;

  /// Whether a result may have a row.
  [[nodiscard]] bool lists(const Pair& pair) const {
    return pair.allowed < 0 && !decisions.is_settled(pair);
  }
};

TableBlock worst_of(const ShownTest& test, clash::Class cls, std::size_t rows, clash::SortBy sort) {
  TableBlock block;
  const Report& report = test.report;
  for (std::size_t i = 0; i < report.pairs.size(); ++i)
    if (report.pairs[i].cls == cls && test.lists(report.pairs[i])) block.pairs.push_back(i);
  const std::size_t shown = std::min(rows, block.pairs.size());
  const auto volume = [&](std::size_t i) {
    return sort == clash::SortBy::volume ? report.pairs[i].volume_mm3.value_or(0) : 0;
  };
  // What came back is reported, whatever its depth.
  const auto is_old = [&](std::size_t i) {
    return test.decisions.reopened(report.pairs[i]) == Reopened::no;
  };
  std::partial_sort(block.pairs.begin(), block.pairs.begin() + static_cast<std::ptrdiff_t>(shown),
                    block.pairs.end(), [&](std::size_t i, std::size_t j) {
                      return std::tuple(is_old(i), -volume(i), report.pairs[i].d_mm, i) <
                             std::tuple(is_old(j), -volume(j), report.pairs[j].d_mm, j);
                    });
  block.hidden = block.pairs.size() - shown;
  block.pairs.resize(shown);
  return block;
}

struct ClassRows {
  clash::Class cls;
  std::string_view one, many;
  std::size_t count, listed, rows;
  std::size_t unlisted = 0;  ///< of those that are not listed, as many as were only counted
};

std::size_t listed(const ShownTest& test, clash::Class cls) {
  return static_cast<std::size_t>(std::ranges::count_if(
      test.report.pairs, [&](const Pair& p) { return p.cls == cls && test.lists(p); }));
}

/// Returns the rows of each class: a fifth for each, so that none hides the others, and the rest to
/// those that need a decision before those that are mostly meant.
std::array<ClassRows, 3> shares(const ShownTest& test, std::size_t rows) {
  const Report& report = test.report;
  constexpr std::size_t kParts = 5;
  std::array<ClassRows, 3> all{{
      {clash::Class::hit, "hit", "hits", report.count_hit, 0, 0},
      {clash::Class::contact, "contact", "contacts", report.count_contact, 0, 0,
       report.unlisted.contacts},
      {clash::Class::clearance_violation, "clearance violation", "clearance violations",
       report.count_clearance, 0, 0},
  }};
  for (ClassRows& c : all) {
    c.listed = listed(test, c.cls);
    c.count -= test.decisions.count_settled([&](const DecidedResult& r) { return r.cls == c.cls; });
  }
  const auto give = [&](ClassRows& c, std::size_t limit) {
    const std::size_t given = std::min({limit, rows, c.listed - c.rows});
    c.rows += given;
    rows -= given;
  };
  const std::size_t share = std::max<std::size_t>(1, rows / kParts);
  for (ClassRows& c : all) give(c, share);
  for (const std::size_t i : {std::size_t{0}, std::size_t{2}, std::size_t{1}}) give(all[i], rows);
  return all;
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

std::string counted_as(const ClassRows& c, std::size_t n) { return counted(n, c.one, c.many); }

/// Returns how many results brackets leave open: the classes counted are those of the nominal d.
std::string uncertain(const ShownTest& test) {
  std::uint64_t all = 0, worse = 0;
  for (const Pair& p : test.report.pairs) {
    if (test.decisions.is_settled(p)) continue;
    if ((p.flags & clash::kUncertain) != 0) ++all;
    if (p.severest > (p.allowed < 0 ? p.cls : clash::Class::no_hit)) ++worse;
  }
  if (all == 0) return {};
  const std::string text = "; " + counted(all, "result is", "results are") + " uncertain";
  if (worse == 0) return text;
  return worse == all ? text + " and may be more severe"
                      : text + ", " + std::to_string(worse) + " of them may be more severe";
}

/// Returns what a report without hits may hide.
std::string not_compared(const Report& report, const model::Model& model) {
  if (report.objects_a == 0 || report.objects_b == 0)
    return std::string("; nothing was compared: set ") + (report.objects_a == 0 ? "A" : "B") +
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

/// Returns how many of a class the report does not have: only counted, or of a class that is left
/// out.
std::string not_listed(const ClassRows& c) {
  std::string text;
  if (c.unlisted > 0) text = std::to_string(c.unlisted) + " not listed";
  if (c.listed + c.unlisted < c.count)
    text += (text.empty() ? "" : ", ") + std::to_string(c.count - c.listed - c.unlisted) +
            " left out by class";
  return text.empty() ? text : " (" + text + ")";
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

/// Returns how many results the test does not report, by what it leaves them out.
std::string not_reported(const Report& report) {
  std::string text;
  const auto add = [&](const clash::NotReported::Counts& counts, std::string_view by) {
    if (counts.all() > 0)
      text +=
          ", " + counted(counts.all(), "result", "results") + " not reported by " + std::string(by);
  };
  add(report.not_reported.by_relation, "relation");
  add(report.not_reported.by_volume, "volume");
  return text;
}

std::string summary_of(const ShownTest& test, const std::array<ClassRows, 3>& classes,
                       std::string_view profile) {
  const Report& report = test.report;
  std::string summary;
  for (const ClassRows& c : classes) {
    summary += (summary.empty() ? "" : ", ") + counted_as(c, c.count);
    summary += not_listed(c);
  }
  if (report.count_allowed > 0) summary += ", " + std::to_string(report.count_allowed) + " allowed";
  if (const auto approved = test.decisions.count_settled([](const auto&) { return true; });
      approved > 0)
    summary += ", " + std::to_string(approved) + " approved";
  if (report.count_allowed_regions > 0)
    summary +=
        ", " + counted(report.count_allowed_regions, "place", "places") + " of others allowed";
  summary += not_reported(report);
  for (const clash::Exempted& e : report.exempted)
    if (e.pairs > 0 && profile.empty())
      summary += ", " + std::to_string(e.pairs) + " exempted by " + printable(e.rule);
  summary += uncertain(test) + not_compared(report, test.model) + "\n";
  return profile.empty() ? summary : summary + profile_line(report, profile);
}

std::string cell_row(std::string_view cell, const std::array<std::string, 4>& counts,
                     std::size_t cell_columns) {
  std::string line = fit_to_columns(cell, cell_columns);
  for (const std::string& count : counts) line += "  " + right_aligned(count, kNumberColumns);
  return line + "\n";
}

/// Returns the cells of a matrix in which something was found.
std::string matrix_table(const ShownTest& test, std::size_t width) {
  const Report& report = test.report;
  constexpr std::size_t kCounts = 4 * (kNumberColumns + 2), kMax = 40;
  const std::size_t columns = std::clamp(width - std::min(width, kCounts), kMinCell, kMax);
  std::string out;
  for (const clash::CellReport& c : report.cells) {
    const auto open = [&](std::uint64_t found, clash::Class cls) {
      return found - test.decisions.count_settled([&](const DecidedResult& r) {
        return r.cls == cls && std::minmax(report.discipline[index(r.a)],
                                           report.discipline[index(r.b)]) == std::minmax(c.a, c.b);
      });
    };
    const std::array counts{open(c.hit, clash::Class::hit), open(c.contact, clash::Class::contact),
                            open(c.clearance_violation, clash::Class::clearance_violation),
                            c.allowed};
    if (std::ranges::all_of(counts, [](std::uint64_t n) { return n == 0; })) continue;
    if (out.empty())
      out = cell_row("disciplines", {"hits", "contacts", "clearance", "allowed"}, columns);
    out += cell_row(report.disciplines[c.a].name + " x " + report.disciplines[c.b].name,
                    {std::to_string(counts[0]), std::to_string(counts[1]),
                     std::to_string(counts[2]), std::to_string(counts[3])},
                    columns);
  }
  return out.empty() ? out : out + "\n";
}

/// Returns the discipline of an object, or its file where the test knows no disciplines; nothing
/// where all are of one file.
std::string_view source_of(const Report& report, const model::Model& model, model::ObjectId id) {
  if (!report.disciplines.empty()) {
    const std::uint32_t d = report.discipline[index(id)];
    return d == clash::kNoLabel ? std::string_view("-") : report.disciplines[d].name;
  }
  if (model.files.size() < 2) return {};
  return model.files[model.object(id).file].label;
}

PairRow row_of(const ShownTest& test, const Pair& p) {
  const auto side = [&](model::ObjectId id) {
    return RowSide{source_of(test.report, test.model, id), label(test.model, id)};
  };
  return {short_class_name(p.cls),
          test.decisions.status(p),
          fixed(p.d_mm, 3),
          range_of(p),
          p.volume_mm3 ? fixed(*p.volume_mm3, 1) : "-",
          name(p.relation),
          place_text(p.point_mm),
          side(p.a),
          side(p.b)};
}

PairTableHead head_of(const Report& report, const model::Model& model,
                      const TableOptions& options) {
  PairTableHead head{{}, options.sort == clash::SortBy::volume, options.width};
  if (!report.disciplines.empty())
    head.source = "discipline";
  else if (model.files.size() > 1)
    head.source = "file";
  return head;
}

std::string test_table(const ShownTest& test, const TableOptions& options,
                       std::string_view profile) {
  const std::array<ClassRows, 3> classes = shares(test, options.rows);
  std::array<PairBlock, 3> blocks;
  for (std::size_t c = 0; c < classes.size(); ++c) {
    const TableBlock worst = worst_of(test, classes[c].cls, classes[c].rows, options.sort);
    for (const std::size_t i : worst.pairs)
      blocks[c].rows.push_back(row_of(test, test.report.pairs[i]));
    if (worst.hidden > 0)
      blocks[c].more = "… and " + counted_as(classes[c], worst.hidden) + " more\n";
  }
  std::string out = pair_table(blocks, head_of(test.report, test.model, options));
  if (!out.empty()) out += "\n";
  return out + matrix_table(test, options.width) + summary_of(test, classes, profile);
}

/// Returns what was decided of all tests, in one line.
std::string decisions_line(const DecidedResults& decided) {
  std::string line = "decisions of " + printable(decided.file->name) + ":";
  for (std::size_t s = 0; s < kDecisionStatuses.size(); ++s)
    line += (s == 0 ? " " : ", ") + std::to_string(decided.counts[s]) + " " +
            std::string(name(kDecisionStatuses[s]));
  const std::uint64_t severer = decided.count(Reopened::severer),
                      deeper = decided.count(Reopened::deeper),
                      more = decided.count(Reopened::more_regions),
                      again = decided.count(Reopened::found_again);
  if (severer > 0)
    line += "; approved, but of a severer class than they were: " + std::to_string(severer);
  if (deeper > 0)
    line += "; approved, but deeper or nearer than they were: " + std::to_string(deeper);
  if (more > 0) line += "; approved, but at more places than they were: " + std::to_string(more);
  if (again > 0) line += "; resolved, but found again: " + std::to_string(again);
  if (!decided.not_found.empty())
    line += "; no longer found: " + std::to_string(decided.not_found.size());
  return line + "\n";
}

}  // namespace

std::string clash_table(const ClashContents& contents, const TableOptions& options) {
  std::string out;
  const bool grouped = contents.grouping != nullptr && !contents.grouping->groups.empty();
  if (grouped) out = group_table(*contents.grouping, options);
  const std::string_view profile =
      contents.rules != nullptr ? std::string_view(contents.rules->profile) : std::string_view();
  for (std::size_t t = 0; t < contents.findings.tests.size(); ++t) {
    const ShownTest test{contents.findings.tests[t], {contents.decided, t}, contents.model};
    if (t > 0 && contents.grouping == nullptr) out += "\n";
    if (!test.report.name.empty()) out += "== " + printable(test.report.name) + "\n";
    out += contents.grouping != nullptr
               ? matrix_table(test, options.width) + summary_of(test, shares(test, 0), profile)
               : test_table(test, options, profile);
  }
  return contents.decided == nullptr ? out : out + decisions_line(*contents.decided);
}

}  // namespace strake::report
