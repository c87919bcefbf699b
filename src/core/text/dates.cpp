// SPDX-License-Identifier: Apache-2.0
#include "core/text/dates.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>

#include "core/text_encoding.hpp"

namespace strake {
namespace {

/// Reads a number of so many digits at a place of a text.
std::optional<int> digits_at(std::string_view text, std::size_t at, std::size_t count) {
  if (at + count > text.size()) return std::nullopt;
  int value = 0;
  for (const char c : text.substr(at, count)) {
    if (c < '0' || c > '9') return std::nullopt;
    value = 10 * value + (c - '0');
  }
  return value;
}

/// Reads what stands behind the seconds: a fraction, which is dropped, and a zone, in minutes.
std::optional<int> zone_minutes(std::string_view rest) {
  if (rest.starts_with('.')) {
    rest.remove_prefix(1);
    rest.remove_prefix(std::min(rest.find_first_not_of("0123456789"), rest.size()));
  }
  if (rest.empty() || rest == "Z") return 0;
  constexpr std::size_t kLength = 6;  // +01:00
  if (rest.size() != kLength || (rest[0] != '+' && rest[0] != '-') || rest[3] != ':')
    return std::nullopt;
  const std::optional<int> hours = digits_at(rest, 1, 2), minutes = digits_at(rest, 4, 2);
  if (!hours || !minutes) return std::nullopt;
  const int total = 60 * *hours + *minutes;
  constexpr int kFarthest = 14 * 60;
  if (*minutes > 59 || total > kFarthest) return std::nullopt;
  return rest[0] == '-' ? -total : total;
}

/// Returns a number of at least so many digits.
template <class Number>
std::string padded(Number number, std::size_t digits) {
  const std::string text = std::to_string(number);
  return std::string(digits - std::min(digits, text.size()), '0') + text;
}

/// A time as it is written, each part as it stands there.
struct TimeParts {
  int year = 0, month = 0, day = 0, hours = 0, minutes = 0, seconds = 0;
};

/// Returns a time in UTC that was told so many minutes before it; nothing where there is none such.
std::optional<std::string> utc_text(const TimeParts& parts, int zone) {
  namespace chrono = std::chrono;
  const chrono::year_month_day day{chrono::year(parts.year),
                                   chrono::month(static_cast<unsigned>(parts.month)),
                                   chrono::day(static_cast<unsigned>(parts.day))};
  // Seconds that are put in before midnight count as those after it; 24:00 is the next day.
  if (!day.ok() || parts.hours > 24 || parts.minutes > 59 || parts.seconds > 60)
    return std::nullopt;
  if (parts.hours == 24 && parts.minutes + parts.seconds > 0) return std::nullopt;
  const chrono::sys_seconds at = chrono::sys_days(day) + chrono::hours(parts.hours) +
                                 chrono::minutes(parts.minutes) + chrono::seconds(parts.seconds) -
                                 chrono::minutes(zone);
  const chrono::sys_days midnight = chrono::floor<chrono::days>(at);
  const chrono::year_month_day utc(midnight);
  // The schemas of XML know no year 0.
  if (utc.year() < chrono::year(1) || utc.year() > chrono::year(9999)) return std::nullopt;
  const chrono::hh_mm_ss time(at - midnight);
  return padded(static_cast<int>(utc.year()), 4) + '-' +
         padded(static_cast<unsigned>(utc.month()), 2) + '-' +
         padded(static_cast<unsigned>(utc.day()), 2) + 'T' + padded(time.hours().count(), 2) + ':' +
         padded(time.minutes().count(), 2) + ':' + padded(time.seconds().count(), 2) + 'Z';
}

/// Whether a text has digits where a form has zeros, and its other characters where it has others.
bool has_form(std::string_view text, std::string_view form) {
  if (text.size() < form.size()) return false;
  for (std::size_t i = 0; i < form.size(); ++i)
    if (form[i] == '0' ? text[i] < '0' || text[i] > '9' : text[i] != form[i]) return false;
  return true;
}

constexpr std::string_view kBlanks = " \t\r\n";

}  // namespace

bool is_day(std::string_view text) {
  constexpr std::string_view kForm = "0000-00-00";
  return text.size() == kForm.size() && has_form(text, kForm);
}

std::optional<std::string> utc_of(std::string_view date) {
  date = trimmed(date, kBlanks);
  constexpr std::string_view kForm = "0000-00-00T00:00:00";
  if (!has_form(date, kForm)) return std::nullopt;
  const std::optional<int> zone = zone_minutes(date.substr(kForm.size()));
  if (!zone) return std::nullopt;
  const auto part = [&](std::size_t at, std::size_t count) {
    return digits_at(date, at, count).value_or(0);
  };
  return utc_text({part(0, 4), part(5, 2), part(8, 2), part(11, 2), part(14, 2), part(17, 2)},
                  *zone);
}

std::optional<std::string> utc_of_c_time(std::string_view date) {
  date = trimmed(date, kBlanks);
  constexpr std::string_view kMonths = "JanFebMarAprMayJunJulAugSepOctNovDec";
  constexpr std::size_t kLength = 24;  // Thu Jul 11 09:38:20 2013
  if (date.size() != kLength || !has_form(date.substr(11), "00:00:00 0000")) return std::nullopt;
  const std::size_t month = kMonths.find(date.substr(4, 3));
  std::string day(date.substr(8, 2));
  if (day[0] == ' ') day[0] = '0';
  if (month == std::string_view::npos || month % 3 != 0 || !has_form(day, "00"))
    return std::nullopt;
  const auto part = [&](std::size_t at, std::size_t count) {
    return digits_at(date, at, count).value_or(0);
  };
  return utc_text({part(20, 4), static_cast<int>(month / 3) + 1, digits_at(day, 0, 2).value_or(0),
                   part(11, 2), part(14, 2), part(17, 2)},
                  0);
}

}  // namespace strake
