// SPDX-License-Identifier: Apache-2.0
#include "clash/results/required_clearance.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace strake::clash {
namespace {

/// Returns the tolerances by which a pair was checked: those of its cell where there is a matrix.
const Tolerances& tolerances_of(const Report& report, const Pair& pair) {
  if (report.cells.empty()) return report.options.tolerances;
  const auto cell_of = [](const CellReport& cell) { return std::pair(cell.a, cell.b); };
  const std::pair<std::uint32_t, std::uint32_t> wanted =
      std::minmax(report.discipline[index(pair.a)], report.discipline[index(pair.b)]);
  const auto cell = std::ranges::lower_bound(report.cells, wanted, {}, cell_of);
  const bool there = cell != report.cells.end() && cell_of(*cell) == wanted;
  return there ? cell->tolerances : report.options.tolerances;
}

}  // namespace

std::optional<double> required_clearance_mm(const Report& report, const Pair& pair) {
  const Tolerances& t = tolerances_of(report, pair);
  if (!t.object_clearances) return std::nullopt;
  return t.clearance_mm + t.added_clearance_mm(index(pair.a), index(pair.b));
}

}  // namespace strake::clash
