// SPDX-License-Identifier: Apache-2.0
#include "io/source/text_decoder.hpp"

#include <iconv.h>

#include <array>
#include <cerrno>
#include <cstdint>

#include "core/text_encoding.hpp"

namespace strake::io {

std::string from_windows_1252(std::string_view text) {
  // 0x80 to 0x9F; the five holes keep their C1 code as the WHATWG encoding standard has it.
  static constexpr std::array<std::uint16_t, 32> kHigh = {
      0x20AC, 0x0081, 0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
      0x2039, 0x0152, 0x008D, 0x017D, 0x008F, 0x0090, 0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
      0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x009D, 0x017E, 0x0178};
  std::string out;
  out.reserve(text.size() + text.size() / 8);
  for (const char c : text) {
    const std::uint32_t byte = static_cast<unsigned char>(c);
    append_utf8(out, byte >= 0x80 && byte < 0xA0 ? kHigh[byte - 0x80] : byte);
  }
  return out;
}

struct TextDecoder::Converter {
  iconv_t handle;
  explicit Converter(iconv_t h) : handle(h) {}
  Converter(const Converter&) = delete;
  Converter& operator=(const Converter&) = delete;
  ~Converter() { iconv_close(handle); }
};

Result<TextDecoder> TextDecoder::for_encoding(const std::string& name) {
  const iconv_t handle = iconv_open("UTF-8", name.c_str());
  // iconv_open reports failure as the address -1.
  if (reinterpret_cast<std::intptr_t>(handle) == -1)
    return Error{ErrorCode::usage, "the text encoding \"" + name + "\" is not known", "",
                 "use a name such as UTF-8, ISO-8859-1, GB18030, Shift_JIS or EUC-KR"};
  TextDecoder decoder;
  decoder.converter_ = std::make_shared<Converter>(handle);
  return decoder;
}

std::string TextDecoder::operator()(std::string_view text) const {
  if (converter_ == nullptr) return is_utf8(text) ? std::string(text) : from_windows_1252(text);
  const iconv_t handle = converter_->handle;
  iconv(handle, nullptr, nullptr, nullptr, nullptr);
  std::string source(text), out;
  char* in = source.data();
  std::size_t in_left = source.size();
  std::array<char, 256> buffer{};
  while (in_left > 0) {
    char* to = buffer.data();
    std::size_t to_left = buffer.size();
    const std::size_t rc = iconv(handle, &in, &in_left, &to, &to_left);
    out.append(buffer.data(), buffer.size() - to_left);
    if (rc != static_cast<std::size_t>(-1) || errno == E2BIG) continue;
    out += kReplacement;
    ++in;
    --in_left;
  }
  return out;
}

}  // namespace strake::io
