// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nanobind/nanobind.h>

#include <array>
#include <cstdint>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

namespace strake::python {

/// A pair as a row of the array, without padding.
struct ClashRow {
  std::uint32_t test, a, b;
  std::int32_t allowed;
  std::uint8_t kind, relation;
  std::uint16_t flags;
  std::uint32_t regions;
  double separation, lower, upper, depth, distance;
  std::array<double, 3> point, point_on_a, point_on_b, push_out;
  double volume;
};

/// Returns the pairs of all tests in their order.
[[nodiscard]] Result<std::vector<ClashRow>> rows_of(const clash::Findings& findings,
                                                    const parallel::Context& context);

/// Shows rows as a structured array.
[[nodiscard]] nanobind::object array_of_rows(std::vector<ClashRow> rows);

}  // namespace strake::python
