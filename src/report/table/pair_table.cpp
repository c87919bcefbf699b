// SPDX-License-Identifier: Apache-2.0
#include "report/table/pair_table.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/number.hpp"
#include "core/text_encoding.hpp"
#include "report/text/columns.hpp"
#include "report/text/table_names.hpp"

namespace strake::report {
namespace {

constexpr std::size_t kMinName = 8, kMaxSource = 24, kIndent = 4;
constexpr std::string_view kGap = "  ", kBothNames = "a, and b below it";

/// Where the two names of a row stand.
enum class NameLayout : std::uint8_t {
  beside,   ///< both behind the numbers
  stacked,  ///< a behind the numbers, b below it
  below,    ///< each on a line of its own, below the numbers
};

struct SideText {
  std::string source, name;
};

/// A row, or the head over all rows, whose sides are as they are shown.
struct TableLine {
  std::vector<std::string> numbers;  ///< class, status, d, range, volume, relation and place
  SideText a, b;
};

std::vector<std::string> numbers_of(const PairRow& row) {
  std::vector<std::string> numbers{std::string(row.cls), std::string(row.status),  row.d, row.range,
                                   row.volume,           std::string(row.relation)};
  numbers.insert(numbers.end(), row.place_mm.begin(), row.place_mm.end());
  return numbers;
}

class PairTable {
 public:
  PairTable(std::span<const PairBlock> blocks, const PairTableHead& head)
      : blocks_(blocks), head_(head) {
    add_lines();
    find_widths();
    choose_place();
  }

  [[nodiscard]] std::string text() const {
    std::string out;
    if (!lead_.empty()) out += std::string(kLeadMark) + " stands for " + printable(lead_) + "\n";
    if (!lines_.empty()) out += text_of(title());
    std::size_t next = 0;
    for (const PairBlock& block : blocks_) {
      for (std::size_t r = 0; r < block.rows.size(); ++r) out += text_of(lines_[next++]);
      out += block.more;
    }
    return out;
  }

 private:
  /// Numbers of the columns in TableLine::numbers.
  enum Column : std::size_t {
    kClass,
    kStatus,
    kD,
    kRange,
    kVolume,
    kRelation,
    kX,
    kY,
    kZ,
    kColumns
  };

  /// Coordinates belong together.
  [[nodiscard]] static std::string_view gap_behind(std::size_t column) {
    return column == kX || column == kY ? kGap.substr(1) : kGap;
  }

  void add_lines() {
    std::vector<std::string_view> names;
    std::vector<std::string> sources;
    for (const PairBlock& block : blocks_)
      for (const PairRow& row : block.rows)
        for (const RowSide& side : {row.a, row.b}) {
          names.push_back(side.name);
          sources.push_back(printable(side.source));
        }
    lead_ = common_lead(names);
    sources = shorten_distinctly(sources, kMaxSource);
    std::size_t side = 0;
    for (const PairBlock& block : blocks_)
      for (const PairRow& row : block.rows) {
        TableLine& line = lines_.emplace_back();
        line.numbers = numbers_of(row);
        for (SideText* const of : {&line.a, &line.b}) {
          *of = {sources[side], without_lead(names[side], lead_)};
          ++side;
        }
      }
  }

  [[nodiscard]] TableLine title() const {
    const std::string source(head_.source);
    const bool beside = stand_ == NameLayout::beside;
    return {
        {"class", "status", "d mm", "d range mm", "volume mm3", "relation", "x mm", "y mm", "z mm"},
        {source, beside ? "a" : std::string(kBothNames)},
        beside ? SideText{source, "b"} : SideText{}};
  }

  void find_widths() {
    widths_.assign(kColumns, 0);
    const std::vector<std::string> titles = title().numbers;
    for (const TableLine& line : lines_)
      for (std::size_t c = 0; c < widths_.size(); ++c)
        widths_[c] = std::max(widths_[c], columns_in(line.numbers[c]));
    if (!head_.volume) widths_[kVolume] = 0;
    for (std::size_t c = 0; c < widths_.size(); ++c)
      if (widths_[c] > 0) widths_[c] = std::max(widths_[c], columns_in(titles[c]));
    for (std::size_t c = 0; c < widths_.size(); ++c)
      numbers_ += widths_[c] > 0 ? widths_[c] + gap_behind(c).size() : 0;
    if (head_.source.empty()) return;
    source_ = head_.source.size();
    for (const TableLine& line : lines_)
      source_ = std::max({source_, columns_in(line.a.source), columns_in(line.b.source)});
    source_ += kGap.size();
  }

  /// Chooses where the names stand, and cuts those that fit nowhere.
  void choose_place() {
    std::size_t a = 1, b = 1;
    for (const TableLine& line : lines_) {
      a = std::max(a, columns_in(line.a.name));
      b = std::max(b, columns_in(line.b.name));
    }
    name_a_ = a;
    if (numbers_ + 2 * source_ + a + kGap.size() + b <= head_.width) return;
    stand_ = NameLayout::stacked;
    if (numbers_ + source_ + std::max({a, b, kBothNames.size()}) <= head_.width) return;
    stand_ = NameLayout::below;
    const std::size_t taken = kIndent + source_;
    cut_names(head_.width > taken + kMinName ? head_.width - taken : kMinName);
  }

  void cut_names(std::size_t room) {
    std::vector<std::string> names;
    for (const TableLine& line : lines_) {
      names.push_back(line.a.name);
      names.push_back(line.b.name);
    }
    names = shorten_distinctly(names, room);
    for (std::size_t l = 0; l < lines_.size(); ++l) {
      lines_[l].a.name = std::move(names[2 * l]);
      lines_[l].b.name = std::move(names[2 * l + 1]);
    }
  }

  [[nodiscard]] std::string text_of(const SideText& side) const {
    return source_ == 0 ? side.name : left_aligned(side.source, source_) + side.name;
  }

  [[nodiscard]] std::string numbers_text(const TableLine& line) const {
    std::string text;
    for (std::size_t c = 0; c < widths_.size(); ++c) {
      if (widths_[c] == 0) continue;
      const bool is_word = c == kClass || c == kStatus || c == kRelation;
      text += is_word ? left_aligned(line.numbers[c], widths_[c])
                      : right_aligned(line.numbers[c], widths_[c]);
      text += gap_behind(c);
    }
    return text;
  }

  [[nodiscard]] std::string text_of(const TableLine& line) const {
    std::string first = numbers_text(line), second, third;
    const std::string indent(stand_ == NameLayout::below ? kIndent : numbers_, ' ');
    if (stand_ == NameLayout::beside) {
      first += text_of({line.a.source, left_aligned(line.a.name, name_a_)});
      first += std::string(kGap) + text_of(line.b);
    } else if (stand_ == NameLayout::stacked) {
      first += text_of(line.a);
      second = indent + text_of(line.b);
    } else {
      second = indent + text_of(line.a);
      third = indent + text_of(line.b);
    }
    std::string out;
    for (std::string* const part : {&first, &second, &third})
      if (!part->empty()) out += ended(std::move(*part));
    return out;
  }

  std::span<const PairBlock> blocks_;
  PairTableHead head_;
  std::string lead_;
  std::vector<TableLine> lines_;
  std::vector<std::size_t> widths_;       ///< of the columns of TableLine::numbers; 0: left out
  std::size_t numbers_ = 0, source_ = 0;  ///< columns that they take, with gaps
  std::size_t name_a_ = 0;
  NameLayout stand_ = NameLayout::beside;
};

}  // namespace

std::array<std::string, 3> place_text(const geometry::Vec3d& mm) {
  return {fixed(mm.x, 0), fixed(mm.y, 0), fixed(mm.z, 0)};
}

std::string pair_table(std::span<const PairBlock> blocks, const PairTableHead& head) {
  return PairTable(blocks, head).text();
}

}  // namespace strake::report
