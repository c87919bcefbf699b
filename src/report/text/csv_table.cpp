// SPDX-License-Identifier: Apache-2.0
#include "report/text/csv_table.hpp"

#include <algorithm>
#include <optional>

#include "core/text_encoding.hpp"

namespace strake::report {
namespace {

constexpr std::string_view kMark = "\xEF\xBB\xBF", kBreaks = "\r\n";

std::string place(const std::string& name, std::size_t line) {
  return name + ", line " + std::to_string(line);
}

/// Returns the separator that the first line has most of outside its quotes.
char separator_of(std::string_view text) {
  std::string outside;
  bool quoted = false;
  for (const char c : text) {
    if (c == '"') quoted = !quoted;
    if (!quoted && kBreaks.find(c) != std::string_view::npos) break;
    if (!quoted) outside += c;
  }
  char best = ',';
  for (const char c : {';', '\t'})
    if (std::ranges::count(outside, c) > std::ranges::count(outside, best)) best = c;
  return best;
}

/// Takes records off a text, one by one.
class CsvScanner {
 public:
  CsvScanner(std::string_view text, char separator, const std::string& name)
      : rest_(text), separator_(separator), name_(name) {}

  [[nodiscard]] bool at_end() const { return rest_.empty(); }

  Result<CsvRecord> record() {
    CsvRecord next;
    next.line = line_;
    for (;;) {
      Result<std::string> read = cell();
      if (!read) return read.error();
      next.cells.push_back(std::move(*read));
      if (rest_.empty()) return next;
      if (rest_.front() != separator_) break;
      rest_.remove_prefix(1);
    }
    next.end = take(rest_.starts_with("\r\n") ? 2 : 1);
    ++line_;
    return next;
  }

 private:
  std::string take(std::size_t bytes) {
    std::string taken(rest_.substr(0, bytes));
    rest_.remove_prefix(taken.size());
    return taken;
  }

  Result<std::string> cell() {
    if (rest_.starts_with('"')) return quoted_cell();
    return take(rest_.find_first_of(std::string{separator_, '\r', '\n'}));
  }

  Result<std::string> quoted_cell() {
    std::size_t end = 1;
    for (;; end += 2) {
      end = rest_.find('"', end);
      if (end == std::string_view::npos)
        return Error{ErrorCode::input, "a quote is not closed", place(name_, line_),
                     "end the cell with a quote; one within it is written twice"};
      if (!rest_.substr(end + 1).starts_with('"')) break;
    }
    const std::size_t began = line_;
    std::string quoted = take(end + 1);
    line_ += breaks_in(quoted);
    if (!rest_.empty() && rest_.front() != separator_ &&
        kBreaks.find(rest_.front()) == kBreaks.npos)
      return Error{ErrorCode::input, "there is text behind a quoted cell", place(name_, began),
                   "write a quote within a cell twice"};
    return quoted;
  }

  /// Returns how many lines end within a cell.
  static std::size_t breaks_in(std::string_view cell) {
    std::size_t breaks = 0;
    for (std::size_t i = 0; i < cell.size(); ++i)
      if (cell[i] == '\n' || (cell[i] == '\r' && !cell.substr(i + 1).starts_with('\n'))) ++breaks;
    return breaks;
  }

  std::string_view rest_;
  char separator_;
  const std::string& name_;
  std::size_t line_ = 1;
};

/// Returns the number of the first line that is not UTF-8.
std::optional<std::size_t> line_of_other_encoding(std::string_view text) {
  if (is_utf8(text)) return std::nullopt;
  std::size_t line = 1;
  while (!text.empty()) {
    const DecodedCharacter c = decode_character(text);
    if (c.length == 0) break;
    if (c.bytes == "\n") ++line;
  }
  return line;
}

}  // namespace

Result<CsvTable> parse_csv_table(std::string_view text, const std::string& name) {
  if (const auto line = line_of_other_encoding(text))
    return Error{ErrorCode::input, "is not UTF-8", place(name, *line),
                 "save it in the spreadsheet as 'CSV UTF-8'"};
  CsvTable table;
  table.mark = text.starts_with(kMark);
  if (table.mark) text.remove_prefix(kMark.size());
  table.separator = separator_of(text);
  CsvScanner scanner(text, table.separator, name);
  while (!scanner.at_end()) {
    Result<CsvRecord> record = scanner.record();
    if (!record) return record.error();
    table.records.push_back(std::move(*record));
  }
  return table;
}

std::string csv_text(const CsvTable& table) {
  std::string text(table.mark ? kMark : std::string_view());
  for (const CsvRecord& record : table.records) {
    for (std::size_t c = 0; c < record.cells.size(); ++c) {
      if (c > 0) text += table.separator;
      text += record.cells[c];
    }
    text += record.end;
  }
  return text;
}

std::string cell_text(std::string_view cell) {
  return std::string(trimmed(untrimmed_cell_text(cell)));
}

std::string untrimmed_cell_text(std::string_view cell) {
  if (!cell.starts_with('"')) return std::string(cell);
  std::string text;
  for (std::size_t i = 1; i + 1 < cell.size(); ++i) {
    text += cell[i];
    if (cell[i] == '"') ++i;
  }
  return text;
}

bool is_blank(const CsvRecord& record) {
  return std::ranges::all_of(record.cells,
                             [](const std::string& cell) { return cell_text(cell).empty(); });
}

}  // namespace strake::report
