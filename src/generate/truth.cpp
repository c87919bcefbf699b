// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <iterator>
#include <ostream>
#include <string>

#include "strake/generate/ship.hpp"

namespace strake::generate {
namespace {

std::string_view class_text(clash::Class cls) {
  switch (cls) {
    case clash::Class::hit:
      return "HIT";
    case clash::Class::contact:
      return "CONTACT";
    case clash::Class::clearance_violation:
      return "CLEARANCE_VIOLATION";
    default:
      return "NO_HIT";
  }
}

std::string imported_text(const ShipOptions& options) {
  if (options.imported_detail == 0) return {};
  return fmt::format(", \"imported_detail\": {}, \"imported_triangles\": {}",
                     options.imported_detail, options.imported_triangles);
}

void write_head(const Ship& ship, fmt::memory_buffer& text) {
  std::array<std::uint64_t, 4> counts{};
  for (const TruthPair& pair : ship.truth.pairs) ++counts[static_cast<std::size_t>(pair.cls)];
  fmt::format_to(std::back_inserter(text),
                 "{{\n  \"schema_version\": 1,\n"
                 "  \"generator\": {{\"kind\": \"ship\", \"objects\": {}, \"seed\": {}, "
                 "\"turned\": {}{}}},\n"
                 "  \"settings\": {{\"clearance_mm\": {}, \"touch_gap_mm\": 1, "
                 "\"touch_overlap_mm\": 1, \"thickness_cap\": true}},\n"
                 "  \"counts\": {{\"HIT\": {}, \"CONTACT\": {}, \"CLEARANCE_VIOLATION\": {}}},\n",
                 ship.options.objects, ship.options.seed, ship.options.turned,
                 imported_text(ship.options), Truth::kClearanceMm, counts[3], counts[2], counts[1]);
}

}  // namespace

void write_truth(const Ship& ship, std::ostream& out) {
  constexpr std::size_t kFlush = 1U << 20U;
  fmt::memory_buffer text;
  const auto flush = [&] {
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    text.clear();
  };
  const auto id = [&](model::ObjectId object) -> const std::string& {
    return ship.model.object(object).id;  // letters, digits and dashes: nothing to escape
  };
  write_head(ship, text);
  fmt::format_to(std::back_inserter(text), "  \"inside_out\": [");
  const char* separator = "\n";
  for (const model::ObjectId object : ship.truth.inside_out) {
    fmt::format_to(std::back_inserter(text), "{}    \"{}\"", separator, id(object));
    separator = ",\n";
  }
  fmt::format_to(std::back_inserter(text), "\n  ],\n  \"pairs\": [");
  separator = "\n";
  for (const TruthPair& pair : ship.truth.pairs) {
    fmt::format_to(std::back_inserter(text),
                   "{}    {{\"a\": \"{}\", \"b\": \"{}\", \"class\": \"{}\", \"d_mm\": {}, "
                   "\"why\": \"{}\"}}",
                   separator, id(pair.a), id(pair.b), class_text(pair.cls), pair.d_mm,
                   ship.truth.reasons[pair.why]);
    separator = ",\n";
    if (text.size() > kFlush) flush();
  }
  fmt::format_to(std::back_inserter(text), "\n  ]\n}}\n");
  flush();
}

}  // namespace strake::generate
