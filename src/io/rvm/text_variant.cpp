// SPDX-License-Identifier: Apache-2.0
#include "io/rvm/text_variant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "core/text_encoding.hpp"
#include "io/rvm/primitive_chunk.hpp"
#include "io/source/input_file.hpp"
#include "io/source/text_number.hpp"

namespace strake::io::rvm {

namespace {

constexpr std::array<std::string_view, 9> kIds = {"HEAD", "MODL", "CNTB", "CNTE", "PRIM",
                                                  "OBST", "INSU", "COLR", "END:"};

/// Reads lines and numbers of the text. Numbers are read across line breaks; a token in which two
/// fixed-width numbers touch is split after the five decimals of the first.
class LineScanner {
 public:
  explicit LineScanner(std::string_view text) : text_(text) {}

  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }
  [[nodiscard]] std::uint64_t line() const { return line_; }
  [[nodiscard]] std::size_t left() const { return text_.size() - at_; }

  std::string_view next_line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view line = text_.substr(at_, end - at_);
    at_ = std::min(end + 1, text_.size());
    ++line_;
    return line;
  }
  /// Reads the rest of a line whose numbers have been read.
  void finish_line() {
    if (at_ > 0 && text_[at_ - 1] != '\n') next_line();
  }
  [[nodiscard]] std::optional<float> number();
  [[nodiscard]] std::optional<std::uint32_t> count();

 private:
  void skip_blank() {
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '\n')
        ++line_;
      else if (c != ' ' && c != '\t' && c != '\r')
        return;
    }
  }
  std::string_view text_;
  std::size_t at_ = 0;
  std::uint64_t line_ = 1;
};

std::size_t token_length(std::string_view text) {
  const std::size_t end = text.find_first_of(" \t\r\n");
  const std::string_view token = text.substr(0, std::min(end, text.size()));
  const std::size_t dot = token.find('.');
  if (dot == std::string_view::npos || token.find('.', dot + 1) == std::string_view::npos)
    return token.size();
  constexpr std::size_t kDecimals = 5;
  return std::min(dot + 1 + kDecimals, token.size());
}

std::optional<float> LineScanner::number() {
  skip_blank();
  const std::size_t length = token_length(text_.substr(at_, 128));
  std::string_view token = text_.substr(at_, length);
  if (token.starts_with('+')) token.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  const bool too_large = error == std::errc::result_out_of_range;
  if ((error != std::errc() && !too_large) || end != token.data() + token.size())
    return std::nullopt;  // not consumed: it may be the id of the next chunk
  at_ += length;
  return too_large ? std::numeric_limits<float>::infinity() : static_cast<float>(value);
}

std::optional<std::uint32_t> LineScanner::count() {
  skip_blank();
  const std::size_t end = std::min(text_.find_first_of(" \t\r\n", at_), text_.size());
  std::uint32_t value = 0;
  const auto [stop, error] = std::from_chars(text_.data() + at_, text_.data() + end, value);
  if (error != std::errc() || stop != text_.data() + end) return std::nullopt;
  at_ = end;
  return value;
}

class Transcoder {
 public:
  Transcoder(std::string_view text, DiagnosticLog& log) : in_(text), log_(&log) {}
  Transcoded run();

 private:
  [[nodiscard]] bool transcode_chunk(std::string_view id);
  [[nodiscard]] bool numbers(std::size_t n);
  [[nodiscard]] bool integer();
  [[nodiscard]] bool primitive(std::string_view id);
  [[nodiscard]] bool matrix();
  [[nodiscard]] bool facets();
  void name_line();
  void u32(std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
      out_.bytes.push_back(static_cast<std::byte>(value >> shift & 0xFFU));
  }
  void begin(std::string_view id);
  void end();

  LineScanner in_;
  DiagnosticLog* log_;
  Transcoded out_;
  std::size_t chunk_ = 0;
};

void Transcoder::begin(std::string_view id) {
  chunk_ = out_.bytes.size();
  out_.marks.push_back({chunk_, in_.line() - 1});
  for (const char c : id) u32(static_cast<unsigned char>(c));
  u32(0);
  u32(1);
}

void Transcoder::end() {
  const std::uint32_t next = static_cast<std::uint32_t>(out_.bytes.size());
  for (std::size_t k = 0; k < 4; ++k)
    out_.bytes[chunk_ + 16 + k] = static_cast<std::byte>(next >> (24 - 8 * k) & 0xFFU);
}

void Transcoder::name_line() {
  const std::string_view name = trimmed(in_.next_line(), kLineBlanks);
  const std::uint32_t words = static_cast<std::uint32_t>((name.size() + 3) / 4);
  u32(words);
  for (const char c : name) out_.bytes.push_back(static_cast<std::byte>(c));
  out_.bytes.resize(out_.bytes.size() + words * std::size_t{4} - name.size());
}

bool Transcoder::numbers(std::size_t n) {
  for (std::size_t k = 0; k < n; ++k) {
    const auto value = in_.number();
    if (!value) return false;
    u32(std::bit_cast<std::uint32_t>(*value));
  }
  return true;
}

bool Transcoder::integer() {
  const auto value = in_.count();
  if (value) u32(*value);
  return value.has_value();
}

/// Reads a matrix: three rows of four in the text, four columns of three in the chunk.
bool Transcoder::matrix() {
  std::array<float, 12> m{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      const auto value = in_.number();
      if (!value) return false;
      m[3 * column + row] = *value;
    }
  }
  for (const float value : m) u32(std::bit_cast<std::uint32_t>(value));
  return true;
}

bool Transcoder::facets() {
  const auto polygons = in_.count();
  if (!polygons || *polygons > in_.left()) return false;
  u32(*polygons);
  for (std::uint32_t p = 0; p < *polygons; ++p) {
    const auto contours = in_.count();
    if (!contours || *contours > in_.left()) return false;
    u32(*contours);
    for (std::uint32_t c = 0; c < *contours; ++c) {
      const auto vertices = in_.count();
      if (!vertices || *vertices > in_.left() ||
          !(u32(*vertices), numbers(*vertices * std::size_t{6})))
        return false;
    }
  }
  return true;
}

bool Transcoder::primitive(std::string_view id) {
  u32(1);
  const auto kind = in_.count();
  if (!kind) return false;
  u32(*kind);
  if (!matrix() || !numbers(6)) return false;
  if (id != "PRIM") u32(0);  // the text variant carries no transparency
  if (*kind == kFacetKind) return facets();
  return numbers(parameter_count(*kind));
}

bool Transcoder::transcode_chunk(std::string_view id) {
  if (id == "HEAD") {
    u32(1);
    for (int k = 0; k < 4; ++k) name_line();
    return true;
  }
  if (id == "MODL") {
    u32(1);
    name_line();
    name_line();
    return true;
  }
  if (id == "CNTB") {
    u32(1);
    name_line();
    return numbers(3) && integer();
  }
  if (id == "COLR") {
    std::uint32_t rgb = 0;
    if (!integer() || !integer()) return false;
    for (int k = 0; k < 3; ++k) {
      const auto value = in_.count();
      if (!value || *value > 255) return false;
      rgb = rgb << 8 | *value;
    }
    u32(rgb << 8);
    return true;
  }
  if (id == "PRIM" || id == "OBST" || id == "INSU") return primitive(id);
  u32(1);
  return true;
}

/// Whether a line looks like the id of a chunk that is not known: the reader of chunks reports it,
/// its numbers are stray lines.
bool is_like_id(std::string_view line) {
  return line.size() == 4 &&
         std::all_of(line.begin(), line.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
}

Transcoded Transcoder::run() {
  std::uint64_t strays = 0, first_stray = 0;
  bool ended = false;
  while (!in_.at_end() && !ended) {
    const std::string_view line = trimmed(in_.next_line(), kLineBlanks);
    if (line.empty()) continue;
    if (std::find(kIds.begin(), kIds.end(), line) == kIds.end()) {
      if (is_like_id(line)) {
        begin(line);
        end();
      } else if (strays++ == 0) {
        first_stray = in_.line() - 1;
      }
      continue;
    }
    begin(line);
    in_.next_line();  // two integers that carry nothing
    // A chunk that ends, or holds something else, where a number must be remains as short as that:
    // the reader of chunks reports it and what it belongs to.
    ended = transcode_chunk(line) && line == "END:";
    in_.finish_line();
    end();
  }
  if (strays > 0) {
    out_.marks.insert(out_.marks.begin(), LineMark{0, first_stray});
    log_->use_lines(out_.marks);
    log_->skip("rvm-lost-lines", fmt::format("{} lines are no part of any chunk", strays), 0);
    out_.marks.erase(out_.marks.begin());
  }
  return std::move(out_);
}

}  // namespace

bool is_text_variant(std::string_view text) {
  text = without_byte_order_mark(text);
  LineScanner in(text.substr(0, 4096));
  std::string_view line;
  while (!in.at_end() && line.empty()) line = trimmed(in.next_line(), kLineBlanks);
  return line == "HEAD" && in.count() && in.count();
}

Transcoded transcode_text(std::string_view text, DiagnosticLog& log) {
  return Transcoder(without_byte_order_mark(text), log).run();
}

}  // namespace strake::io::rvm
