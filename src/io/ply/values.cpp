// SPDX-License-Identifier: Apache-2.0
#include "io/ply/values.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace strake::io::ply {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are read as they lie");

template <class T>
double value_at(const std::array<char, 8>& bytes) {
  T value{};
  std::memcpy(&value, bytes.data(), sizeof value);
  return static_cast<double>(value);
}

double value_of(NumberType type, const std::array<char, 8>& bytes) {
  switch (type) {
    case NumberType::i8:
      return value_at<std::int8_t>(bytes);
    case NumberType::u8:
      return value_at<std::uint8_t>(bytes);
    case NumberType::i16:
      return value_at<std::int16_t>(bytes);
    case NumberType::u16:
      return value_at<std::uint16_t>(bytes);
    case NumberType::i32:
      return value_at<std::int32_t>(bytes);
    case NumberType::u32:
      return value_at<std::uint32_t>(bytes);
    case NumberType::f32:
      return value_at<float>(bytes);
    case NumberType::f64:
      break;
  }
  return value_at<double>(bytes);
}

}  // namespace

bool ValueReader::read(NumberType type, double& value, DigitStatistics& digits) {
  if (encoding_ == Encoding::text) {
    const char* at = text_.data() + at_;
    const char* const end = text_.data() + text_.size();
    while (at != end && (is_blank(*at) || *at == '\n')) ++at;
    if (!read_number(at, end, value, digits)) return false;
    at_ = static_cast<std::size_t>(at - text_.data());
    return true;
  }
  const std::size_t size = bytes_of(type);
  if (size > left()) return false;
  std::array<char, 8> bytes{};
  std::memcpy(bytes.data(), text_.data() + at_, size);
  if (encoding_ == Encoding::big_endian) std::reverse(bytes.begin(), bytes.begin() + size);
  value = value_of(type, bytes);
  at_ += size;
  return true;
}

}  // namespace strake::io::ply
