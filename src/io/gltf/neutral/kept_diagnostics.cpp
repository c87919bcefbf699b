// SPDX-License-Identifier: Apache-2.0
#include "io/gltf/neutral/kept_diagnostics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/text_encoding.hpp"

namespace strake::io::gltf {
namespace {

/// What is noticed of any model that is read, and what is of a run and not of a file.
constexpr std::array<std::string_view, 3> kNoticedAgain{"object-id-positional",
                                                        "coarse-coordinates", "file-given-twice"};

bool is_found_again(std::string_view code) {
  return std::ranges::find(kNoticedAgain, code) != kNoticedAgain.end();
}

std::optional<Severity> severity_of(const JsonValue& word) {
  for (const Severity severity : {Severity::note, Severity::warning, Severity::skipped})
    if (word.is_text(severity_name(severity))) return severity;
  return std::nullopt;
}

}  // namespace

void append_diagnostics(std::string& out, const Diagnostics& diagnostics) {
  std::string kept, more;
  for (const Diagnostic& one : diagnostics.kept()) {
    if (is_found_again(one.code)) continue;
    kept += kept.empty() ? "[\"" : ",[\"";
    kept += severity_name(one.severity);
    kept += '"';
    for (const std::string* const text : {&one.code, &one.message, &one.where}) {
      kept += ',';
      append_json_string(kept, *text);
    }
    kept += ']';
  }
  for (const Diagnostics::Count& count : diagnostics.counts()) {
    if (is_found_again(count.code) || count.count <= Diagnostics::kMaxPerCode) continue;
    more += more.empty() ? "[" : ",[";
    append_json_string(more, count.code);
    fmt::format_to(std::back_inserter(more), ",{}]", count.count - Diagnostics::kMaxPerCode);
  }
  if (!kept.empty()) out += R"(,"diagnostics":[)" + kept + ']';
  if (!more.empty()) out += R"(,"more":[)" + more + ']';
}

Diagnostics diagnostics_of(const JsonValue& scene) {
  // As many as an importer may have; each one is looked for among all.
  constexpr std::size_t kMaxCodes = 500;
  Diagnostics diagnostics;
  scene["diagnostics"].elements([&](const JsonValue& json) {
    const std::vector<JsonValue> items = json.items();
    const std::optional<Severity> severity =
        items.size() == 4 ? severity_of(items[0]) : std::nullopt;
    if (!severity) return;
    std::string code = items[1].text_value();
    const auto& counts = diagnostics.counts();
    const bool fits = counts.size() < kMaxCodes ||
                      std::ranges::find(counts, code, &Diagnostics::Count::code) != counts.end();
    if (!is_code(code) || !fits) code = fmt::format("gltf-other-{}", severity_name(*severity));
    diagnostics.add(*severity, code, items[2].text_value(), items[3].text_value());
  });
  scene["more"].elements([&](const JsonValue& json) {
    const std::vector<JsonValue> items = json.items();
    if (items.size() == 2)
      diagnostics.count_more(items[0].text_value(), items[1].index().value_or(0));
  });
  return diagnostics;
}

}  // namespace strake::io::gltf
