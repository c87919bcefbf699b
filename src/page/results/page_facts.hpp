// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/report/clash.hpp"
#include "strake/report/decisions.hpp"

namespace strake::page {

/// Different texts by number, in the order in which they came.
class NumberedTexts {
 public:
  std::uint32_t number(std::string_view text);
  [[nodiscard]] const std::vector<std::string>& all() const { return texts_; }

 private:
  std::map<std::string, std::uint32_t, std::less<>> numbers_;
  std::vector<std::string> texts_;
};

/// A result of findings.
struct PageRow {
  std::size_t test = 0, pair = 0;
};

/// The results of all tests in one row, in the order of the clash document.
class PageRows {
 public:
  explicit PageRows(const clash::Findings& findings);
  [[nodiscard]] std::size_t size() const { return first_.back(); }
  [[nodiscard]] PageRow at(std::size_t row) const;

 private:
  std::vector<std::size_t> first_;  ///< of each test, with one more at the end
};

/// What columns of a page count through: names that several tests share.
struct PageNames {
  std::vector<std::string> rules, disciplines;
  std::vector<std::vector<std::uint16_t>> rule_of;        ///< by test, by Report::allowed
  std::vector<std::vector<std::uint16_t>> discipline_of;  ///< by test, by Report::disciplines
};
inline constexpr std::uint16_t kNoName = 0xffff;

/// Names beyond the 65,534th of a kind have the number kNoName.
[[nodiscard]] PageNames page_names(const clash::Findings& findings);

/// Returns the number that pages have for a class: 0 HIT, 1 CONTACT, 2 CLEARANCE_VIOLATION; 255 for
/// none of them.
[[nodiscard]] std::uint8_t class_number(clash::Class cls);

/// Returns the flags of a page: those of a result, and whether its depth is not complete.
[[nodiscard]] std::uint8_t flag_bits(std::uint16_t flags, bool depth_complete);

/// Returns what is decided about each row; null: nothing. It is empty where nothing is known of
/// decisions.
[[nodiscard]] std::vector<const report::DecidedResult*> decided_rows(
    const report::ClashContents& contents, const PageRows& rows);

}  // namespace strake::page
