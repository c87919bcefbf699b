// SPDX-License-Identifier: Apache-2.0
#include "rules/clearances.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/text_encoding.hpp"
#include "core/units.hpp"
#include "model/attributes.hpp"

namespace strake::rules {
namespace {

constexpr const char* kExample =
    "write a length, an attribute or one of each, as '25mm', '@INSU' or '@INSU + 25mm'";

bool is_quote(char c) { return c == '\'' || c == '"'; }

/// Whether the plus sign there is of the exponent of a number: "1e+2mm".
bool is_in_exponent(std::string_view term) {
  const auto is_digit = [](char c) { return (c >= '0' && c <= '9') || c == '.'; };
  return term.size() >= 2 && (term.back() == 'e' || term.back() == 'E') &&
         is_digit(term[term.size() - 2]) && !trimmed(term).starts_with('@');
}

/// Returns what stands between plus signs that are not in quotes, without blanks.
std::vector<std::string_view> terms_of(std::string_view text) {
  std::vector<std::string_view> terms;
  char quote = '\0';
  std::size_t begin = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (is_quote(c)) {
      quote = c;
    } else if (c == '+' && !is_in_exponent(text.substr(begin, i - begin))) {
      terms.push_back(trimmed(text.substr(begin, i - begin)));
      begin = i + 1;
    }
  }
  terms.push_back(trimmed(text.substr(begin)));
  return terms;
}

/// Returns the name in quotes of one kind, in which two of them stand for one; nothing where a
/// quote is missing.
std::optional<std::string> quoted_name(std::string_view text) {
  const char quote = text.front();
  if (text.size() < 2 || text.back() != quote) return std::nullopt;
  std::string name;
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    name += text[i];
    if (text[i] != quote) continue;
    if (i + 2 >= text.size() || text[i + 1] != quote) return std::nullopt;
    ++i;
  }
  return name;
}

/// Returns the name behind the sign of an attribute, written as in selections.
Result<std::string> attribute_of(std::string_view term) {
  constexpr std::string_view kNotInName = " \t()[]{},=!<>~'\"@";
  const std::string_view written = term.substr(1);
  std::optional<std::string> name;
  if (!written.empty() && is_quote(written.front()))
    name = quoted_name(written);
  else if (written.find_first_of(kNotInName) == std::string_view::npos)
    name = std::string(written);
  if (name && !name->empty()) return *name;
  return Error{ErrorCode::usage,
               in_quotes(term) + " names no attribute",
               {},
               "write @NAME, or @'a name with blanks'"};
}

Error twice(std::string_view text, const char* what) {
  return {ErrorCode::usage, in_quotes(text) + " has two " + what, {}, kExample};
}

/// Whether it is a length that a clearance may have.
bool is_clearance(const std::optional<double>& mm) { return mm && *mm >= 0 && *mm <= kLongestMm; }

/// Values of an attribute that are no lengths.
class OddValues {
 public:
  void add(std::string_view value, const model::Object& object) {
    if (first_ == nullptr) first_ = &object;
    if (std::exchange(last_, &object) != &object) ++objects_;
    ++uses_[value];
  }

  void report(const std::string& attribute, Diagnostics& diagnostics) const {
    if (first_ == nullptr) return;
    diagnostics.add(
        Severity::warning, kNotALength,
        "the attribute " + in_quotes(attribute) + " of " + std::to_string(objects_) +
            (objects_ == 1 ? " object" : " objects") +
            " is no length from 0 to 1km and adds nothing to the clearance: " + values(),
        first_->id);
  }

 private:
  /// Returns the values with the most uses, and how many more there are.
  [[nodiscard]] std::string values() const {
    constexpr std::size_t kMax = 5;
    std::vector<std::pair<std::string_view, std::uint64_t>> all(uses_.begin(), uses_.end());
    std::ranges::sort(all, [](const auto& x, const auto& y) {
      return x.second != y.second ? x.second > y.second : x.first < y.first;
    });
    std::string out;
    for (std::size_t i = 0; i < std::min(kMax, all.size()); ++i)
      out += (i == 0 ? "" : ", ") + in_quotes(all[i].first) + " (" + std::to_string(all[i].second) +
             ")";
    return all.size() > kMax ? out + " and " + std::to_string(all.size() - kMax) + " more" : out;
  }

  std::map<std::string_view, std::uint64_t> uses_;
  const model::Object *first_ = nullptr, *last_ = nullptr;
  std::uint64_t objects_ = 0;
};

}  // namespace

Result<WrittenClearance> parse_clearance(std::string_view text) {
  WrittenClearance written;
  bool has_length = false;
  for (const std::string_view term : terms_of(text)) {
    if (term.starts_with('@')) {
      if (!written.attribute.empty()) return twice(text, "attributes");
      Result<std::string> attribute = attribute_of(term);
      if (!attribute) return attribute.error();
      written.attribute = std::move(*attribute);
      continue;
    }
    const Result<double> length = parse_distance_mm(term);
    if (!length) return length.error();
    if (std::exchange(has_length, true)) return twice(text, "lengths");
    written.mm = *length;
  }
  return written;
}

std::shared_ptr<const clash::ObjectClearances> object_clearances(const model::Model& model,
                                                                 const std::string& attribute,
                                                                 const std::string& where,
                                                                 Diagnostics& diagnostics) {
  auto clearances = std::make_shared<clash::ObjectClearances>();
  clearances->attribute = attribute;
  clearances->mm.assign(model.objects.size(), 0);
  bool some = false;
  OddValues odd;
  for (std::size_t o = 0; o < model.objects.size(); ++o)
    for (const std::string_view value : model::values_of(model, model.objects[o], attribute)) {
      const std::optional<double> mm = model::length_of_value_mm(value);
      some = true;
      if (is_clearance(mm))
        clearances->mm[o] = std::max(clearances->mm[o], *mm);
      else
        odd.add(value, model.objects[o]);
    }
  odd.report(attribute, diagnostics);
  if (!some)
    diagnostics.add(Severity::warning, kNoSuchAttribute,
                    "no object has the attribute " + in_quotes(attribute) +
                        ", so it adds nothing to any clearance",
                    where);
  return clearances;
}

}  // namespace strake::rules
