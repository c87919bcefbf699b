// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "clash/results/clash_key.hpp"
#include "report/decisions/decision_columns.hpp"
#include "report/decisions/decision_files.hpp"
#include "report/decisions/decision_match.hpp"
#include "report/decisions/row_keys.hpp"
#include "report/text/csv.hpp"
#include "report/text/csv_table.hpp"
#include "report/text/formatting.hpp"
#include "strake/report/clash.hpp"
#include "strake/report/decisions.hpp"

namespace strake::report {
namespace {

using Column = DecisionColumn;

constexpr std::array kMeasuredColumns{Column::cls, Column::d, Column::x,
                                      Column::y,   Column::z, Column::regions};
constexpr std::array kNameColumns{Column::test,   Column::a_file, Column::a_id,  Column::a_name,
                                  Column::b_file, Column::b_id,   Column::b_name};

/// A result with its test.
struct FoundResult {
  const clash::Report* test = nullptr;
  const clash::Pair* pair = nullptr;
};

/// Returns a table with the headings alone.
CsvTable new_table(const CsvForm& form) {
  CsvTable table{.mark = form.mark, .separator = form.separator, .records = {}};
  CsvRecord& head = table.records.emplace_back(CsvRecord{1, {}, "\r\n"});
  for (const std::string_view heading : kDecisionColumns) head.cells.emplace_back(heading);
  return table;
}

/// Returns the form in which a file has its numbers: where semicolons part the cells, commas are
/// decimal points, unless its numbers have points.
CsvForm form_of(const CsvTable& table, const DecisionColumns& columns) {
  CsvForm form{.separator = table.separator, .decimal = table.separator == ';' ? ',' : '.'};
  if (form.separator == ',') return form;
  for (const CsvRecord& record : table.records)
    for (const Column column : {Column::d, Column::x, Column::y, Column::z})
      for (const char point : {'.', ','})
        if (columns.text(record, column).find(point) != std::string::npos) form.decimal = point;
  return form;
}

/// Writes the cells of results into the records of a file.
class RowWriter {
 public:
  RowWriter(const model::Model& model, const DecisionColumns& columns, const CsvForm& form)
      : model_(model), columns_(columns), form_(form) {}

  void write(CsvRecord& record, Column column, const FoundResult& result) const {
    set(record, column, cell(column, result));
  }
  void write_text(CsvRecord& record, Column column, std::string_view text) const {
    std::string cell;
    append_csv(cell, text);
    set(record, column, std::move(cell));
  }
  /// Whether a record says nothing in any of some columns.
  template <class Columns>
  [[nodiscard]] bool lacks_all(const CsvRecord& record, const Columns& of) const {
    return std::ranges::all_of(of, [&](Column c) { return columns_.text(record, c).empty(); });
  }

 private:
  void set(CsvRecord& record, Column column, std::string cell) const {
    const std::size_t at = columns_.at(column);
    if (record.cells.size() <= at) record.cells.resize(at + 1);
    record.cells[at] = std::move(cell);
  }

  [[nodiscard]] std::string cell(Column column, const FoundResult& result) const {
    std::string out;
    CsvRow row(out, form_);
    const auto& [test, pair] = result;
    switch (column) {
      case Column::key:
        row.word(clash::pair_key(test->name, model_, pair->a, pair->b));
        break;
      case Column::status:
        row.word(name(DecisionStatus::undecided));
        break;
      case Column::cls:
        row.word(name(pair->cls));
        break;
      case Column::d:
        row.number(pair->d_mm, append_mm);
        break;
      case Column::x:
      case Column::y:
      case Column::z:
        row.number(pair->point_mm[static_cast<int>(column) - static_cast<int>(Column::x)],
                   append_mm);
        break;
      case Column::regions:
        if (pair->regions > 0) row.count(pair->regions);
        break;
      case Column::test:
        row.text(test->name);
        break;
      default:
        name_cell(row, column, *pair);
    }
    return out;
  }

  void name_cell(CsvRow& row, Column column, const clash::Pair& pair) const {
    const bool of_a =
        column == Column::a_file || column == Column::a_id || column == Column::a_name;
    const model::Object& object = model_.object(of_a ? pair.a : pair.b);
    if (column == Column::a_file || column == Column::b_file)
      row.text(model_.files[object.file].label);
    else if (column == Column::a_id || column == Column::b_id)
      row.text(object.id);
    else if (column == Column::a_name || column == Column::b_name)
      row.text(object.name);
  }

  const model::Model& model_;
  const DecisionColumns& columns_;
  const CsvForm& form_;
};

/// Merges results into a file.
class DecisionUpdate {
 public:
  DecisionUpdate(const ClashContents& contents, CsvTable table, DecisionColumns columns)
      : contents_(contents),
        decided_(*contents.decided),
        table_(std::move(table)),
        columns_(columns),
        form_(decided_.file->text.empty() ? contents.csv : form_of(table_, columns_)),
        writer_(contents.model, columns_, form_),
        keys_(decided_.files, contents.model, *decided_.file) {}

  UpdatedDecisions run() {
    add_columns();
    find_results();
    row_keys_ = assign_keys(wanted_keys());
    update_rows();
    add_rows();
    updated_.text = csv_text(table_);
    return updated_;
  }

 private:
  void add_columns() {
    states_depths_ = columns_.has(Column::d);
    CsvRecord& head = table_.records.front();
    for (std::size_t c = 0; c < kDecisionColumns.size(); ++c) {
      const auto column = static_cast<Column>(c);
      if (columns_.has(column)) continue;
      columns_.set(column, head.cells.size());
      head.cells.emplace_back(kDecisionColumns[c]);
    }
  }

  void find_results() {
    for (std::size_t t = 0; t < contents_.findings.tests.size(); ++t) {
      const clash::Report& test = contents_.findings.tests[t];
      for (const clash::Pair& pair : test.pairs) {
        const DecidedResult* const decided = decided_.of(t, pair);
        if (decided != nullptr)
          results_.emplace(decided->decision, FoundResult{&test, &pair});
        else if (pair.allowed < 0)
          undecided_.push_back({&test, &pair});
      }
    }
  }

  [[nodiscard]] std::vector<WantedKey> wanted_keys() const {
    std::vector<WantedKey> wanted;
    for (const Decision& row : decided_.file->decisions) {
      const auto result = results_.find(&row);
      if (result != results_.end()) {
        const auto& [test, pair] = result->second;
        wanted.push_back({&row, keys_.key(test->name, *pair), true});
      } else {
        const auto today = keys_.renamed(row);
        wanted.push_back({&row, today ? today->key : row.key, false});
      }
    }
    return wanted;
  }

  void update_rows() {
    std::map<std::size_t, const Decision*> by_line;
    for (const Decision& row : decided_.file->decisions) by_line.emplace(row.line, &row);
    const auto row_of = [&](const CsvRecord& record) {
      const auto at = by_line.find(record.line);
      return at == by_line.end() ? nullptr : at->second;
    };
    updated_.taken_out = std::erase_if(table_.records, [&](const CsvRecord& record) {
      const Decision* const row = row_of(record);
      return row != nullptr && !row_keys_.keys.contains(row);
    });
    for (CsvRecord& record : table_.records)
      if (const Decision* const row = row_of(record)) update(record, *row);
  }

  void update(CsvRecord& record, const Decision& row) const {
    const auto result = results_.find(&row);
    const Hash128& key = row_keys_.keys.at(&row);
    if (result != results_.end()) {
      write_measures(record, row, result->second);
      write_names(record, row, result->second, key != row.key);
    } else if (const auto today = keys_.renamed(row); today && today->key == key) {
      writer_.write_text(record, Column::key, clash::key_text(today->key));
      writer_.write_text(record, Column::a_file, today->a.file);
      writer_.write_text(record, Column::b_file, today->b.file);
    }
  }

  void write_measures(CsvRecord& record, const Decision& row, const FoundResult& result) const {
    // Whoever empties the depth decides about the clash as it is now, and not about two in one.
    const bool renews = row.status == DecisionStatus::undecided || (states_depths_ && !row.d_mm);
    for (const Column column : kMeasuredColumns)
      if (renews || writer_.lacks_all(record, std::array{column}))
        writer_.write(record, column, result);
  }

  void write_names(CsvRecord& record, const Decision& row, const FoundResult& result,
                   bool is_renamed) const {
    const bool is_another = is_positional(contents_.model, *result.pair) && is_bare(row) &&
                            !is_same_place(*result.pair, row);
    if (is_renamed) writer_.write(record, Column::key, result);
    if (is_renamed || is_another || writer_.lacks_all(record, kNameColumns))
      for (const Column column : kNameColumns) writer_.write(record, column, result);
  }

  void add_rows() {
    const std::string end =
        table_.records.front().end.empty() ? "\r\n" : table_.records.front().end;
    for (const FoundResult& result : undecided_) {
      // Where an id is only a position, the key may stand there for another clash.
      if (!row_keys_.held.insert(keys_.key(result.test->name, *result.pair)).second) {
        ++updated_.without_row;
        continue;
      }
      if (table_.records.back().end.empty()) table_.records.back().end = end;
      CsvRecord record{0, std::vector<std::string>(table_.records.front().cells.size()), end};
      for (std::size_t c = 0; c < kDecisionColumns.size(); ++c)
        writer_.write(record, static_cast<Column>(c), result);
      table_.records.push_back(std::move(record));
      ++updated_.added;
    }
  }

  const ClashContents& contents_;
  const DecidedResults& decided_;
  CsvTable table_;
  DecisionColumns columns_;
  CsvForm form_;
  RowWriter writer_;
  DecidedKeys keys_;
  std::map<const Decision*, FoundResult> results_;
  std::vector<FoundResult> undecided_;
  bool states_depths_ = false;  ///< the file had the column before
  RowKeys row_keys_;
  UpdatedDecisions updated_;
};

}  // namespace

UpdatedDecisions update_decisions(const ClashContents& contents) {
  const DecisionFile& file = *contents.decided->file;
  // The text was read before: it has no faults.
  CsvTable table =
      file.text.empty() ? new_table(contents.csv) : parse_csv_table(file.text, file.name).value();
  const DecisionColumns columns = DecisionColumns::read(table, file.name).value();
  return DecisionUpdate(contents, std::move(table), columns).run();
}

}  // namespace strake::report
