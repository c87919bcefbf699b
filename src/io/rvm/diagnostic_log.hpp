// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "strake/core/diagnostics.hpp"

namespace strake::io::rvm {

/// Where a chunk of a text-variant file came from: the chunk at byte `offset` of the transcoded
/// stream began on line `line`. Marks ascend by offset.
struct LineMark {
  std::uint64_t offset = 0;
  std::uint64_t line = 0;
};

/// The diagnostics of one file, each with its position there: a byte offset, or a line of a text
/// file.
class DiagnosticLog {
 public:
  DiagnosticLog(Diagnostics& to, std::string file) : to_(&to), file_(std::move(file)) {}

  void use_lines(const std::vector<LineMark>& marks) { marks_ = &marks; }
  void warn(std::string_view code, std::string message, std::uint64_t offset) {
    to_->add(Severity::warning, code, std::move(message), where(offset));
  }
  void skip(std::string_view code, std::string message, std::uint64_t offset) {
    to_->add(Severity::skipped, code, std::move(message), where(offset));
  }
  void note(std::string_view code, std::string message, std::uint64_t offset) {
    to_->add(Severity::note, code, std::move(message), where(offset));
  }
  [[nodiscard]] std::uint64_t count(std::string_view code) const { return to_->count(code); }
  [[nodiscard]] std::string where(std::uint64_t offset) const;

 private:
  Diagnostics* to_;
  std::string file_;
  const std::vector<LineMark>* marks_ = nullptr;
};

}  // namespace strake::io::rvm
