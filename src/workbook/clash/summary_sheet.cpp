// SPDX-License-Identifier: Apache-2.0
#include "workbook/clash/summary_sheet.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clash/rules/tolerance_lengths.hpp"
#include "report/text/formatting.hpp"
#include "strake/core/diagnostics.hpp"
#include "strake/report/decisions.hpp"

namespace strake::workbook {
namespace {

using report::ClashContents;
using Cells = std::function<void(SheetRow&)>;

/// The rows of the summary, one after the other; a blank one before each heading.
class SummaryRows {
 public:
  void add(Cells cells) { rows_.push_back(std::move(cells)); }
  void title(std::string text) {
    add([text = std::move(text)](SheetRow& row) { row.word(text, CellStyle::title); });
  }
  void heads(std::vector<std::string> words) {
    add([](SheetRow&) {});
    add([words = std::move(words)](SheetRow& row) {
      for (const std::string& word : words) row.word(word, CellStyle::head);
    });
  }
  void text(std::string label, std::string value) {
    add([label = std::move(label), value = std::move(value)](SheetRow& row) {
      row.word(label, CellStyle::bold).text(value);
    });
  }
  void count(std::string label, std::uint64_t value) {
    add([label = std::move(label), value](SheetRow& row) {
      row.word(label, CellStyle::bold).count(value);
    });
  }
  [[nodiscard]] std::vector<Cells> take() { return std::move(rows_); }

 private:
  std::vector<Cells> rows_;
};

std::string written_classes(const report::WrittenClasses& classes) {
  std::string text;
  for (const clash::Class cls :
       {clash::Class::hit, clash::Class::contact, clash::Class::clearance_violation})
    if (classes.has(cls)) text.append(text.empty() ? "" : ", ").append(name(cls));
  return text;
}

void add_origin(SummaryRows& rows, const ClashContents& contents) {
  rows.title("Clash results");
  if (contents.rules != nullptr) {
    rows.text("Rules", contents.rules->file);
    rows.text("Hash of the rules", contents.rules->hash.text());
    if (!contents.rules->profile.empty()) rows.text("Profile", contents.rules->profile);
  }
  rows.text("Hash of the results", hash_of(contents.findings));
  if (!contents.classes.all()) rows.text("Only these classes", written_classes(contents.classes));
  rows.text("Units", "Lengths in mm, volumes in mm³; a negative d is the depth of an overlap");
  rows.heads({"File", "Format", "Unit"});
  for (const model::SourceFile& file : contents.model.files)
    rows.add([&file](SheetRow& row) {
      row.text(file.label).text(file.format).text(file.unit);
      if (file.ends_early) row.word("ends early: what follows is not known");
    });
}

/// How many pairs and objects of a test could not be compared.
clash::NotComparedCounts not_compared(const clash::Report& test) {
  return clash::counts_of(std::span(&test, 1));
}

void add_counts(SummaryRows& rows, const ClashContents& contents) {
  rows.heads({"Test", "Set A", "Set B", "Objects A", "Objects B", "HIT", "CONTACT",
              "CLEARANCE_VIOLATION", "Allowed by rules", "Exempted by rules", "Contacts not listed",
              "Not reported", "Pairs not compared", "Objects not compared whole"});
  for (const clash::Report& test : contents.findings.tests)
    rows.add([&test](SheetRow& row) {
      std::uint64_t exempted = 0;
      for (const clash::Exempted& rule : test.exempted) exempted += rule.pairs;
      const clash::NotComparedCounts lacks = not_compared(test);
      row.text(test.name.empty() ? "(the only one)" : test.name).text(test.set_a).text(test.set_b);
      for (const std::uint64_t n :
           {test.objects_a, test.objects_b, test.count_hit, test.count_contact,
            test.count_clearance, test.count_allowed, exempted,
            test.unlisted.contacts + test.unlisted.allowed,
            test.not_reported.by_relation.all() + test.not_reported.by_volume.all(), lacks.pairs,
            lacks.objects})
        row.count(n);
    });
}

void add_settings(SummaryRows& rows, const ClashContents& contents) {
  std::vector<std::string> heads{"Settings of"};
  for (const clash::ToleranceLength& length : clash::kToleranceLengths)
    heads.push_back(std::string(length.name) + "_mm");
  for (const char* const more : {"contact_distance_mm", "thickness_cap", "curves"})
    heads.emplace_back(more);
  rows.heads(std::move(heads));
  for (const clash::Report& test : contents.findings.tests)
    rows.add([&test](SheetRow& row) {
      const clash::Tolerances& t = test.options.tolerances;
      row.text(test.name.empty() ? "(the only one)" : test.name);
      for (const clash::ToleranceLength& length : clash::kToleranceLengths)
        row.number(t.*length.value_mm, report::append_mm);
      row.number(test.contact_distance_mm, report::append_mm);
      row.word(t.thickness_cap == clash::ThicknessCap::on ? "on" : "off");
      row.word(test.options.engine.curves == clash::Curves::on ? "on" : "off");
    });
}

void add_decisions(SummaryRows& rows, const report::DecidedResults* decided) {
  if (decided == nullptr) return;
  rows.heads({"Status", "Results"});
  for (std::size_t s = 0; s < report::kDecisionStatuses.size(); ++s)
    rows.count(std::string(name(report::kDecisionStatuses[s])), decided->counts[s]);
  for (const report::Reopened why : {report::Reopened::severer, report::Reopened::deeper,
                                     report::Reopened::more_regions, report::Reopened::found_again})
    rows.count("back: " + std::string(name(why)), decided->count(why));
  rows.count("decisions about no result", decided->not_found.size());
}

void add_diagnostics(SummaryRows& rows, const ClashContents& contents) {
  Diagnostics all;
  if (contents.loading != nullptr) all = *contents.loading;
  all.append(contents.findings.all_diagnostics());
  if (all.counts().empty()) return;
  rows.heads({"Noticed", "Times", "Severity"});
  for (const Diagnostics::Count& count : all.counts())
    rows.add([count](SheetRow& row) {
      row.word(count.code, CellStyle::bold).count(count.count).word(severity_name(count.severity));
    });
}

void add_sheets(SummaryRows& rows, std::span<const Worksheet> others) {
  rows.heads({"Sheet", "Rows"});
  for (const Worksheet& sheet : others) rows.count(sheet.name, sheet.rows);
  for (const Worksheet& sheet : others)
    if (sheet.rows == kMaxRows - 1) {
      rows.text("Note",
                "A sheet has at most 1,048,576 rows: what is more stands on further sheets "
                "of the same name with a number");
      return;
    }
}

}  // namespace

Worksheet summary_sheet(const ClashContents& contents, std::span<const Worksheet> others) {
  SummaryRows rows;
  add_origin(rows, contents);
  add_counts(rows, contents);
  add_settings(rows, contents);
  add_decisions(rows, contents.decided);
  add_diagnostics(rows, contents);
  add_sheets(rows, others);
  constexpr std::size_t kColumns = 14;
  Worksheet sheet{
      .name = "Summary", .columns = std::vector<SheetColumn>(kColumns, {"", 19}), .cells = {}};
  sheet.columns.front().width = 32;
  std::vector<Cells> cells = rows.take();
  sheet.rows = cells.size();
  sheet.cells = [cells = std::move(cells)](std::size_t i, SheetRow& row) { cells[i](row); };
  return sheet;
}

}  // namespace strake::workbook
