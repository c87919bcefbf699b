// SPDX-License-Identifier: Apache-2.0
#include "io/source/text_number.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

#include "io/source/units_and_axes.hpp"

namespace strake::io {
namespace {

constexpr std::int64_t kMantissaDigits = 19;  ///< the digits that 64 bits hold

constexpr bool is_digit(char c) { return static_cast<unsigned char>(c - '0') < 10; }

/// What a scan over the digits of a decimal number found.
struct Scan {
  std::uint64_t mantissa = 0;  ///< of the first kMantissaDigits significant digits
  std::int64_t significant = 0;
  std::int64_t decimals = 0;  ///< digits behind the point
  std::int64_t exponent = 0;  ///< as written
  const char* end = nullptr;  ///< behind the number; null: no number
};

/// Counts and accumulates the digits at `at`; leading zeros are not significant.
const char* scan_digits(const char* at, const char* end, Scan& scan) {
  for (; at != end && is_digit(*at); ++at) {
    const auto digit = static_cast<std::uint64_t>(*at - '0');
    if (scan.significant != 0 || digit != 0) {
      if (scan.significant < kMantissaDigits) scan.mantissa = scan.mantissa * 10 + digit;
      ++scan.significant;
    }
  }
  return at;
}

/// Reads the exponent at `at` ("e-12"), or returns `at` itself when there is none.
const char* scan_exponent(const char* at, const char* end, Scan& scan) {
  if (at == end || (*at != 'e' && *at != 'E')) return at;
  const char* digit = at + 1;
  const bool negative = digit != end && *digit == '-';
  if (digit != end && (*digit == '-' || *digit == '+')) ++digit;
  if (digit == end || !is_digit(*digit)) return at;
  for (; digit != end && is_digit(*digit); ++digit)
    if (scan.exponent < 100'000'000) scan.exponent = scan.exponent * 10 + (*digit - '0');
  if (negative) scan.exponent = -scan.exponent;
  return digit;
}

Scan scan_decimal(const char* at, const char* end) {
  Scan scan;
  const char* const whole = at;
  at = scan_digits(at, end, scan);
  std::int64_t count = at - whole;
  if (at != end && *at == '.') {
    const char* const fraction = at + 1;
    at = scan_digits(fraction, end, scan);
    scan.decimals = at - fraction;
    count += scan.decimals;
  }
  if (count == 0) return scan;
  scan.end = scan_exponent(at, end, scan);
  return scan;
}

/// The powers of ten that a double has exactly.
constexpr std::array<double, 23> kPowers{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                         1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                         1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
constexpr std::int64_t kMaxPower = kPowers.size() - 1;

double power_of_ten(std::int64_t n) {
  const std::int64_t size = n < 0 ? -n : n;
  if (size > kMaxPower) return std::pow(10.0, static_cast<double>(n));
  const double power = kPowers[static_cast<std::size_t>(size)];
  return n < 0 ? 1 / power : power;
}

/// Numbers that one correctly rounded multiplication or division gives exactly (Clinger 1990).
bool simple_value(const Scan& scan, double& value) {
  const std::int64_t power = scan.exponent - scan.decimals;
  if (scan.significant > kMantissaDigits || scan.mantissa > (std::uint64_t{1} << 53)) return false;
  if (power < -kMaxPower || power > kMaxPower) return false;
  const auto mantissa = static_cast<double>(scan.mantissa);
  value = power < 0 ? mantissa / kPowers[static_cast<std::size_t>(-power)]
                    : mantissa * kPowers[static_cast<std::size_t>(power)];
  return true;
}

/// Records what the value of a number tells of float32.
void compare_with_float32(const Scan& scan, double value, DigitStatistics& digits) {
  constexpr std::int64_t kFloatDigits = std::numeric_limits<float>::max_digits10;
  if (!(std::fabs(value) <= static_cast<double>(std::numeric_limits<float>::max()))) return;
  const double off = std::fabs(value - static_cast<double>(static_cast<float>(value)));
  // Half a step of the last digit, and what rounding the number to a double may add.
  constexpr double kRounding = std::numeric_limits<double>::epsilon();
  if (off > 0 &&
      off > power_of_ten(scan.exponent - scan.decimals) / 2 + kRounding * std::fabs(value)) {
    digits.beyond_float32 = true;
  } else if (scan.significant > kFloatDigits && !digits.shows_float32) {
    // Zeros at the end of fixed notation are no digits that count.
    std::uint64_t mantissa = scan.mantissa;
    std::int64_t significant_digits = std::min<std::int64_t>(scan.significant, kMantissaDigits);
    for (; significant_digits > kFloatDigits && mantissa % 10 == 0; mantissa /= 10)
      --significant_digits;
    digits.shows_float32 = significant_digits > kFloatDigits;
  }
}

double hard_value(const Scan& scan, const char* begin) {
  double value = 0;
  const auto answer = std::from_chars(begin, scan.end, value);
  if (answer.ec != std::errc::result_out_of_range) return value;
  // Out of range on either side: the decimal point's place tells which.
  const std::int64_t magnitude = scan.significant + scan.exponent - scan.decimals;
  return magnitude > 0 ? std::numeric_limits<double>::infinity() : 0.0;
}

/// Reads "inf", "nan" and their longer spellings.
bool read_special(const char*& at, const char* end, double& value) {
  const auto answer = std::from_chars(at, end, value);
  if (answer.ec != std::errc()) return false;
  at = answer.ptr;
  return true;
}

}  // namespace

void DigitStatistics::merge(const DigitStatistics& other) {
  max_significant_digits = std::max(max_significant_digits, other.max_significant_digits);
  max_decimals = std::max(max_decimals, other.max_decimals);
  shows_float32 = shows_float32 || other.shows_float32;
  beyond_float32 = beyond_float32 || other.beyond_float32;
}

bool read_number(const char*& at, const char* end, double& value, DigitStatistics& digits) {
  const char* begin = at;
  const bool negative = begin != end && *begin == '-';
  if (begin != end && (*begin == '-' || *begin == '+')) ++begin;
  const Scan scan = scan_decimal(begin, end);
  if (scan.end == nullptr) {
    if (begin == end || *begin == '-' || !read_special(begin, end, value)) return false;
    at = begin;
  } else {
    if (!simple_value(scan, value)) value = hard_value(scan, begin);
    const auto capped = [](std::int64_t n) {
      return static_cast<std::int16_t>(std::clamp<std::int64_t>(n, 0, 1000));
    };
    digits.max_significant_digits =
        std::max(digits.max_significant_digits, capped(scan.significant));
    if (scan.significant != 0)
      digits.max_decimals = std::max(digits.max_decimals, capped(scan.decimals - scan.exponent));
    compare_with_float32(scan, value, digits);
    at = scan.end;
  }
  if (negative) value = -value;
  return true;
}

double text_half_spacing(const DigitStatistics& digits, double magnitude) {
  constexpr int kDesignDigits = 5;
  if (digits.max_significant_digits <= kDesignDigits) return float32_half_spacing(magnitude);
  // Fixed notation writes the same decimals everywhere; shortest and %g notation the same number
  // of significant digits: the fewer decimals of the two hold at the largest coordinate.
  int whole_digits = 0;
  for (double size = magnitude; size >= 1 && whole_digits < 400; size /= 10) ++whole_digits;
  if (digits.max_decimals == 0 && digits.max_significant_digits >= whole_digits)
    return float32_half_spacing(magnitude);
  const int decimals =
      std::min<int>(digits.max_decimals, digits.max_significant_digits - whole_digits);
  double spacing = 1;
  for (int i = 0; i < decimals; ++i) spacing /= 10;
  for (int i = 0; i > decimals; --i) spacing *= 10;
  const bool is_float32 = digits.shows_float32 && !digits.beyond_float32;
  return std::max(spacing / 2, is_float32 ? float32_half_spacing(magnitude) : 0.0);
}

}  // namespace strake::io
