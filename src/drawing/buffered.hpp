// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <exception>
#include <string>
#include <string_view>

#include "strake/drawing/write.hpp"

namespace strake::drawing {

/// Gathers text and hands it on in large pieces. What a sink throws goes to whoever made this.
class Buffered {
 public:
  explicit Buffered(Sink sink) : sink_(sink) {}
  /// An exception that unwinds has cut the text short: what is gathered goes nowhere then.
  ~Buffered() noexcept(false) {
    if (std::uncaught_exceptions() == exceptions_) flush();
  }
  Buffered(const Buffered&) = delete;
  Buffered& operator=(const Buffered&) = delete;
  Buffered(Buffered&&) = delete;
  Buffered& operator=(Buffered&&) = delete;

  Buffered& operator<<(std::string_view text) {
    text_ += text;
    done();
    return *this;
  }
  /// What to append to in place; call done() after each record.
  [[nodiscard]] std::string& text() { return text_; }
  void done() {
    if (text_.size() >= kFull) flush();
  }

 private:
  void flush() {
    if (!text_.empty()) sink_(text_);
    text_.clear();
  }
  static constexpr std::size_t kFull = std::size_t{1} << 16U;
  Sink sink_;
  std::string text_;
  int exceptions_ = std::uncaught_exceptions();
};

}  // namespace strake::drawing
