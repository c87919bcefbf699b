// SPDX-License-Identifier: Apache-2.0
#include "python/bindings/clash_rows.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>

#include "python/bindings/arrays.hpp"
#include "strake/parallel/transform.hpp"

namespace nb = nanobind;

namespace strake::python {

namespace {

std::array<double, 3> numbers(const geometry::Vec3d& v) { return {v.x, v.y, v.z}; }

/// A row takes less time than to request it.
constexpr std::size_t kRowsAtOnce = 8192;

ClashRow row_of(std::uint32_t test, const clash::Pair& pair) {
  return {.test = test,
          .a = model::index(pair.a),
          .b = model::index(pair.b),
          .allowed = pair.allowed,
          .kind = static_cast<std::uint8_t>(pair.cls),
          .relation = static_cast<std::uint8_t>(pair.relation),
          .flags = pair.flags,
          .regions = pair.regions,
          .separation = pair.d_mm,
          .lower = pair.d_lower_mm,
          .upper = pair.d_upper_mm,
          .depth = std::max(0.0, -pair.d_mm),
          .distance = std::max(0.0, pair.d_mm),
          .point = numbers(pair.point_mm),
          .point_on_a = numbers(pair.on_a_mm),
          .point_on_b = numbers(pair.on_b_mm),
          .push_out = numbers(pair.away),
          .volume = pair.volume_mm3.value_or(std::numeric_limits<double>::quiet_NaN())};
}

}  // namespace

Result<std::vector<ClashRow>> rows_of(const clash::Findings& findings,
                                      const parallel::Context& context) {
  std::vector<ClashRow> all;
  for (std::size_t t = 0; t < findings.tests.size(); ++t) {
    const std::vector<clash::Pair>& pairs = findings.tests[t].pairs;
    auto rows = parallel::transform(
        context, {.name = "rows", .n = pairs.size(), .grain = kRowsAtOnce},
        [&](std::size_t i) { return row_of(static_cast<std::uint32_t>(t), pairs[i]); });
    if (!rows) return rows.error();
    if (all.empty())
      all = std::move(*rows);
    else
      all.insert(all.end(), rows->begin(), rows->end());
  }
  return all;
}

nb::object array_of_rows(std::vector<ClashRow> rows) {
  static_assert(sizeof(ClashRow) == 168);
#define STRAKE_FIELD(name, format) \
  Field { #name, format, offsetof(ClashRow, name) }
  const std::vector<Field> fields{STRAKE_FIELD(test, "<u4"),
                                  STRAKE_FIELD(a, "<u4"),
                                  STRAKE_FIELD(b, "<u4"),
                                  STRAKE_FIELD(kind, "u1"),
                                  STRAKE_FIELD(relation, "u1"),
                                  STRAKE_FIELD(flags, "<u2"),
                                  STRAKE_FIELD(separation, "<f8"),
                                  STRAKE_FIELD(lower, "<f8"),
                                  STRAKE_FIELD(upper, "<f8"),
                                  STRAKE_FIELD(depth, "<f8"),
                                  STRAKE_FIELD(distance, "<f8"),
                                  STRAKE_FIELD(point, "(3,)<f8"),
                                  STRAKE_FIELD(point_on_a, "(3,)<f8"),
                                  STRAKE_FIELD(point_on_b, "(3,)<f8"),
                                  STRAKE_FIELD(push_out, "(3,)<f8"),
                                  STRAKE_FIELD(volume, "<f8"),
                                  STRAKE_FIELD(allowed, "<i4"),
                                  STRAKE_FIELD(regions, "<u4")};
#undef STRAKE_FIELD
  const auto owner = std::make_shared<std::vector<ClashRow>>(std::move(rows));
  return records_of(owner->data(), owner->size(), sizeof(ClashRow), fields, keep_alive(owner));
}

}  // namespace strake::python
