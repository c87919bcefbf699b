// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/number.hpp"
#include "core/text_encoding.hpp"
#include "report/text/columns.hpp"
#include "report/text/formatting.hpp"
#include "strake/report/clash_diff.hpp"

namespace strake::report {
namespace {

std::string describe(const ClashDocument& run, const DocumentResult& r, bool with_places) {
  std::string out = std::string(short_class_name(r.cls)) + " " + fixed(r.d_mm, 3);
  if (!r.depth_complete) out += ", depth incomplete";
  if (with_places && r.regions > 0)
    out += " at " + std::to_string(r.regions) + (r.regions == 1 ? " place" : " places");
  if (with_places && r.allowed_regions > 0)
    out += ", " + std::to_string(r.allowed_regions) + " more allowed";
  if (const std::string& rule = run.allowed(r); !rule.empty())
    out += ", allowed by " + printable(rule);
  return out;
}

/// Returns "HIT -12.000", "HIT -12.000 (was CONTACT 0.000)"; with the number of regions where that
/// changed.
std::string change(const ClashDiff& diff, const DiffEntry& e) {
  const bool both = e.before != nullptr && e.after != nullptr;
  const bool places = both && (compare_region_counts(*e.before, *e.after) != 0 ||
                               e.before->allowed_regions != e.after->allowed_regions);
  const std::string is = describe(diff.run_of(e), e.either(), places);
  return both ? is + " (was " + describe(*diff.before, *e.before, places) + ")" : is;
}

std::string_view label(const DocumentObject& o) { return o.name.empty() ? o.id : o.name; }

/// Tells which of several tests, and of several files, the objects of a result are from: names may
/// repeat in each.
class ResultOrigin {
 public:
  explicit ResultOrigin(const ClashDiff& diff) : diff_(diff) {
    std::string_view first = any_file();
    for (const ClashDocument* run : {diff.before, diff.after}) {
      tests_ = tests_ || run->tests.size() > 1;
      // A file that was renamed is one file, and is reported above.
      if (!diff.files.by_label_alone() && !run->objects.empty()) first = run->objects.front().file;
      files_ = files_ || std::ranges::any_of(run->objects, [&](const DocumentObject& o) {
                 return o.file != first;
               });
    }
  }

  [[nodiscard]] std::string text(const DiffEntry& entry) const {
    const ClashDocument& run = diff_.run_of(entry);
    const DocumentResult& r = entry.either();
    std::string out;
    if (files_) {
      const std::string_view a = run.a(r).file, b = run.b(r).file;
      out = ", of " + printable(a) + (a == b ? "" : " and " + printable(b));
    }
    return tests_ ? out + ", test '" + printable(run.tests[r.test].name) + "'" : out;
  }

 private:
  [[nodiscard]] std::string_view any_file() const {
    for (const ClashDocument* run : {diff_.before, diff_.after})
      if (!run->objects.empty()) return run->objects.front().file;
    return {};
  }

  const ClashDiff& diff_;
  bool tests_ = false, files_ = false;
};

/// How the rows of a block fit the terminal.
struct RowLayout {
  std::size_t names = 0;  ///< columns for each of the two
  bool beside = true;     ///< whether what became of the result stands behind them, else below
};

/// Returns the layout of rows of which the text behind the names is at most so wide.
RowLayout layout_of(std::size_t widest, std::size_t width) {
  constexpr std::size_t kMin = 8, kChange = 34, kGaps = 6;
  const auto names = [&](std::size_t taken) {
    return std::max(kMin, (width - std::min(width, taken)) / 2);
  };
  if (kGaps + 2 * kMin + widest > width) return {names(kGaps - 2), false};
  return {names(kGaps + std::max(kChange, widest)), true};
}

std::string block(std::string_view title, const ClashDiff& diff, const std::vector<DiffEntry>& list,
                  const TableOptions& options, std::string_view of = {}) {
  if (list.empty()) return {};
  std::string out = std::string(title) + " (" + std::to_string(list.size()) + ")\n";
  const std::size_t shown = std::min(options.rows, list.size());
  const ResultOrigin origin(diff);
  std::vector<std::string> texts;
  std::size_t widest = 0;
  for (std::size_t i = 0; i < shown; ++i) {
    texts.push_back(change(diff, list[i]) + origin.text(list[i]));
    widest = std::max(widest, columns_in(texts.back()));
  }
  const RowLayout layout = layout_of(widest, options.width);
  for (std::size_t i = 0; i < shown; ++i) {
    const ClashDocument& run = diff.run_of(list[i]);
    const DocumentResult& r = list[i].either();
    const std::string names = "  " + fit_to_columns(label(run.a(r)), layout.names) + "  " +
                              fit_to_columns(label(run.b(r)), layout.names);
    out += layout.beside ? names + "  " : ended(names) + "      ";
    out += texts[i] + "\n";
    const bool same_reason = i > 0 && list[i].why == list[i - 1].why;
    if (!list[i].why.empty() && !same_reason)
      out += "      " + std::string(of) + printable(list[i].why) + "\n";
  }
  if (shown < list.size()) out += "  … and " + std::to_string(list.size() - shown) + " more\n";
  return out + "\n";
}

std::string in_test(const std::string& name) {
  return name.empty() ? std::string() : " of test '" + printable(name) + "'";
}

/// Returns what the rules of a run are called.
std::string rules_name(const DocumentRules& rules) {
  if (rules.file.empty()) return "none";
  return rules.profile.empty() ? printable(rules.file) : "profile " + printable(rules.profile);
}

/// Returns where the two runs were not made with the same rules.
std::string rules_text(const DocumentRules& before, const DocumentRules& after) {
  if (before == after) return {};
  const std::string was = rules_name(before), is = rules_name(after);
  if (was != is) return "rules: were " + was + ", are " + is + "\n";
  return (after.profile.empty() ? "rules file " : "") + is + " is not what it was\n";
}

std::string settings_text(const ClashDiff& diff) {
  std::string out =
      file_matches_text(diff.files) + rules_text(diff.before->made_by, diff.after->made_by);
  for (const SettingChange& s : diff.settings)
    out += "setting " + printable(s.setting) + in_test(s.test) + ": was " +
           (s.before.empty() ? "absent" : printable(s.before)) + ", is " +
           (s.after.empty() ? "absent" : printable(s.after)) + "\n";
  for (const std::string& name : diff.tests_gone)
    out += "test '" + printable(name) + "' is only in the old run\n";
  for (const std::string& name : diff.tests_added)
    out += "test '" + printable(name) + "' is only in the new run\n";
  return out.empty() ? out : out + "\n";
}

}  // namespace

std::string clash_diff_table(const ClashDiff& diff, const TableOptions& options) {
  const std::string out = settings_text(diff) +
                          // Why there was no such result before is said of the run before.
                          block("new", diff, diff.added, options, "in the old run: ") +
                          block("still there, changed", diff, diff.changed, options) +
                          block("gone", diff, diff.gone, options) +
                          block("cannot tell", diff, diff.cannot_tell, options);
  return out + std::to_string(diff.added.size()) + " new, " + std::to_string(diff.changed.size()) +
         " changed, " + std::to_string(diff.same.size()) + " unchanged, " +
         std::to_string(diff.gone.size()) + " gone, " + std::to_string(diff.cannot_tell.size()) +
         " cannot tell\n";
}

}  // namespace strake::report
