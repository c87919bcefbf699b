// SPDX-License-Identifier: Apache-2.0
#include "io/importer/import_report.hpp"

#include <algorithm>
#include <utility>

#include "core/text_encoding.hpp"

namespace strake::io {
namespace {

constexpr std::string_view kOdd = "import-report", kOther = "import-other";

/// Returns a text as messages show it: one line of valid characters, cut where it is very long.
std::string short_text(const gltf::JsonValue& value, std::size_t limit) {
  if (!value.is_string()) return {};
  std::string text = printable(value.text_value());
  if (text.size() <= limit) return text;
  std::size_t kept = limit;
  while (kept > 0 && (static_cast<unsigned char>(text[kept]) & 0xC0U) == 0x80U) --kept;
  return text.substr(0, kept) + "...";
}

std::optional<Severity> severity_of(std::string_view name) {
  for (const Severity severity : {Severity::note, Severity::warning, Severity::skipped})
    if (name == severity_name(severity)) return severity;
  return std::nullopt;
}

constexpr std::size_t kLongestMessage = 1000, kLongestName = 100;

}  // namespace

void ImportReport::feed(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::size_t end = std::min(bytes.find('\n'), bytes.size());
    if (line_.size() + end > kLongestLine) {
      too_long_ = true;
      line_.clear();
    }
    if (!too_long_) line_ += bytes.substr(0, end);
    if (end < bytes.size()) read_line();
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
  }
}

void ImportReport::end() { read_line(); }

void ImportReport::note_odd() {
  facts_.diagnostics.add(Severity::warning, kOdd,
                         "a line of the importer's report cannot be understood", {});
}

void ImportReport::read_line() {
  const std::string line = std::exchange(line_, {});
  if (std::exchange(too_long_, false)) return note_odd();
  if (trimmed(line, " \t\r").empty()) return;
  const Result<gltf::JsonDocument> document = gltf::JsonDocument::parse(line);
  if (!document || !document->root().is_object()) return note_odd();
  const auto [progress, severity, error, made_by] =
      document->root().pick<4>({"progress", "severity", "error", "made_by"});
  if (error.is_string()) {
    // What comes after the first reason is what follows from it.
    if (!fault_ || fault_->message.empty())
      fault_ = {short_text(error, kLongestMessage),
                short_text(document->root()["mend"], kLongestMessage)};
  } else if (severity.is_string()) {
    read_diagnostic(document->root(), severity.text_value());
  } else if (made_by.is_string()) {
    read_end(document->root());
  } else if (const std::optional<double> done = progress.number()) {
    if (*done > progress_) progress_ = std::min(*done, 1.0);
  } else {
    note_odd();
  }
}

void ImportReport::read_diagnostic(const gltf::JsonValue& line, std::string_view severity) {
  const std::optional<Severity> known = severity_of(severity);
  if (!known) return note_odd();
  std::string code = line["code"].text_value();
  const auto& counts = facts_.diagnostics.counts();
  const auto before = std::ranges::find(counts, code, &Diagnostics::Count::code);
  const bool fits = before == counts.end() ? counts.size() < kMaxCodes : before->severity == *known;
  // All of one code count with the severity of the first.
  if (!is_code(code) || !fits)
    code = std::string(kOther) + '-' + std::string(severity_name(*known));
  facts_.diagnostics.add(*known, code, short_text(line["message"], kLongestMessage),
                         short_text(line["object"], kLongestName));
}

void ImportReport::read_end(const gltf::JsonValue& line) {
  complete_ = true;
  facts_.made_by = short_text(line["made_by"], kLongestName);
  facts_.format = short_text(line["format"], kLongestName);
  facts_.unit = short_text(line["unit"], kLongestName);
  facts_.map = map_place_in(line["map"]);
  if (facts_.map && facts_.map->crs.size() > kLongestName) facts_.map.reset();
  if (line["map"].exists() && !facts_.map) note_odd();
  facts_.depends_on.clear();
  line["depends_on"].elements([&](const gltf::JsonValue& file) {
    if (file.is_string() && facts_.depends_on.size() < kMaxDepends)
      facts_.depends_on.push_back(file.text_value());
  });
}

}  // namespace strake::io
