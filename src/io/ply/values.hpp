// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "io/ply/header.hpp"
#include "io/source/text_number.hpp"

namespace strake::io::ply {

/// Reads the numbers behind a header one after the other, in whichever of the encodings.
class ValueReader {
 public:
  ValueReader(std::string_view text, Encoding encoding) : text_(text), encoding_(encoding) {}

  /// Reads a number; `digits` learns how it is written in text. False where there is none: the text
  /// ends, or what is there is no number.
  [[nodiscard]] bool read(NumberType type, double& value, DigitStatistics& digits);

  /// Returns how many bytes are left.
  [[nodiscard]] std::size_t left() const { return text_.size() - at_; }
  [[nodiscard]] std::size_t offset() const { return at_; }

 private:
  std::string_view text_;
  Encoding encoding_;
  std::size_t at_ = 0;
};

}  // namespace strake::io::ply
