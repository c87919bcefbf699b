// SPDX-License-Identifier: Apache-2.0
// Writers of long texts: through a buffer, and in batches that are encoded in parallel.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <string_view>

#include "strake/core/result.hpp"
#include "strake/drawing/write.hpp"
#include "strake/parallel/pipeline.hpp"
#include "strake/parallel/progress.hpp"

namespace strake::drawing {

/// Gathers text and hands it on in large chunks. Exceptions of the sink are passed on to the owner.
class BufferedWriter {
 public:
  explicit BufferedWriter(Sink sink) : sink_(sink) {}
  /// Flushes, unless an exception is unwinding: the text has been cut short then and is dropped.
  ~BufferedWriter() noexcept(false) {
    if (std::uncaught_exceptions() == exceptions_) flush();
  }
  BufferedWriter(const BufferedWriter&) = delete;
  BufferedWriter& operator=(const BufferedWriter&) = delete;
  BufferedWriter(BufferedWriter&&) = delete;
  BufferedWriter& operator=(BufferedWriter&&) = delete;

  BufferedWriter& operator<<(std::string_view text) {
    text_ += text;
    done();
    return *this;
  }
  /// Returns the buffer to append to in place; call done() after each record.
  [[nodiscard]] std::string& text() { return text_; }
  void done() {
    if (text_.size() >= kFull) flush();
  }
  /// Hands on what has been gathered.
  void flush() {
    if (text_.empty()) return;
    // A sink that throws gets no text twice. Both buffers keep their memory.
    handed_over_.clear();
    handed_over_.swap(text_);
    sink_(handed_over_);
  }

 private:
  static constexpr std::size_t kFull = std::size_t{1} << 16U;
  Sink sink_;
  std::string text_, handed_over_;
  int exceptions_ = std::uncaught_exceptions();
};

/// Makes the pieces of n items in parallel and hands them on in order: make(i) returns the i-th,
/// take(piece, i) takes it, by one worker at a time. 64 pieces are held at a time. What `take`
/// throws comes out. Errors: cancelled, out of memory.
template <class Make, class Take>
[[nodiscard]] Status make_in_order(std::string_view name, std::size_t n, Make&& make, Take&& take,
                                   const parallel::Context& context) {
  struct Piece {
    std::size_t i = 0;
    std::string text;
  };
  std::size_t next = 0;
  std::exception_ptr thrown;
  const Status status = parallel::pipeline(
      context, {.name = name, .in_flight = 64},
      [&]() -> std::optional<std::size_t> {
        if (next >= n) return std::nullopt;
        return next++;
      },
      [&](std::size_t i) { return Piece{i, make(i)}; },
      [&](const Piece& piece) -> Status {
        try {
          take(piece.text, piece.i);
        } catch (...) {
          thrown = std::current_exception();
          return Error{ErrorCode::internal, "the sink threw", {}, {}};
        }
        return {};
      });
  if (thrown) std::rethrow_exception(thrown);
  return status;
}

/// Writes n items in order and makes their bytes in parallel: encode(begin, end, out) appends those
/// of a run. The bytes of 65,536 items are held at a time. What the sink throws comes out. Errors:
/// cancelled, out of memory.
template <class Encode>
[[nodiscard]] Status write_in_batches(std::string_view name, std::size_t n, Encode&& encode,
                                      Sink sink, const parallel::Context& context) {
  constexpr std::size_t kRun = 1024;
  const parallel::ProgressPhase phase(context.progress, name, n);
  const auto items = [&](std::size_t run) { return std::min(kRun, n - run * kRun); };
  return make_in_order(
      name, (n + kRun - 1) / kRun,
      [&](std::size_t run) {
        std::string text;
        encode(run * kRun, run * kRun + items(run), text);
        return text;
      },
      [&](const std::string& text, std::size_t run) {
        sink(text);
        phase.add(items(run));
      },
      context);
}

}  // namespace strake::drawing
