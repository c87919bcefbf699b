// SPDX-License-Identifier: Apache-2.0
#include "strake/core/diagnostics.hpp"

#include <algorithm>
#include <utility>

namespace strake {

Diagnostics::Count& Diagnostics::entry(std::string_view code, Severity severity) {
  const auto found =
      std::find_if(counts_.begin(), counts_.end(), [&](const Count& c) { return c.code == code; });
  if (found != counts_.end()) return *found;
  return counts_.emplace_back(Count{std::string(code), severity, 0});
}

void Diagnostics::add(Diagnostic diagnostic) {
  Count& count = entry(diagnostic.code, diagnostic.severity);
  ++count.count;
  if (count.count <= kMaxPerCode) kept_.push_back(std::move(diagnostic));
}

void Diagnostics::add(Severity severity, std::string_view code, std::string message,
                      std::string where) {
  add(Diagnostic{severity, std::string(code), std::move(message), std::move(where)});
}

void Diagnostics::append(const Diagnostics& other) {
  for (const Diagnostic& d : other.kept_) {
    Count& count = entry(d.code, d.severity);
    if (count.count < kMaxPerCode) kept_.push_back(d);
    ++count.count;
  }
  // Counts what the other run counted but did not keep.
  for (const Count& theirs : other.counts_)
    if (theirs.count > kMaxPerCode)
      entry(theirs.code, theirs.severity).count += theirs.count - kMaxPerCode;
}

void Diagnostics::count_more(std::string_view code, std::uint64_t more) {
  for (Count& c : counts_)
    if (c.code == code && c.count >= kMaxPerCode) c.count += more;
}

void Diagnostics::remove(std::string_view code) {
  std::erase_if(kept_, [&](const Diagnostic& d) { return d.code == code; });
  std::erase_if(counts_, [&](const Count& c) { return c.code == code; });
}

std::uint64_t Diagnostics::count(std::string_view code) const {
  for (const Count& c : counts_)
    if (c.code == code) return c.count;
  return 0;
}

std::uint64_t Diagnostics::skipped() const {
  std::uint64_t sum = 0;
  for (const Count& c : counts_)
    if (c.severity == Severity::skipped) sum += c.count;
  return sum;
}

bool is_code(std::string_view text) {
  constexpr std::size_t kLongest = 64;
  return !text.empty() && text.size() <= kLongest && std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
}

std::string_view severity_name(Severity severity) {
  switch (severity) {
    case Severity::note:
      return "note";
    case Severity::warning:
      return "warning";
    case Severity::skipped:
      break;
  }
  return "skipped";
}

}  // namespace strake
