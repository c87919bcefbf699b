// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "clash/results/clash_key.hpp"
#include "core/number.hpp"
#include "core/text_encoding.hpp"
#include "report/decisions/decision_columns.hpp"
#include "report/document/document_reader.hpp"
#include "report/text/csv_table.hpp"
#include "strake/report/decisions.hpp"

namespace strake::report {
namespace {

using Column = DecisionColumn;

/// Returns the whole number that a text is, of digits alone.
std::optional<int> digits(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool signless = !text.empty() && text.front() != '-';
  if (error != std::errc() || end != text.data() + text.size() || !signless) return std::nullopt;
  return number;
}

/// Returns a date as 2026-01-31, which it may be written as, or as 31.1.2026; nothing where it is
/// anything else. Months and days between strokes stand in either order, so that nobody can tell.
std::optional<std::string> date_of(std::string_view text) {
  const char between = text.find('.') == std::string_view::npos ? '-' : '.';
  const std::size_t first = text.find(between), last = text.rfind(between);
  if (first == std::string_view::npos || first == last) return std::nullopt;
  constexpr int kNone = -1;
  int year = digits(text.substr(0, first)).value_or(kNone);
  const int month = digits(text.substr(first + 1, last - first - 1)).value_or(kNone);
  int day = digits(text.substr(last + 1)).value_or(kNone);
  if (between == '.') std::swap(year, day);
  constexpr int kFirstYear = 1900, kLastYear = 9999;
  if (year < kFirstYear || year > kLastYear || month < 1 || month > 12 || day < 1 || day > 31)
    return std::nullopt;
  const std::chrono::year_month_day date(std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day)));
  if (!date.ok()) return std::nullopt;
  const auto two = [](int n) { return (n < 10 ? "-0" : "-") + std::to_string(n); };
  return std::to_string(year) + two(month) + two(day);
}

std::optional<DecisionStatus> status_of(std::string_view text) {
  const std::string word = lowered(text);
  if (word.empty()) return DecisionStatus::undecided;
  for (const DecisionStatus status : kDecisionStatuses)
    if (word == name(status)) return status;
  return std::nullopt;
}

/// Returns how far a number may be from what it was before it was written: by half of its last
/// decimal. A whole number is one, to what the program writes.
double rounding_of(std::string_view number) {
  constexpr double kWrittenMm = 1e-6, kNoise = 1e-9;
  const std::size_t point = number.find('.'), exponent = number.find_first_of("eE");
  double digit_mm = kWrittenMm;
  if (point != std::string_view::npos && exponent == std::string_view::npos &&
      point + 1 < number.size())
    digit_mm = std::max(kWrittenMm, std::pow(10, -static_cast<double>(number.size() - point - 1)));
  return digit_mm / 2 + kNoise;
}

/// Reads the rows of a file one by one.
class DecisionReader {
 public:
  DecisionReader(const CsvTable& table, const DecisionColumns& columns, const std::string& name)
      : table_(table), columns_(columns), name_(name) {}

  Result<std::vector<Decision>> rows() {
    std::vector<Decision> all;
    for (std::size_t r = 1; r < table_.records.size(); ++r) {
      const CsvRecord& record = table_.records[r];
      if (columns_.all_blank(record) && !has_extra_cells(record)) continue;
      if (is_exempted(record)) continue;
      Result<Decision> read = row(record);
      if (!read) return read.error();
      const auto [at, is_new] = lines_.try_emplace(read->key, read->line);
      if (!is_new)
        return fault(record, "the key stands in line " + std::to_string(at->second) + " already",
                     "keep one of the two rows");
      all.push_back(std::move(*read));
    }
    return all;
  }

 private:
  [[nodiscard]] std::string text(const CsvRecord& record, Column column) const {
    return columns_.text(record, column);
  }

  /// Whether a row of a CSV of results is a pair that a rule exempts, which has no key.
  [[nodiscard]] bool is_exempted(const CsvRecord& record) const {
    return text(record, Column::key).empty() && text(record, Column::status).empty() &&
           text(record, Column::cls) == "EXEMPTED";
  }

  [[nodiscard]] bool has_extra_cells(const CsvRecord& record) const {
    const std::size_t headings = table_.records.front().cells.size();
    for (std::size_t c = headings; c < record.cells.size(); ++c)
      if (!cell_text(record.cells[c]).empty()) return true;
    return false;
  }

  [[nodiscard]] Error fault(const CsvRecord& record, std::string message, std::string mend) const {
    return {ErrorCode::input, std::move(message), name_ + ", line " + std::to_string(record.line),
            std::move(mend)};
  }

  Result<Decision> row(const CsvRecord& record) const {
    if (has_extra_cells(record))
      return fault(record, "the row has more cells than there are headings",
                   "put a cell that has the separator in it between quotes");
    Decision decision;
    decision.line = record.line;
    const std::string key = lowered(text(record, Column::key));
    if (key.empty())
      return fault(
          record, "the row has no key",
          "write the 26 letters and digits that its result has as 'key', or empty the row");
    const auto parsed = clash::parse_key(key);
    if (!parsed)
      return fault(record, in_quotes_cut(key) + " is no key",
                   "a key is the 26 letters and digits that results have as 'key'");
    decision.key = *parsed;
    if (const Status status = decided(record, decision); !status) return status.error();
    if (const Status status = measured(record, decision); !status) return status.error();
    decision.test = columns_.name(record, Column::test);
    decision.a = {columns_.name(record, Column::a_file), columns_.name(record, Column::a_id),
                  columns_.name(record, Column::a_name)};
    decision.b = {columns_.name(record, Column::b_file), columns_.name(record, Column::b_id),
                  columns_.name(record, Column::b_name)};
    return decision;
  }

  /// Reads what people write.
  Status decided(const CsvRecord& record, Decision& row) const {
    const std::string word = text(record, Column::status), date = text(record, Column::date);
    const auto status = status_of(word);
    if (!status)
      return fault(record, in_quotes_cut(word) + " is no status",
                   "write new, active, reviewed, approved or resolved");
    row.status = *status;
    row.by = text(record, Column::by);
    row.comment = text(record, Column::comment);
    if (date.empty()) return {};
    auto read = date_of(date);
    if (!read)
      return fault(record, in_quotes_cut(date) + " is no date", "write 2026-01-31, or 31.1.2026");
    row.date = std::move(*read);
    return {};
  }

  /// Returns the text of a number, with a point for a decimal comma.
  [[nodiscard]] std::string with_point(const CsvRecord& record, Column column) const {
    std::string written = text(record, column);
    std::ranges::replace(written, ',', '.');
    return written;
  }

  /// Reads a number; nothing where there is none. Where commas part the cells, none is a decimal
  /// point: it may part thousands as well.
  Result<std::optional<double>> number(const CsvRecord& record, Column column) const {
    const std::string written = with_point(record, column);
    if (written.empty()) return std::optional<double>();
    if (table_.separator == ',' && text(record, column).find(',') != std::string::npos)
      return fault(record, in_quotes_cut(text(record, column)) + " has a comma",
                   "write numbers as 1234.5, without commas, in a file separated by commas");
    const auto value = parse_number(written);
    if (!value)
      return fault(record, in_quotes_cut(text(record, column)) + " is no number",
                   "write as many " +
                       std::string(column == Column::regions ? "places" : "millimetres") +
                       " as the result had, or nothing");
    return value;
  }

  /// Reads what the program writes.
  Status measured(const CsvRecord& record, Decision& row) const {
    std::array<std::optional<double>, 5> values;
    constexpr std::array kColumns{Column::d, Column::x, Column::y, Column::z, Column::regions};
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
      const Result<std::optional<double>> value = number(record, kColumns[i]);
      if (!value) return value.error();
      values[i] = *value;
    }
    const auto& [d, x, y, z, regions] = values;
    row.d_mm = d;
    if (d) row.d_rounding_mm = rounding_of(with_point(record, Column::d));
    if (x && y && z) row.point_mm = geometry::Vec3d{*x, *y, *z};
    if (const Status status = counted(record, regions.value_or(0), row); !status)
      return status.error();
    if (const Status status = classified(record, row); !status) return status.error();
    // Whoever empties the depth decides about the clash as it is now.
    if (columns_.has(Column::d) && !d) {
      row.regions = 0;
      row.cls.reset();
    }
    return {};
  }

  /// Takes a number of places, of which 0 says as much as none.
  Status counted(const CsvRecord& record, double places, Decision& row) const {
    if (places == 0) return {};
    const bool is_count = places >= 1 && places <= std::numeric_limits<std::uint32_t>::max() &&
                          places == std::floor(places);
    if (!is_count)
      return fault(record, in_quotes_cut(text(record, Column::regions)) + " is no number of places",
                   "write as many places as the result had, or nothing");
    row.regions = static_cast<std::uint32_t>(places);
    return {};
  }

  Status classified(const CsvRecord& record, Decision& row) const {
    const std::string word = lowered(text(record, Column::cls));
    if (word.empty()) return {};
    for (const clash::Class cls :
         {clash::Class::clearance_violation, clash::Class::contact, clash::Class::hit})
      if (word == lowered(name(cls))) row.cls = cls;
    if (row.cls) return {};
    return fault(record, in_quotes_cut(text(record, Column::cls)) + " is no class",
                 "write HIT, CONTACT or CLEARANCE_VIOLATION, or nothing");
  }

  const CsvTable& table_;
  const DecisionColumns& columns_;
  const std::string& name_;
  std::map<Hash128, std::size_t> lines_;  ///< of the keys that were read
};

}  // namespace

std::string_view name(DecisionStatus status) {
  switch (status) {
    case DecisionStatus::undecided:
      return "new";
    case DecisionStatus::active:
      return "active";
    case DecisionStatus::reviewed:
      return "reviewed";
    case DecisionStatus::approved:
      return "approved";
    case DecisionStatus::resolved:
      return "resolved";
  }
  return "";
}

Result<DecisionFile> parse_decisions(std::string text, std::string name) {
  const Result<CsvTable> table = parse_csv_table(text, name);
  if (!table) return table.error();
  const Result<DecisionColumns> columns = DecisionColumns::read(*table, name);
  if (!columns) return columns.error();
  Result<std::vector<Decision>> rows = DecisionReader(*table, *columns, name).rows();
  if (!rows) return rows.error();
  return DecisionFile{std::move(name), std::move(text), std::move(*rows)};
}

Result<DecisionFile> read_decisions(const std::filesystem::path& file) {
  Result<std::ifstream> in = open_document(file);
  if (!in) return in.error();
  std::string text{std::istreambuf_iterator<char>(*in), std::istreambuf_iterator<char>()};
  if (in->bad())
    return Error{ErrorCode::input, "cannot be read", file.string(), "check who may read it"};
  return parse_decisions(std::move(text), file.string());
}

}  // namespace strake::report
