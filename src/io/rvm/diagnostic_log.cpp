// SPDX-License-Identifier: Apache-2.0
#include "io/rvm/diagnostic_log.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace strake::io::rvm {

std::string DiagnosticLog::where(std::uint64_t offset) const {
  if (marks_ == nullptr) return fmt::format("{}, byte {}", file_, offset);
  const auto after = std::upper_bound(
      marks_->begin(), marks_->end(), offset,
      [](std::uint64_t value, const LineMark& mark) { return value < mark.offset; });
  const std::uint64_t line = after == marks_->begin() ? 1 : std::prev(after)->line;
  return fmt::format("{}, line {}", file_, line);
}

}  // namespace strake::io::rvm
