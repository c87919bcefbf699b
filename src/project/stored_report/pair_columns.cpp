// SPDX-License-Identifier: Apache-2.0
#include "project/stored_report/pair_columns.hpp"

#include <cstdint>
#include <optional>

#include "project/stored_report/value_columns.hpp"

namespace strake::project {
namespace {

using clash::Pair;

constexpr auto kPoints = {&Pair::point_mm, &Pair::on_a_mm, &Pair::on_b_mm, &Pair::away};
constexpr auto kLengths = {&Pair::d_mm, &Pair::d_lower_mm, &Pair::d_upper_mm};
constexpr auto kNumbers = {&Pair::part_a, &Pair::part_b, &Pair::regions, &Pair::allowed_regions};

}  // namespace

void write_pairs(BlobWriter& out, std::span<const Pair> pairs) {
  const auto put = [&](const auto& value) { write_column(out, pairs, value); };
  const auto byte = [](auto value) { return static_cast<std::uint8_t>(value); };
  put([](const Pair& p) { return index(p.a); });
  put([](const Pair& p) { return index(p.b); });
  put([&](const Pair& p) { return byte(p.cls); });
  put([&](const Pair& p) { return byte(p.relation); });
  put([&](const Pair& p) { return byte(p.level_a); });
  put([&](const Pair& p) { return byte(p.level_b); });
  put([&](const Pair& p) { return byte(p.severest); });
  for (const auto member : kLengths) put([&](const Pair& p) { return p.*member; });
  for (const auto member : kPoints)
    for (const int axis : {0, 1, 2}) put([&](const Pair& p) { return (p.*member)[axis]; });
  for (const auto member : kNumbers) put([&](const Pair& p) { return p.*member; });
  put([](const Pair& p) { return p.flags; });
  put([](const Pair& p) { return p.allowed; });
  put([](const Pair& p) { return p.deep_in_a; });
  put([](const Pair& p) { return p.depth_complete; });
  put([](const Pair& p) { return p.volume_mm3.has_value(); });
  put([](const Pair& p) { return p.volume_mm3.value_or(0); });
}

void read_pairs(BlobReader& in, std::vector<Pair>& pairs) {
  ColumnsInto<Pair> columns(in, pairs);
  columns.first<std::uint32_t>([](Pair& p, std::uint32_t v) { p.a = model::ObjectId{v}; });
  columns.next<std::uint32_t>([](Pair& p, std::uint32_t v) { p.b = model::ObjectId{v}; });
  columns.next_enum(clash::Class::hit, [](Pair& p, clash::Class v) { p.cls = v; });
  columns.next_enum(clash::Relation::cross, [](Pair& p, clash::Relation v) { p.relation = v; });
  columns.next_enum(clash::Level::none, [](Pair& p, clash::Level v) { p.level_a = v; });
  columns.next_enum(clash::Level::none, [](Pair& p, clash::Level v) { p.level_b = v; });
  columns.next_enum(clash::Class::hit, [](Pair& p, clash::Class v) { p.severest = v; });
  for (const auto member : kLengths)
    columns.next<double>([&](Pair& p, double value) { p.*member = value; });
  for (const auto member : kPoints)
    for (const int axis : {0, 1, 2})
      columns.next<double>([&](Pair& p, double value) { (p.*member)[axis] = value; });
  for (const auto member : kNumbers)
    columns.next<std::uint32_t>([&](Pair& p, std::uint32_t value) { p.*member = value; });
  columns.next<std::uint16_t>([](Pair& p, std::uint16_t v) { p.flags = v; });
  columns.next<std::int32_t>([](Pair& p, std::int32_t v) { p.allowed = v; });
  columns.next<bool>([](Pair& p, bool v) { p.deep_in_a = v; });
  columns.next<bool>([](Pair& p, bool v) { p.depth_complete = v; });
  columns.next<bool>([](Pair& p, bool v) { p.volume_mm3 = v ? std::optional(0.0) : std::nullopt; });
  columns.next<double>([](Pair& p, double v) {
    if (p.volume_mm3) p.volume_mm3 = v;
  });
}

}  // namespace strake::project
