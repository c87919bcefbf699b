// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <exception>
#include <string>
#include <string_view>

#include "strake/clash/clash.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/report/clash.hpp"

namespace strake::report {

/// Gathers text and hands it on in large pieces.
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

  /// What to append to; call done() after each record.
  std::string& text() { return text_; }
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

/// A JSON string with its quotes.
void append_json(std::string& out, std::string_view text);

/// Millimetres to a nanometre, without trailing zeros.
void append_mm(std::string& out, double mm);

/// The same, rounded down or up, so that a bracket stays certain.
void append_mm_down(std::string& out, double mm);
void append_mm_up(std::string& out, double mm);

/// Fields of a result with something between: the bounds of d, the coordinates of a point, the
/// names of the flags, each between quotes.
void append_range(std::string& out, double lower_mm, double upper_mm, std::string_view between);
void append_point(std::string& out, const geometry::Vec3d& mm, std::string_view between);
void append_flags(std::string& out, std::uint16_t flags, std::string_view between,
                  std::string_view quote);

/// At most `columns` characters of the text, the middle left out where it is longer; padded to the
/// left-aligned width. Control characters, those that turn the writing, and bytes that are not
/// UTF-8 become '?'.
[[nodiscard]] std::string fitted(std::string_view text, std::size_t columns);

}  // namespace strake::report
