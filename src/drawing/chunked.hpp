// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "strake/drawing/write.hpp"

namespace strake::drawing {

/// Gathers small texts into pieces worth handing to a sink.
class Chunked {
 public:
  explicit Chunked(Sink sink) : sink_(sink) {}
  Chunked(const Chunked&) = delete;
  Chunked& operator=(const Chunked&) = delete;
  ~Chunked() { flush(); }

  Chunked& operator<<(std::string_view text) {
    buffer_ += text;
    if (buffer_.size() >= kPiece) flush();
    return *this;
  }
  /// For what appends numbers in place.
  [[nodiscard]] std::string& buffer() { return buffer_; }

 private:
  static constexpr std::size_t kPiece = 65536;
  void flush() {
    if (!buffer_.empty()) sink_(buffer_);
    buffer_.clear();
  }
  Sink sink_;
  std::string buffer_;
};

}  // namespace strake::drawing
