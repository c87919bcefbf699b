// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "strake/core/result.hpp"

namespace strake::io {

/// Converts Windows-1252 bytes (a superset of printable ISO-8859-1) to UTF-8.
[[nodiscard]] std::string from_windows_1252(std::string_view text);

/// Turns the bytes of names and attributes into UTF-8.
///
/// Without a stated encoding, bytes stay as they are when they are valid UTF-8, otherwise they
/// count as Windows-1252. With a stated encoding, bytes that it does not know become U+FFFD.
class TextDecoder {
 public:
  TextDecoder() = default;
  /// Makes a decoder for any name that the system's converter knows: "UTF-8", "GB18030",
  /// "Shift_JIS", "EUC-KR" …
  [[nodiscard]] static Result<TextDecoder> for_encoding(const std::string& name);

  [[nodiscard]] std::string operator()(std::string_view text) const;
  [[nodiscard]] std::string operator()(std::span<const std::byte> bytes) const {
    return (*this)(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  }

 private:
  struct Converter;
  std::shared_ptr<Converter> converter_;
};

}  // namespace strake::io
