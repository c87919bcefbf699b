// SPDX-License-Identifier: Apache-2.0
// The objects of a PDF file, and the table that finds them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "strake/core/hash.hpp"
#include "strake/drawing/write.hpp"

namespace strake::drawing {

/// Writes objects one after another as PDF 1.7. Each has a number that is reserved before; they may
/// come in any order. The identity of the file is a hash of all that is written: neither the time
/// nor the name of the file. What the sink throws comes out.
class PdfFile {
 public:
  explicit PdfFile(Sink sink);

  [[nodiscard]] std::uint32_t reserve();
  void write_object(std::uint32_t number, std::string_view contents);
  /// `entries` are those of the dictionary, without length and filter; the bytes are as deflated()
  /// gives them.
  void write_stream(std::uint32_t number, std::string_view entries, std::string_view deflated);
  /// Ends the file. All numbers must have their objects.
  void finish(std::uint32_t catalog, std::uint32_t info);

 private:
  void put(std::string_view bytes);
  void begin(std::uint32_t number);

  Sink sink_;
  Hasher hash_;
  std::size_t written_ = 0;
  std::vector<std::size_t> places_;  ///< of each object, by number - 1
};

}  // namespace strake::drawing
