// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "strake/report/clash.hpp"

namespace strake::report {

/// Appends a text as a cell of RFC 4180, quoted where needed. An apostrophe keeps a spreadsheet
/// from taking it for a formula: names that begin with '=' or '-' are common, and one from a
/// foreign file may do anything.
void append_csv(std::string& out, std::string_view raw);

/// Returns a text without the apostrophe that append_csv() put before it, if it did.
[[nodiscard]] std::string_view without_apostrophe(std::string_view text);

/// Appends the cells of a line one by one, in the form that is requested.
class CsvRow {
 public:
  /// Appends a number to a text, with a decimal point.
  using AppendNumber = void (*)(std::string& out, double value);

  CsvRow(std::string& out, const CsvForm& form) : out_(out), form_(form) {}

  /// Begins a cell and returns the text to append it to: of letters, digits and blanks alone.
  std::string& cell() {
    if (!first_) out_ += form_.separator;
    first_ = false;
    return out_;
  }
  /// Appends a name from a file, quoted where needed.
  CsvRow& text(std::string_view raw);
  /// Appends the value of an attribute: a name, but for numbers, which no sign makes a formula.
  CsvRow& value(std::string_view raw);
  /// Appends a word of ours as it is.
  CsvRow& word(std::string_view word);
  CsvRow& count(std::uint64_t number);
  CsvRow& number(double value, AppendNumber append);
  CsvRow& blank(std::size_t cells = 1);
  void end() { out_ += "\r\n"; }

 private:
  std::string& out_;
  const CsvForm& form_;
  bool first_ = true;
};

/// Begins a file of rows: the mark, if there is one, and the names of the columns, then of
/// attributes of both objects.
template <class Names>
void begin_csv(std::string& out, const CsvForm& form, const Names& names,
               const std::vector<std::string>& attributes) {
  if (form.mark) out += "\xEF\xBB\xBF";
  CsvRow row(out, form);
  for (const char* const name : names) row.word(name);
  for (const std::string& attribute : attributes)
    for (const char* const side : {"a_@", "b_@"}) row.text(side + attribute);
  row.end();
}

}  // namespace strake::report
