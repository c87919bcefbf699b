// SPDX-License-Identifier: Apache-2.0
#include "iges_syntax.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <system_error>

namespace strake::import_step {
namespace {

constexpr std::size_t kLetter = 72, kLength = 80, kCountWidth = 7;
constexpr std::string_view kSections = "SGDPT";

bool is_number(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return c == ' ' || (c >= '0' && c <= '9'); });
}

/// Returns a number that stands to the right of a field.
std::optional<std::uint64_t> number_in(std::string_view field) {
  field.remove_prefix(std::min(field.find_first_not_of(' '), field.size()));
  std::uint64_t number = 0;
  const auto [end, fault] = std::from_chars(field.data(), field.data() + field.size(), number);
  if (fault != std::errc() || end != field.data() + field.size()) return std::nullopt;
  return number;
}

/// Walks over the lines of a file.
class Walk {
 public:
  explicit Walk(const std::filesystem::path& file) : file_(file) {}

  [[nodiscard]] Status take(std::string_view line, bool is_last) {
    ++line_;
    if (is_ended_) return line.find_first_not_of(' ') == std::string_view::npos ? Status{} : end();
    if (line.size() < kLength && is_last)
      return Error{ErrorCode::input, fmt::format("the file ends too soon, within line {}", line_),
                   file_.string(), "copy or export it again"};
    if (line.size() <= kLetter)
      return fault(fmt::format("has {} columns, and one of IGES has {}", line.size(), kLength));
    const std::size_t section = kSections.find(line[kLetter]);
    if (section == std::string_view::npos || !is_iges_line(line, line[kLetter]))
      return fault("has no letter of a section in column 73 with a number behind it");
    if (section < section_)
      return fault(fmt::format("is of section {}, behind lines of section {}", kSections[section],
                               kSections[section_]));
    section_ = section;
    const auto number = number_in(line.substr(kLetter + 1, kLength - kLetter - 1));
    if (number != ++counts_[section])
      return fault(fmt::format("is not line {} of section {}: lines before it are missing",
                               counts_[section], kSections[section]));
    return kSections[section] == 'T' ? check_counts(line) : Status{};
  }

  [[nodiscard]] Status finish() const {
    if (is_ended_) return {};
    return Error{ErrorCode::input,
                 fmt::format("the file ends too soon: behind line {}, in section {}, the T line is "
                             "missing",
                             line_, kSections[section_]),
                 file_.string(), "copy or export it again"};
  }

 private:
  [[nodiscard]] Error fault(const std::string& what) const {
    return {ErrorCode::input, fmt::format("line {} {}", line_, what), file_.string(),
            "the file is damaged or cut off: copy or export it again"};
  }
  [[nodiscard]] Status end() const { return fault("is behind the T line, which is the last"); }

  /// The last line says how many lines each section has: S0000001G0000004D0000010P0000005.
  [[nodiscard]] Status check_counts(std::string_view line) {
    is_ended_ = true;
    for (std::size_t k = 0; k + 1 < kSections.size(); ++k) {
      const std::string_view field = line.substr(k * (kCountWidth + 1), kCountWidth + 1);
      const auto stated = field[0] == kSections[k] ? number_in(field.substr(1)) : std::nullopt;
      if (!stated)
        return fault(fmt::format("does not say how many lines section {} has", kSections[k]));
      if (stated != counts_[k])
        return fault(fmt::format("says that section {} has {} lines, and it has {}", kSections[k],
                                 *stated, counts_[k]));
    }
    return {};
  }

  const std::filesystem::path& file_;
  std::size_t line_ = 0, section_ = 0;
  std::array<std::uint64_t, kSections.size()> counts_{};
  bool is_ended_ = false;
};

}  // namespace

bool is_iges_line(std::string_view line, char section) {
  return line.size() >= kLength && line[kLetter] == section &&
         is_number(line.substr(kLetter + 1, kLength - kLetter - 1));
}

Status check_iges_syntax(std::string_view text, const std::filesystem::path& file) {
  Walk walk(file);
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (const Status status = walk.take(line, text.empty()); !status) return status;
  }
  return walk.finish();
}

}  // namespace strake::import_step
